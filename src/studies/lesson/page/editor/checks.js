// What is wrong with a listing that is typed: where it leaves the notation, with the likely cause, and what can be
// read but hardly be meant.

/** Where and why a text leaves the notation; nothing where it does not. */
function errorIn(name, text) {
  try {
    readListing(name, linesOf(text));
    return null;
  } catch (error) {
    if (error instanceof ParseError) return error;
    throw error;
  }
}

/** Where the innermost bracket stands that is still open where a line breaks off; nothing where there is none. */
function openBracket({ message, fileLine, column }, text) {
  const open = [];
  [...text.split("\n")[fileLine - 1]].slice(0, column - 1).forEach((c, k) => ("([".includes(c) ? open.push(k + 1) : ")]".includes(c) && open.pop()));
  return /^found (the end|`).*expected.*`[\])]`/.test(message) ? open.at(-1) : undefined;
}

/** The one or two likely causes of an error. */
function likelyCauses({ message, fileLine, column }, text) {
  const line = text.split("\n")[fileLine - 1] ?? "";
  const behind = [...line].slice(0, column - 1).join("").trimEnd();
  const wants = (what) => message.includes("expected") && message.split("expected")[1].includes(what);
  const found = (what) => message.startsWith(`found ${what}`);
  const open = [...behind].filter((c) => "([".includes(c)).length - [...behind].filter((c) => ")]".includes(c)).length;
  const causes = [
    [found("`,`") && /\d$/.test(behind), () => t("a decimal number has a point here: 0.5")],
    [message.includes("indent") || message.includes("odd space") || message.includes("beside the header"), () => t("two spaces for each level; only the lines below for, while, if and otherwise stand deeper than those before")],
    [message.includes("no part of the notation"), () => t("signs are typed as and, or, not, <=, >=, !=, *, <-")],
    [found("`=`") && /[=<>:]$/.test(behind), () => t("to compare, write one =; to assign, write ← or <-")],
    [found("`←`") && open === 0, () => t("on the left of ← stands one name or one entry; a comparison is written with =")],
    [(wants("`)`") || wants("`]`")) && open > 0, () => t("a bracket is not closed")],
    [(found("`)`") || found("`]`")) && open <= 0, () => t("a bracket is closed that is not open")],
    [found("the end of the line") && wants("an operand"), () => t("the line breaks off behind a sign")],
    [(found("a name") || found("`")) && wants("an operator") && /[\w\])]$/.test(behind), () => t("an operator is missing between two operands, such as · or ∧")],
    [!found("the end") && wants("an operand"), () => t("an operand is missing, or a sign stands twice")],
  ];
  return causes.filter(([is]) => is).slice(0, 2).map(([, words]) => words());
}

/** How many characters of one name must change to make another of it. */
const changesBetween = (a, b) => Math.max(a.length, b.length) - commonPlaces(a, b).size;

/** The name that is most like one, if any is. */
function nearest(name, names) {
  const like = [...names].filter((other) => other !== name).map((other) => [changesBetween(name.toLowerCase(), other.toLowerCase()), other]);
  const [changes, found] = like.sort(([a], [b]) => a - b)[0] ?? [Infinity];
  return changes <= Math.max(1, name.length / 3) ? found : undefined;
}

/** What can be read and is hardly meant: a comparison that stands where an assignment would, a name that nothing
 * defines, and one that is written for nothing. Each has its line in the text, its column and its length. */
function remarksOn(listing, worksheet, isKnown) {
  const { lines, program, parameters, assigned } = listing;
  const found = [];
  const remark = (line, { start, end }, words) => {
    const { inFile, level, text } = lines[line];
    found.push({ fileLine: inFile, column: 2 * level + [...text.slice(0, start)].length + 1, length: [...text.slice(start, end)].length, words });
  };
  const used = new Set();
  const names = new Set([...assigned, ...parameters, ...worksheet.values.keys(), ...Object.keys(FUNCTIONS), ...worksheet.functions.keys()]);
  const suggestion = (name) => {
    const other = nearest(name, names);
    return other ? " " + t("Did you mean {other}?", { other }) : "";
  };
  const look = (line, part, local) => {
    const { kind, name, parts, block = [], variable } = part;
    const inner = variable ? new Set([...local, variable]) : local;
    if (kind === "read" || kind === "call") used.add(name);
    if ((kind === "read" || kind === "call") && !names.has(name) && !inner.has(name) && !isKnown(name)) remark(line, { start: part.start, end: part.start + name.length }, t("{name} is not defined.", { name }) + suggestion(name));
    for (const other of parts) look(line, other, inner);
    for (const statement of block) visit(statement);
  };
  const writes = [];
  const visit = (statement) => {
    const { line, step, value, target } = statement;
    if (step === "evaluate" && value.kind === "compare" && value.signs.includes("=")) remark(line, value, t("= compares and assigns nothing: to assign, write ← or <-."));
    if (step === "assign") writes.push([line, target]);
    for (const part of ownExpressions(statement)) if (part !== target) look(line, part, new Set());
    for (const other of blocksOf(statement)) visit(other);
  };
  for (const statement of program) visit(statement);
  const results = listing.name === "c_cnt" ? ["ct", "yt", "dy"] : [];
  for (const [line, { name, start }] of writes) {
    if (!used.has(name) && !results.includes(name)) remark(line, { start, end: start + name.length }, t("{name} is written, and no line reads it.", { name }) + suggestion(name));
  }
  return found;
}
