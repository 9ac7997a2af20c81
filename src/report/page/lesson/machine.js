// The steps of a program, forwards and backwards.

/** Opens a step: its line's place, what decided it, what it read and what it wrote. */
function opened(place) {
  const [line, held, operands, reads, writes] = data.steps[place];
  const access = (at) => {
    const [name, value] = data.accesses[at];
    return { name: data.names[name], value: data.values[value] };
  };
  return { line, held, operands, reads: reads.map(access), writes: writes.map(access) };
}

/** A program after some of its steps: `values` has each name and each entry that was written. */
class Machine {
  constructor(program) {
    this.lines = program.lines.map(([number, level, text]) => ({ number, level, text }));
    this.steps = program.steps.map(opened);
    this.turns = program.turns.map(([from, turn]) => ({ from, turn }));
    this.failure = program.failure;
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

  get(name) {
    return this.values.get(name);
  }

  /** The step that was executed last, and the next one. */
  get last() {
    return this.steps[this.at - 1];
  }
  get next() {
    return this.steps[this.at];
  }

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
  nextDecision() {
    return this.after((at) => this.steps[at].held !== null);
  }
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
