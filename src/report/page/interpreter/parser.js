// From text to syntax tree. An expression is { kind, start, end, ... }, a statement { line, step, ... }; the
// line counts from 0 through the listing's lines.

/** The most lines, characters of a line, and levels of brackets, expressions, blocks and arrays. */
const MOST = { lines: 1000, characters: 2000, depth: 64 };

/** Reads one line by descent. From the loosest to the tightest: ∨, ∧, ¬, comparisons, + −, · /, the sign
 * of −x, one power, and behind an operand xᵀ, x[i], x⟨j⟩. */
class LineParser {
  tokens; line; next; expected;
  constructor(tokens, line) { Object.assign(this, { tokens, line, next: 0, expected: [] }); }
  get token() { return this.tokens[this.next]; }
  get start() { return this.token?.start ?? this.tokens.at(-1)?.end ?? 0; }

  /** An expression from `start` to the end of the last token taken. */
  node(kind, start, parts) { return { kind, start, end: this.tokens[this.next - 1].end, ...parts }; }
  expect(words) { this.expected.push([this.next, words]); }

  takesToken(type, words) {
    const isNext = this.token?.type === type;
    this.expect(words);
    this.next += isNext ? 1 : 0;
    return isNext;
  }

  takes(sign) {
    const isNext = isSign(this.token, sign);
    this.expect(`\`${sign}\``);
    this.next += isNext ? 1 : 0;
    return isNext;
  }

  need(sign) { if (!this.takes(sign)) this.refuse(); }
  end() { if (this.token) this.refuse(); }

  refuse() {
    if (isSign(this.token, "<-")) throw new Complaint(this.start, `found ${ARROW}`);
    const expected = this.expected.filter(([place]) => place === this.next).map(([, words]) => words);
    const found = this.token ? tokenInWords(this.token) : "the end of the line";
    throw new Complaint(this.start, `found ${found}, expected ${[...new Set(expected)].sort().join(" or ")}`);
  }

  /** Takes a name, or a function. */
  named(type) {
    this.expect(`a ${type}`);
    if (this.token?.type !== type) this.refuse();
    this.next += 1;
    return this.tokens[this.next - 1].value;
  }

  /** Reads the first line of a listing. */
  header() {
    const name = this.named("function");
    const parameters = this.inBrackets(() => this.named("name"));
    this.need(":=");
    this.end();
    return { name, parameters };
  }

  /** Reads a line of a program; blocks below it are left empty, that of `x otherwise` is `x`. */
  statement() {
    const statement = this.step();
    this.end();
    return statement;
  }

  step() {
    const start = this.start;
    const word = this.token?.type === "sign" && !this.isChoice() ? this.token.value : "";
    const parse = { for: "loop", while: "block", if: "block", otherwise: "block", try: "block", return: "value", break: "jump", continue: "jump" }[word];
    if (parse) this.next += 1;
    const statement = { line: this.line, ...(parse ? this[parse](word) : this.assignment()) };
    if (!statement.body && this.takes("otherwise")) {
      if (statement.condition) throw new Complaint(start, "found `if` and `otherwise` on one line");
      return { line: this.line, step: "otherwise", body: [statement] };
    }
    return statement;
  }

  /** Reads a program within an expression, the bracket of which is taken. */
  program() {
    const block = [];
    const inner = () => (this.need("{"), this.program());
    for (;;) {
      const statement = this.step();
      if (statement.body?.length === 0) statement.body = inner();
      if (statement.fallback) statement.fallback = inner();
      block.push(statement);
      if (this.takes("}")) return block;
      this.need(";");
    }
  }

  loop() {
    const name = this.named("name");
    this.need("∈");
    const range = this.range();
    return { step: "for", name, range, condition: this.guard(), body: [] };
  }
  block(word) {
    const condition = word === "while" || word === "if" ? this.expression() : undefined;
    return { step: word, condition, body: [], fallback: word === "try" ? [] : undefined };
  }
  value() { return { step: "return", value: this.expression(), condition: this.guard() }; }
  jump(word) { return { step: word, condition: this.guard() }; }

