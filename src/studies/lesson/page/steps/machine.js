// The steps of a program, forwards and backwards.

/** What is shown of a value: of a large array, and of one of arrays, only what it is. */
function shown(value) {
  if (isNumber(value)) return value;
  if (!isArrayOfNumbers(value) || value.entries.length > 36) return interpreted(kindOf(value)).replaceAll(" x ", " × ");
  return value.cols === 1 ? value.entries : value.lists;
}

/** A step: its line's place, what decided it, what it wrote, and what it read, each value once. */
class Step {
  line; turn; held; operands; all; writes;
  constructor({ line, turn, held, operands, reads, writes }) {
    Object.assign(this, { line, turn, held, operands, all: reads, writes: writes.map(accessOf) });
  }

  get reads() {
    const seen = new Map(this.all.map(accessOf).map((read) => [`${read.name} ${exact(read.value)}`, read]));
    return [...seen.values()];
  }
}

function accessOf({ name, subscripts, value }) {
  return { name: subscripts.length ? `${name}[${subscripts.join(",")}]` : name, value: shown(value) };
}

/** A program after some of its steps: `values` has each name and each entry that was written. */
class Machine {
  constructor({ lines, steps, failure }) {
    this.lines = lines;
    this.steps = steps.map((step) => new Step(step));
    this.turns = this.steps.flatMap(({ turn }, from) => (from === 0 || turn !== this.steps[from - 1].turn ? [{ from, turn }] : []));
    this.failure = failure && interpreted(String(failure));
    this.at = 0;
    this.values = new Map();
  }

  /** Goes to the state after `at` steps; backwards from the start. */
  goTo(at) {
    const wanted = Math.max(0, Math.min(at, this.steps.length));
    if (wanted < this.at) [this.at, this.values] = [0, new Map()];
    for (; this.at < wanted; this.at += 1) for (const { name, value } of this.steps[this.at].writes) this.write(name, value);
  }

  /** Writes a value to a name or an entry; a whole array takes the place of all its entries. */
  write(name, value) {
    if (typeof value !== "number") for (const other of this.values.keys()) if (other.startsWith(name + "[")) this.values.delete(other);
    this.values.set(name, value);
    if (!Array.isArray(value)) return;
    value.forEach((row, i) => {
      if (Array.isArray(row)) row.forEach((entry, j) => this.values.set(`${name}[${i + 1},${j + 1}]`, entry));
      else this.values.set(`${name}[${i + 1}]`, row);
    });
  }

  get(name) { return this.values.get(name); }

  /** The step that was executed last, and the next one. */
  get last() { return this.steps[this.at - 1]; }
  get next() { return this.steps[this.at]; }

  /** The turn of the outer loop that step `k` belongs to; null outside, and before the first. */
  turnAt(k) { return this.turns.findLast(({ from }) => from <= k)?.turn ?? null; }

  /** The next place, in steps, behind the place now at which `is` holds of the step before or
   * behind it; the end where there is none. */
  after(is) {
    const found = this.steps.findIndex((_, at) => at > this.at && is(at));
    return found < 0 ? this.steps.length : found;
  }

  /** Where "over" leads: behind the body of the line that was executed last. */
  over() {
    const level = this.last ? this.lines[this.last.line].level : 0;
    return this.last ? this.after((at) => this.lines[this.steps[at].line].level <= level) : 1;
  }
  nextDecision() { return this.after((at) => this.steps[at].held !== null); }
  nextTurn() {
    const begin = this.turns.find(({ from, turn }) => from >= this.at && turn !== null);
    return begin ? begin.from + 1 : this.steps.length;
  }
  /** Behind the next execution of the line at a place of the listing, from the start once more
   * where there is none ahead. */
  runTo(line) {
    const ahead = this.steps.findIndex((step, k) => k >= this.at && step.line === line);
    const any = ahead < 0 ? this.steps.findIndex((step) => step.line === line) : ahead;
    return any < 0 ? this.at : any + 1;
  }
}
