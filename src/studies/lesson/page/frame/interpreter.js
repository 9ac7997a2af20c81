// What the interpreter says, in the page's language: its own sentences are English, as the program's are.

/** The sentences of the interpreter and their parts, the more special before the general. */
const SENTENCES = ((t) => [
  t("{listing}, line {line}: {cause} In `{text}`, column {column} of `{statement}`."),
  t("{listing}, line {line}: This array index is invalid for this array. {values}, index of {name} = {index}, {size}"),
  t("Division by zero. («Деление на ноль.» in Mathcad 14.1.) {quotient}."),
  t("Found a number beyond 10^307. («Найдено число величиной более 10^307» in Mathcad 14.1.) The result is {x}."),
  t("unsupported: {what}."),
  t("The limit of {limit} {of} is reached."),
  t("This array index is invalid for this array. {entry} lies below ORIGIN = {origin}."),
  t("This array index is invalid for this array. {entry} of {size} entries."),
  t("An array index must be an integer: {entry}."),
  t("These array sizes do not match: {sizes}."),
  t("The matrix is singular."),
  t("This function has {count} arguments; {given} were given."),
  t("Expected at least one number, found none."),
  t("Expected {wanted}, found something else in {name}."),
  t("Expected {wanted}, found {found}."),
  t("`break` and `continue` belong in a loop."),
  t("The program has no value."),
  t("A range must lead from its start to its end: {range}."),
  t("This variable or function is not defined above: {name}."),
  t("{entry} names node {node}, which is not there."),
  t("D: D takes an elastic modulus and a Poisson's ratio."),
  t("the number {x}"),
  t("a number or an array"),
  t("a number or a column to divide by"),
  t("a whole number"),
  t("whole numbers"),
  t("a number"),
  t("a string"),
  t("a square matrix"),
  t("a square matrix and a column"),
  t("a column of {count} arrays"),
  t("a {size} array of arrays"),
  t("a {size} array"),
  t("an array"),
  t("a column"),
  t("value of the program"),
  t("statements shown"),
  t("numbers held at once"),
  t("levels of calls"),
  t("arrays within arrays"),
  t("steps"),
  t("found `<` and `-` without brackets, which may mean two things: write `x <- 1` to assign 1, or `x < (-1)` to compare with -1"),
  t("found {what}, which is no part of the notation"),
  t("found brackets more than {most} deep"),
  t("found blocks more than {most} deep"),
  t("found operators and brackets more than {most} deep"),
  t("found a string without its second quotation mark"),
  t("found a number too large"),
  t("found `if` and `otherwise` on one line"),
  t("found `if` without three arguments"),
  t("found a range within a list"),
  t("found rows of different lengths"),
  t("found a line beside the header, expected it indented"),
  t("found a line below a function whose body stands behind `:=`"),
  t("found a block behind `:=`, expected it indented below"),
  t("found {count} lines, expected at most {most}"),
  t("found {count} characters, expected at most {most}"),
  t("found {count} spaces of indentation, expected {wanted}"),
  t("found an odd space, expected two for each level"),
  t("expected an indented line below"),
  t("expected a line `on error` below, beside its `try`"),
  t("found {found}, expected {expected}"),
  t("an operand"),
  t("an operator"),
  t("a comparison"),
  t("a name"),
  t("a function"),
  t("the end of the line"),
  t("the space between two elements"),
])((key) => key).map((key) => {
  const names = [...key.matchAll(/\{(\w+)\}/g)].map(([, name]) => name);
  const texts = key.split(/\{\w+\}/).map((text) => text.replace(/[.*+?^$()|[\]\\]/g, "\\$&"));
  return { key, names, pattern: new RegExp(`^${texts.join("(.+?)")}$`) };
});

/** A sentence of the interpreter in the page's language, what its parts say too; what is none of its sentences stays. */
function interpreted(message) {
  if (speech.language === "en") return message;
  for (const { key, names, pattern } of SENTENCES) {
    const found = pattern.exec(message);
    if (!found) continue;
    return t(key, Object.fromEntries(names.map((name, k) => [name, interpreted(found[k + 1])])));
  }
  const parts = message.split(" or ");
  return parts.length > 1 ? parts.map(interpreted).join(` ${t("or")} `) : message;
}
