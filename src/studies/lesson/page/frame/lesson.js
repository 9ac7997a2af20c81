// The page: what is chosen, and what is shown after each step.

const page = { chapter: 0, run: 0, which: "c_cnt", factor: 1, moved: new Map(), turned: new Set(), typed: new Map(), isMine: false, isStale: false, edits: new Map(), atStake: new Set() };
const chapter = () => data.scenes[page.chapter];
const run = () => chapter().runs[page.run];

/** The run beside which a run is shown: as printed, or with a repair less. */
const runBefore = () => chapter().runs[run().programs ? Math.max(1, page.run - 1) : 0];
const meshOf = (run, moved, turned) => new Mesh(data.meshes[run.mesh], chapter().units, moved, turned);
const programsOf = (run) => new Programs(run, meshOf(run), chapter().nodes);

/** Whether the tolerance, a node or an edge is not as the scene has it. */
const isMoved = () => page.factor !== 1 || page.moved.size > 0 || page.turned.size > 0;

/** Whether a listing of the run is edited; one that other readings share is so in all of them. */
const isEdited = () => LISTINGS.some((name) => page.edits.has(run()[name]));
const isChanged = () => isMoved() || isEdited();
const isIterating = () => page.which === "iterations";

/** The choices of a listing. @returns {any[]} */
const radios = () => [...document.getElementsByName("which")];

/** Whether the window has room for all that is said of a chapter. */
const isWide = () => window.innerWidth >= 1100;

/** A program that is not called. */
const NOTHING = { lines: [], steps: [], failure: null };

