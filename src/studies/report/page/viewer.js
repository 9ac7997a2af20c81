// Two pictures of fields that move together.

const OWN_FIELD = FIELDS.findIndex(({ triangle }) => triangle === "von_mises_stress");
const view = { cx: 0, cy: 0, scale: 1, field: FIELDS[OWN_FIELD], factor: 0, panels: [] };
const SHADES = data.colours.map(([r, g, b]) => `rgb(${r},${g},${b})`);
const REST = 120;

/** The extent of places: left, right, low, high. @returns {[any, any, any, any]} */
function extent(places, nodes) {
  const of = (j) => range(nodes ? nodes.map((n) => places[2 * n + j]) : places.filter((_, k) => k % 2 === j));
  const [[left, right], [low, high]] = [of(0), of(1)];
  return [left, right, low, high];
}

/** Looks at an extent in whole. */
function lookAt([left, right, low, high]) {
  const canvas = view.panels[0].canvas;
  [view.cx, view.cy] = [(left + right) / 2, (low + high) / 2];
  view.scale = 0.94 * Math.min(canvas.clientWidth / (right - left || 1), height(canvas) / (high - low || 1));
}

const height = (canvas) => Math.min(520, Math.max(260, canvas.clientWidth * 0.85));

/** Computes what the panels show: places, values, and the range that both have. */
function compute() {
  for (const panel of view.panels) {
    panel.places = placesOf(panel.run, view.factor);
    panel.values = valuesOf(panel.run, view.field);
    panel.marks = marksOf(panel.run, view.field);
  }
  const ranges = view.panels.flatMap((panel) => rangeOf(panel) ?? []);
  view.range = ranges.length ? range(ranges) : [0, 1];
  const plain = packed(/** @type {[any, any, any]} */ ([1, 3, 5].map((at) => parseInt(colour("rule").slice(at, at + 2), 16))));
  const shades = data.colours.map(packed);
  for (const { colours, values } of view.panels) {
    if (values) for (let t = 0; t < mesh.count; t += 1) colours[t] = shades[shadeOf(values[t])];
    else colours.fill(plain);
  }
}

/** The smallest and the largest value that a panel shows; nothing where it shows none. */
function rangeOf({ values, marks }) {
  const all = values ?? marks?.values();
  return all && range(all);
}

/** The place of a value's colour. */
function shadeOf(value) {
  const [low, high] = view.range;
  if (!(high > low)) return SHADES.length >> 1;
  return Math.min(SHADES.length - 1, Math.floor(((value - low) / (high - low)) * SHADES.length));
}

/** Draws a panel with so many pixels to one of the page. */
function draw(panel, ratio) {
  const { canvas, places } = panel;
  const [width, tall] = [canvas.clientWidth, height(canvas)];
  canvas.style.height = `${tall}px`;
  const [columns, rows] = [width, tall].map((size) => Math.round(size * ratio));
  if (canvas.width !== columns || canvas.height !== rows) {
    [canvas.width, canvas.height] = [columns, rows];
    panel.image = new ImageData(columns, rows);
    panel.pixels = new Uint32Array(panel.image.data.buffer);
  }
  const [scale, x0, y0] = [view.scale * ratio, columns / 2, rows / 2];
  for (let n = 0; n < mesh.nodes; n += 1) {
    panel.x[n] = x0 + (places[2 * n] - view.cx) * scale;
    panel.y[n] = y0 - (places[2 * n + 1] - view.cy) * scale;
  }
  panel.pixels.fill(0);
  fillTriangles(panel.pixels, columns, mesh.triangles, panel.x, panel.y, panel.colours);
  const context = canvas.getContext("2d");
  context.putImageData(panel.image, 0, 0);
  drawSurfaces(context, panel, ratio);
  if (panel.marks) drawMarks(context, panel, ratio);
}

/** The two contact surfaces: contact nodes joined, target edges. */
function drawSurfaces(context, { x, y }, ratio) {
  const [{ edges, contact }, width] = [data.mesh, 1.2 * ratio];
  const [target, stamp] = ["target-ink", "stamp-ink"].map(colour);
  const through = (nodes, stroke) => path(context, nodes.map((n) => [x[n - 1], y[n - 1]]), { stroke, width });
  for (const edge of edges) through(edge, target);
  through(contact, stamp);
}

/** The values at contact nodes, each by a disc in its colour. */
function drawMarks(context, { x, y, marks }, ratio) {
  const [stroke, width] = [colour("ink"), 0.5 * ratio];
  for (const [n, value] of marks) circle(context, [x[n], y[n]], 5 * ratio, { fill: SHADES[shadeOf(value)], stroke, width });
}

