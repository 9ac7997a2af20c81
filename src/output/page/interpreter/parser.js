// From text to syntax tree. An expression is { kind, start, end, ... }, a statement { line, step, ... }; the
// line counts from 0 through the listing's lines.

/** The most lines, characters of a line, and levels of brackets, expressions, blocks and arrays. */
const MOST = { lines: 1000, characters: 2000, depth: 64 };

/** Reads one line, the listing's of this number, by descent. From the loosest to the tightest: ∨, ∧, ¬, comparisons, + −, · /, the sign
 * of −x, one power, and behind an operand xᵀ, x[i], x⟨j⟩. */
class LineParser {
  tokens; line; number; next; expected;
  constructor(tokens, line, number) { Object.assign(this, { tokens, line, number, next: 0, expected: [] }); }
  get token() { return this.tokens[this.next]; }
  get start() { return this.token?.start ?? this.tokens.at(-1)?.end ?? 0; }

  /** An expression from `start` to the end of the last token taken. */
  node(kind, start, parts) { return { kind, start, end: this.tokens[this.next - 1].end, ...parts }; }
  expect(words) { this.expected.push([this.next, words]); }

  /** Takes the next token where it is the wanted one, which messages call `words`. */
  take(words, isWanted) {
    this.expect(words);
    const { token } = this;
    if (!token || !isWanted(token)) return undefined;
    this.next += 1;
    return token;
  }

  takes(sign) { return this.take(`\`${sign}\``, (token) => isSign(token, sign)); }
  need(sign) { if (!this.takes(sign)) this.refuse(); }
  end() { if (this.token) this.refuse(); }

  refuse() {
    if (isSign(this.token, "<-")) throw new ParseError(this.line, this.start, `found ${ARROW}`);
    const expected = this.expected.filter(([place]) => place === this.next).map(([, words]) => words);
    const found = this.token ? tokenInWords(this.token) : "the end of the line";
    throw new ParseError(this.line, this.start, `found ${found}, expected ${[...new Set(expected)].sort().join(" or ")}`);
  }

