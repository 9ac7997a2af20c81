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
  const value = (of, name) => of.get(name) ?? (name === "stops" ? t("no") : 0);
  return names.map((name) => [name, value(before, name), value(after, name)]).filter(([, a, b]) => a !== b);
}

const MOST_CHANGES = 12;

/** What runs, in words. */
function whatRuns(run) {
  const what = isEdited() ? t("the edited listing") : run.label;
  return isMoved() ? t("{what} on the changed scene", { what }) : what;
}

/** Shows what the run changes against the one before, on the scene as it was given. */
function showChanges(run, programs) {
  const place = byId("changes");
  const before = runBefore();
  // A repair may be of Fm alone.
  const isSame = run === before || (run.programs && LISTINGS.every((name) => run[name] === before[name]));
  place.hidden = isSame && !isChanged();
  if (place.hidden) return;
  const changed = changes(results(programsOf(before)), results(programs));
  const rows = changed.slice(0, MOST_CHANGES).map(([name, a, b]) =>
    make("tr", {}, make("th", { scope: "row" }, name === "stops" ? t("stops") : name), make("td", { "data-exact": exact(a) }, brief(a)), make("td", { "data-exact": exact(b) }, brief(b))),
  );
  const entries = changed.filter(([name]) => name.startsWith("MJS")).length;
  const head = headOf([t("name"), before.label, isChanged() ? t("now") : run.label]);
  place.replaceChildren(
    make("h3", {}, t("At the end, {what} beside {before}", { what: whatRuns(run), before: before.label })),
    ...(changed.length
      ? [
          make("div", { class: "scroll" }, make("table", {}, head, make("tbody", {}, ...rows))),
          make("p", { class: "muted" }, [t("Values that change: {count}, of them in MJS: {entries}.", { count: changed.length, entries }), ...(changed.length > MOST_CHANGES ? [t("The first {count} are shown.", { count: MOST_CHANGES })] : [])].join(" ")),
        ]
      : [make("p", {}, t("Nothing changes on this scene."))]),
  );
  roving(place, "td", () => 2);
}

/** What to try in a chapter, each a button. */
function trials({ lines, listing, edit }, { contact, load }) {
  const trial = (isThere, text, act) => (isThere ? [button(text, act), " "] : []);
  const [line] = lines;
  const runToLine = () => {
    choose({ run: 0, which: listing });
    go(page.machine.runTo(page.machine.lines.findIndex(({ number }) => number === line)), true);
  };
  const playIterations = () => {
    choose({ run: 0, which: "iterations" });
    play(true);
  };
  return [
    ...trial(lines.length, t("run to line {line}", { line }), runToLine),
    ...trial(!edit.none, t("run the repaired listing"), () => choose({ run: 1, at: Infinity })),
    ...trial(contact.length && load.some((f) => f !== 0), t("play the iterations"), playIterations),
  ];
}

/** Shows what a chapter says; nothing of the scene with which the page opens. */
function showFinding(chapter) {
  const place = byId("finding");
  place.hidden = !chapter.finding && !chapter.repairs;
  place.classList.toggle("repairs", Boolean(chapter.repairs));
  if (chapter.repairs) place.replaceChildren(...repairsOf(chapter.repairs));
  if (!chapter.finding) return;
  const row = chapter.finding;
  const lines = row.lines.length ? `${row.listing} ${row.lines.join(", ")}` : t("around the listings");
  const part = (term, ...content) => [make("dt", {}, term), make("dd", {}, ...content)];
  place.replaceChildren(
    make("summary", {}, make("h2", {}, `${row.id} (${lines}): ${row.title}`)),
    make(
      "dl",
      {},
      ...part(t("Goal"), row.lines.length ? t("See what {lines} does that the text does not say.", { lines }) : t("See in the iterations what no line of a listing shows.")),
      ...part(t("Try it"), ...trials(row, data.meshes[chapter.runs[0].mesh])),
      ...part(t("On this scene"), `${row.verdict}: ${row.number === null ? t("decided by rounding:") : inProse(row.number)} ${row.of}. ${row.detail}`),
      ...part(t("Why it matters"), row.why),
      ...part(t("A repair"), row.repair),
      ...part(t("Before and after"), row.edit.none?.reason ?? t("before: {about}; after: choose the reading “repaired”, the listing with the repair, and see what it changes", chapter.runs[0])),
    ),
  );
}
