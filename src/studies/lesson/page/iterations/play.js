// The iterations as they are played: the deformed shape, who is in contact, and the error.

/** The iterations of a variant, gone through by the bar as the steps of a program are. */
class Played {
  steps; failure; lines; turns; at;
  constructor({ states, failure }, measure) {
    Object.assign(this, { steps: states, failure: failure && interpreted(failure), lines: [], turns: [], at: 0 });
    this.measures = states.map(({ u }) => measure?.(u) ?? {});
    this.errors = this.measures.map(({ error }) => error);
    this.over = this.nextDecision = this.nextTurn = () => this.at + 1;
  }

  goTo(at) { this.at = Math.max(0, Math.min(at, this.steps.length)); }
}

/** The iterations of the variant that is chosen. */
function played() {
  // The corrected programs have the faults that the run puts back.
  const corrected = { ...data.corrected, programs: new Map(readAt(run().programs ?? data.corrected.programs, page.edits)) };
  const made = iterated(equationsOf(run(), page.edits), page.variant, corrected);
  // The energy is that of the stiffness as printed, whatever is edited.
  return new Played(made, hasReference() ? measuredBy(equationsOf(chapter().runs[0]).K, chapter().reference) : undefined);
}

/** The listings of some places, read, as given or as edited. @returns {any} */
const readAt = (places, edits) => Object.entries(places).map(([name, place]) => [name, listingOf(name, linesAt(place, edits))]);

/** The equations of the scene as it is now, under the listings of a run. */
function equationsOf(run, edits) {
  return new Equations(run, Object.fromEntries(readAt({ c_cnt: run.c_cnt, Km: run.Km }, edits)), page.mesh.own, page.mesh.stands, page.programs.c_tll);
}

/** Whether a load acts on the chapter's scene. */
const isLoaded = () => data.meshes[chapter().runs[0].mesh].load.some((f) => f !== 0);

/** Whether the reference solution is one of the scene as it is now. */
const hasReference = () => chapter().reference && isLoaded() && page.moved.size === 0 && run().mesh === chapter().runs[0].mesh && run().plane === chapter().runs[0].plane;

/** Errors that are the equations' rounding. */
const ROUNDING = 1e-10;

/** How far displacements are from a reference solution's, in the energy norm, and what part of the load they bring to
 * the target. */
function measuredBy(K, reference) {
  const whole = energyNorm(K, reference);
  return (u) => {
    const error = energyNorm(K, u.map((x, e) => x - reference[e]));
    return { error: error <= ROUNDING * whole ? 0 : error / whole, share: transmitted(K, u) };
  };
}

/** The component along the load of the forces of contact on the target, over the load, as src/studies/audit/prices.rs
 * has it; nothing without a load. */
function transmitted(K, u) {
  const { own, contact, edges } = page.mesh;
  const force = (e) => u.reduce((sum, x, j) => sum + K.entries[e * u.length + j] * x, -own.load[e]);
  const isHeld = (n, d) => own.restrained[n - 1][d];
  const sum = (nodes, d) => nodes.reduce((sum, n) => sum + (isHeld(n, d) ? 0 : force(2 * n - 2 + d)), 0);
  const target = [...new Set(edges.flatMap(([, ends]) => ends))];
  const load = [0, 1].map((d) => own.load.reduce((sum, f, e) => sum + (e % 2 === d ? f : 0), 0));
  const along = load.map((f, d) => f * (target.some((n) => isHeld(n, d)) ? -sum(contact, d) : sum(target, d)));
  const share = (along[0] + along[1]) / (load[0] ** 2 + load[1] ** 2);
  if (Number.isNaN(share)) return undefined;
  return Math.abs(share) <= ROUNDING ? 0 : share;
}

const percent = (error) => `${inProse(Number((100 * error).toPrecision(3)))} %`;
const listed = (nodes) => nodes.map((n) => page.mesh.name(n)).join(", ");
const contactInWords = (nodes) => (nodes.length ? t("in contact: {nodes}", { nodes: listed(nodes) }) : t("no node in contact"));

/** The iteration that is shown, in words. */
function stateInWords({ at, steps, measures }) {
  if (at === 0) return t("The initial shape, before the first iteration.");
  const [now, before] = [steps[at - 1].inContact, steps[at - 2]?.inContact];
  const { error, share } = measures[at - 1];
  const others = (some, all) => some.filter((n) => !all.includes(n));
  const [joined, left] = before ? [others(now, before), others(before, now)] : [[], []];
  return [
    t("Iteration {at} of {count}, {state}.", { at, count: steps.length, state: contactInWords(now) }),
    ...(joined.length ? [t("New in contact: {nodes}.", { nodes: listed(joined) })] : []),
    ...(left.length ? [t("No longer in contact: {nodes}.", { nodes: listed(left) })] : []),
    ...(share === undefined ? [] : [t("The target bears {share} of the load.", { share: percent(share) })]),
    ...(error === undefined ? [] : [t("Error {error}.", { error: percent(error) })]),
  ].join(" ");
}

