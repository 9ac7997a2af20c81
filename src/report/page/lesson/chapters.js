// A chapter: what a finding's scene shows, why it matters, the repair; and what a run changes against
// the listing as printed.

/** The values of a run at its end that are compared: by name. */
function results(programs) {
  const found = new Map();
  for (const program of [programs.c_cnt, programs.Km]) {
    if (!program) continue;
    const machine = new Machine(program);
    machine.goTo(machine.steps.length);
    for (const [name, value] of machine.values) if (/^(ct|yt|dy|k_cnt|MJS)\[/.test(name)) found.set(name, value);
    if (machine.failure) found.set("stops", machine.failure);
  }
  return found;
}

const RESULTS = ["stops", "ct", "yt", "dy", "k_cnt", "MJS"];

/** The names whose values differ between two runs, each with both, in the order in which they are
 * computed. An entry never written is 0. */
function changes(before, after) {
  const place = (name) => RESULTS.indexOf(name.split("[")[0]);
  const names = [...new Set([...before.keys(), ...after.keys()])].sort((a, b) => place(a) - place(b));
  const value = (of, name) => of.get(name) ?? (name === "stops" ? "no" : 0);
  return names.map((name) => [name, value(before, name), value(after, name)]).filter(([, a, b]) => a !== b);
}

const MOST_CHANGES = 12;

/** Shows what the run changes against the listings as printed, on the scene as it was given. */
function showChanges(run, programs) {
  const place = byId("changes");
  const printed = chapter().runs[0];
  place.hidden = run === printed && !isChanged();
  if (place.hidden) return;
  const changed = changes(results(programsOf(printed)), results(programs));
  const rows = changed.slice(0, MOST_CHANGES).map(([name, a, b]) =>
    make("tr", {}, make("th", { scope: "row" }, name), make("td", { "data-exact": exact(a) }, brief(a)), make("td", { "data-exact": exact(b) }, brief(b))),
  );
  const entries = changed.filter(([name]) => name.startsWith("MJS")).length;
  const heads = ["", "as printed", isChanged() ? "now" : run.name].map((text, k) => make("th", { scope: "col" }, k ? text : "name"));
  place.replaceChildren(
    make("h3", {}, `At the end, ${isEdited() ? "the edited listing" : run.name}${isMoved() ? " on the changed scene" : ""} beside as printed`),
    ...(changed.length
      ? [
          make("div", { class: "scroll" }, make("table", {}, make("thead", {}, make("tr", {}, ...heads)), make("tbody", {}, ...rows))),
          make("p", { class: "muted" }, `${changed.length === 1 ? "One value changes" : `${changed.length} values change`}, ${entries} of them in MJS${changed.length > MOST_CHANGES ? `; the first ${MOST_CHANGES} are shown` : ""}.`),
        ]
      : [make("p", {}, "Nothing changes on this scene.")]),
  );
  roving(place, "td", () => 2);
}

/** Shows what a finding's chapter says; nothing of a scene that is not a finding's. */
function showFinding(chapter) {
  const place = byId("finding");
  place.hidden = !chapter.finding;
  if (!chapter.finding) return;
  const row = chapter.finding;
  const lines = row.lines.length ? `${row.listing} ${row.lines.join(", ")}` : "around the listings";
  const part = (term, text) => [make("dt", {}, term), make("dd", {}, text)];
  place.replaceChildren(
    make("h2", {}, `${row.id} (${lines}): ${row.title}`),
    make(
      "dl",
      {},
      ...part("On this scene", `${row.verdict}: ${short(row.number)} ${row.of}. ${row.detail}`),
      ...part("Why it matters", row.why),
      ...part("A repair", row.repair),
      ...part("Before and after", row.edit.none?.reason ?? `before: ${chapter.runs[0].about}; after: choose the reading “repaired”, the listing with the repair, and see what it changes`),
    ),
  );
}
