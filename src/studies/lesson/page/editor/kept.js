// What a reader types is kept: the texts of each chapter's listings, in the browser's storage where it has one.
// page.typed has of each listing, by its place, the text and, where that has an error, the last text that ran.

const keyOf = (chapter) => `plane-contact lesson ${data.version} ${data.scene_sha256} ${nameOf(chapter)}`;

/** The reading and the name under which a chapter first has the listing at a place. */
const ownerOf = (place) => chapter().runs.flatMap((run) => LISTINGS.map((name) => [run, name])).find(([run, name]) => run[name] === place);

/** Does what needs the storage, which a browser may refuse. */
function stored(act) { try { return act(); } catch { return null; } }

/** What was typed in the chapter before, and whether it was in force. */
function typedBefore() {
  const { texts = [], isMine = false } = stored(() => JSON.parse(localStorage.getItem(keyOf(chapter())))) ?? {};
  const placeOf = (name, which) => chapter().runs.find((run) => run.name === name)?.[which];
  const placed = texts.map(([name, which, text, last]) => [placeOf(name, which), { text, last: last ?? undefined }]);
  return { typed: new Map(placed.filter(([place]) => place !== undefined)), isMine };
}

/** Keeps what is typed now. */
function keepTyped() {
  const texts = [...page.typed].map(([place, { text, last }]) => {
    const [run, which] = ownerOf(place);
    return [run.name, which, text, last];
  });
  const [key, kept] = [keyOf(chapter()), JSON.stringify({ texts, isMine: page.isMine })];
  stored(() => (texts.length ? localStorage.setItem(key, kept) : localStorage.removeItem(key)));
}

/** The texts that run: of what is typed where it is in force. */
const editsInForce = () => new Map(page.isMine ? [...page.typed].flatMap(([place, { last }]) => (last === undefined ? [] : [[place, last]])) : []);

/** The text that the editor shows of a listing. */
const shownText = (place) => (page.isMine && page.typed.get(place)?.text) || textOf(place);

/** Saves the text of the listing as a file that `plane-contact listing run --listing` takes; its name says what it is. */
function download() {
  const { which } = page;
  const place = run()[which];
  const isTyped = page.isMine && page.typed.has(place);
  const of = isTyped ? "my-" : place === chapter().runs[0][which] ? "" : run().name.replace(/\W+/g, "-") + "-";
  const href = URL.createObjectURL(new Blob([shownText(place) + "\n"], { type: "text/plain" }));
  make("a", { href, download: `${of}${which}.txt` }).click();
  setTimeout(() => URL.revokeObjectURL(href), 1000);
}