  /** Reads an assignment, or a value alone. */
  assignment() {
    const value = this.expression();
    const isName = ({ kind, parts }) => kind === "read" && parts.length === 0;
    const isColumn = value.kind === "column" && isName(value.parts[0]);
    const isSpread = isColumn || (value.kind === "array" && value.parts.every(isName));
    if (value.kind === "read" || isSpread) {
      this.expect("`←`");
      if (isSign(this.token, "←", "<-", ":=")) {
        this.next += 1;
        const names = isColumn ? [value.parts[0].name] : value.parts.map((part) => part.name);
        const to = isSpread ? { step: "spread", names, target: isColumn ? { parts: [value.parts[1]] } : undefined } : { step: "assign", target: value };
        return { ...to, value: this.expression(), condition: this.guard() };
      }
    }
    return { step: "evaluate", value, condition: this.guard() };
  }

  guard() { return this.takes("if") ? this.expression() : undefined; }

  /** Whether the function `if` comes next: the brackets behind it have a comma. */
  isChoice() {
    if (!isSign(this.token, "if")) return false;
    let depth = 0;
    for (const token of this.tokens.slice(this.next + 1)) {
      if (isSign(token, "(", "[", "⟨")) depth += 1;
      if (isSign(token, ")", "]", "⟩")) depth -= 1;
      if (depth <= 0) return false;
      if (depth === 1 && isSign(token, ",")) return true;
    }
    return false;
  }

  /** Reads `from .. to`, `from, second .. to`, or values one after another. */
  range() {
    const start = this.start;
    const values = this.list(() => this.expression());
    if (!this.takes("..")) return { values };
    const to = this.expression();
    if (values.length > 2) throw new Complaint(start, "found a range within a list");
    return { from: values[0], second: values[1], to };
  }

  list(item) {
    const list = [item()];
    while (this.takes(",")) list.push(item());
    return list;
  }

  inBrackets(item) {
    this.need("(");
    if (this.takes(")")) return [];
    const list = this.list(item);
    this.need(")");
    return list;
  }

  expression() { return this.joined("∨", "any", () => this.joined("∧", "all", () => this.not())); }

  /** Reads operands with a sign between them; one alone is itself. */
  joined(sign, kind, operand) {
    const start = this.start;
    const parts = [operand()];
    while (this.takes(sign)) parts.push(operand());
    return parts.length === 1 ? parts[0] : this.node(kind, start, { parts });
  }

  not() {
    const start = this.start;
    let signs = 0;
    while (this.takes("¬")) signs += 1;
    let value = this.comparison();
    for (; signs > 0; signs -= 1) value = this.node("not", start, { parts: [value] });
    return value;
  }

  /** Reads a comparison, or several of each operand with the next. */
  comparison() {
    const start = this.start;
    const parts = [this.sum()];
    const signs = [];
    for (let sign; (sign = this.operator("comparison", "a comparison")); parts.push(this.sum())) signs.push(sign);
    return signs.length === 0 ? parts[0] : this.node("compare", start, { signs, parts });
  }

  sum() { return this.calculation("sum", () => this.product()); }
  product() { return this.calculation("product", () => this.power()); }
  calculation(level, operand) {
    const start = this.start;
    let value = operand();
    for (let sign; (sign = this.operator(level, "an operator")); ) value = this.node("calculate", start, { sign, parts: [value, operand()] });
    return value;
  }

  /** Takes an operator of a level, if one comes next. */
  operator(level, words) {
    this.expect(words);
    const found = OPERATORS.find((row) => row.level === level && isSign(this.token, row.sign));
    this.next += found ? 1 : 0;
    return found?.sign;
  }

  power() {
    return this.signed(() => {
      const start = this.start;
      const base = this.tight();
      if (!this.takes("^")) return base;
      return this.node("power", start, { parts: [base, this.signed(() => this.tight())] });
    });
  }

  /** Reads a value, or its opposite. */
  signed(value) {
    const start = this.start;
    if (!isSign(this.token, "−")) return value();
    this.next += 1;
    return this.node("negative", start, { parts: [value()] });
  }

  /** Reads an atom and what stands behind it: transposes, subscripts and columns. */
  tight() {
    const start = this.start;
    let value = this.atom();
    for (;;) {
      if (this.takes("ᵀ")) value = this.node("transpose", start, { parts: [value] });
      else if (this.takes("[")) value = this.entry(value, start);
      else if (this.takes("⟨")) {
        const column = this.expression();
        this.need("⟩");
        value = this.node("column", start, { parts: [value, column] });
      } else return value;
    }
  }

  /** Reads one subscript or two, and the bracket behind them. */
  entry(value, start) {
    const subscripts = [this.expression()];
    if (this.takes(",")) subscripts.push(this.expression());
    this.need("]");
    const isName = value.kind === "read" && value.parts.length === 0;
    return isName ? this.node("read", start, { name: value.name, parts: subscripts }) : this.node("entry", start, { parts: [value, ...subscripts] });
  }

