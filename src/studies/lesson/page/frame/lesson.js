// The page: what is chosen, and what is shown after each step.

/** The title of the page, which is that of its first chapter. */
const LESSON = document.title;

const page = { chapter: 0, run: 0, which: "c_cnt", factor: 1, moved: new Map(), turned: new Set(), edits: new Map() };

const chapter = () => data.scenes[page.chapter];
const run = () => chapter().runs[page.run];

/** The run beside which a run is shown: as printed, or with a repair less. */
const runBefore = () => chapter().runs[run().programs ? Math.max(1, page.run - 1) : 0];

const meshOf = (run, moved, turned) => new Mesh(data.meshes[run.mesh], chapter().units, moved, turned);
const programsOf = (run) => new Programs(run, meshOf(run), chapter().nodes);

/** Whether the tolerance, a node or an edge is not as the scene has it. */
const isMoved = () => page.factor !== 1 || page.moved.size > 0 || page.turned.size > 0;

/** Whether a listing of the run is edited; one that other readings share is so in all of them. */
const isEdited = () => page.edits.has(run().c_cnt) || page.edits.has(run().Km);

const isChanged = () => isMoved() || isEdited();

const isIterating = () => page.which === "iterations";

/** A program that is not called. */
const NOTHING = { lines: [], steps: [], failure: null };

/** Chooses scene, run and listing. Under another reading of the same listing the place stays. */
function choose(change) {
  play(false);
  const isEnded = page.machine?.at > 0 && page.machine.at === page.machine.steps.length;
  const at = isEnded ? Infinity : (page.machine?.at ?? 0);
  Object.assign(page, change);
  if ("run" in change) fillVariants();
  page.mesh = meshOf(run(), page.moved, page.turned);
  page.programs = new Programs(run(), page.mesh, chapter().nodes, page.factor * run().c_tll, page.edits);
  page.pairs = new Machine(page.programs.c_cnt ?? NOTHING);
  page.machine = isIterating() ? played() : page.which === "Km" ? new Machine(page.programs.Km ?? { ...NOTHING, failure: t("c_cnt stopped, so Km is not called") }) : page.pairs;
  if (page.which === "Km") page.pairs.goTo(page.pairs.steps.length);
  page.zone = zoneOf(page.mesh, page.pairs);
  page.map = page.which === "Km" ? new MatrixMap(page.mesh, page.machine) : null;
  page.machine.goTo(change.at ?? ("which" in change ? 0 : at));
  byId("slider").max = page.machine.steps.length;
  byId("chapter").value = page.chapter;
  byId("run").value = page.run;
  for (const radio of document.getElementsByName("which")) radio.checked = radio.value === page.which;
  say("about", t("Scene {scene}. Reading: {label} ({about}).", { scene: chapter().name, ...run() }));
  byId("tolerance").value = Math.log10(page.factor);
  say("tolerance-label", `c_tll ${short(page.programs.c_tll)}`);
  byId("tolerance").setAttribute("aria-valuetext", byId("tolerance-label").textContent);
  if (!isIterating() && ["run", "which", "edits"].some((name) => name in change)) {
    showText();
    showLines(page.machine, linesAt(runBefore()[page.which]), (line) => go(page.machine.runTo(line)));
    byId("turn").textContent = page.which === "Km" ? t("element") : t("node");
    byId("turn").title = page.which === "Km" ? t("Run to the next element (N)") : t("Run to the next contact node (N)");
  }
  showReset();
  // Beside the arrays these would take half of a move's time.
  if (!page.dragged) {
    fillTurns();
    showChanges(run(), page.programs);
  }
  show();
}

/** Lists the turns of the outer loops, each with the step that begins it. */
function fillTurns() {
  const name = (turn) => (page.which === "Km" ? t("element {n}", { n: turn }) : t("node {n}", { n: page.mesh.name(page.mesh.contact[turn - 1]) }));
  const options = page.machine.turns.flatMap(({ from, turn }) => {
    const line = page.machine.lines[page.machine.steps[from].line].number;
    return turn === null ? [] : [make("option", { value: from + 1 }, t("{turn}, line {line}", { turn: name(turn), line }))];
  });
  byId("turns").replaceChildren(make("option", { value: 0 }, t("the start")), ...options);
}

