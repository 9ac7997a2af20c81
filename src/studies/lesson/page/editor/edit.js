// The listing edited in place: a text with its lines' numbers, what is wrong in it marked where it stands, and which
// lines are not as printed. An editor of our own, of a text area over its marks: one from outside, such as CodeMirror,
// would weigh as much as the whole page.

/** A listing as text, as it was given: two spaces a level. */
const textOf = (place) => linesAt(place).map(({ level, text }) => "  ".repeat(level) + text).join("\n");

/** The places in `one` of what `other` has in the same order: of lines, those that are as printed; of letters, those of
 * another name. It is a longest common subsequence. */
function commonPlaces(one, other) {
  const longest = Array.from({ length: one.length + 1 }, () => Array(other.length + 1).fill(0));
  for (let i = one.length - 1; i >= 0; i -= 1) {
    for (let j = other.length - 1; j >= 0; j -= 1) longest[i][j] = one[i] === other[j] ? 1 + longest[i + 1][j + 1] : Math.max(longest[i + 1][j], longest[i][j + 1]);
  }
  const same = new Set();
  for (let [i, j] = [0, 0]; i < one.length && j < other.length; ) {
    if (one[i] === other[j]) same.add(i), i++, j++;
    else if (longest[i + 1][j] >= longest[i][j + 1]) i += 1;
    else j += 1;
  }
  return same;
}

/** The state of a run's listing that is in force, in words: as printed, repaired, edited. */
function stateOf(name) {
  const printed = chapter().runs[0];
  const { label, programs } = run();
  const isAsPrinted = !programs && run()[name] === printed[name];
  const isReading = !programs && !["as printed", "repaired", "edited"].includes(label);
  const base = isReading ? (isAsPrinted ? t("as printed, read with {label}", { label }) : t("under {label}", { label })) : isAsPrinted ? t("as printed") : tell(label);
  if (!page.edits.has(run()[name])) return base;
  return isAsPrinted && !isReading ? t("edited") : t("{base}, then edited", { base });
}

/** Whether the text of a listing that was typed is not in force, as it has an error. */
function isStale(name) {
  const typed = page.isMine && page.typed.get(run()[name]);
  return Boolean(typed) && typed.text !== typed.last;
}

/** A listing in words: what is in force, and whether the text that was typed is not. */
function listingInWords(name, hasError = isStale(name)) {
  if (!hasError) return stateOf(name);
  return `${stateOf(name)}, ${page.edits.has(run()[name]) ? t("of the last text without an error") : t("your text has an error and is not run")}`;
}

/** What the controls can do: "reset" takes back tolerance and nodes, "as printed" the listings; what was typed comes back. */
function showButtons() {
  byId("edit").textContent = byId("editor").hidden ? t("edit") : t("done");
  byId("reset").disabled = !isMoved();
  byId("printed").disabled = page.run === 0 && !page.isMine;
  byId("mine").hidden = page.isMine || page.typed.size === 0;
  byId("ask").disabled = isIterating();
}

/** Shows what is wrong, and how sure it is: an error does not run. */
function showRemarks(text) {
  const error = errorIn(page.which, text);
  const lines = linesOf(text);
  // A corrected listing may call its programs.
  const isKnown = (name) => new Run({}, page.programs.worksheet, {}).has(name) || name in (run().programs ?? {});
  const remarks = error || text === textOf(run()[page.which]) ? [] : remarksOn(readListing(page.which, lines), page.programs.worksheet, isKnown);
  const open = error && openBracket(error, text);
  const words = open ? t("the bracket that is opened here is not closed.") : error && interpreted(error.message) + ".";
  const wrong = error ? [{ ...error, column: open ?? error.column, length: 1, words }] : remarks;
  const items = wrong.map((at) => {
    const causes = error && !open ? likelyCauses(error, text) : [];
    const words = t("Line {fileLine}, column {column}: {words}", at) + (causes.length ? ` ${t("Likely: {causes}.", { causes: causes.join(` ${t("or")} `) })}` : "");
    const mend = () => {
      showEditor(true);
      putCaret(at);
    };
    return make("li", {}, button(words, mend));
  });
  byId("text-error").replaceChildren(...items);
  if (error) byId("text-error").append(make("li", {}, t("Until it is mended, the rest of the page stays with the last text that could be read, and “done” leads back to the error; “as printed” takes the text back.")));
  byId("text").setAttribute("aria-invalid", String(error !== null));
  page.isStale = error !== null;
  byId("columns").classList.toggle("stale", page.isStale);
  showMarks(text, wrong);
  say("listing-title", `${page.which}, ${listingInWords(page.which, page.isStale)}`);
  return error;
}