  atom() {
    const { start, token } = this;
    this.expect("an operand");
    this.next += 1;
    if (token?.type === "number" || token?.type === "text") return this.node("constant", start, { value: token.value, parts: [] });
    if (token?.type === "name") return this.node("read", start, { name: token.value, parts: [] });
    if (token?.type === "function") return this.call(token.value, start);
    if (isSign(token, "(")) return this.rows(start);
    if (isSign(token, "{")) {
      const block = this.program();
      return this.node("program", start, { block, parts: block.flatMap(expressionsOf) });
    }
    if (isSign(token, "if")) return this.choice(start);
    if (isSign(token, "transpose")) return this.transposed(start);
    if (isSign(token, "|")) {
      const inside = this.expression();
      if (!this.takesToken("bar", "`|`")) this.refuse();
      return this.node("magnitude", start, { parts: [inside] });
    }
    this.next -= 1;
    return this.refuse();
  }

  choice(start) {
    const parts = this.inBrackets(() => this.expression());
    if (parts.length !== 3) throw new Complaint(start, "found `if` without three arguments");
    return this.node("choice", start, { parts });
  }

  transposed(start) {
    const bracket = this.start;
    this.need("(");
    const rows = this.rows(bracket);
    return this.node("transpose", start, { parts: rows.kind === "group" ? rows.parts : [rows] });
  }

  /** Reads the arguments of a function, or the range and the term of a series. */
  call(name, start) {
    if (!isSign(this.tokens[this.next + 2], "∈")) return this.node("call", start, { name, parts: this.inBrackets(() => this.expression()) });
    this.need("(");
    const variable = this.named("name");
    this.need("∈");
    const parts = [this.expression()];
    if (this.takes("..")) parts.push(this.expression());
    this.need(",");
    parts.push(this.expression());
    this.need(")");
    return this.node("series", start, { name, variable, parts });
  }

  /** Reads what stands in round brackets, the first of which is taken: one expression, or an array. */
  rows(start) {
    const open = this.tokens[this.next - 1].start;
    const parts = [this.expression()];
    const ends = [];
    while (!this.takes(")")) {
      if (!this.takesToken("gap", "the space between two elements")) {
        this.need(";");
        ends.push(parts.length);
        if (parts.length === 1 && this.takes(")")) return this.node("array", start, { cols: 1, parts });
      }
      parts.push(this.expression());
    }
    ends.push(parts.length);
    const cols = ends[0];
    if (ends.some((end, row) => end !== (row + 1) * cols)) throw new Complaint(open, "found rows of different lengths");
    return parts.length === 1 ? this.node("group", start, { parts }) : this.node("array", start, { cols, parts });
  }
}

/** The expressions on a statement's own line. */
const ownExpressions = ({ range, target, value, condition }) =>
  [range?.from, range?.second, range?.to, ...(range?.values ?? []), ...(target?.parts ?? []), value, condition].filter(Boolean);

/** The expressions of a statement and of those below it. */
const expressionsOf = (statement) => [...ownExpressions(statement), ...blocksOf(statement).flatMap(expressionsOf)];
const blocksOf = ({ body = [], fallback = [] }) => [...body, ...fallback];

/** How deep statements stand below one, itself included. */
const levelsOf = (statement) => 1 + Math.max(0, ...blocksOf(statement).map(levelsOf));

/** The names that a statement writes to, with those below it and those of programs within its expressions. */
function writtenBy(statement) {
  const { step, name, names, target } = statement;
  const own = { for: [name], assign: [target?.name], spread: names }[step] ?? [];
  const inner = (part) => (part.kind === "program" ? part.block.flatMap(writtenBy) : part.parts.flatMap(inner));
  return [...own, ...ownExpressions(statement).flatMap(inner), ...blocksOf(statement).flatMap(writtenBy)];
}

/** Where and why a text leaves the notation: the printed line, and the line and the column in the text,
 * all from 1. */
class ParseError {
  line; fileLine; column; message;
  constructor(line, at, message) {
    const behind = [...line.text.slice(0, at)].length;
    Object.assign(this, { line: line.number, fileLine: line.inFile, column: 2 * line.level + behind + 1, message });
  }
}

/** A line of a listing: its number in the print and in the text, its level and its text. An odd space
 * stays with the text, where it is refused. */
function lineOf(number, inFile, text) {
  const level = Math.floor(/^ */.exec(text)[0].length / 2);
  return { number, inFile, level, text: text.slice(2 * level).trimEnd() };
}