/** Goes to a place; what a button or a key brings into MJS on the way flies. */
function go(at, isFlying = false) {
  const from = page.machine.at;
  page.machine.goTo(at);
  if (page.which === "Km") page.map.brought = broughtIn(page.machine, from);
  show();
  if (page.which === "Km") showAssembly(page.map.brought, page.map, isFlying);
}

/** Shows the state after the steps or the iterations that were made. */
function show() {
  document.querySelector(".columns").hidden = isIterating();
  byId("iterations").hidden = !isIterating();
  const line = isIterating() ? showIterations() : showSteps();
  if (chapter().repairs) showRepair(chapter().repairs);
  const { at, steps } = page.machine;
  byId("slider").value = at;
  say("status", isIterating() ? t("iteration {at} of {count}", { at, count: steps.length }) : [t("step {at} of {count}", { at, count: steps.length }), ...(line ? [t("line {line}", { line })] : [])].join(", "));
  byId("slider").setAttribute("aria-valuetext", byId("status").textContent);
  keepAddress();
  for (const id of ["start", "back"]) byId(id).disabled = at === 0;
  for (const id of ["forward", "end"]) byId(id).disabled = at === steps.length;
  for (const id of ["over", "decision", "turn"]) byId(id).disabled = isIterating() || at === steps.length;
}

/** Shows the listing and its arrays; returns the number of the line that was executed last, 0 before the first. */
function showSteps() {
  const { machine, mesh, pairs, zone } = page;
  const turn = machine.turnAt(machine.at - 1);
  const inKm = page.which === "Km";
  const line = machine.last ? machine.lines[machine.last.line].number : 0;
  // Read before anything is written, else the page is laid out anew.
  page.width = byId("pictures").clientWidth;
  if (mesh.contact.length) {
    const node = inKm ? null : turn;
    drawZone(mesh, pairs, zone, page.programs.c_tll, node, !inKm && !run().programs && (line === 6 || line === 7));
    drawGaps(mesh, pairs, zone, page.programs.c_tll, node);
  }
  const linked = inKm ? page.map.vector("W").map((e) => Math.ceil(e / 2)) : [];
  drawWhole(mesh, pairs, inKm ? turn : null, linked);
  byId("matrix").hidden = !inKm;
  byId("pictures").classList.toggle("stiffness", inKm);
  if (inKm) page.map.draw();
  showStep(machine);
  showTables(byId("values"), machine, inKm ? stiffnessTables(machine) : contactTables(mesh, machine), inKm ? -1 : turn - 1);
  if (inKm) showTables(byId("block"), machine, [elementTable(machine)], -1);
  const ended = machine.at === machine.steps.length;
  say("failure", ended && machine.failure ? t("The listing stops: {failure}", machine) : "");
  ask(machine, mesh);
  if (machine.at === 0 && !inKm && !run().programs && byId("question").hidden) askWhichTouch(mesh);
  // The box is as high as the question leaves it.
  lightLine(machine);
  byId("turns").value = machine.turns.filter(({ from, turn }) => from < machine.at && turn !== null).at(-1)?.from + 1 || 0;
  return line;
}

/** What each button does, and its key. */
const moves = {
  start: ["Home", (machine) => 0],
  back: ["ArrowLeft", (machine) => machine.at - 1],
  forward: ["ArrowRight", (machine) => machine.at + 1],
  over: ["o", (machine) => machine.over()],
  decision: ["d", (machine) => machine.nextDecision()],
  turn: ["n", (machine) => machine.nextTurn()],
  end: ["End", (machine) => machine.steps.length],
};