/** Draws the numbers of the lines, and the text once more below the letters, with what is wrong underlined. */
function showMarks(text, wrong) {
  const lines = text.split("\n");
  byId("gutter").textContent = lines.map((_, k) => k + 1).join("\n");
  const marked = lines.flatMap((line, k) => {
    const letters = [...line];
    let at = 0;
    const pieces = wrong.filter(({ fileLine }) => fileLine === k + 1).sort((a, b) => a.column - b.column).flatMap(({ column, length }) => {
      const [last, from] = [at, Math.max(at, column - 1)];
      at = from + length;
      return [letters.slice(last, from).join(""), make("mark", {}, letters.slice(from, at).join("") || " ")];
    });
    return [...pieces, letters.slice(at).join("") + "\n"];
  });
  byId("marks").replaceChildren(...marked);
  scrollMarks();
}

function scrollMarks() {
  const { scrollTop, scrollLeft } = byId("text");
  byId("marks").style.transform = `translate(${-scrollLeft}px, ${-scrollTop}px)`;
  byId("gutter").style.transform = `translateY(${-scrollTop}px)`;
}

/** Says where the caret is. */
function sayCaret() {
  const { value, selectionStart } = byId("text");
  const before = value.slice(0, selectionStart).split("\n");
  say("caret", t("line {line}, column {column}", { line: String(before.length), column: String([...before.at(-1)].length + 1) }));
}

function putCaret({ fileLine, column, length = 0 }) {
  const text = byId("text");
  const lines = text.value.split("\n");
  const start = [...lines.slice(0, fileLine - 1), [...lines[fileLine - 1]].slice(0, column - 1).join("")].join("\n").length;
  // The focus scrolls to where the caret is then.
  text.setSelectionRange(start, start + length);
  text.focus();
  sayCaret();
}

/** Shows the text of the listing that is chosen. What is typed stays, so that the caret does. */
function showText() {
  const text = shownText(run()[page.which]);
  if (byId("text").value !== text) byId("text").value = text;
  showRemarks(text);
  sayCaret();
}

/** Reads what is typed and keeps it: the page runs it, or says what is wrong with it. The iterations have no text. */
function readText() {
  if (isIterating()) return;
  const place = run()[page.which];
  const text = byId("text").value;
  const isFirst = !page.isMine;
  const error = showRemarks(text);
  const last = error ? (isFirst ? undefined : page.typed.get(place)?.last) : text;
  page.typed.set(place, { text, last });
  if (text === textOf(place)) page.typed.delete(place);
  page.isMine = page.typed.size > 0;
  keepTyped();
  if (!error || isFirst) return choose({ edits: true });
  say("status", placeInWords());
}

/** Shows the text to type in, from its top, or the listing. */
function showEditor(isOpen) {
  byId("editor").hidden = !isOpen;
  byId("listing-box").hidden = byId("legend").hidden = isOpen;
  byId("below").classList.toggle("editing", isOpen);
  showButtons();
  if (!isOpen) return lightLine(page.machine);
  byId("text").scrollTop = byId("text").scrollLeft = 0;
  putCaret({ fileLine: 1, column: 1 });
  scrollMarks();
}

function watchEditor() {
  const text = byId("text");
  let timer;
  text.addEventListener("input", () => {
    clearTimeout(timer);
    timer = setTimeout(readText, 150);
  });
  text.addEventListener("scroll", scrollMarks);
  document.addEventListener("selectionchange", () => document.activeElement === text && sayCaret());
  byId("edit").addEventListener("click", () => {
    const isOpen = !byId("editor").hidden;
    clearTimeout(timer);
    if (isOpen) readText();
    if (isOpen && page.isStale) return byId("text-error").querySelector("button").click();
    showEditor(!isOpen);
  });
  for (const [id, change] of Object.entries({ printed: { run: 0, isMine: false }, mine: { isMine: true } })) byId(id).addEventListener("click", () => {
    choose(change);
    keepTyped();
  });
  byId("download").addEventListener("click", download);
}
