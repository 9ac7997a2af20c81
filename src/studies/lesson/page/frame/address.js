// The situation in the page's address, behind `#`: chapter, reading, listing, step, tolerance, moved
// nodes, reversed edges, and the texts of the listings that are edited.

const LISTINGS = ["c_cnt", "Km"];

/** The chapter's name in the address: its finding, "repairs", or its scene. */
const nameOf = ({ finding, repairs, name }) => finding?.id ?? (repairs ? "repairs" : name);

/** Writes the situation into the address once nothing has changed for a while. */
function keepAddress() {
  clearTimeout(page.timer);
  page.timer = setTimeout(() => {
    const moved = [...page.moved].map(([n, [x, y]]) => `${n}:${x},${y}`).join(";");
    const fields = { chapter: nameOf(chapter()), run: run().name, listing: page.which, step: page.machine.at, tolerance: page.factor, moved };
    if (page.turned.size) fields.turned = [...page.turned].join();
    if (page.which === "iterations") fields.variant = page.variant;
    for (const name of LISTINGS) if (page.edits.has(run()[name])) fields[name] = page.edits.get(run()[name]);
    const isDefault = page.chapter === 0 && page.run === 0 && page.machine.at === 0 && !isChanged();
    history.replaceState(null, "", isDefault ? " " : `#${new URLSearchParams(fields)}`);
  }, 300);
}

/** Opens the situation of the address; what it does not say, or says wrongly, is as at first. */
function openAddress() {
  const fields = new URLSearchParams(location.hash.slice(1));
  const place = (list, name) => Math.max(0, list.findIndex((item) => nameOf(item) === name));
  openChapter(place(data.scenes, fields.get("chapter")));
  if (!fields.has("chapter")) return;
  const whiches = page.mesh.contact.length ? ["c_cnt", "Km", "iterations"] : ["Km"];
  const which = whiches.find((which) => which === fields.get("listing")) ?? whiches[0];
  const variants = [...byId("variant").options].map(({ value }) => value);
  const chosen = place(chapter().runs, fields.get("run"));
  const edits = LISTINGS.filter((name) => fields.has(name) && !errorIn(name, fields.get(name)));
  const factor = Number(fields.get("tolerance"));
  const nodes = (fields.get("moved") ?? "").split(";").map((text) => text.split(/[:,]/).map(Number));
  const isNode = ([n, ...at]) => Number.isInteger(n) && n >= 1 && n <= page.mesh.count && at.length === 2 && at.every(Number.isFinite);
  choose({
    run: chosen,
    which,
    variant: variants.find((variant) => variant === fields.get("variant")) ?? page.variant,
    at: Number(fields.get("step")) || 0,
    factor: factor >= 0.01 && factor <= 100 ? factor : 1,
    edits: new Map(edits.map((name) => [chapter().runs[chosen][name], fields.get(name)])),
    turned: new Set((fields.get("turned") ?? "").split(",").map(Number).filter((edge) => page.mesh.edge.has(edge))),
    moved: new Map(nodes.filter(isNode).map(([n, ...at]) => [n, at])),
  });
}
