// Running a listing: its statements and expressions, and what each statement reads, decides and writes.

/** Where and why a listing failed: the printed line, the column without the indentation, from 1. */
class Failure {
  listing; line; column; text; statement; cause; isLimit;
  constructor(listing, line, { start, end }, { words, isLimit }) {
    const column = [...line.text.slice(0, start)].length + 1;
    Object.assign(this, { listing, line: line.number, column, text: line.text.slice(start, end), statement: line.text, cause: words, isLimit });
  }

  /** The failure in a sentence, of long texts the first 100 characters. */
  toString() {
    const shown = (text) => ([...text].length > 100 ? `${[...text].slice(0, 100).join("")} ...` : text);
    return `${this.listing}, line ${this.line}: ${this.cause} In \`${shown(this.text)}\`, column ${this.column} of \`${shown(this.statement)}\`.`;
  }
}

/** Keeps every statement that is executed, a `for` line once for each turn. */
class Recorder {
  lines; steps;
  constructor(lines) { Object.assign(this, { lines, steps: [] }); }
  begin(line) { this.steps.push({ line, held: null, operands: [], reads: [], writes: [] }); }

  /** The current statement, a new one when a loop's line comes round again. */
  on(line) {
    const last = this.steps.at(-1);
    if (!last || this.lines[last.line].number !== this.lines[line].number) this.begin(line);
    return this.steps.at(-1);
  }
}

/** What a run may take: statements and turns of loops together; of these, kept by a recorder; numbers of one
 * array; calls within each other. */
const LIMITS = { steps: 20_000, kept: Infinity, entries: 1 << 20, calls: 60 };

/** How much of a step a range may pass its end by: rounding's. */
const RANGE_END = 1e-12;

/** A run of a listing in a worksheet: `values`, `programs` and `functions` by their names, and Mathcad's other
 * names, `known`. */
class Run {
  listing; worksheet; settings; limits; recorder; line; last; held;
  constructor(listing, worksheet, settings, { limits = LIMITS, recorder = null, caller = null } = {}) {
    Object.assign(this, { listing, worksheet, settings, limits, recorder, line: 0, last: undefined, held: false });
    this.values = new Map(worksheet.values);
    this.locals = new Set();
    this.count = caller?.count ?? { steps: 0 };
    this.output = caller?.output ?? [];
    this.calls = (caller?.calls ?? 0) + 1;
  }

  /** Runs the program to its end; returns its value. Throws a Failure. */
  execute(values) {
    const { parameters, program } = this.listing;
    if (parameters.length !== values.length) throw this.failure(new Cause(`This function has ${parameters.length} arguments; ${values.length} were given.`));
    parameters.forEach((name, k) => this.values.set(name, share(values[k])));
    const flow = this.block(program);
    if (flow === "break" || flow === "continue") throw this.failure(new Cause("`break` and `continue` belong in a loop."));
    if (this.last === undefined) throw this.failure(new Cause("The program has no value."));
    return this.last;
  }

  /** The failure of a part of the current line, or of the whole line. */
  failure(cause, part = { start: 0, end: Infinity }) { return new Failure(this.listing.name, this.listing.lines[this.line], part, cause); }

  spend() {
    this.count.steps += 1;
    if (this.count.steps > this.limits.steps) throw this.failure(overLimit(this.limits.steps, "steps"));
    if (this.recorder?.steps.length > this.limits.kept) throw this.failure(overLimit(this.limits.kept, "statements shown"));
  }

  /** Checks that an array of so many numbers, of such a depth, may be. */
  checkSize(numbers, depth = 0) {
    if (numbers > this.limits.entries) throw this.failure(overLimit(this.limits.entries, "numbers held at once"));
    if (depth >= MOST.depth) throw this.failure(overLimit(MOST.depth, "arrays within arrays"));
  }

  /** Runs statements; returns where the program goes on: next, break, continue or return. */
  block(block) {
    // Whether an `if` was true since the block's last `otherwise`.
    const state = { held: false };
    let flow = "next";
    for (const statement of block) if ((flow = this.statement(statement, state)) !== "next") break;
    return flow;
  }

  statement(statement, state) {
    const { step, line, condition, body, value } = statement;
    this.line = line;
    this.recorder?.begin(line);
    this.spend();
    if (step === "while") return this.repeatWhile(statement);
    if (step === "try") {
      try {
        return this.block(body);
      } catch (failure) {
        if (!(failure instanceof Failure) || failure.isLimit) throw failure;
        return this.block(statement.fallback);
      }
    }
    if (step === "otherwise") {
      const skips = state.held;
      state.held = false;
      return skips ? "next" : this.block(body);
    }
    if (condition) {
      const truth = this.decided(condition);
      state.held ||= truth;
      if (!truth && this.settings.last_if_is_zero) this.last = 0;
      if (!truth) return "next";
    }
    if (step === "for") return this.repeat(statement);
    if (step === "if") return this.block(body);
    if (step === "spread") throw this.failure(unsupported("an assignment to several entries in the page"));
    if (step === "assign") this.assign(statement.target, this.eval(value));
    else if (value) this.last = this.eval(value);
    return step === "assign" || step === "evaluate" ? "next" : step;
  }