/** What all iterations come to, in words. */
function courseInWords({ steps, failure }, variant) {
  if (failure) return t("Iteration {k} stops: {failure}", { k: steps.length + 1, failure });
  const period = periodOf(steps);
  const sets = steps.map(({ inContact }) => contactInWords(inContact));
  const settled = () => sets.findLastIndex((set) => set !== sets.at(-1)) + 2;
  if (variant === "corrected" && steps.length < ITERATIONS) return t("It ends with iteration {k}: the contact of its shape was there before, in its own equations or in earlier ones.", { k: steps.length });
  if (period === 1) return t("The contact state is settled from iteration {k} on, {state}.", { k: settled(), state: sets.at(-1) });
  if (period === 2) return t("The contact state does not settle: two states alternate ({one}; {other}).", { one: sets.at(-2), other: sets.at(-1) });
  return period ? t("The contact state does not settle: it comes back after {period} iterations.", { period }) : t("The contact state has not settled.");
}

/** How many times displacements are drawn: the largest of all iterations comes to an eighth of the scene. */
function magnification(steps, size) {
  const most = Math.max(0, ...steps.flatMap(({ u }) => u.map(Math.abs)));
  return most > 0 ? roundAtMost(size / 8 / most) : 0;
}

/** Draws the shape after the iteration, over the initial one. */
function drawShape(mesh, { steps, at }) {
  const canvas = byId("shape");
  const points = Array.from({ length: mesh.count }, (_, k) => mesh.at(k + 1));
  const times = magnification(steps, Math.max(...[0, 1].map((j) => range(points.map((p) => p[j]))).map(([low, high]) => high - low)));
  const moved = (u) => (n) => mesh.at(n).map((x, d) => x + times * (u?.[2 * n - 2 + d] ?? 0));
  const { context, width, height } = prepared(canvas, Math.max(220, Math.min(420, canvas.clientWidth * 0.7)));
  const corners = steps.flatMap(({ u }) => points.map((_, k) => moved(u)(k + 1)));
  const { to } = viewOf([...points, ...corners], width, height, 26, false);
  const [now, inContact] = [moved(steps[at - 1]?.u), steps[at - 1]?.inContact];
  for (const [nodes] of mesh.triangles) path(context, nodes.map((n) => to(mesh.at(n))), { stroke: colour("rule"), width: 0.8, close: true });
  drawBodies(context, mesh, (n) => to(now(n)));
  for (const n of mesh.contact) {
    drawStatus(context, to(now(n)), inContact && Number(inContact.includes(n)), false);
    if (mesh.contact.length <= 12) label(context, mesh.name(n), [to(now(n))[0], to(now(n))[1] - 12], colour("stamp-ink"));
  }
  const scale = times ? t("Displacements are drawn {times} times as large.", { times }) + " " : "";
  byId("shape-caption").textContent = scale + t("Thin lines: the initial shape. Filled: in contact; open: not in contact.");
  canvas.setAttribute("aria-label", byId("state").textContent);
}

/** Which contact nodes are in contact, by iteration, and the errors. */
function statesTable(mesh, { steps, errors, at }) {
  const nodes = mesh.contact.length <= 12 ? mesh.contact : mesh.contact.filter((n) => steps.some(({ inContact }) => inContact.includes(n)));
  const now = (k) => (k === at - 1 ? "written" : undefined);
  const row = (head, cells) => [head, ...cells.map((text, k) => make("td", { class: now(k) }, text))];
  const rows = nodes.map((n) => row(mesh.name(n), steps.map(({ inContact }) => (inContact.includes(n) ? "●" : "○"))));
  const share = (error) => (error === undefined ? "–" : short(Number((100 * error).toPrecision(3))));
  const heads = steps.map((_, k) => make("th", { scope: "col", "aria-current": k === at - 1 ? "step" : undefined }, String(k + 1)));
  return tableFrom(t("By iteration: ● in contact, ○ not in contact"), [t("node"), ...heads], [...rows, row(t("error, %"), errors.map(share))]);
}