  /** Takes a name, or a function. */
  named(type) { return (this.take(`a ${type}`, (token) => token.type === type) ?? this.refuse()).value; }

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
    const statement = { line: this.number, ...this.headed(word) };
    if (!statement.body && this.takes("otherwise")) {
      if (statement.condition) throw new ParseError(this.line, start, "found `if` and `otherwise` on one line");
      return { line: this.number, step: "otherwise", body: [statement] };
    }
    return statement;
  }

  /** Reads the statement that begins with a word; one that begins with none is an assignment or a value alone. */
  headed(word) {
    if (!["for", "while", "if", "otherwise", "try", "return", "break", "continue"].includes(word)) return this.assignment();
    this.next += 1;
    if (word === "return") return { step: word, value: this.expression(), condition: this.guard() };
    if (word === "break" || word === "continue") return { step: word, condition: this.guard() };
    if (word === "try") return { step: word, body: [], fallback: [] };
    if (word === "otherwise") return { step: word, body: [] };
    if (word !== "for") return { step: word, condition: this.expression(), body: [] };
    const name = this.named("name");
    this.need("∈");
    return { step: word, name, range: this.range(), condition: this.guard(), body: [] };
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

  /** Reads an assignment, or a value alone. */
  assignment() {
    const value = this.expression();
    const isName = ({ kind, parts }) => kind === "read" && parts.length === 0;
    const isColumn = value.kind === "column" && isName(value.parts[0]);
    const isSpread = isColumn || (value.kind === "array" && value.parts.every(isName));
    const isTarget = value.kind === "read" || isSpread;
    if (!isTarget || !this.take("`←`", (token) => isSign(token, "←", "<-", ":="))) return { step: "evaluate", value, condition: this.guard() };
    const names = isColumn ? [value.parts[0].name] : value.parts.map((part) => part.name);
    const to = isSpread ? { step: "spread", names, target: isColumn ? { parts: [value.parts[1]] } : undefined } : { step: "assign", target: value };
    return { ...to, value: this.expression(), condition: this.guard() };
  }

  guard() { return this.takes("if") ? this.expression() : undefined; }

  /** Whether the function `if` comes next: the brackets behind it have a comma. */
  isChoice() {
    if (!isSign(this.token, "if")) return false;
    let depth = 0;
    for (const token of this.tokens.slice(this.next + 1)) {
      if (isSign(token, "(", "[", "⟨", "{")) depth += 1;
      if (isSign(token, ")", "]", "⟩", "}")) depth -= 1;
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
    if (values.length > 2) throw new ParseError(this.line, start, "found a range within a list");
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

  expression() { return this.joined("any", "`∨`", () => this.joined("all", "`∧`", () => this.not())); }

  /** Reads operands with operators of a level between them, which messages call `words`; one alone is itself. */
  joined(level, words, operand) {
    const start = this.start;
    const [parts, signs] = [[operand()], []];
    for (let sign; (sign = this.operator(level, words)); parts.push(operand())) signs.push(sign);
    return signs.length === 0 ? parts[0] : this.node(level, start, { signs, parts });
  }

  not() {
    const start = this.start;
    return this.takes("¬") ? this.node("not", start, { parts: [this.not()] }) : this.joined("compare", "a comparison", () => this.sum());
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
    return this.take(words, ({ type, value }) => type === "sign" && OPERATORS.some((row) => row.level === level && row.sign === value))?.value;
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
      else if (this.takes("[")) {
        const subscripts = [this.expression()];
        if (this.takes(",")) subscripts.push(this.expression());
        this.need("]");
        const isName = value.kind === "read" && value.parts.length === 0;
        value = isName ? this.node("read", start, { name: value.name, parts: subscripts }) : this.node("entry", start, { parts: [value, ...subscripts] });
      } else if (this.takes("⟨")) {
        const column = this.expression();
        this.need("⟩");
        value = this.node("column", start, { parts: [value, column] });
      } else return value;
    }
  }

  atom() {
    const { start, token } = this;
    this.expect("an operand");
    if (!token || !(startsOperand(token) || isSign(token, "transpose"))) this.refuse();
    this.next += 1;
    if (token.type === "number" || token.type === "text") return this.node("constant", start, { value: token.value, parts: [] });
    if (token.type === "name") return this.node("read", start, { name: token.value, parts: [] });
    if (token.type === "function") return this.call(token.value, start);
    if (token.value === "(") return this.rows(start);
    if (token.value === "if") {
      const parts = this.inBrackets(() => this.expression());
      if (parts.length !== 3) throw new ParseError(this.line, start, "found `if` without three arguments");
      return this.node("choice", start, { parts });
    }
    if (token.value === "transpose") {
      const bracket = this.start;
      this.need("(");
      const rows = this.rows(bracket);
      return this.node("transpose", start, { parts: rows.kind === "group" ? rows.parts : [rows] });
    }
    if (token.value === "{") {
      const block = this.program();
      return this.node("program", start, { block, parts: block.flatMap(expressionsOf) });
    }
    const inside = this.expression();
    if (!this.take("`|`", ({ type }) => type === "bar")) this.refuse();
    return this.node("magnitude", start, { parts: [inside] });
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
      if (!this.take("the space between two elements", ({ type }) => type === "gap")) {
        this.need(";");
        ends.push(parts.length);
        if (parts.length === 1 && this.takes(")")) return this.node("array", start, { cols: 1, parts });
      }
      parts.push(this.expression());
    }
    ends.push(parts.length);
    const cols = ends[0];
    if (ends.some((end, row) => end !== (row + 1) * cols)) throw new ParseError(this.line, open, "found rows of different lengths");
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

/** A line of a listing: its number in the print and in the text, its level and its text. An odd space
 * stays with the text, where it is refused. */
function lineOf(number, inFile, text) {
  const level = Math.floor(/^ */.exec(text)[0].length / 2);
  return { number, inFile, level, text: text.slice(2 * level).trimEnd() };
}

/** A line that has no string without its remark. */
const withoutRemark = (line) => line.split("#")[0].trimEnd();

/** The lines of a text, those that are a remark alone left out. */
function linesOf(text) {
  const all = text.replace(/\n$/, "").split("\n").map((line, k) => [k + 1, line.replace(/\r$/, "")]);
  const kept = all.filter(([, line]) => withoutRemark(line) !== "");
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

  /** Reads the first line: the parameters, and the body if it stands on that line too. */
  header() {
    const line = this.lines[0] ?? lineOf(1, 1, "");
    if (this.lines.length > MOST.lines) this.refuse(line, 0, `found ${this.lines.length} lines, expected at most ${MOST.lines}`);
    const tokens = this.tokens(line);
    this.next = 1;
    const sign = tokens.findIndex((token) => isSign(token, ":="));
    const behind = sign < 0 ? tokens.length : sign + 1;
    const { parameters } = new LineParser(tokens.slice(0, behind), line, 0).header();
    if (behind === tokens.length) return { parameters };
    const body = this.parsed(line, tokens.slice(behind), 0);
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
    const statement = this.parsed(line, this.tokens(line), this.next);
    this.next += 1;
    if (statement.body?.length === 0) statement.body = this.block(line.level + 1);
    if (statement.fallback) {
      const between = this.lines[this.next];
      const last = this.lines[this.next - 1];
      if (between?.level !== line.level || withoutRemark(between.text) !== "on error") this.refuse(last, last.text.length, "expected a line `on error` below, beside its `try`");
      this.next += 1;
      statement.fallback = this.block(line.level + 1);
    }
    return statement;
  }

  tokens(line) {
    const length = [...line.text].length;
    if (length > MOST.characters) this.refuse(line, 0, `found ${length} characters, expected at most ${MOST.characters}`);
    if (line.text.startsWith(" ")) this.refuse(line, 0, "found an odd space, expected two for each level");
    return tokensOf(line, MOST.depth);
  }

  /** The statement that tokens of a line make, whose place is `at`. */
  parsed(line, tokens, at) {
    const statement = new LineParser(tokens, line, at).statement();
    const depth = ({ parts, block = [] }) => 1 + Math.max(0, ...block.map(levelsOf)) + Math.max(0, ...parts.map(depth));
    const deep = [statement, ...(statement.body ?? [])].flatMap(ownExpressions).find((part) => depth(part) > MOST.depth);
    if (deep) this.refuse(line, deep.start, `found operators and brackets more than ${MOST.depth} deep`);
    return statement;
  }
}