  decided(condition) {
    const truth = this.truth(condition);
    if (this.recorder) this.recorder.on(this.line).held = truth;
    return truth;
  }

  repeatWhile({ condition, body, line }) {
    while (this.decided(condition)) {
      const flow = this.block(body);
      if (flow === "break") break;
      if (flow === "return") return flow;
      this.line = line;
      this.spend();
    }
    return "next";
  }

  /** Runs the body for each value of the range, which is fixed on entry. */
  repeat({ name, range, body, line }) {
    for (const value of range.values ? this.entriesOf(range.values) : this.turns(range)) {
      this.line = line;
      this.spend();
      this.store(name, value);
      const flow = this.block(body);
      if (flow === "break") break;
      if (flow === "return") return flow;
    }
    return "next";
  }

  /** The numbers of `from .. to` or `from, second .. to`, each from the first and not from the one before. */
  turns(range) {
    const from = this.number(range.from);
    const second = range.second && this.number(range.second);
    const to = this.number(range.to);
    const step = second === undefined ? (from <= to || this.settings.descending_is_empty ? 1 : -1) : second - from;
    if (second !== undefined && !((to - from) * step > 0 || (to === from && step !== 0))) {
      throw this.failure(new Cause(`A range must lead from its start to its end: ${inDigits(from)}, ${inDigits(second)} .. ${inDigits(to)}.`));
    }
    return (function* () {
      const end = to + RANGE_END * step;
      for (let turn = 0, x = from; step > 0 ? x <= end : x >= end; turn += 1, x = from + step * turn) yield x;
    })();
  }

  /** The values that a loop runs over: of an array its entries column by column. */
  entriesOf(parts) { return parts.map((part) => this.eval(part)).flatMap((value) => (isArray(value) ? value.transposed().entries : [value])); }

  /** Writes a value to a name or an entry. */
  assign({ name, parts, start, end }, value) {
    const subscripts = parts.map((part) => this.number(part));
    if (subscripts.length === 0) this.store(name, value);
    else this.located({ start, end }, () => this.write(name, subscripts, value));
    this.last = value;
  }

  store(name, value) {
    this.values.set(name, share(value));
    this.locals.add(name);
    this.recorder?.on(this.line).writes.push({ name, subscripts: [], value });
  }

  /** Writes to an entry. A name that holds no array becomes one. */
  write(name, subscripts, value) {
    this.checkSize(0, depthOf(value));
    const [i, j] = offsets(subscripts, this.settings.origin, name);
    let array = this.values.get(name);
    if (!isArray(array)) array = new Grid(0, 0, []);
    if (subscripts.length === 1 && array.cols > 1) throw outside(name, subscripts, array);
    this.checkSize(Math.max(array.rows, i + 1) * Math.max(array.cols, j + 1));
    if (array.shared) array = array.copy();
    array.write(i, j, share(value));
    this.values.set(name, array);
    this.locals.add(name);
    this.recorder?.on(this.line).writes.push({ name, subscripts, value });
  }

  /** Does what may have no value, whose cause becomes a failure of a part of the current line. */
  located(part, act) { try { return act(); } catch (cause) { throw cause instanceof Cause ? this.failure(cause, part) : cause; } }

  eval(expression) {
    try { return this[expression.kind](expression); } catch (cause) { throw cause instanceof Cause ? this.failure(cause, expression) : cause; }
  }

  number(expression) {
    const value = this.eval(expression);
    if (!isNumber(value)) throw this.failure(wrongKind("a number", value), expression);
    return value;
  }

  truth(expression) { return this.number(expression) !== 0; }
  constant({ value }) { return value; }

  read({ name, parts }) {
    const subscripts = parts.map((part) => this.number(part));
    // A local name without a value is 0.
    let value = this.values.get(name) ?? (this.listing.assigned.has(name) ? 0 : undefined);
    if (value === undefined) throw this.undefinedName(name);
    if (subscripts.length > 0 && !this.values.has(name)) throw wrongKind("an array", 0);
    if (subscripts.length > 0) value = entryOf(value, subscripts, this.settings.origin, name);
    share(value);
    this.recorder?.on(this.line).reads.push({ name, subscripts, value });
    return value;
  }

  /** The cause of a name that has no value or, where it is called, is no function. */
  undefinedName(name, isCalled = false) {
    const { functions, units } = this.worksheet.known;
    const isUnit = name.split(".").every((part, k) => units.has(part.replace(/\d+$/, "")) || (k > 0 && /^\d+$/.test(part)));
    if (isCalled && functions.has(name)) return unsupported(`the function ${name}`);
    if (!isCalled && isUnit && !this.worksheet.programs.has(name)) return unsupported(`units: ${name}`);
    if (!isCalled && this.has(name)) return unsupported(`a function as a value (${name})`);
    return new Cause(`This variable or function is not defined above: ${name}.`);
  }

