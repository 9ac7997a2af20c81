// What a script adds to the report: tables of a run, parts that unfold when they are linked to, tables that copy as CSV.

/** The columns of the quantities that live on a place, of those that any row has. */
function columnsOf(place, rows) {
  const known = data.quantities[place].filter(({ name }) => rows.some((row) => row[name] !== undefined && row[name] !== null));
  const valueOf = ({ name }) => (row) => (name === "cycle" ? cycleInWords(row.cycle) : Array.isArray(row[name]) ? row[name].join(", ") : row[name]);
  const kindOf = (quantity) => (rows.some((row) => typeof valueOf(quantity)(row) === "string") ? "text" : undefined);
  const headOf = ({ title, unit }) => [title, data.units[unit]].filter(Boolean).join(", ");
  return known.map((quantity) => [headOf(quantity), valueOf(quantity), kindOf(quantity)]);
}

const cycleInWords = (cycle) => (!cycle ? t("new") : cycle.length === 1 ? t("unchanged") : t("as in {first} (period of {length})", { first: cycle.members[0], length: cycle.length }));

/** The iterations of a run, its bodies and its contact nodes at the end. */
function showIterations({ name, result }) {
  const tables = [[t("Iterations of {run}", { run: name }), "iteration", result?.iterations], [t("Bodies of {run}", { run: name }), "body", result?.bodies], [t("Contact nodes of {run}", { run: name }), "contact", result?.contact]];
  const known = tables.filter(([, , rows]) => rows?.length);
  byId("iterations").replaceChildren(...known.map(([title, place, rows]) => tableOf(title, columnsOf(place, rows), rows)));
}

/** Unfolds the part that the address names, and those around it. */
function unfold() {
  const named = byId(decodeURIComponent(location.hash.slice(1)));
  for (let part = named; part; part = part.parentElement) if (part.tagName === "DETAILS") part.open = true;
  named?.scrollIntoView();
}

byId("fields").hidden = byId("to-fields").hidden = false;
byId("menu").addEventListener("click", ({ target }) => target.closest("a") && (byId("menu").open = false));
byId("menu").after(button(t("print"), () => window.print()));
document.addEventListener("click", (/** @type {any} */ { target }) => target.closest?.("a")?.hash === location.hash && unfold());
window.addEventListener("hashchange", unfold);
document.querySelectorAll("article table").forEach(addCopying);
startViewer();
showExactValues();
unfold();
