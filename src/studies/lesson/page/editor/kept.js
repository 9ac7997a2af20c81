// What a reader types is kept: the texts of each chapter's listings, in the browser's storage where it has one.
// page.typed has of each listing, by its place, the text and, where that has an error, the last text that ran.

const keyOf = (chapter) => `plane-contact lesson ${data.version} ${data.scene_sha256} ${nameOf(chapter)}`;

/** The reading and the name under which a chapter first has the listing at a place. */
const ownerOf = (place) => chapter().runs.flatMap((run) => LISTINGS.map((name) => [run, name])).find(([run, name]) => run[name] === place);

/** Does what needs the storage, which a browser may refuse. */
function stored(act) { try { return act(); } catch { return null; } }

/** What was typed in the chapter before. */
function typedBefore() {
  const found = stored(() => JSON.parse(localStorage.getItem(keyOf(chapter())))) ?? [];
  const placed = found.map(([name, which, text, last]) => [chapter().runs.find((run) => run.name === name)?.[which], { text, last: last ?? undefined }]);
  return new Map(placed.filter(([place]) => place !== undefined));
}

/** Keeps what is typed now. */
function keepTyped() {
  const found = [...page.typed].map(([place, { text, last }]) => {
    const [run, which] = ownerOf(place);
    return [run.name, which, text, last];
  });
  stored(() => (found.length ? localStorage.setItem(keyOf(chapter()), JSON.stringify(found)) : localStorage.removeItem(keyOf(chapter()))));
}

/** The texts that run: of what is typed where it is in force. */
const editsInForce = () => new Map(page.isMine ? [...page.typed].flatMap(([place, { last }]) => (last === undefined ? [] : [[place, last]])) : []);

/** The text that the editor shows of a listing. */
const shownText = (place) => (page.isMine && page.typed.get(place)?.text) || textOf(place);

/** Saves the text of the listing as a file that `plane-contact listing run --listing` takes. */
function download() {
  const link = make("a", { href: URL.createObjectURL(new Blob([shownText(run()[page.which]) + "\n"], { type: "text/plain" })), download: `my-${page.which}.txt` });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}
