// The listing edited in place: its text, what is wrong with it, and which lines are not as printed.

/** A listing as text, as it was given: two spaces a level. */
const textOf = (place) => linesAt(place).map(({ level, text }) => "  ".repeat(level) + text).join("\n");

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

/** The places of the lines that are as printed: a longest common subsequence of both. */
function placesAsPrinted(lines, printed) {
  const longest = Array.from({ length: lines.length + 1 }, () => Array(printed.length + 1).fill(0));
  for (let i = lines.length - 1; i >= 0; i -= 1) {
    for (let j = printed.length - 1; j >= 0; j -= 1) {
      longest[i][j] = lines[i] === printed[j] ? 1 + longest[i + 1][j + 1] : Math.max(longest[i + 1][j], longest[i][j + 1]);
    }
  }
  const same = new Set();
  for (let [i, j] = [0, 0]; i < lines.length && j < printed.length; ) {
    if (lines[i] === printed[j]) {
      same.add(i);
      i += 1;
      j += 1;
    } else if (longest[i + 1][j] >= longest[i][j + 1]) i += 1;
    else j += 1;
  }
  return same;
}

/** "reset" takes back what is changed, and a text with an error. */
function showReset() {
  byId("reset").disabled = !isChanged() && byId("text-error").textContent === "";
}

function showError(error) {
  byId("text-error").textContent = error ? t("Line {fileLine}, column {column}: {message}.", error) : "";
  byId("text").setAttribute("aria-invalid", String(error !== null));
  showReset();
}

/** Shows the text of the listing that is chosen. What is typed stays, so that the caret does. */
function showText() {
  const place = run()[page.which];
  const text = page.edits.get(place) ?? textOf(place);
  byId("listing-title").textContent = page.edits.has(place) ? t("The listing, edited") : run().programs ? t("The listing, {label}", run()) : t("The listing as printed");
  if (byId("text").value !== text) byId("text").value = text;
  showError(null);
}

/** Reads what is typed: the page runs it, or says what is wrong with it. The iterations have no text. */
function readText() {
  if (isIterating()) return;
  const place = run()[page.which];
  const text = byId("text").value;
  const error = errorIn(page.which, text);
  showError(error);
  if (error) return;
  const edits = new Map(page.edits).set(place, text);
  if (text === textOf(place)) edits.delete(place);
  choose({ edits });
}

/** Shows the text to type in, or the listing. */
function showEditor(isOpen) {
  byId("editor").hidden = !isOpen;
  byId("listing-box").hidden = isOpen;
  byId("edit").textContent = isOpen ? t("done") : t("edit");
}

function watchEditor() {
  const text = byId("text");
  let timer;
  text.addEventListener("input", () => {
    clearTimeout(timer);
    timer = setTimeout(readText, 150);
  });
  byId("edit").addEventListener("click", () => {
    const isOpen = !byId("editor").hidden;
    if (isOpen) readText();
    showEditor(!isOpen || byId("text-error").textContent !== "");
    if (byId("editor").hidden) lightLine(page.machine);
    else text.focus();
  });
}