  /** Whether a name is that of a function. */
  has(name) {
    const { functions, programs } = this.worksheet;
    return functions.has(name) || programs.has(name) || name in FUNCTIONS || name === "trace" || ELSEWHERE.has(name);
  }

  call({ name, parts }) {
    if (!this.has(name)) throw this.undefinedName(name, true);
    // Vectorize takes its argument apart.
    const values = name === "→" ? [] : parts.map((part) => this.eval(part));
    const { functions, programs } = this.worksheet;
    if (functions.has(name)) return functions.get(name)(values);
    if (programs.has(name)) return this.inWorksheet(programs.get(name), values);
    if (ELSEWHERE.has(name)) throw unsupported(`the function ${name} in the page`);
    if (name === "trace") return this.trace(values);
    if (name === "identity" && values[0] > 0) this.checkSize(values[0] * values[0]);
    return FUNCTIONS[name](values);
  }

  /** Mathcad's trace: a line of output, which is also its value. */
  trace(values) {
    const line = values.map(inText).join(" ");
    this.output.push(line);
    return line;
  }

  /** Runs a function of the worksheet; its steps count with those of the caller. */
  inWorksheet(listing, values) {
    if (this.calls >= this.limits.calls) throw this.failure(overLimit(this.limits.calls, "levels of calls"));
    return new Run(listing, this.worksheet, this.settings, { limits: this.limits, caller: this }).execute(values);
  }

  program() { throw unsupported("a program within an expression in the page"); }
  group({ parts }) { return this.eval(parts[0]); }

  entry({ parts: [array, ...subscripts] }) {
    const value = this.eval(array);
    const at = subscripts.map((part) => this.number(part));
    return entryOf(value, at, this.settings.origin, this.listing.lines[this.line].text.slice(array.start, array.end));
  }

  array({ cols, parts }) {
    const array = gridOf(cols, parts.map((part) => this.eval(part)));
    this.checkSize(parts.length, array.depth - 1);
    return array;
  }

  magnitude({ parts }) { return magnitude(this.eval(parts[0])); }
  negative({ parts }) { return negative(this.eval(parts[0])); }
  transpose({ parts }) { return transposed(this.eval(parts[0])); }
  not({ parts }) { return this.truth(parts[0]) ? 0 : 1; }
  power({ parts: [x, y] }) { return power(this.eval(x), this.number(y)); }
  column({ parts: [array, j] }) { return column(this.eval(array), this.number(j), this.settings.origin); }
  calculate({ sign, parts: [x, y] }) { return operate(sign, this.eval(x), this.eval(y), this.settings); }
  choice({ parts: [condition, x, y] }) { return this.truth(condition) ? this.eval(x) : this.eval(y); }
  series({ name }) { throw name === "∑" || name === "∏" ? unsupported(`the function ${name} in the page`) : this.undefinedName(name, true); }

  /** Compares each operand with the next: numbers, or strings by the codes of their characters. After a
   * false comparison the rest is evaluated only if `∧` evaluates everything. */
  compare({ signs, parts: [first, ...rest] }) {
    let [at, left, all] = [first, this.eval(first), true];
    for (const [k, part] of rest.entries()) {
      if (!all && this.settings.conjunction !== "eager") break;
      if (isArray(left)) throw this.failure(wrongKind("a number", left), at);
      const right = this.eval(part);
      if (typeof left !== typeof right) throw this.failure(wrongKind(isNumber(left) ? "a number" : "a string", right), part);
      const truth = isNumber(left) ? compare(signs[k], left, right, this.settings) : ordered(signs[k], left < right, left === right, left > right);
      [at, left, all] = [part, right, all && truth];
    }
    return all ? 1 : 0;
  }

  all(expression) {
    const { truth, seen } = this.decide(expression.parts, false);
    if (this.recorder) {
      const { text } = this.listing.lines[this.line];
      this.recorder.on(this.line).operands = expression.parts.map(({ start, end }, k) => [text.slice(start, end), seen[k] ?? null]);
    }
    return truth();
  }

  any({ parts }) { return this.decide(parts, true).truth(); }

  /** What the operands of an `∧` or `∨` decide together by the worksheet's method; one that is `decisive`
   * decides alone. `truth` throws the failure that stands. */
  decide(parts, decisive) {
    const method = this.settings.conjunction;
    let [decided, failure] = [false, null];
    const seen = [];
    for (const part of parts) {
      if (method === "left-to-right" && decided) break;
      let truth = null;
      try {
        truth = this.truth(part);
      } catch (error) {
        if (method !== "guarded" || !(error instanceof Failure) || error.isLimit) throw error;
        failure ??= error;
      }
      decided ||= truth === decisive;
      seen.push(truth);
    }
    const truth = () => {
      if (failure && !decided) throw failure;
      return decided === decisive ? 1 : 0;
    };
    return { truth, seen };
  }
}