/** The pixels to one of the page of a picture at rest, whose edges are then smooth. */
const fine = () => Math.max(2, window.devicePixelRatio);
const drawAll = (ratio) => view.panels.forEach((panel) => draw(panel, ratio));

/** Draws a moving view once a frame, and finely when it rests. */
function moved() {
  view.frame ??= requestAnimationFrame(() => {
    view.frame = undefined;
    drawAll(window.devicePixelRatio);
  });
  clearTimeout(view.resting);
  view.resting = setTimeout(() => drawAll(fine()), REST);
}

function drawScale() {
  const canvas = byId("scale");
  const { context, width } = prepared(canvas, 44);
  const [low, high] = view.range;
  const wide = Math.min(width - 24, 640);
  SHADES.forEach((shade, s) => {
    context.fillStyle = shade;
    context.fillRect(12 + (s * wide) / SHADES.length, 4, wide / SHADES.length + 1, 14);
  });
  context.fillStyle = colour("ink");
  for (let k = 0; k <= 4; k += 1) {
    context.textAlign = k === 0 ? "left" : k === 4 ? "right" : "center";
    const value = low + ((high - low) * k) / 4;
    const rounding = 1e-9 * (high - low);
    context.fillText(short(Math.abs(value) < rounding ? 0 : Number(value.toPrecision(4))), 12 + (wide * k) / 4, 34);
  }
  canvas.setAttribute("aria-label", t("{field} from {low} to {high}", { field: view.field.name, low, high: inUnit(inProse(high), view.field) }));
}

/** What a panel shows, in words. */
function saidOf(panel) {
  const field = { run: panel.run.name, field: view.field.name };
  const known = rangeOf(panel);
  if (!known) return t("{run}: {field} is not known", field);
  return t("{run}: {field} from {low} to {high}", { ...field, low: known[0], high: inUnit(inProse(known[1]), view.field) });
}

/** Computes and draws everything anew. */
function showFields() {
  compute();
  drawAll(fine());
  drawScale();
  const shape = view.factor === 0 ? t("undeformed") : view.factor === 1 ? t("deformed") : t("displacement scale {factor}", view);
  view.panels.forEach((panel, side) => {
    const said = saidOf(panel);
    byId(`said-${side}`).textContent = `${said}; ${shape}`;
    panel.canvas.setAttribute("aria-label", said);
  });
  showIterations(view.panels[0].run);
}

/** The point of the scene under a place of a canvas. @returns {[any, any]} */
function pointAt(panel, offsetX, offsetY) {
  const { canvas } = panel;
  return [view.cx + (offsetX - canvas.clientWidth / 2) / view.scale, view.cy - (offsetY - height(canvas) / 2) / view.scale];
}

/** What there is at a point of a panel's drawn shape: in words, and the value of each panel there. A
 * contact node is found `within` a distance. */
function foundAt({ places, marks }, x, y, within) {
  if (view.field.contact) {
    const far = (n) => Math.hypot(places[2 * n] - x, places[2 * n + 1] - y);
    const nearest = [...(marks?.keys() ?? [])].reduce((best, n) => (best === undefined || far(n) < far(best) ? n : best), undefined);
    if (nearest === undefined || far(nearest) > within) return null;
    return { at: t("node {n}", { n: nearest + 1 }), values: view.panels.map(({ marks }) => marks?.get(nearest) ?? null) };
  }
  const triangle = triangleAt(places, x, y);
  if (triangle < 0) return null;
  return { at: t("triangle {n}", { n: triangle + 1 }), body: data.mesh.bodies[mesh.body[triangle]], values: view.panels.map(({ values }) => values?.[triangle] ?? null) };
}

/** How near to a contact node the pointer finds it, pixels. */
const NEAR = 14;
const said = (value) => (value === null ? t("not known") : inUnit(inProse(value), view.field));

function pointed(panel, place) {
  const [x, y] = pointAt(panel, ...place);
  const found = foundAt(panel, x, y, NEAR / view.scale);
  const values = found && view.panels.map(({ run }, k) => `${run.name} ${said(found.values[k])}`).join("; ");
  byId("pointed").textContent = found ? t("{what}, at ({x}, {y}): {values}", { what: [found.at, found.body].filter(Boolean).join(", "), x, y, values }) : "";
}

const probes = [];

/** Takes the values of both panels at a point of the drawn shape of one; of a field of contact
 * nodes, at the nearest. */
function probe(panel, x, y) {
  const found = foundAt(panel, x, y, Infinity);
  const [left, right] = found?.values ?? [null, null];
  probes.push({ x, y, at: found?.at ?? t("outside"), left, right, names: view.panels.map(({ run }) => run.name), field: view.field });
  byId("probes").replaceChildren(
    tableOf(t("Probes"), [
      ["x", (p) => p.x], ["y", (p) => p.y], [t("at"), (p) => p.at, "text"],
      [t("field"), (p) => p.field.name, "text"], [t("unit"), (p) => unitOf(p.field), "text"],
      [t("left"), (p) => p.names[0], "text"], [t("value left"), (p) => p.left],
      [t("right"), (p) => p.names[1], "text"], [t("value right"), (p) => p.right],
    ], probes),
  );
}

