// A chapter: what to try on a finding's scene, and at its end the conclusion; and what a run changes against the
// listing as printed.

/** The values of a run at its end that are compared: by name. */
function results({ c_cnt, Km }) {
  const machines = [c_cnt, Km].map(atEnd);
  const values = machines.flatMap((machine) => [...machine.values]).filter(([name]) => /^(ct|yt|dy|k_cnt|MJS)\[/.test(name));
  return new Map(/** @type {any} */ ([...values, ...machines.flatMap(({ failure }) => (failure ? [["stops", failure]] : []))]));
}

/** A machine at the end of a program. */
function atEnd(program) {
  const machine = new Machine(program ?? NOTHING);
  machine.goTo(machine.steps.length);
  return machine;
}

const RESULTS = ["stops", "ct", "yt", "dy", "k_cnt", "MJS"];

/** The names whose values differ between two runs, each with both, in the order in which they are
 * computed. An entry never written is 0. */
function changes(before, after) {
  const place = (name) => RESULTS.indexOf(name.split("[")[0]);
  const names = [...new Set([...before.keys(), ...after.keys()])].sort((a, b) => place(a) - place(b));
  const value = (of, name) => of.get(name) ?? (name === "stops" ? t("no") : 0);
  // Sums in another order differ by less.
  const isOther = (a, b) => (isNumber(a) && isNumber(b) ? Math.abs(a - b) > 1e-9 * Math.max(Math.abs(a), Math.abs(b)) : a !== b);
  return names.map((name) => [name, value(before, name), value(after, name)]).filter(([, a, b]) => isOther(a, b));
}

/** The run of a finding's chapter under its repair. */
const repairedRun = () => chapter().finding && chapter().runs[1];

/** The names of what the repair of a chapter on Km changes, on its scene as given. */
function atStake() {
  if (chapter().finding?.listing !== "Km" || !repairedRun()) return new Set();
  const [before, after] = chapter().runs.map((run) => results(programsOf(run)));
  return new Set(changes(before, after).map(([name]) => name));
}

/** Whether an edited listing does what the repaired one does, by their results on the scene as it is. */
function besideRepairInWords() {
  if (!repairedRun() || !isEdited()) return "";
  const repaired = new Programs(repairedRun(), page.mesh, chapter().nodes, page.programs.c_tll);
  const count = changes(results(repaired), results(page.programs)).length;
  return count ? t("Your edit is another one than the chapter's repair: {count} values differ from those of the repaired listing.", { count }) : t("Your edit does what the chapter's repair does: all values are those of the repaired listing, to rounding.");
}

const MOST_CHANGES = 12;

/** Shows what the run changes against the one before, on the scene as it was given. */
function showChanges(run, programs) {
  const place = byId("changes");
  const before = runBefore();
  // A repair may be of Fm alone.
  const isSame = run === before || (run.programs && LISTINGS.every((name) => run[name] === before[name]));
  place.hidden = isIterating() || (isSame && !isChanged());
  if (place.hidden) return place.replaceChildren();
  const changed = changes(results(programsOf(before)), results(programs));
  const now = LISTINGS.some((name) => page.edits.has(run[name])) ? t("the edited listing") : tell(run.label);
  const rows = changed.slice(0, MOST_CHANGES).map(([name, a, b]) => [name === "stops" ? t("stops") : name, valueCell(a), valueCell(b)]);
  const entries = changed.filter(([name]) => name.startsWith("MJS")).length;
  const heads = [t("name"), tell(before.label), isChanged() ? t("now") : tell(run.label)];
  const count = [t("Values that change: {count}, of them in MJS: {entries}.", { count: changed.length, entries }), ...(changed.length > MOST_CHANGES ? [t("The first {count} are shown.", { count: MOST_CHANGES })] : [])].join(" ");
  const what = isMoved() ? t("{what} on the changed scene", { what: now }) : now;
  place.replaceChildren(
    make("h3", {}, t("At the end, {what} beside {before}", { what, before: tell(before.label) })),
    ...(changed.length ? [make("div", { class: "scroll" }, tableFrom("", heads, rows)), make("p", { class: "muted" }, count)] : [make("p", {}, t("Nothing changes on this scene."))]),
    make("p", {}, besideRepairInWords()),
  );
  roving(place, "td", () => 2);
}

/** Where a finding stands in the listings. */
const placeOf = ({ listing, lines }) => (lines.length ? `${listing} ${lines.join(", ")}` : t("around the listings"));

/** What to try in a chapter, each a button. */
function trials({ lines, listing, edit }, { contact, load }) {
  const [line] = lines;
  const runToLine = () => {
    choose({ run: 0, which: listing });
    go(page.machine.runTo(page.machine.lines.findIndex(({ number }) => number === line)));
  };
  const played = (text, run) => button(text, () => {
    choose({ run, which: "iterations", variant: variantOf(chapter()), isMine: false });
    play(true);
  });
  const isStill = load.every((f) => f === 0);
  const isPlayed = contact.length > 0 && !isStill;
  return [
    lines.length ? button(t("run to line {line}", { line }), runToLine) : "",
    edit.none ? "" : button(t("run the repaired listing"), () => choose({ run: 1, isMine: false, at: Infinity })),
    isPlayed ? played(t("play the iterations"), 0) : "",
    isPlayed && !edit.none ? played(t("play them repaired"), 1) : "",
    ...(contact.length && isStill ? [t("No load acts on this scene: only the corrected iterations move anything, where they push a node out of the target.")] : []),
  ];
}

const described = (parts) => make("dl", {}, ...parts.flatMap(([term, ...content]) => [make("dt", {}, term), make("dd", {}, ...content)]));

/** Shows what a chapter is there for; of the scene with which the page opens there is nothing to say before its end. */
function showFinding({ finding: row, repairs, runs }) {
  const place = byId("finding");
  place.hidden = !row && !repairs;
  place.classList.toggle("repairs", Boolean(repairs));
  if (repairs) place.replaceChildren(...repairsOf(repairs));
  if (!row) return;
  const lines = placeOf(row);
  place.replaceChildren(
    make("summary", {}, make("h2", {}, `${row.id} (${lines})`)),
    described([
      [t("Goal"), t("See in {lines}: {title}.", { lines: row.lines.length ? lines : t("the iterations"), title: t(row.title) })],
      [t("Try it"), ...trials(row, data.meshes[runs[0].mesh]).flatMap((trial) => [trial, " "])],
    ]),
  );
}

/** The end of the chapter: what the listing did, what is wrong, what it costs, what repairs it. */
function showConclusion() {
  const { finding, repairs } = chapter();
  const parts = finding ? ofFinding(finding) : repairs ? ofRepairs(repairs) : ofScene();
  if (parts && isChanged()) parts.push([t("Of what"), finding || repairs ? t("This is of the chapter's scene and listings as given, not of your changes.") : t("What the listing did and what is wrong is of the scene as you changed it; what it costs is of the scene as given.")]);
  if (parts && score.asked) parts.push([t("Your answers"), t("{right} of {asked} right", score)]);
  page.concluded = parts;
  byId("conclusion").hidden = !parts || !page.isConcluded;
  if (parts) byId("conclusion").replaceChildren(make("summary", {}, make("h2", {}, t("Conclusion"))), described(parts));
}

/** Shows the conclusion from the first time on that the end is reached; unfolded where there is room. */
function unfoldConclusion() {
  if (page.isConcluded || !page.concluded) return;
  page.isConcluded = true;
  showConclusion();
  if (!isWide() || chapter().repairs) return;
  byId("finding").open = false;
  byId("conclusion").open = true;
}

/** What a fault costs, put back alone into the corrected algorithm on a scene: a sentence. */
function costInWords({ scene, price }) {
  const { weight, energy_relative, von_mises_relative, transmitted } = price;
  const [name, error, stress, share] = [t(price.name), ...[energy_relative, Math.abs(von_mises_relative), transmitted].map(percent)];
  const way = von_mises_relative > 0 ? t("too high") : t("too low");
  const values = { scene: t(scene.replace("findings/", "")), name, error, stress, share, way };
  const sentences = {
    fatal: () => t("On scene {scene}, the fault {name} stops the run, or contact presses no node any more.", values),
    shifts: () => t("On scene {scene}, the fault {name} makes the largest von Mises stress {way} by {stress}: an error of {error} in energy, with {share} of the load on the target.", values),
    free: () => t("On scene {scene}, the fault {name} changes nothing.", values),
    "decided by rounding": () => t("On scene {scene}, rounding decides what comes of the fault {name}.", values),
    "no fault under the scene's own friction": () => t("On scene {scene}, the fault {name} changes nothing, as no node slides under its friction.", values),
  };
  return sentences[weight]();
}

/** Words as a sentence of their own. */
const sentence = (words) => words[0].toUpperCase() + words.slice(1).replace(/\.?$/, ".");

/** What a finding's faults cost: on the chapter's scene and fig1, or on the first scene where they cost anything. */
function costsInWords({ prices }) {
  // Without a load there are no displacements that a fault could change.
  const loaded = prices.filter(({ scene }) => scene !== chapter().name || isLoaded());
  const near = loaded.filter(({ scene }) => [chapter().name, "fig1"].includes(scene));
  const costly = (list) => list.filter(({ price }) => !["free", "no fault under the scene's own friction"].includes(price.weight));
  const shown = [costly(near), [...near, ...costly(loaded)]].find((list) => list.length) ?? [];
  return shown.length ? [t("The fault was put back alone into the corrected algorithm."), ...shown.map(costInWords)] : [];
}

function ofFinding(row) {
  const { runs } = chapter();
  const named = (text) => text.replace(/(node|уз\S*) (\d+)/g, (_, word, n) => `${word} ${page.mesh.name(Number(n))}`);
  const repaired = row.edit.none ? t(row.edit.none.reason) : [t("choose the reading “repaired” and see what it changes"), ...runs[0].about.slice(1).map((words) => t("what is shown: {about}", { about: t(words) }))].join("; ");
  return [
    [t("What the listing did"), sentence(t("On scene {scene}, {what}", { scene: row.id, what: named(interpreted(t(row.detail))) }))],
    [t("What is wrong"), sentence(t(row.title))],
    [t("What it costs"), [sentence(t(row.why)), ...costsInWords(row)].join(" ")],
    [t("What repairs it"), sentence(`${t(row.repair)}; ${repaired}`)],
  ];
}

/** Of the chapter of repairs: from the print's own figures to the solution's. */
function ofRepairs({ rows }) {
  const [first, last] = [rows[0], rows.findLast(({ finding }) => finding)];
  return [
    [t("What the listing did"), t("Under printed it leaves an error of {error} in energy.", { error: first.error === undefined ? t("no result") : percent(first.error) })],
    [t("What repairs it"), t("After {count} repairs, the last of them {finding}, the error is {error}.", { count: last.repairs, finding: last.finding, error: percent(last.error) })],
  ];
}

/** Of a scene of one's own: which nodes the listing finds, and which it should. */
function ofScene() {
  const { mesh, programs } = page;
  if (!mesh.contact.length || run().programs) return null;
  const end = atEnd(programs.c_cnt);
  if (end.failure) return [[t("What the listing did"), t("The listing stops: {failure}", end)]];
  const nodes = contactNodes(mesh, end).map((node) => ({ ...node, ...fromTarget(mesh, node.node) }));
  const named = (list) => listed(list.map(({ node }) => node));
  const missed = nodes.filter(({ dy, isInside }) => dy !== 1 && isInside);
  const taken = nodes.filter(({ dy, isInside, distance }) => dy === 1 && !isInside && distance > programs.c_tll);
  const rows = data.scenes.find(({ repairs, name }) => repairs && name === chapter().name)?.repairs.rows;
  const cost = rows?.[0].error;
  const wrong = [
    ...(missed.length ? [t("Inside the target and missed: {nodes}.", { nodes: named(missed) })] : []),
    ...(taken.length ? [t("Farther away than c_tll and taken: {nodes}.", { nodes: named(taken) })] : []),
  ];
  return [
    [t("What the listing did"), t("c_cnt ({state}) finds, {contact}.", { state: stateOf("c_cnt"), contact: contactInWords(nodes.filter(({ dy }) => dy === 1).map(({ node }) => node)) })],
    [t("What is wrong"), wrong.join(" ") || t("No node is missed and none is taken that is apart.")],
    ...(cost === undefined ? [] : [[t("What it costs"), t("Under printed it leaves an error of {error} in energy.", { error: percent(cost) })]]),
    ...(rows ? [[t("What repairs it"), make("a", { href: "#chapter=repairs" }, tell(data.scenes.find(({ repairs }) => repairs).title))]] : []),
  ];
}
