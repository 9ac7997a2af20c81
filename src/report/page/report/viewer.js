// Two pictures of fields that move together. Triangles are drawn once for a view, by colour; while
// the view moves, what was drawn is moved, and drawn anew when it rests.

const view = { cx: 0, cy: 0, scale: 1, field: FIELDS[0], k: 1, factor: 0, panels: [] };
const SHADES = data.colours.map(([r, g, b]) => `rgb(${r},${g},${b})`);
const REST = 120;

/** The extent of places: left, right, low, high. */
function extent(places, nodes) {
  const of = (j) => range(nodes ? nodes.map((n) => places[2 * n + j]) : places.filter((_, k) => k % 2 === j));
  return [...of(0), ...of(1)];
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
    const k = Math.min(view.k, iterationsOf(panel.run));
    panel.places = placesOf(panel.run, k, view.factor);
    panel.values = valuesOf(panel.run, view.field, k);
    panel.k = k;
  }
  const ranges = view.panels.filter(({ values }) => values).map(({ values }) => range(values));
  view.range = ranges.length ? [Math.min(...ranges.map(([low]) => low)), Math.max(...ranges.map(([, high]) => high))] : [0, 1];
  const [low, high] = view.range;
  for (const panel of view.panels) panel.order = panel.values && byColour(panel.values, low, high);
}

/** The triangles in the order of their colours, and where each colour begins. */
function byColour(values, low, high) {
  const shades = SHADES.length;
  const part = (x) => (high > low ? Math.min(shades - 1, Math.floor(((x - low) / (high - low)) * shades)) : shades >> 1);
  const begins = new Uint32Array(shades + 1);
  for (const x of values) begins[part(x) + 1] += 1;
  for (let s = 0; s < shades; s += 1) begins[s + 1] += begins[s];
  const next = begins.slice(0, shades);
  const order = new Uint32Array(values.length);
  values.forEach((x, t) => (order[next[part(x)]++] = t));
  return { begins, order };
}

/** Draws every triangle of a panel. */
function drawTriangles(panel) {
  const { context, width, height: tall } = prepared(panel.canvas, height(panel.canvas));
  const { triangles } = mesh;
  const { places, order } = panel;
  const [x0, y0] = [width / 2 - view.cx * view.scale, tall / 2 + view.cy * view.scale];
  const x = (n) => x0 + places[2 * n] * view.scale;
  const y = (n) => y0 - places[2 * n + 1] * view.scale;
  context.lineWidth = 0.6;
  const batch = (from, to, shade, of) => {
    if (from === to) return;
    context.beginPath();
    for (let k = from; k < to; k += 1) {
      const t = 3 * of(k);
      context.moveTo(x(triangles[t]), y(triangles[t]));
      context.lineTo(x(triangles[t + 1]), y(triangles[t + 1]));
      context.lineTo(x(triangles[t + 2]), y(triangles[t + 2]));
      context.closePath();
    }
    context.fillStyle = context.strokeStyle = shade;
    context.fill();
    context.stroke();
  };
  if (order) SHADES.forEach((shade, s) => batch(order.begins[s], order.begins[s + 1], shade, (k) => order.order[k]));
  else batch(0, mesh.count, colour("rule"), (k) => k);
  drawSurfaces(context, x, y);
  panel.drawn = { cx: view.cx, cy: view.cy, scale: view.scale, picture: snapshot(panel.canvas) };
}

/** The two contact surfaces: contact nodes joined, target edges. */
function drawSurfaces(context, x, y) {
  const stroke = (edges, ink) => {
    context.beginPath();
    for (const [a, b] of edges) {
      context.moveTo(x(a - 1), y(a - 1));
      context.lineTo(x(b - 1), y(b - 1));
    }
    context.strokeStyle = colour(ink);
    context.lineWidth = 1.2;
    context.stroke();
  };
  stroke(data.mesh.edges, "target-ink");
  const { contact } = data.mesh;
  stroke(contact.slice(1).map((n, k) => [contact[k], n]), "stamp-ink");
}

function snapshot(canvas) {
  const kept = document.createElement("canvas");
  [kept.width, kept.height] = [canvas.width, canvas.height];
  kept.getContext("2d").drawImage(canvas, 0, 0);
  return kept;
}

/** Shows what was drawn where it is in the view now. */
function moveDrawn(panel) {
  const { canvas, drawn } = panel;
  const context = canvas.getContext("2d");
  const ratio = window.devicePixelRatio || 1;
  const grown = view.scale / drawn.scale;
  const [w, h] = [canvas.width, canvas.height];
  context.setTransform(1, 0, 0, 1, 0, 0);
  context.clearRect(0, 0, w, h);
  const dx = (drawn.cx - view.cx) * view.scale * ratio;
  const dy = (view.cy - drawn.cy) * view.scale * ratio;
  context.drawImage(drawn.picture, w / 2 + dx - (w * grown) / 2, h / 2 + dy - (h * grown) / 2, w * grown, h * grown);
}