function watchPanel(panel) {
  const { canvas } = panel;
  let held = null;
  canvas.addEventListener("pointerdown", (event) => {
    held = { x: event.offsetX, y: event.offsetY, far: false };
    canvas.setPointerCapture(event.pointerId);
  });
  canvas.addEventListener("pointermove", (event) => {
    if (!held) return pointed(panel, [event.offsetX, event.offsetY]);
    const [dx, dy] = [event.offsetX - held.x, event.offsetY - held.y];
    held = { x: event.offsetX, y: event.offsetY, far: held.far || Math.hypot(dx, dy) > 2 };
    pan(-dx, dy);
  });
  canvas.addEventListener("pointerup", (event) => {
    if (held && !held.far) probe(panel, ...pointAt(panel, event.offsetX, event.offsetY));
    held = null;
  });
  canvas.addEventListener("wheel", (event) => {
    event.preventDefault();
    zoom(Math.exp(-event.deltaY / 500), pointAt(panel, event.offsetX, event.offsetY));
  }, { passive: false });
  canvas.addEventListener("keydown", (event) => {
    const by = ARROWS[event.key];
    const grown = { "+": 1.25, "=": 1.25, "-": 0.8 }[event.key];
    if (by) pan(40 * by[0], -40 * by[1]);
    else if (grown) zoom(grown, [view.cx, view.cy]);
    else if (event.key === "Enter") probe(panel, view.cx, view.cy);
    else return;
    event.preventDefault();
  });
}

function pan(dx, dy) {
  view.cx += dx / view.scale;
  view.cy += dy / view.scale;
  moved();
}

/** Zooms about a point, which stays where it is. */
function zoom(grown, [x, y]) {
  view.scale *= grown;
  view.cx = x + (view.cx - x) / grown;
  view.cy = y + (view.cy - y) / grown;
  moved();
}

/** A factor at which the largest displacement of the runs is a twenty-fifth of the scene. */
function handyFactor() {
  const [left, right, low, high] = extent(mesh.at);
  const most = Math.max(...shownRuns.map((run) => Math.max(...range(displacements(run)).map(Math.abs))));
  if (!(most > 0)) return 0;
  const factor = Math.max(right - left, high - low) / 25 / most;
  return Number(factor.toPrecision(1));
}

function startViewer() {
  if (shownRuns.length === 0) return void (byId("fields").hidden = true);
  const own = Math.max(0, shownRuns.findIndex((run) => run.name === data.own));
  const other = Math.max(0, shownRuns.findIndex((run) => run.name === data.equilibrium));
  view.panels = [own, other].map((at, side) => ({
    canvas: byId(`view-${side}`), run: shownRuns[at],
    x: new Float64Array(mesh.nodes), y: new Float64Array(mesh.nodes), colours: new Uint32Array(mesh.count),
  }));
  view.panels.forEach((panel, side) => {
    const select = byId(`run-${side}`);
    select.replaceChildren(...shownRuns.map((run, k) => make("option", { value: k }, run.name)));
    select.value = side === 0 ? own : other;
    select.addEventListener("change", () => ((panel.run = shownRuns[select.value]), showFields()));
    watchPanel(panel);
  });
  byId("field").replaceChildren(...FIELDS.map((field, k) => make("option", { value: k }, field.name)));
  byId("field").value = OWN_FIELD;
  byId("field").addEventListener("change", (event) => ((view.field = FIELDS[event.target.value]), showFields()));
  byId("factor").value = view.factor;
  byId("handy").textContent = t("for example {factor}", { factor: handyFactor() });
  byId("factor").addEventListener("change", (event) => ((view.factor = Number(event.target.value) || 0), showFields()));
  const look = (nodes) => {
    lookAt(extent(mesh.at, nodes));
    showFields();
  };
  byId("whole").addEventListener("click", () => look());
  byId("zoom-contact").hidden = data.mesh.contact.length === 0;
  byId("zoom-contact").addEventListener("click", () => look(data.mesh.contact.map((n) => n - 1)));
  byId("probe").addEventListener("submit", (event) => {
    event.preventDefault();
    probe(view.panels[0], Number(byId("probe-x").value), Number(byId("probe-y").value));
  });
  look();
  window.addEventListener("resize", () => look());
  matchMedia("screen and (prefers-color-scheme: dark)").addEventListener("change", showFields);
}
