// What the interpreter says, in the page's language: its own sentences are English, as the program's are.

/** The sentences of the interpreter and their parts (src/studies/lesson/interpreter.tsv), each with its pattern. */
const SENTENCES = data.interpreter.map(([english, russian]) => {
  const names = [...english.matchAll(/\{(\w+)\}/g)].map(([, name]) => name);
  const texts = english.split(/\{\w+\}/).map((text) => text.replace(/[.*+?^$()|[\]\\]/g, "\\$&"));
  return { russian, names, pattern: new RegExp(`^${texts.join("(.+?)")}$`) };
});

/** A sentence of the interpreter in the page's language, what its parts say too; what is none of its sentences stays. */
function interpreted(message) {
  if (speech.language === "en") return message;
  for (const { russian, names, pattern } of SENTENCES) {
    const found = pattern.exec(message);
    if (found) return russian.replace(/\{(\w+)\}/g, (_, name) => interpreted(found[1 + names.indexOf(name)]));
  }
  const parts = message.split(" or ");
  return parts.length > 1 ? parts.map(interpreted).join(` ${t("or")} `) : message;
}