/** Chooses scene, run and listing. Under another reading of the same listing the place stays. */
function choose(change) {
  play(false);
  const isEnded = page.machine?.at > 0 && page.machine.at === page.machine.steps.length;
  const at = isEnded ? Infinity : (page.machine?.at ?? 0);
  Object.assign(page, change);
  page.edits = editsInForce();
  if (["run", "edits", "isMine"].some((name) => name in change)) fillVariants();
  page.mesh = meshOf(run(), page.moved, page.turned);
  page.programs = new Programs(run(), page.mesh, chapter().nodes, page.factor * run().c_tll, page.edits);
  page.pairs = new Machine(page.programs.c_cnt ?? NOTHING);
  page.machine = isIterating() ? played() : page.which === "Km" ? new Machine(page.programs.Km ?? { ...NOTHING, failure: t("c_cnt stopped, so Km is not called") }) : page.pairs;
  if (page.which === "Km") page.pairs.goTo(page.pairs.steps.length);
  page.zone = zoneOf(page.mesh, chapter().nodes);
  page.map = page.which === "Km" ? new MatrixMap(page.mesh, page.machine, page.atStake) : null;
  page.machine.goTo(change.at ?? ("which" in change ? 0 : at));
  byId("slider").max = page.machine.steps.length;
  byId("chapter").value = page.chapter;
  byId("run").value = page.run;
  for (const radio of radios()) radio.checked = radio.value === page.which;
  const { label, lines, about } = run();
  const words = (about.text ? [tell(about)] : about.map((text) => t(text))).join(", ");
  say("about", t("Scene {scene}. Reading: {label} ({about}).", { scene: chapter().name, label: tell(label), about: lines && !run().programs ? `${t(lines)}: ${words}` : words }));
  byId("tolerance").value = Math.log10(page.factor);
  say("tolerance-label", `c_tll ${short(page.programs.c_tll)}`);
  byId("tolerance").setAttribute("aria-valuetext", byId("tolerance-label").textContent);
  if (!isIterating() && ["run", "which", "edits", "isMine"].some((name) => name in change)) {
    showText();
    showLines(page.machine, linesAt(runBefore()[page.which]), (line) => go(page.machine.runTo(line)));
  }
  const [turn, title] = page.which === "Km" ? [t("element"), t("Run to the next element (N)")] : [t("node"), t("Run to the next contact node (N)")];
  Object.assign(byId("turn"), { textContent: turn, title });
  showButtons();
  // Beside the arrays these would take half of a move's time.
  if (!page.dragged) {
    fillTurns();
    showChanges(run(), page.programs);
    showConclusion();
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

/** Goes to a place; what a button or a key brings into MJS on the way is marked. */
function go(at) {
  const from = page.machine.at;
  page.machine.goTo(at);
  if (page.map) page.map.brought = broughtIn(page.machine, from);
  show();
}

/** The place in words: the step, the line that was executed last, whether a decision is next, and what listing it is. */
function placeInWords() {
  const { at, steps, next, lines, last } = page.machine;
  if (isIterating()) {
    const states = LISTINGS.map((name) => listingInWords(name));
    const listings = states[0] === states[1] ? [states[0]] : LISTINGS.map((name, k) => `${name} ${states[k]}`);
    return [t("iteration {at} of {count}", { at, count: steps.length }), ...(page.variant === "corrected" ? [] : listings)].join(", ");
  }
  const place = [t("step {at} of {count}", { at, count: steps.length }), ...(last ? [t("line {line}", { line: lines[last.line].number })] : [])];
  const decision = next && next.held !== null ? [t("before the decision of line {line}", { line: lines[next.line].number })] : [];
  return [...place, listingInWords(page.which), ...decision].join(", ");
}

/** Shows the state after the steps or the iterations that were made. */
function show() {
  const { at, steps } = page.machine;
  // What it takes of the window the others have not.
  if (at === steps.length && at > 0) unfoldConclusion();
  say("status", placeInWords());
  say("place", `${byId("about").textContent} ${byId("status").textContent}. ${byId("tolerance-label").textContent}.`);
  byId("columns").hidden = isIterating();
  byId("iterations").hidden = !isIterating();
  if (isIterating()) showIterations();
  else showSteps();
  if (chapter().repairs) showRepair(chapter().repairs);
  byId("slider").value = at;
  byId("slider").setAttribute("aria-valuetext", byId("status").textContent);
  keepAddress();
  for (const id of ["start", "back"]) byId(id).disabled = at === 0;
  byId("play").disabled = steps.length === 0;
  for (const id of ["forward", "end"]) byId(id).disabled = at === steps.length;
  for (const id of ["over", "decision", "turn"]) byId(id).disabled = isIterating() || at === steps.length;
}

/** Shows the listing and its arrays. */
function showSteps() {
  const { machine, mesh, pairs, zone } = page;
  const turn = machine.turnAt(machine.at - 1);
  const inKm = page.which === "Km";
  const line = machine.last ? machine.lines[machine.last.line].number : 0;
  // What was hidden is scrolled where it was.
  if (!byId("editor").hidden) scrollMarks();
  // Read before anything is written, else the page is laid out anew.
  page.width = byId("pictures").clientWidth;
  if (mesh.contact.length) {
    const node = inKm ? null : turn;
    drawZone(mesh, pairs, zone, page.programs.c_tll, node, !inKm && !run().programs && (line === 6 || line === 7));
    drawGaps(mesh, pairs, zone, page.programs.c_tll, node);
  }
  const linked = inKm ? page.map.vector("W").map((e) => Math.ceil(e / 2)) : [];
  drawWhole(mesh, pairs, inKm ? turn : null, linked);
  byId("matrix").hidden = byId("block").hidden = !inKm;
  byId("pictures").classList.toggle("stiffness", inKm);
  page.map?.draw();
  showStep(machine);
  showTables(byId("values"), machine, inKm ? stiffnessTables(machine) : contactTables(mesh, machine), inKm ? -1 : turn - 1);
  if (inKm) showTables(byId("block"), machine, [elementTable(machine)], -1);
  for (const { from } of page.map?.brought ?? []) document.querySelector(`td[data-name="${from}"]`).classList.add("read");
  const ended = machine.at === machine.steps.length;
  say("failure", ended && machine.failure ? t("The listing stops: {failure}", machine) : "");
  ask(machine, mesh);
  // The box is as high as the question leaves it.
  lightLine(machine);
  byId("turns").value = machine.turns.filter(({ from, turn }) => from < machine.at && turn !== null).at(-1)?.from + 1 || 0;
}

/** What each button does, and its key. @type {Record<string, any>} */
const moves = {
  start: ["Home", () => 0],
  back: ["ArrowLeft", (machine) => machine.at - 1],
  forward: ["ArrowRight", (machine) => machine.at + 1],
  over: ["o", (machine) => machine.over()],
  decision: ["d", (machine) => machine.nextDecision()],
  turn: ["n", (machine) => machine.nextTurn()],
  end: ["End", (machine) => machine.steps.length],
};

/** Steps by a key that nothing else takes: with the focus on a control the arrows, Home, End and the space bar are that
 * control's (of a button the space bar alone); letters are a text's and a list's. */
function pressed(event) {
  const { key, ctrlKey, altKey, metaKey, target } = event;
  if (ctrlKey || altKey || metaKey || target.closest("textarea, select, input[type=text]")) return;
  const isLetter = /^[a-z]$/i.test(key);
  const isButton = key !== " " && target.closest("button, summary") && !target.closest("[data-roving], #nodes");
  if (!isLetter && !isButton && target !== document.body) return;
  if (key === "p" || key === "P") play(!page.playing);
  const wanted = key === " " ? "ArrowRight" : isLetter ? key.toLowerCase() : key;
  const move = Object.values(moves).find(([key]) => key === wanted);
  if (!move || (isLetter && isIterating())) return;
  event.preventDefault();
  go(move[1](page.machine));
}

function watch() {
  const on = (id, event, act) => byId(id).addEventListener(event, ({ target }) => act(target.value));
  for (const [id, [, to]] of Object.entries(moves)) on(id, "click", () => go(to(page.machine)));
  document.addEventListener("keydown", pressed);
  // A button that the pointer has pressed gives the focus back, so that the keys step.
  document.addEventListener("click", (/** @type {any} */ { target, detail }) => detail && target.closest(".controls button, .heading button") && byId("editor").hidden && target.closest("button").blur());
  // So does a choice that it has made.
  document.addEventListener("change", (/** @type {any} */ { target }) => target.matches("select, [type=radio], [type=checkbox]") && !target.matches(":focus-visible") && target.blur());
  on("play", "click", () => play(!page.playing));
  on("variant", "change", (variant) => choose({ variant, at: 0 }));
  on("slider", "input", (at) => go(Number(at)));
  on("turns", "change", (at) => go(Number(at)));
  on("chapter", "change", (k) => openChapter(Number(k)));
  on("run", "change", (k) => choose({ run: Number(k) }));
  on("ask", "change", show);
  on("tolerance", "input", (power) => choose({ factor: 10 ** Number(power) }));
  on("reset", "click", () => choose({ factor: 1, moved: new Map(), turned: new Set() }));
  on("language", "click", switchLanguage);
  on("link", "click", copyLink);
  for (const id of ["finding", "conclusion"]) on(id, "toggle", show);
  window.addEventListener("hashchange", openAddress);
  watchDrag();
  watchMeanings();
  watchEditor();
  for (const radio of radios()) radio.addEventListener("change", () => choose({ which: radio.value }));
  window.addEventListener("resize", show);
  matchMedia("screen and (prefers-color-scheme: dark)").addEventListener("change", show);
  watchMatrix(() => page.map);
}

/** The title of a chapter that has a topic; of another one, `otherwise`. */
function titleOf({ finding, repairs, title }, otherwise) {
  if (finding) return `${finding.id}: ${t(finding.title)}`;
  return repairs ? tell(title) : otherwise;
}

/** Lists the chapters. */
function fillChapters() {
  const option = (scene, k) => make("option", { value: k }, titleOf(scene, t("scene {name}", scene)));
  byId("chapter").replaceChildren(...data.scenes.map(option));
}

/** Says what a chapter has: its title, its readings, and what it is there to show. */
function fillChapter() {
  byId("run").replaceChildren(...chapter().runs.map(({ label }, k) => make("option", { value: k }, tell(label))));
  document.title = byId("title").textContent = titleOf(chapter(), t("Lesson: {title}", { title: tell(chapter().title) }));
  showFinding(chapter());
  const { name, sha256 } = chapter();
  const [scene, mesh] = sha256 ?? ["–", "–"];
  say("colophon", t("plane-contact {version}; scene {name}, SHA-256 {scene}, mesh {mesh}.", { version: data.version, name, scene, mesh }));
}

/** The variant that shows what a chapter is about: of a finding in Km its own matrix. */
const variantOf = ({ finding, variant }) => (finding?.listing === "Km" ? "printed" : variant);

/** Opens a chapter, with what was typed in it. */
function openChapter(k) {
  page.chapter = k;
  page.run = 0;
  page.asked = 0;
  page.atStake = atStake();
  page.isConcluded = byId("conclusion").open = false;
  Object.assign(score, { right: 0, asked: 0 });
  fillChapter();
  byId("finding").open = isWide();
  const isAlone = data.meshes[run().mesh].contact.length === 0;
  byId("pictures").classList.toggle("alone", isAlone);
  for (const radio of radios()) radio.disabled = (isAlone && radio.value !== "Km") || (radio.value === "iterations" && !chapter().isIterated);
  const which = isAlone || chapter().finding?.listing === "Km" ? "Km" : "c_cnt";
  choose({ run: 0, which, variant: variantOf(chapter()), at: 0, factor: 1, moved: new Map(), turned: new Set(), ...typedBefore() });
}

byId("choices").open = window.innerWidth >= 700;
readBody();
watch();
showExactValues();
openAddress();
