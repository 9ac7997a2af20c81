// The situation in the page's address, behind `#`: chapter, reading, listing, step, tolerance, moved nodes, reversed
// edges, language, and what is edited of the listings. What a link does not say is as printed.

const LISTINGS = ["c_cnt", "Km"];

/** The chapter's name in the address: its finding, "repairs", or its scene. */
const nameOf = ({ finding, repairs, name }) => finding?.id ?? (repairs ? "repairs" : name);

/** How many elements two lists begin with in common. */
function sameStart(a, b) {
  const k = a.findIndex((item, k) => item !== b[k]);
  return k < 0 ? a.length : k;
}

/** What a text has in place of lines of a base: how many lines before and behind it are the base's, then its own. */
function editOf(text, base) {
  const [own, other] = [text, base].map((text) => text.split("\n"));
  const before = sameStart(own, other);
  const behind = sameStart(...[own, other].map((lines) => lines.slice(before).reverse()));
  return [before, behind, ...own.slice(before, own.length - behind)].join("\n");
}

/** The text that [`editOf`] was made of. */
function edited(edit, base) {
  const [before, behind, ...own] = edit.split("\n");
  const other = base.split("\n");
  return [...other.slice(0, Number(before)), ...own, ...other.slice(other.length - Number(behind))].join("\n");
}

/** The address of the situation that is shown. */
function address() {
  /** @type {Record<string, any>} */
  const fields = { chapter: nameOf(chapter()) };
  if (page.run > 0) fields.run = run().name;
  fields.listing = page.which;
  if (page.machine.at > 0) fields.step = page.machine.at;
  if (page.factor !== 1) fields.tolerance = page.factor;
  if (page.moved.size) fields.moved = [...page.moved].map(([n, [x, y]]) => `${n}:${x},${y}`).join(";");
  if (page.turned.size) fields.turned = [...page.turned].join();
  if (isIterating()) fields.variant = page.variant;
  if (speech.language !== data.language) fields.language = speech.language;
  for (const name of LISTINGS) if (page.edits.has(run()[name])) fields[name] = editOf(page.edits.get(run()[name]), textOf(run()[name]));
  // Brackets and commas need no escape behind #.
  return `#${new URLSearchParams(fields)}`.replace(/%(28|29|5B|5D|2C)/g, decodeURIComponent);
}

/** Writes the situation into the address once nothing has changed for a while. */
function keepAddress() {
  clearTimeout(page.timer);
  page.timer = setTimeout(() => {
    const isDefault = page.chapter === 0 && page.run === 0 && page.machine.at === 0 && !isMoved() && page.typed.size === 0 && speech.language === data.language;
    history.replaceState(null, "", isDefault ? " " : address());
  }, 300);
}

/** Copies a link to the situation, for a message or a sheet of exercises; of a page that is a file, its end, as the file
 * has another place with who gets it. */
async function copyLink() {
  const link = location.protocol === "file:" ? address() : new URL(address(), location.href).href;
  const isCopied = await stored(() => navigator.clipboard.writeText(link).then(() => true, () => false));
  say("said", !isCopied ? link : location.protocol === "file:" ? t("Copied: it goes behind the address of the lesson’s file.") : t("The link is copied."));
  byId("link").firstChild.data = isCopied ? t("copied") : t("in the address bar");
  setTimeout(() => (byId("link").firstChild.data = t("copy link")), 2000);
  history.replaceState(null, "", link);
}

/** Opens the situation of the address; what it does not say, or says wrongly, is as at first. */
function openAddress() {
  const fields = new URLSearchParams(location.hash.slice(1));
  const place = (list, name) => Math.max(0, list.findIndex((item) => nameOf(item) === name));
  setLanguage(["en", "ru"].includes(fields.get("language")) ? fields.get("language") : data.language);
  fillChapters();
  openChapter(place(data.scenes, fields.get("chapter")));
  if (!fields.has("chapter")) return;
  const isThere = ({ value, disabled }) => value === fields.get("listing") && !disabled;
  const chosen = Math.max(0, chapter().runs.findIndex(({ name }) => name === fields.get("run")));
  const nodes = (fields.get("moved") ?? "").split(";").map((text) => text.split(/[:,]/).map(Number));
  const isNode = ([n, ...at]) => Number.isInteger(n) && n >= 1 && n <= page.mesh.count && at.length === 2 && at.every(Number.isFinite);
  const texts = LISTINGS.filter((name) => fields.has(name)).map((name) => {
    const place = chapter().runs[chosen][name];
    return { name, place, text: edited(fields.get(name), textOf(place)) };
  }).filter(({ name, text }) => !errorIn(name, text));
  // A later text that has an error stays where the link has the one before it.
  for (const { place, text } of texts) if (page.typed.get(place)?.last !== text) page.typed.set(place, { text, last: text });
  choose({
    run: chosen,
    which: radios().find(isThere)?.value ?? page.which,
    variant: fields.get("variant") ?? page.variant,
    at: Number(fields.get("step")) || 0,
    factor: Math.min(100, Math.max(0.01, Number(fields.get("tolerance") ?? 1) || 1)),
    // A text that never ran is not in a link; what runs is the same with it.
    isMine: texts.length > 0 || (page.isMine && page.edits.size === 0),
    turned: new Set((fields.get("turned") ?? "").split(",").map(Number).filter((edge) => page.mesh.edge.has(edge))),
    moved: new Map(nodes.filter(isNode).map(([n, ...at]) => [n, at])),
  });
}
