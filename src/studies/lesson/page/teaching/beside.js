// The corrected algorithm beside the listing that is shown, step by step on the same scene: it goes along turn by turn,
// and has its own buttons within a turn; what both have found of each node stands in one table.

/** A run of the corrected programs on the scene of the run that is shown. */
const correctedRun = () => {
  const { programs, settings } = data.corrected;
  return { ...run(), label: "corrected", programs, c_cnt: programs.c_cnt, Km: programs.Km, settings };
};

/** Whether the corrected listing can stand beside the one that is shown. */
const canBeBeside = () => !isIterating() && !run().programs && page.mesh.contact.length > 0;

/** Executes the corrected listing where it is wanted. */
function openBeside() {
  const isThere = page.isBeside && canBeBeside();
  byId("beside").hidden = !isThere;
  byId("columns").classList.toggle("with-beside", isThere);
  page.beside = null;
  if (!isThere) return;
  const programs = new Programs(correctedRun(), page.mesh, chapter().nodes, page.programs.c_tll);
  page.beside = new Machine(programs[page.which] ?? NOTHING);
  page.besideTurn = undefined;
  const step = (text, to) => button(text, () => {
    page.beside.goTo(to(page.beside));
    drawBeside();
  });
  byId("beside").replaceChildren(
    make("h2", {}, `${page.which}, ${t("corrected")}`),
    make("div", { class: "scroll", tabindex: 0, role: "region", "aria-label": t("The corrected listing") }, make("ol", {}, ...page.beside.lines.map(({ number, level, text }) => make("li", {}, make("span", { class: "number" }, String(number)), make("code", { style: `--level: ${level}` }, text))))),
    make("p", { class: "answers" }, step(t("back"), ({ at }) => at - 1), step(t("step"), ({ at }) => at + 1), step(t("end of the turn"), endOfTurn), make("span", { id: "beside-said", role: "status" })),
    make("div", { id: "both", class: "scroll", tabindex: 0, role: "region", "aria-label": t("The arrays") }),
  );
}

/** Behind the last step of the turn that a listing is in. */
const endOfTurn = ({ turns, steps, at }) => turns.find(({ from }) => from > at)?.from ?? steps.length;

/** Lets the corrected listing follow to the turn of the listing that is shown: to its end once that has gone on, and with it
 * to the start and the end. */
function showBeside(turn) {
  const { beside, machine } = page;
  if (!beside) return;
  const place = machine.at === 0 ? 0 : machine.at === machine.steps.length ? Infinity : turn;
  if (place !== page.besideTurn) {
    page.besideTurn = place;
    const begins = beside.turns.findLast(({ turn: own, from }) => own === turn && from <= (beside.steps.length * machine.at) / machine.steps.length + 1) ?? beside.turns.find(({ turn: own }) => own === turn);
    if (place === 0 || place === Infinity) beside.goTo(place);
    else if (begins) beside.goTo(begins.from + 1);
  }
  drawBeside();
}

/** Shows the step of the corrected listing, and what both have found. */
function drawBeside() {
  const { beside, machine, mesh } = page;
  const list = byId("beside").querySelector("ol");
  list.parentElement.scrollTop = (litIn(list, beside)?.offsetTop ?? 0) - list.offsetTop - 60;
  say("beside-said", `${t("step {at} of {count}", { at: beside.at, count: beside.steps.length })}. ${stepInWords(beside)}`);
  if (page.which === "Km") return byId("both").replaceChildren();
  const names = ["ct", "yt", "dy"];
  const both = (name) => [machine, beside].map((machine) => valueCell(machine.get(name)));
  const rows = mesh.contact.map((n, k) => [mesh.name(n), ...names.flatMap((name) => both(`${name}[${k + 1}]`))]);
  byId("both").replaceChildren(
    tableFrom(t("* of the corrected listing"), [t("node"), ...names.flatMap((name) => [name, `${name}*`])], rows),
    make("p", { class: "muted" }, mesh.side > 0 ? t("yt* is a gap, positive apart; the yt of line 10 is the target’s height less the node’s, and has the other sign.") : t("yt* is a gap, positive apart; so is the yt of line 10, the target’s height less the node’s, as the target lies above here.")),
  );
}
