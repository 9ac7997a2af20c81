// The operations on values, and the functions that a listing may call. Every number comes from one operation
// of IEEE 754 after another in the printed order, so that it has the bits of the Rust interpreter
// (src/mathcad); what cannot be had to the last bit, such as a sine, is refused by its name.

/** A finite number, or the overflow that Mathcad reports: no number comes of an overflow before. */
function finite(x) {
  if (Number.isFinite(x)) return x;
  if (Number.isNaN(x)) return finite(Infinity);
  throw new Cause(`Found a number beyond 10^307. («Найдено число величиной более 10^307» in Mathcad 14.1.) The result is ${inDigits(x)}.`);
}

const divisionByZero = (x, y) =>
  new Cause(`Division by zero. («Деление на ноль.» in Mathcad 14.1.) ${inDigits(x)}/${inDigits(y)}.`);

const complex = (name) => new Cause(`unsupported: complex numbers, of which the result of ${name} is one.`);

/** What one of the four operations makes of two numbers. */
function calculate(sign, x, y, settings) {
  if (sign === "+") return finite(x + y);
  if (sign === "−") return finite(x - y);
  if (sign === "·") return finite(x * y);
  if (y !== 0) return finite(x / y);
  if (x === 0 && settings.zero_over_zero_is_zero) return 0;
  throw divisionByZero(x, y);
}

/** What one of the four operations makes of two values. */
function operate(sign, left, right, settings) {
  const [ofNumbers, isMatrix] = [(x, y) => calculate(sign, x, y, settings), isArrayOfNumbers(right) && right.cols > 1];
  if (isNumber(left) && isNumber(right)) return ofNumbers(left, right);
  if (sign === "/" && isMatrix) throw wrongKind("a number or a column to divide by", right);
  if (isNumber(left) && isArrayOfNumbers(right)) return mapped(right, (y) => ofNumbers(left, y));
  if (isArrayOfNumbers(left) && isNumber(right)) return mapped(left, (x) => ofNumbers(x, right));
  if (!isNumber(left) && !isArrayOfNumbers(left)) throw wrongKind("a number or an array", left);
  if (!isArrayOfNumbers(right)) throw wrongKind("a number or an array", right);
  if (sign === "·") return product(left, right);
  if (left.rows !== right.rows || left.cols !== right.cols) throw wrongSizes(sign, left, right);
  return new Grid(left.rows, left.cols, left.entries.map((x, k) => ofNumbers(x, right.entries[k])));
}

const mapped = (array, f) => new Grid(array.rows, array.cols, array.entries.map((x) => f(x)));

/** The sum of `count` terms, one after another from the first; 0 if there is none. */
function sum(count, term) {
  let total = count > 0 ? term(0) : 0;
  for (let k = 1; k < count; k += 1) total += term(k);
  return total;
}

/** The matrix product; of two columns of one length, the scalar product. What has one entry is a number. */
function product(a, b) {
  const isColumn = (array) => array.cols === 1 && array.rows > 1;
  if (isColumn(a) && isColumn(b) && a.rows === b.rows) return finite(sum(a.rows, (k) => a.entries[k] * b.entries[k]));
  if (a.cols !== b.rows) throw wrongSizes("·", a, b);
  const entry = (i, j) => sum(a.cols, (k) => a.entries[i * a.cols + k] * b.entries[k * b.cols + j]);
  const result = gridFrom(a.rows, b.cols, entry);
  result.entries.forEach(finite);
  return result.entries.length === 1 ? result.entries[0] : result;
}

function negative(value) {
  if (isNumber(value)) return -value;
  return mapped(numbersOf(value), (x) => -x);
}

function transposed(value) {
  if (isNumber(value)) return value;
  if (!isArray(value)) throw wrongKind("a number or an array", value);
  return value.transposed();
}

/** An array of numbers, which an operation takes where it takes a number. */
function numbersOf(value) {
  if (!isArrayOfNumbers(value)) throw wrongKind("a number or an array", value);
  return value;
}

/** The power of a number: by repeated squaring from the last bit of a whole exponent. */
function power(x, y) {
  if (!isNumber(x)) throw unsupported("a power of an array in the page");
  if (x === 0 && y < 0) throw divisionByZero(1, 0);
  if (!Number.isInteger(y) && x < 0) throw complex("a power");
  if (!Number.isInteger(y) || Math.abs(y) >= 1e15) throw unsupported("a power that is not whole in the page");
  let [result, square] = [1, x];
  for (let n = Math.abs(y); n > 0; n = Math.floor(n / 2)) {
    if (n % 2 === 1) result *= square;
    square *= square;
  }
  return finite(y < 0 ? 1 / result : result);
}

/** Whether two numbers compare so: exactly, or equal where they differ by less than 1e-12 of their mean. */
function compare(sign, x, y, settings) {
  if (settings.tiny_is_zero) [x, y] = [x, y].map((x) => (Math.abs(x) < 1e-307 ? 0 : x));
  const same = x === y || (!settings.exact_boolean && Math.abs((x - y) / (x / 2 + y / 2)) < 1e-12);
  return ordered(sign, x < y && !same, same, x > y && !same);
}

/** Whether a comparison is true of what is less, the same or greater. */
const ordered = (sign, less, same, greater) =>
  ({ "=": same, "≠": !same, "<": less, "≤": less || same, ">": greater, "≥": greater || same })[sign];

