// The chapter "From the print to the right answer": a row after each repair, which opens the programs with the
// faults that are left.

/** Opens the programs after a repair: the listing that it changed, or the last iteration where those are played. */
function openRepair(k) {
  const [before, after] = chapter().runs.slice(k, k + 2);
  const changed = LISTINGS.find((name) => before.programs && before[name] !== after[name]);
  choose({ run: k + 1, ...(isIterating() ? { at: Infinity } : changed && changed !== page.which ? { which: changed } : {}) });
}

/** The content of the chapter: what a row is, the table, and the picture. */
function repairsOf({ rows, order }) {
  const cell = (text, value) => make("td", { "data-exact": value === undefined ? undefined : exact(value) }, text);
  const share = (x) => cell(x === undefined ? "–" : decimal((Math.round(1e4 * x) / 100).toFixed(2)), x);
  const row = ({ repairs, finding, fault, places, in_contact, transmitted, error, by_rounding }) => {
    const link = finding ? make("a", { href: `#chapter=${finding}` }, finding) : "–";
    const words = `${tell(fault)}${places ? ` (${places.replaceAll("-", "–")})` : ""}${error === undefined ? `; ${by_rounding ? t("decided by rounding") : t("stops")}` : ""}`;
    const number = make("th", { scope: "row" }, make("button", {}, String(repairs)));
    return [number, cell(link), share(error), share(transmitted), cell(in_contact ?? "–"), make("td", { class: "words" }, words)];
  };
  const heads = [t("repairs"), t("finding repaired"), t("error in energy, %"), t("transmitted load, %"), t("in contact"), t("its fault")];
  const table = tableFrom("", heads, rows.map(row));
  table.id = "repairs";
  table.tBodies[0].addEventListener("click", ({ target }) => target.closest("a") || openRepair(target.closest("tr").sectionRowIndex));
  roving(table, "button");
  const words = t("A row opens the corrected algorithm with the faults that are left. Errors are against the solution without friction, node to segment, in the initial geometry, on the same mesh.");
  const figure = make("div", {}, make("h3", {}, t("Error by the number of repairs")), make("canvas", { id: "way", role: "img" }), make("p", { id: "mended" }), make("p", { class: "muted" }, t(order)));
  return [make("summary", {}, make("h2", {}, t("Repair by repair"))), make("p", {}, words), make("div", { class: "way" }, make("div", { class: "scroll" }, table), figure)];
}

/** The lines of the programs that the last repair of the run has changed, those of programs that the page does not step
 * through too. */
function mendedLines() {
  const { programs: before } = runBefore();
  return Object.entries((before && run().programs) ?? {}).flatMap(([name, place]) => {
    const [own, other] = [place, before[name]].map((place) => linesAt(place));
    const same = commonPlaces(...[own, other].map((lines) => lines.map(({ text }) => text)));
    return own.filter((_, k) => !same.has(k)).map(({ number, text }) => make("code", {}, `${name} ${number}: ${text}`));
  });
}

/** Lights the row of the run that is shown, and its point in the picture. */
function showRepair({ rows }) {
  [...byId("repairs").tBodies[0].rows].forEach((row, k) => row.classList.toggle("current", k === page.run - 1));
  const mended = mendedLines();
  byId("mended").replaceChildren(...(mended.length ? [t("changed:"), ...mended] : []));
  const errors = rows.map(({ error }) => error);
  drawCurve(byId("way"), errors, page.run - 1, rows.map(({ finding, repairs }) => finding ?? String(repairs)));
  byId("way").setAttribute("aria-label", `${t("Error by the number of repairs")}: ${errors.map((error) => (error === undefined ? "–" : percent(error))).join("; ")}`);
}
