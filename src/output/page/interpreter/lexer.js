// A line's text as tokens: { type, value, start, end }. The types: number, text, name, function (a name
// with a bracket behind it), sign (keywords too), bar (that closes |x|), gap (between elements of a row).

/** All operators: as printed, as typed, and how tightly they bind, by the expression that they make. */
const OPERATORS = [
  ["∨", "or", "any"], ["∧", "and", "all"], ["¬", "not", "not"],
  ["=", "=", "compare"], ["≠", "!=", "compare"], ["<", "<", "compare"],
  ["≤", "<=", "compare"], [">", ">", "compare"], ["≥", ">=", "compare"],
  ["+", "+", "sum"], ["−", "-", "sum"], ["·", "*", "product"], ["/", "/", "product"],
].map(([sign, typed, level]) => ({ sign, typed, level }));

const KEYWORDS = "for while if otherwise try return break continue in and or not transpose".split(" ");

/** The signs, the longest first. */
const SIGNS = [":=", "..", "<-", "←", "∈", "^", "ᵀ", "|", ",", ";", "(", ")", "[", "]", "⟨", "⟩", "{", "}"]
  .concat(OPERATORS.flatMap(({ sign, typed }) => [sign, typed]))
  .filter((sign) => !/^[a-z]/.test(sign))
  .sort((a, b) => b.length - a.length);

const ARROW =
  "`<` and `-` without brackets, which may mean two things: write `x <- 1` to assign 1, or `x < (-1)` to compare with -1";

const NAME = /^(?!ᵀ)[\p{Alphabetic}_√∑∏×→](?:(?!ᵀ)[\p{Alphabetic}_√∑∏×→\p{N}']|\.(?=(?!ᵀ)[\p{Alphabetic}_√∑∏×→\p{N}']))*/u;
const NUMBER = /^\d+(?:\.\d+)?(?:[eE][+\-−]?\d+)?/;

/** The sign as printed that a sign or keyword stands for. `<-` stays: the grammar knows where it assigns. */
const printed = (typed) => (typed === "in" ? "∈" : (OPERATORS.find((row) => row.typed === typed)?.sign ?? typed));

/** Where and why a text leaves the notation: the printed line, and the line and the column in the text,
 * all from 1. */
class ParseError {
  line; fileLine; column; message;
  constructor(line, at, message) {
    const behind = [...line.text.slice(0, at)].length;
    Object.assign(this, { line: line.number, fileLine: line.inFile, column: 2 * line.level + behind + 1, message });
  }
}

/** A token as messages name it. */
function tokenInWords({ type, value }) {
  if (type === "number") return `\`${inDigits(value)}\``;
  if (type === "text") return `\`"${value}"\``;
  if (type === "name" || type === "function") return "a name";
  return type === "gap" ? "the space between two elements" : `\`${value}\``;
}

/** A character in quotation marks; one that cannot be seen by its number. */
function quoted(c) {
  const escapes = { "\t": "\\t", "\n": "\\n", "\r": "\\r", "\0": "\\0", "\\": "\\\\" };
  const seen = c !== " " && /[\p{C}\p{Z}\p{Grapheme_Extend}]/u.test(c) ? `\\u{${c.codePointAt(0).toString(16)}}` : c;
  return `"${escapes[c] ?? seen}"`;
}

const isSign = (token, ...signs) => token?.type === "sign" && signs.includes(token.value);
const endsOperand = (token) => ["number", "text", "name", "bar"].includes(token?.type) || isSign(token, ")", "]", "⟩", "}", "ᵀ");
const startsOperand = (token) =>
  ["number", "text", "name", "function"].includes(token.type) || isSign(token, "(", "|", "{", "if");

/** Splits a line into tokens; from `#` on it is a remark. Throws a ParseError, also of brackets more than
 * `depth` deep. */
function tokensOf(line, depth) {
  const { text } = line;
  const found = [];
  const open = [];
  for (let at = 0; ; at = found.at(-1).end) {
    const spaces = /^ */.exec(text.slice(at))[0].length;
    at += spaces;
    if (at === text.length || text[at] === "#") return found;
    const token = tokenAt(line, at, found, open);
    const wanted = startsOperand(token) ? 1 : 2;
    if (open.at(-1) === "(" && endsOperand(found.at(-1)) && !isSign(token, ")", ",", ";") && spaces >= wanted) {
      found.push({ type: "gap", start: at - spaces, end: at });
    }
    if (isSign(token, "(", "[", "⟨", "|", "{")) open.push(token.value);
    if (isSign(token, ")", "]", "⟩", "}") || token.type === "bar") open.pop();
    if (open.length > depth) throw new ParseError(line, at, `found brackets more than ${depth} deep`);
    found.push(token);
  }
}

function tokenAt(line, at, found, open) {
  const rest = line.text.slice(at);
  const token = (type, value, length) => ({ type, value, start: at, end: at + length });
  const sign = SIGNS.find((sign) => rest.startsWith(sign));
  if (sign === "-" && isSign(found.at(-1), "<")) throw new ParseError(line, at, `found ${ARROW}`);
  if (sign === "|" && open.at(-1) === "|" && endsOperand(found.at(-1))) return token("bar", "|", 1);
  if (sign) return token("sign", printed(sign), sign.length);
  if (rest[0] === '"') {
    const length = rest.indexOf('"', 1) + 1;
    if (length === 0) throw new ParseError(line, at, "found a string without its second quotation mark");
    return token("text", rest.slice(1, length - 1), length);
  }
  const number = NUMBER.exec(rest)?.[0];
  if (number) {
    const value = Number(number.replace("−", "-"));
    if (!Number.isFinite(value)) throw new ParseError(line, at, "found a number too large");
    return token("number", value, number.length);
  }
  const name = NAME.exec(rest)?.[0];
  if (!name) throw new ParseError(line, at, `found ${quoted(String.fromCodePoint(rest.codePointAt(0)))}, which is no part of the notation`);
  if (KEYWORDS.includes(name)) return token("sign", printed(name), name.length);
  return token(rest[name.length] === "(" ? "function" : "name", name, name.length);
}