function watch() {
  for (const [id, [, to]] of Object.entries(moves)) byId(id).addEventListener("click", () => go(to(page.machine), true));
  document.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.altKey || event.metaKey || event.target.closest("textarea")) return;
    // What Tab has reached keeps the keys that it needs: the space bar, ↑ and ↓.
    if (event.key === " " && event.target.closest("button, select, input, summary")) return;
    if (event.key === "p") play(!page.playing);
    const pressed = event.key === " " ? "ArrowRight" : event.key;
    const move = Object.values(moves).find(([key]) => key === pressed || key === pressed.toLowerCase());
    if (!move) return;
    event.preventDefault();
    go(move[1](page.machine), true);
  });
  byId("play").addEventListener("click", () => play(!page.playing));
  byId("variant").addEventListener("change", (event) => choose({ variant: event.target.value, at: 0 }));
  byId("slider").addEventListener("input", (event) => go(Number(event.target.value)));
  byId("turns").addEventListener("change", (event) => go(Number(event.target.value)));
  byId("chapter").addEventListener("change", (event) => openChapter(Number(event.target.value)));
  byId("run").addEventListener("change", (event) => choose({ run: Number(event.target.value) }));
  byId("ask").addEventListener("change", show);
  byId("finding").addEventListener("toggle", show);
  byId("tolerance").addEventListener("input", (event) => choose({ factor: 10 ** Number(event.target.value) }));
  byId("reset").addEventListener("click", () => choose({ factor: 1, moved: new Map(), turned: new Set(), edits: new Map() }));
  window.addEventListener("hashchange", openAddress);
  releaseFocus();
  watchDrag();
  watchMeanings();
  watchEditor();
  for (const radio of document.getElementsByName("which")) {
    radio.addEventListener("change", () => choose({ which: radio.value }));
  }
  window.addEventListener("resize", show);
  matchMedia("screen and (prefers-color-scheme: dark)").addEventListener("change", show);
  watchMatrix(() => page.map);
}

/** What the pointer has chosen gives the focus back, so that the keys step; a text keeps it. */
function releaseFocus() {
  let pointed = null;
  document.addEventListener("pointerdown", ({ target }) => (pointed = target), true);
  document.addEventListener("keydown", () => (pointed = null), true);
  const release = () => pointed && !document.activeElement.matches("textarea") && document.activeElement.blur();
  document.addEventListener("change", release);
  // The click that opens a list is not yet the choice.
  document.addEventListener("click", ({ target }) => target.closest("select") || release());
}

function openChapter(chapter) {
  const runs = data.scenes[chapter].runs.map(({ label }, k) => make("option", { value: k }, label));
  byId("run").replaceChildren(...runs);
  const { finding, repairs, title, variant } = data.scenes[chapter];
  document.title = byId("title").textContent = finding ? `${finding.id}: ${title}` : repairs ? title : LESSON;
  showFinding(data.scenes[chapter]);
  const { contact } = data.meshes[data.scenes[chapter].runs[0].mesh];
  byId("pictures").classList.toggle("alone", contact.length === 0);
  const inKm = contact.length === 0 || data.scenes[chapter].finding?.listing === "Km";
  const which = inKm ? "Km" : "c_cnt";
  for (const radio of document.getElementsByName("which")) {
    radio.disabled = contact.length === 0 && radio.value !== "Km";
  }
  choose({ chapter, run: 0, which, variant, factor: 1, moved: new Map(), turned: new Set(), edits: new Map() });
}

document.querySelector(".choices").open = window.innerWidth >= 700;
byId("finding").open = window.innerWidth >= 1100;
byId("chapter").replaceChildren(
  ...data.scenes.map(({ name, title, finding, repairs }, k) => make("option", { value: k }, finding ? `${finding.id}: ${finding.title}`.slice(0, 70) : repairs ? title : t("scene {name}", { name }))),
);
byId("colophon").textContent =
  t("plane-contact {version}; scene {name}, SHA-256 {scene_sha256}, mesh {mesh_sha256}.", { ...data, name: data.scenes[0].name });
watch();
showExactValues();
openAddress();
