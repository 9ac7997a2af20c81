// The report: its sections, in order; a section without content is left out.

const cells = (list) => (list ?? []).join(", ");
const first = (text) => text?.split("\n")[0];

/** Adds content to a section; without any the section is left out. */
function fill(id, ...content) {
  const section = byId(id);
  section.append(...content.filter(Boolean));
  section.hidden = section.children.length < 2;
}

/** The command that prints a claim's number. */
const commandOf = (claim) => (claim.at.length ? `plane-contact ${claim.command.join(" ")}` : null);

function showWhat() {
  byId("title").textContent = document.title;
  byId("what").textContent = data.scene.title;
  const hashes = [["scene, SHA-256", data.scene_sha256], ["mesh, SHA-256", data.mesh_sha256]].filter(([, hash]) => hash);
  fill("run", tableOf("Program, scene and options", [["what", ([what]) => what, "text"], ["set to", ([, value]) => value, "text"]], [...data.what, ...hashes]));
}

function showAudit() {
  const { audit } = data;
  if (!audit) return ["conclusion", "assumptions", "claims", "variants", "readings", "findings"].forEach((id) => fill(id));
  fill("conclusion", ...audit.answers.flatMap((a) => [
    make("h3", {}, a.question), make("p", {}, a.answer),
    make("p", { class: "muted" }, `${a.at ? `${short(a.value)} = ${a.of}; ` : ""}printed by: plane-contact ${a.command}${a.at ? `, at ${a.at}` : ""}`),
  ]));
  fill("assumptions", audit.assumptions.length > 0 && tableOf("Assumptions", [["what the paper leaves open", (a) => a.what, "text"], ["set to", (a) => a.set_to, "text wide"]], audit.assumptions));
  fill("claims", tableOf("Claims", [
    ["id", (c) => c.id], ["the paper says that", (c) => c.says, "text wide"],
    ["verdict", (c) => c.verdict, "text verdict"], ["scope", (c) => c.scope, "text"], ["certainty", (c) => c.basis, "text"],
    ["value", (c) => c.number], ["what the value is", (c) => c.of, "text wide"], ["beside it", (c) => c.detail, "text wide"],
    ["error of the mesh itself", (c) => c.mesh_error], ["true where", (c) => c.condition, "text wide"], ["threshold", (c) => c.threshold, "text wide"],
    ["where in the paper", (c) => c.place, "text wide"], ["the paper's words", (c) => c.quote, "text wide"], ["in English", (c) => c.translation, "text wide"],
    ["command", commandOf, "text wide"], ["JSON pointer", (c) => c.at.join(" over "), "text"],
  ], audit.claims));
  fill("readings", tableOf("Readings", [
    ["id", (r) => r.id], ["reading", (r) => r.reading, "text"], ["lines", (r) => r.lines, "text"],
    ["dy changed", (r) => r.statuses], ["MJS entries changed", (r) => r.entries], ["largest difference", (r) => r.displacement], ["error in energy norm", (r) => r.equilibrium_error],
    ["of what", (r) => r.of, "text"], ["fails", (r) => first(r.failure), "text wide"],
  ], audit.readings));
  fill("findings", tableOf("Findings", [
    ["id", (f) => f.id], ["line", (f) => `${f.listing} ${cells(f.lines)}`, "text"], ["verdict", (f) => f.verdict, "text verdict"],
    ["value", (f) => f.number], ["what the value is", (f) => f.of, "text wide"],
    ["what the listing does that the text does not say", (f) => f.title, "text wide"], ["on this scene", (f) => f.detail, "text wide"],
  ], audit.findings));
  fill("variants", tableOf("Variants", [
    ["variant", (v) => v.variant, "text"], ["nodes in contact at the end", (v) => v.in_contact?.at(-1)],
    ["state", (v) => stateOf(v), "text"], ["force on target over load", (v) => v.target_share], ["residual of eq. (1)", (v) => v.eq1_residual],
    ["largest von Mises stress", (v) => v.bodies?.map((b) => `${b.name} ${short(Number(b.max_von_mises_stress.toPrecision(5)))}`).join(", "), "text"],
    ["error in u", (v) => v.distance?.displacement_relative], ["error in energy norm", (v) => v.distance?.energy_relative],
    ["largest friction needed", (v) => v.friction_needed], ["nodes pulling", (v) => v.pulling?.length], ["fails", (v) => first(v.failure), "text wide"],
  ], audit.variants), audit.friction.length > 0 && frictionTable(audit.friction));
}

function stateOf(row) {
  if (row.failure) return null;
  const state = row.variant === "unilateral" ? "in equilibrium"
    : !row.cycle ? "new in the last iteration" : row.cycle.length === 1 ? "settled" : `cycle of ${row.cycle.length}`;
  return row.transmits_nothing ? `${state}, nothing transmitted` : state;
}

/** Who sticks and slides under each coefficient of friction. */
function frictionTable(cases) {
  const found = cases.map(({ friction, nodes }) => [friction, new Map((nodes.Ok ?? []).map((node) => [node.node, node]))]);
  const nodes = [...new Set(found.flatMap(([, of]) => [...of.keys()]))].sort((a, b) => a - b);
  const columns = found.flatMap(([friction, of]) => [
    [`friction ${friction}: pressure`, (node) => of.get(node)?.pressure],
    [`shear ${friction}`, (node) => of.get(node)?.shear],
    [`status ${friction}`, (node) => of.get(node)?.status, "text"],
  ]);
  return tableOf("Pressure, shear and status by coefficient of friction", [["node", (node) => node], ...columns], nodes);
}

