// The steps of a program, forwards and backwards.

/** What is shown of a value: of a large array, and of one of arrays, only what it is. */
function shown(value) {
  if (isNumber(value)) return value;
  if (!isArrayOfNumbers(value) || value.entries.length > 36) return interpreted(kindOf(value));
  const row = (i) => value.entries.slice(i * value.cols, (i + 1) * value.cols);
  return value.cols === 1 ? value.entries : Array.from({ length: value.rows }, (_, i) => row(i));
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
    this.replaced = [];
  }

  /** Goes to the state after `at` steps. */
  goTo(at) {
    const wanted = Math.max(0, Math.min(at, this.steps.length));
    while (this.at < wanted) this.forward();
    while (this.at > wanted) this.back();
  }

  forward() {
    const old = [];
    for (const { name, value } of this.steps[this.at].writes) this.write(name, value, old);
    this.replaced[this.at] = old;
    this.at += 1;
  }

  back() {
    this.at -= 1;
    for (const [name, value] of this.replaced[this.at].reverse()) {
      if (value === undefined) this.values.delete(name);
      else this.values.set(name, value);
    }
  }

  /** Writes a value to a name or an entry; a whole array takes the place of all its entries. */
  write(name, value, old) {
    const set = (name, value) => {
      old.push([name, this.values.get(name)]);
      if (value === undefined) this.values.delete(name);
      else this.values.set(name, value);
    };
    if (typeof value !== "number") {
      [...this.values.keys()].filter((other) => other.startsWith(name + "[")).forEach((other) => set(other, undefined));
    }
    set(name, value);
    if (Array.isArray(value)) {
      value.forEach((row, i) => {
        if (Array.isArray(row)) row.forEach((entry, j) => set(`${name}[${i + 1},${j + 1}]`, entry));
        else set(`${name}[${i + 1}]`, row);
      });
    }
  }

  get(name) { return this.values.get(name); }

  /** The step that was executed last, and the next one. */
  get last() { return this.steps[this.at - 1]; }
  get next() { return this.steps[this.at]; }

  /** The turn of the outer loop that step `k` belongs to; null outside, and before the first. */
  turnAt(k) {
    let found = null;
    for (const { from, turn } of this.turns) {
      if (from > k) break;
      found = turn;
    }
    return k < 0 ? null : found;
  }

  /** The next place, in steps, behind the place now at which `is` holds of the step before or
   * behind it; the end where there is none. */
  after(is) {
    for (let at = this.at + 1; at < this.steps.length; at += 1) if (is(at)) return at;
    return this.steps.length;
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
