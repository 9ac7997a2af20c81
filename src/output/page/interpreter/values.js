// The values of a listing: numbers, strings and arrays, and how messages write them. What is said here of
// Mathcad has its source in src/mathcad/README.md.

/** An array by rows; `depth` is 0 where all entries are numbers, else how deep arrays stand in it. One
 * that is `shared` is copied before it is written to. */
class Grid {
  rows; cols; entries; depth; shared;
  constructor(rows, cols, entries, depth = 0) { Object.assign(this, { rows, cols, entries, depth, shared: false }); }

  /** The entry in row `i` and column `j`, from 0; undefined outside. */
  get(i, j) { return i < this.rows && j < this.cols ? this.entries[i * this.cols + j] : undefined; }
  copy() { return new Grid(this.rows, this.cols, [...this.entries], this.depth); }

  /** Writes an entry and makes the array larger where it does not reach so far; new entries are 0. */
  write(i, j, value) {
    if (i >= this.rows || j >= this.cols) this.grow(Math.max(this.rows, i + 1), Math.max(this.cols, j + 1));
    this.entries[i * this.cols + j] = value;
    if (typeof value !== "number") this.depth = Math.max(this.depth, 1 + depthOf(value));
  }

  grow(rows, cols) { Object.assign(this, { rows, cols, entries: gridFrom(rows, cols, (i, j) => this.get(i, j) ?? 0).entries }); }

  /** Its rows, each a list of entries. */
  get lists() { return Array.from({ length: this.rows }, (_, i) => this.entries.slice(i * this.cols, (i + 1) * this.cols)); }

  transposed() { return gridOf(this.rows, gridFrom(this.cols, this.rows, (i, j) => this.get(j, i)).entries); }
}

/** The array of numbers whose entry in row `i` and column `j`, from 0, is `entry(i, j)`. */
function gridFrom(rows, cols, entry) {
  return new Grid(rows, cols, Array.from({ length: rows * cols }, (_, k) => entry(Math.floor(k / cols), k % cols)));
}

/** The array of entries that are numbers, strings or arrays. */
function gridOf(cols, entries) {
  const depth = entries.every(isNumber) ? 0 : 1 + Math.max(...entries.map(depthOf));
  for (const entry of entries) share(entry);
  return new Grid(cols === 0 ? 0 : entries.length / cols, cols, entries, depth);
}

const isNumber = (value) => typeof value === "number";
const isArray = (value) => value instanceof Grid;
const isArrayOfNumbers = (value) => isArray(value) && value.depth === 0;
const depthOf = (value) => (isArray(value) ? value.depth : 0);

/** Marks a value that several hold. */
function share(value) {
  if (isArray(value)) value.shared = true;
  return value;
}

/** The value that a number, a string, or a list of rows stands for. */
function valueOf(json) {
  if (!Array.isArray(json)) return json;
  return share(gridOf(json.length ? json[0].length : 0, json.flat().map(valueOf)));
}

/** Writes a number with the fewest digits that read back to it, and without an exponent. */
function inDigits(x) {
  if (!Number.isFinite(x)) return Number.isNaN(x) ? "NaN" : x > 0 ? "inf" : "-inf";
  if (Object.is(x, -0)) return "-0";
  const found = /^(-?)(\d)\.?(\d*)e([+-]\d+)$/.exec(String(x));
  if (!found) return String(x);
  const [, sign, first, rest, exponent] = found;
  const places = Number(exponent);
  return places > 0 ? sign + first + rest.padEnd(places, "0") : `${sign}0.${"0".repeat(-places - 1)}${first}${rest}`;
}

/** Writes a value as the function trace does. */
function inText(value) {
  if (isNumber(value)) return inDigits(value);
  if (!isArrayOfNumbers(value)) return isArray(value) ? kindOf(value) : value;
  return value.lists.map((row) => row.map(inDigits).join(" ")).join("; ");
}

/** What a value is, in words for a message. */
function kindOf(value) {
  if (isNumber(value)) return `the number ${inDigits(value)}`;
  if (!isArray(value)) return "a string";
  if (value.depth === 0) return `a ${sizeOf(value)} array`;
  return value.cols === 1 ? `a column of ${value.rows} arrays` : `a ${sizeOf(value)} array of arrays`;
}

const sizeOf = (value) => (isArray(value) ? `${value.rows} x ${value.cols}` : "1 x 1");

/** Why an operation has no value, in words that begin with Mathcad's own where those are known. */
class Cause {
  words; isLimit;
  constructor(words, isLimit = false) { Object.assign(this, { words, isLimit }); }
}

const wrongKind = (expected, found) => new Cause(`Expected ${expected}, found ${kindOf(found)}.`);
const wrongSizes = (sign, a, b) => new Cause(`These array sizes do not match: ${sizeOf(a)} ${sign} ${sizeOf(b)}.`);
const unsupported = (construct) => new Cause(`unsupported: ${construct}.`);
const overLimit = (limit, of) => new Cause(`The limit of ${limit} ${of} is reached.`, true);
const outside = (name, at, array) =>
  new Cause(`This array index is invalid for this array. ${name}${bracketed(at)} of ${sizeOf(array)} entries.`);

const bracketed = (subscripts) => `[${subscripts.map(inDigits).join(",")}]`;

/** The row and the column, from 0, that one subscript or two name; a lone one is of the first column. */
function offsets(subscripts, origin, name) {
  const offset = (x) => {
    if (!Number.isInteger(x)) throw new Cause(`An array index must be an integer: ${name}${bracketed(subscripts)}.`);
    if (x >= origin) return x - origin;
    throw new Cause(`This array index is invalid for this array. ${name}${bracketed(subscripts)} lies below ORIGIN = ${origin}.`);
  };
  return [offset(subscripts[0]), subscripts.length > 1 ? offset(subscripts[1]) : 0];
}

/** The entry of a value that messages call `name`. */
function entryOf(value, subscripts, origin, name) {
  const [i, j] = offsets(subscripts, origin, name);
  if (!isArray(value)) throw wrongKind("an array", value);
  const entry = subscripts.length > 1 || value.cols === 1 ? value.get(i, j) : undefined;
  if (entry === undefined) throw outside(name, subscripts, value);
  return share(entry);
}