/** The lines of a text, those that start with `#` left out. */
function linesOf(text) {
  const all = text.replace(/\n$/, "").split("\n").map((line, k) => [k + 1, line.replace(/\r$/, "")]);
  const kept = all.filter(([, line]) => !line.startsWith("#") && line.trim() !== "");
  return kept.map(([inFile, line], k) => lineOf(k + 1, inFile, line));
}

/** Reads a listing from its lines, the first being its header. Throws a ParseError. */
function readListing(name, lines) {
  const reader = new ListingReader(lines);
  const { parameters, body } = reader.header();
  const program = body ? [body] : reader.block(1);
  const line = lines[reader.next];
  if (line) reader.refuse(line, 0, line.level === 0 ? "found a line beside the header, expected it indented" : "found a line below a function whose body stands behind `:=`");
  return { name, lines, parameters, program, assigned: new Set(program.flatMap(writtenBy)) };
}

/** Reads the lines of a listing one after another, blocks with what stands in them. */
class ListingReader {
  lines; next;
  constructor(lines) { Object.assign(this, { lines, next: 0 }); }
  refuse(line, at, message) { throw new ParseError(line, at, message); }

  /** Does what reads a line, whose complaint becomes an error of that line. */
  on(line, read) {
    try {
      return read();
    } catch (complaint) {
      if (complaint instanceof Complaint) this.refuse(line, complaint.at, complaint.message);
      throw complaint;
    }
  }

  /** Reads the first line: the parameters, and the body if it stands on that line too. */
  header() {
    const line = this.lines[0] ?? lineOf(1, 1, "");
    if (this.lines.length > MOST.lines) this.refuse(line, 0, `found ${this.lines.length} lines, expected at most ${MOST.lines}`);
    const tokens = this.tokens(line);
    this.next = 1;
    const sign = tokens.findIndex((token) => isSign(token, ":="));
    const behind = sign < 0 ? [] : tokens.slice(sign + 1);
    const { parameters } = this.on(line, () => new LineParser(sign < 0 ? tokens : tokens.slice(0, sign + 1), 0).header());
    if (behind.length === 0) return { parameters };
    const body = this.on(line, () => new LineParser(behind, 0).statement());
    this.checkDepth(line, body);
    if (!["assign", "spread", "evaluate", "return"].includes(body.step)) this.refuse(line, 0, "found a block behind `:=`, expected it indented below");
    return { parameters, body };
  }

  /** Reads the lines that stand `level` deep from here on. */
  block(level) {
    const block = [];
    for (let line; (line = this.lines[this.next]) && line.level >= level; ) {
      if (line.level > level) this.refuse(line, 0, `found ${2 * line.level} spaces of indentation, expected ${2 * level}`);
      if (level > MOST.depth) this.refuse(line, 0, `found blocks more than ${MOST.depth} deep`);
      block.push(this.statement(line));
    }
    const above = this.lines[this.next - 1];
    if (block.length === 0) this.refuse(above, above.text.length, "expected an indented line below");
    return block;
  }

  statement(line) {
    const tokens = this.tokens(line);
    const statement = this.on(line, () => new LineParser(tokens, this.next).statement());
    this.checkDepth(line, statement);
    this.next += 1;
    if (statement.body?.length === 0) statement.body = this.block(line.level + 1);
    if (statement.fallback) {
      const between = this.lines[this.next];
      const last = this.lines[this.next - 1];
      if (between?.level !== line.level || between.text !== "on error") this.refuse(last, last.text.length, "expected a line `on error` below, beside its `try`");
      this.next += 1;
      statement.fallback = this.block(line.level + 1);
    }
    return statement;
  }

  tokens(line) {
    const length = [...line.text].length;
    if (length > MOST.characters) this.refuse(line, 0, `found ${length} characters, expected at most ${MOST.characters}`);
    if (line.text.startsWith(" ")) this.refuse(line, 0, "found an odd space, expected two for each level");
    return this.on(line, () => tokensOf(line.text, MOST.depth));
  }

  checkDepth(line, statement) {
    const depth = ({ parts, block = [] }) => 1 + Math.max(0, ...block.map(levelsOf)) + Math.max(0, ...parts.map(depth));
    const deep = [statement, ...(statement.body ?? [])].flatMap(ownExpressions).find((part) => depth(part) > MOST.depth);
    if (deep) this.refuse(line, deep.start, `found operators and brackets more than ${MOST.depth} deep`);
  }
}