/** The columns of the quantities that live on a place, of those that any row has. */
function columnsOf(place, rows) {
  const known = data.quantities[place].filter(({ name }) => rows.some((row) => row[name] !== undefined && row[name] !== null));
  const valueOf = ({ name }) => (row) => (name === "cycle" ? periodOf(row.cycle) : Array.isArray(row[name]) ? row[name].join(", ") : row[name]);
  const kindOf = (quantity) => (rows.some((row) => typeof valueOf(quantity)(row) === "string") ? "text" : undefined);
  const headOf = ({ title, unit }) => [title, data.units[unit]].filter(Boolean).join(", ");
  return known.map((quantity) => [headOf(quantity), valueOf(quantity), kindOf(quantity)]);
}

const periodOf = (cycle) => (!cycle ? "new" : cycle.length === 1 ? "unchanged" : `as in ${cycle.members[0]} (period of ${cycle.length})`);

/** The iterations of a run, and its bodies at the end. */
function showIterations({ name, result }) {
  const tables = result ? [["Iterations", "iteration", result.iterations], ["Bodies", "body", result.bodies]] : [];
  byId("iterations").replaceChildren(...tables.map(([title, place, rows]) => tableOf(`${title} of ${name}`, columnsOf(place, rows), rows)));
}

/** The stretch of the contact surface that any run has in contact, with a margin. */
function stretch(runs) {
  const closed = runs.flatMap(({ result }) => result.contact.filter(({ dy }) => dy === 1)).map(({ arc }) => arc);
  const [from, to] = range(closed);
  const margin = 0.25 * (to - from);
  return from < to ? [from - margin, to + margin] : range(runs.flatMap(({ result }) => result.contact.map(({ arc }) => arc)));
}

/** Hertz's pressure over the distance along the contact surface. */
function hertzCurve({ centre, half_width, peak }) {
  const at = Array.from({ length: 201 }, (_, k) => -1 + k / 100);
  return at.map((s) => [centre + s * half_width, peak * Math.sqrt(1 - s * s)]);
}

function showSurface() {
  const runs = data.runs.filter(({ result }) => result?.contact.length);
  if (runs.length === 0) return fill("surface");
  const [from, to] = stretch(runs);
  const across = `distance along the contact surface, ${data.units.length}`;
  const series = (of) => runs.map(({ name, result }) => ({ name, points: result.contact.filter(({ arc }) => from <= arc && arc <= to).map((c) => [c.arc, of(c)]).filter(([, y]) => typeof y === "number") }));
  const hertz = runs.map(({ result }) => result.hertz).findLast((hertz) => hertz);
  const curve = hertz && { name: "Hertz", points: hertzCurve(hertz).filter(([arc]) => from <= arc && arc <= to) };
  const all = [
    ["Contact pressure", "stress", [...series((c) => c.pressure), ...(curve ? [curve] : [])]],
    ["Shear on the contact surface", "stress", series((c) => c.shear)],
    ["Gap (averaged under mortar), < 0 where the node penetrates", "length", series((c) => c.gap)],
  ];
  const rows = runs.flatMap(({ name, result }) => result.contact.map((c) => ({ name, ...c })));
  fill("surface", ...all.flatMap(([title, unit, curves]) => [make("h3", {}, title), chart(title, across, `${title.split(",")[0]}, ${data.units[unit]}`, curves)]),
    hertz && make("p", { class: "muted" }, `Hertz: half width ${short(hertz.half_width)}, peak ${short(hertz.peak)}, relative radius ${short(hertz.radius)}.`),
    tableOf("Contact nodes", [["run", (c) => c.name, "text"], ...columnsOf("contact", rows)], rows.filter(({ arc }) => from <= arc && arc <= to)));
}

function showEstimates() {
  const known = data.runs.filter(({ result }) => result?.error_estimates);
  const rows = known.flatMap(({ name, result: { error_estimates: e } }) => e.bodies.map((body) => ({ name, e, ...body, body: body.name, run: name })));
  fill("estimates", rows.length > 0 && tableOf("Error estimates", [
    ["run", (r) => r.run, "text"], ["body", (r) => r.body, "text"], ["largest von Mises stress", (r) => r.von_mises_stress],
    ["recovered", (r) => r.recovered], ["of the mesh", (r) => r.mesh], ["of rounding", (r) => r.arithmetic],
    ["no limit at node", (r) => r.no_limit?.node], ["error of the mesh in energy", (r) => r.e.mesh_energy_relative],
    ["displacement: of rounding", (r) => r.e.displacement_arithmetic], ["displacement: of the mesh", (r) => r.e.displacement_mesh],
  ], rows));
}

function showOthers() {
  const { calculix } = data;
  fill("calculix", calculix && make("p", {}, calculix.heading), calculix && tableOf("Differences over CalculiX’s largest value", [
    ["of", (row) => row.of, "text"], ["at", (row) => row.at], ["difference", (row) => row.difference], ["largest value", (row) => row.scale], ["relative", (row) => row.relative],
  ], calculix.differences), calculix && tableOf("Largest von Mises stress", [
    ["body", (row) => row.name, "text"], ["here", (row) => row.ours], ["CalculiX", (row) => row.calculix],
  ], calculix.bodies));
  fill("charts", ...data.charts.map(({ name, svg }) => make("img", { src: `data:image/svg+xml;base64,${svg}`, alt: name })));
}

function showContents() {
  const sections = [...document.querySelectorAll("main > section:not([hidden])")];
  byId("contents").replaceChildren(...sections.map((section) => make("a", { href: `#${section.id}` }, section.querySelector("h2").textContent)));
}

showWhat();
showAudit();
showSurface();
showEstimates();
showOthers();
startViewer();
showContents();
showExactValues();