/** Moves what was drawn at once; draws anew when the view rests. */
function moved() {
  view.panels.forEach(moveDrawn);
  clearTimeout(view.resting);
  view.resting = setTimeout(() => view.panels.forEach(drawTriangles), REST);
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
    context.fillText(short(Number((low + ((high - low) * k) / 4).toPrecision(4))), 12 + (wide * k) / 4, 34);
  }
  canvas.setAttribute("aria-label", `${view.field.name} from ${short(low)} to ${short(high)} ${unitOf(view.field)}`);
}

/** Computes and draws everything anew. */
function showFields() {
  compute();
  view.panels.forEach(drawTriangles);
  drawScale();
  const most = Math.max(...view.panels.map(({ run }) => iterationsOf(run)));
  byId("iteration").max = most;
  byId("iteration-shown").textContent = view.panels.map(({ run, k }) => `${numberOf(run, k)} of ${lastOf(run)}`).join(" | ");
  view.panels.forEach((panel, side) => {
    const [low, high] = panel.values ? range(panel.values) : [];
    const unit = unitOf(view.field);
    const said = panel.values
      ? `${panel.run.name}, iteration ${numberOf(panel.run, panel.k)} of ${lastOf(panel.run)}: ${view.field.name} from ${short(low)} to ${short(high)} ${unit}`
      : `${panel.run.name}: ${view.field.name} is kept of the last iteration only`;
    byId(`said-${side}`).textContent = `${said}; displacements drawn ${short(view.factor)} times`;
    panel.canvas.setAttribute("aria-label", said);
  });
  showIterations(view.panels[0].run);
}

/** The point of the scene under a place of a canvas. */
function pointAt(panel, offsetX, offsetY) {
  const { canvas } = panel;
  return [view.cx + (offsetX - canvas.clientWidth / 2) / view.scale, view.cy - (offsetY - height(canvas) / 2) / view.scale];
}

/** What both panels show at a triangle. */
function valuesAt(t) {
  return view.panels.map(({ values }) => (values && t >= 0 ? values[t] : null));
}

function pointed(panel, place) {
  const [x, y] = pointAt(panel, ...place);
  const t = triangleAt(panel.places, x, y);
  const unit = unitOf(view.field);
  byId("pointed").textContent =
    t < 0 ? "" : `triangle ${t + 1}, ${data.mesh.bodies[mesh.body[t]]}, at (${short(x)}, ${short(y)}): ${view.panels.map(({ run }, k) => `${run.name} ${short(valuesAt(t)[k] ?? NaN)} ${unit}`).join("; ")}`;
}

const probes = [];

/** Takes the values of both panels at a point of the drawn shape of one. */
function probe(panel, x, y) {
  const t = triangleAt(panel.places, x, y);
  const [left, right] = valuesAt(t);
  probes.push({ x, y, t, left, right, names: view.panels.map(({ run, k }) => `${run.name}, iteration ${numberOf(run, k)}`), field: view.field });
  byId("probes").replaceChildren(
    tableOf("Probes", [
      ["x", (p) => p.x], ["y", (p) => p.y],
      ["triangle", (p) => (p.t < 0 ? "outside" : p.t + 1)],
      ["field", (p) => p.field.name, "text"], ["unit", (p) => unitOf(p.field), "text"],
      ["left", (p) => p.names[0], "text"], ["value left", (p) => p.left],
      ["right", (p) => p.names[1], "text"], ["value right", (p) => p.right],
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
    const by = { ArrowLeft: [-40, 0], ArrowRight: [40, 0], ArrowUp: [0, 40], ArrowDown: [0, -40] }[event.key];
    const grown = { "+": 1.25, "=": 1.25, "-": 0.8 }[event.key];
    if (by) pan(...by);
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
  const most = Math.max(...shownRuns.map((run) => Math.max(...range(displacements(run, iterationsOf(run))).map(Math.abs))));
  if (!(most > 0)) return 0;
  const factor = Math.max(right - left, high - low) / 25 / most;
  return Number(factor.toPrecision(1));
}

function startViewer() {
  if (shownRuns.length === 0) return void (byId("fields").hidden = true);
  const own = Math.max(0, shownRuns.findIndex((run) => run.name === data.own));
  const other = Math.max(0, shownRuns.findIndex((run) => run.name === data.equilibrium));
  view.panels = [own, other].map((at, side) => ({ canvas: byId(`view-${side}`), run: shownRuns[at] }));
  view.panels.forEach((panel, side) => {
    const select = byId(`run-${side}`);
    select.replaceChildren(...shownRuns.map((run, k) => make("option", { value: k }, run.name)));
    select.value = side === 0 ? own : other;
    select.addEventListener("change", () => ((panel.run = shownRuns[select.value]), showFields()));
    watchPanel(panel);
  });
  byId("field").replaceChildren(...FIELDS.map((field, k) => make("option", { value: k }, field.name)));
  byId("field").addEventListener("change", (event) => ((view.field = FIELDS[event.target.value]), showFields()));
  view.k = Math.max(...shownRuns.map(iterationsOf));
  byId("iteration").max = view.k;
  byId("iteration").value = view.k;
  byId("iteration").addEventListener("input", (event) => ((view.k = Number(event.target.value)), showFields()));
  byId("factor").value = view.factor;
  byId("handy").textContent = `such as ${handyFactor()}`;
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
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", showFields);
}