/** Draws the errors over the iterations. */
function drawErrors({ errors, at }) {
  const last = errors.length - 1;
  const isDrawn = drawCurve(byId("errors"), errors, at - 1, errors.map((_, k) => (k === 0 || k === last ? String(k + 1) : "")));
  byId("errors-caption").textContent = isDrawn
    ? t("Energy norm of the difference from the reference solution (node to segment, initial geometry, without friction) over that of the reference solution, by iteration; the axis has powers of ten.") +
      (page.variant === "stepped" ? ` ${t("Before the last iteration of stepped a part of the load is missing.")}` : "")
    : t("No error can be drawn: the reference solution is of the scene as it was given, under contact that holds it and a load.");
  if (isDrawn) byId("errors").setAttribute("aria-label", t("Error after the last iteration: {error}", { error: percent(errors.at(-1)) }));
}

/** Draws errors side by side by powers of ten, each over its name, that at `at` marked; returns whether there are any. */
function drawCurve(canvas, errors, at, names) {
  const known = errors.filter((error) => error > 0 && Number.isFinite(error)).map(Math.log10);
  canvas.hidden = known.length === 0 && !errors.includes(0);
  if (canvas.hidden) return false;
  const { context, width, height } = prepared(canvas, 150);
  // No error stands at the foot of the axis, as far below the least as a power of ten.
  const least = Math.floor(Math.min(...known, 0));
  const low = errors.includes(0) ? least - 1 : least;
  const high = Math.max(Math.ceil(Math.max(...known, least)), low + 1);
  const to = (k, power) => [64 + (k / Math.max(1, errors.length - 1)) * (width - 84), 14 + ((high - power) / (high - low)) * (height - 42)];
  for (let power = low; power <= high; power += Math.ceil((high - low) / 4)) {
    path(context, [to(0, power), to(errors.length - 1, power)], { stroke: colour("rule") });
    label(context, percent(power < least ? 0 : 10 ** power), [56, to(0, power)[1] + 4], colour("muted"), "right");
  }
  // A run that stopped has no error.
  const points = errors.flatMap((error, k) => (error === undefined ? [] : [[k, to(k, error > 0 ? Math.log10(error) : low)]]));
  path(context, points.map(([, point]) => point), { stroke: colour("accent"), width: 2 });
  for (const [k, point] of points) drawStatus(context, point, k === at ? 1 : undefined, k === at);
  names.forEach((name, k) => label(context, name, [to(k, low)[0], height - 8], colour("muted")));
  return true;
}

/** Shows the iterations as far as they were gone through. */
function showIterations() {
  const { machine, mesh } = page;
  byId("state").textContent = stateInWords(machine);
  byId("course").textContent = [
    courseInWords(machine, page.variant),
    ...(page.variant === "printed" && isJoined(linesAt(run().Km, page.edits)) ? [t("Where MJS has eq. (1) in it, load and displacements have it too.")] : []),
    besideRepairInWords(),
  ].join(" ");
  drawShape(mesh, machine);
  byId("states").replaceChildren(statesTable(mesh, machine));
  roving(byId("states"), "td", () => machine.steps.length);
  // The current iteration stays in sight.
  const now = byId("states").querySelector("[aria-current]");
  const middle = ({ left, right }) => (left + right) / 2;
  byId("states").scrollLeft += now ? middle(now.getBoundingClientRect()) - middle(byId("states").getBoundingClientRect()) : 0;
  drawErrors(machine);
}

/** Lists the variants that a run can play; the one that was chosen stays where it is one of them. */
function fillVariants() {
  const words = {
    printed: [t("printed"), t("MJS as Km gives it")],
    tied: [t("tied"), t("eq. (1) on total displacements")],
    stepped: [t("stepped"), t("eq. (1) on increments, the load in equal steps")],
    corrected: [t("corrected programs"), run().programs ? tell(run().label) : t("both listings with what the findings ask for")],
  };
  // Around the listings eq. (1) would hide what an edited Km does with its contact.
  const isOwn = page.edits.has(run().Km) || isJoined(linesAt(run().Km));
  const names = run().programs ? ["corrected"] : isOwn ? ["printed", "corrected"] : VARIANTS;
  byId("variant").replaceChildren(...names.map((name) => make("option", { value: name }, words[name].join(": "))));
  page.variant = byId("variant").value = [page.variant, variantOf(chapter())].find((name) => names.includes(name)) ?? names[0];
}

/** Plays the steps or the iterations to their end, or stops. */
function play(isOn) {
  clearInterval(page.playing);
  page.playing = null;
  byId("play").textContent = isOn ? t("pause") : t("play");
  if (!isOn) return;
  if (page.machine.at === page.machine.steps.length) go(0);
  page.playing = setInterval(() => {
    go(page.machine.at + 1);
    if (page.machine.at === page.machine.steps.length) play(false);
  }, 600);
}