/** The magnitude of a number, the length of a column or the determinant of a matrix. */
function magnitude(value) {
  if (isNumber(value)) return Math.abs(value);
  if (numbersOf(value).cols === 1) return finite(Math.sqrt(sum(value.rows, (k) => value.entries[k] * value.entries[k])));
  if (value.rows !== value.cols || value.rows === 0) throw wrongKind("a square matrix", value);
  const [a, b, c, d] = value.entries;
  if (value.rows === 2) return finite(a * d - b * c);
  const { rows, sign } = factors(value);
  return finite(rows.reduce((product, row, k) => product * row[k], sign));
}

/** A number over a pivot: times its reciprocal, where that is a number. */
const overPivot = (x, pivot) => (Number.isFinite(1 / pivot) ? x * (1 / pivot) : x / pivot);

/** The rows of an eliminated matrix in the order in which they are pivots, each the largest of its column, with
 * the factors left of the pivot; their places before; and the sign of that order. The products of an entry are
 * added up before they are subtracted from it. */
function factors(matrix) {
  const n = matrix.rows;
  const rows = matrix.lists;
  const sums = rows.map((row) => row.map(() => 0));
  const order = rows.map((_, i) => i);
  let sign = 1;
  for (let k = 0; k < n; k += 1) {
    for (let i = k; i < n; i += 1) rows[i][k] -= sums[i][k];
    let largest = k;
    for (let at = k + 1; at < n; at += 1) if (Math.abs(rows[at][k]) > Math.abs(rows[largest][k])) largest = at;
    if (largest !== k) {
      for (const all of [rows, sums, order]) [all[k], all[largest]] = [all[largest], all[k]];
      sign = -sign;
    }
    const pivot = rows[k];
    for (let j = k + 1; j < n; j += 1) pivot[j] -= sums[k][j];
    for (let i = k + 1; i < n; i += 1) {
      const row = rows[i];
      if (row[k] === 0) continue;
      row[k] = overPivot(row[k], pivot[k]);
      for (let j = k + 1; j < n; j += 1) sums[i][j] += row[k] * pivot[j];
    }
  }
  return { rows, order, sign };
}

/** The solution of `a`·x = `b` by elimination with row pivots. */
function lsolve(a, b) {
  if (!isArrayOfNumbers(a) || !isArrayOfNumbers(b)) throw wrongKind("a square matrix and a column", isNumber(a) ? a : b);
  const n = a.rows;
  if (n !== a.cols || n !== b.rows || b.cols !== 1) throw wrongSizes("lsolve", a, b);
  return substituted(factors(a), b);
}

/** The solution from the rows of an eliminated matrix and their order. */
function substituted({ rows, order }, b) {
  const n = order.length;
  const x = order.map((i) => b.entries[i]);
  for (let k = 0; k < n; k += 1) x[k] -= sum(k, (j) => rows[k][j] * x[j]);
  for (let k = n - 1; k >= 0; k -= 1) {
    if (finite(rows[k][k]) === 0) throw new Cause("The matrix is singular.");
    const known = sum(n - 1 - k, (j) => rows[k][k + 1 + j] * x[k + 1 + j]);
    x[k] = finite(overPivot(x[k] - known, rows[k][k]));
  }
  return new Grid(n, 1, x);
}

/** Column `j` of an array. */
function column(array, j, origin) {
  if (!isArray(array)) throw wrongKind("an array", array);
  const [last] = offsets([origin + array.rows - 1], origin, "the array");
  const [col] = offsets([j], origin, "the array");
  if (col >= array.cols) throw outside("the array", [origin + last, j], array);
  return gridOf(1, Array.from({ length: array.rows }, (_, i) => array.get(i, col)));
}

/** The only argument of a function. */
function only(values, count = 1) {
  if (values.length !== count) throw new Cause(`This function has ${count} arguments; ${values.length} were given.`);
  return values[0];
}

/** The smallest or the largest of all numbers of all arguments. */
function extreme(values, isBetter) {
  const all = values.flatMap((value) => (isNumber(value) ? [value] : numbersOf(value).entries));
  if (all.length === 0) throw new Cause("Expected at least one number, found none.");
  return all.reduce((best, x) => (isBetter(x, best) ? x : best));
}

function identity(values) {
  const n = only(values);
  if (!isNumber(n) || !(n >= 0) || !Number.isInteger(n)) throw wrongKind("a whole number", n);
  return gridFrom(n, n, (i, j) => (i === j ? 1 : 0));
}

function root(values) {
  if (values.length === 2) throw unsupported("a root that is not square in the page");
  const x = only(values, values.length === 1 ? 1 : 2);
  if (!isNumber(x)) throw wrongKind("a number", x);
  if (x < 0) throw complex("√");
  return Math.sqrt(x);
}

/** Mathcad's functions that are here, each of the values of its arguments. What is no array has no rows. */
const FUNCTIONS = {
  rows: (values) => (isArray(only(values)) ? values[0].rows : 0),
  cols: (values) => (isArray(only(values)) ? values[0].cols : 0),
  length: (values) => (isArray(only(values)) ? values[0].rows : 0),
  min: (values) => extreme(values, (x, best) => x < best),
  max: (values) => extreme(values, (x, best) => x > best),
  lsolve: (values) => lsolve(only(values, 2), values[1]),
  "√": root,
  identity,
};

/** Those that the Rust interpreter has and the page has not. */
const ELSEWHERE = new Set(
  ("sin cos tan cot sec csc asin acos atan sinh cosh tanh asinh acosh atanh exp ln floor ceil trunc log mod factorial last " +
    "mean sort round augment stack submatrix determinant ∑ ∏ × → eigenvals eigenvecs").split(" "),
);
