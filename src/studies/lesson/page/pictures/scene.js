// The scene: the contact zone with its heights magnified, the gaps over the target's line, and the
// whole to scale.

/** A mesh whose edges of these numbers run the other way. */
function withReversed(own, turned) {
  const ends = (number, nodes) => (turned.has(number) ? [...nodes].reverse() : nodes);
  return {
    ...own,
    edges: own.edges.map(([number, nodes]) => [number, ends(number, nodes)]),
    elem: own.elem.map((row) => [...row.slice(0, 5), ...ends(row[0], row.slice(5, 7)), row[7]]),
  };
}

/** What is drawn of a scene; nodes by their number. */
class Mesh {
  own; triangles; contact; edges; target; restrained; bodies; side;
  constructor(given, units, moved = new Map(), turned = new Set()) {
    const own = withReversed(given, turned);
    const { nodes, triangles, contact, edges, figure, target, restrained, dropped, bodies } = own;
    Object.assign(this, { own, triangles, contact, edges, target, restrained, bodies });
    this.stands = (n) => moved.get(n) ?? nodes[n - 1];
    // A node of no triangle is drawn where another is.
    this.at = (n) => this.stands(dropped.includes(n) ? triangles[0][0][0] : n);
    this.count = nodes.length;
    this.figure = new Map(figure);
    this.edge = new Map(edges);
    this.length = units.length;
    const heightOf = (nodes) => nodes.reduce((sum, n) => sum + this.at(n)[1], 0) / nodes.length;
    const ofTarget = triangles.filter(([, body]) => body === target).flatMap(([nodes]) => nodes);
    // Which way the stamp lies from the target: 1 above it, -1 below.
    this.side = edges.length && heightOf(ofTarget) > heightOf(edges.flatMap(([, ends]) => ends)) ? -1 : 1;
  }

  /** A node's name in the manner of the paper's fig. 1, and its number. */
  name(n) {
    const figure = this.figure.get(n);
    return figure ? `${figure} (${n})` : String(n);
  }
}

/** The largest round number that is at most `x`. */
function roundAtMost(x) {
  const power = 10 ** Math.floor(Math.log10(x));
  return [7, 5, 4, 3, 2.5, 2, 1.5, 1].find((k) => k * power <= x * (1 + 1e-12)) * power;
}

/** What the run has found of each contact node: `ct`, `yt`, `dy`, its row of `k_cnt`, its height over the target
 * and the way there, as far as known; `pairs` is the machine of c_cnt. An edited listing may write anything: what is no number counts as
 * not known, what is no node as 0. */
function contactNodes(mesh, pairs) {
  return mesh.contact.map((node, k) => {
    const number = (value) => (Number.isFinite(value) ? value : undefined);
    const of = (name) => number(pairs.get(`${name}[${k + 1}]`));
    const [first, a, second, b] = [1, 2, 3, 4].map((j) => number(pairs.get(`k_cnt[${node},${j}]`)) ?? 0);
    const mate = (n) => (Number.isInteger(n) && n >= 1 && n <= mesh.count ? n : 0);
    const row = [mate(first), a, mate(second), b];
    const yt = of("yt");
    // The corrected yt is positive apart, and along the normal n.
    const normal = [1, 2].map((j) => number(pairs.get(`n[${k + 1},${j}]`)));
    const [height, toTarget] = normal.includes(undefined) ? [-yt, [0, yt]] : [mesh.side * yt, normal.map((x) => -x * yt)];
    return { node, place: k + 1, ct: of("ct"), yt, dy: of("dy"), row, height, toTarget };
  });
}

/** A view: where a point of the scene is drawn, in pixels; heights over a line of this slope. */
function viewOf(points, width, height, margin, magnify, slope = 0) {
  const over = ([x, y]) => [x, y - slope * x];
  const [[left, right], [low, high]] = [0, 1].map((j) => range(points.map((p) => over(p)[j])));
  const span = Math.max(right - left, high - low) || 1;
  const fit = (size, room) => room / Math.max(size, 1e-9 * span);
  const [across, up] = [fit(right - left, width - 2 * margin), fit(high - low, height - 2 * margin)];
  let [sx, factor] = [Math.min(across, up), 1];
  if (magnify && up > across) [sx, factor] = [across, Math.max(1, roundAtMost(Math.min(up / across, 1e6)))];
  const sy = sx * factor;
  const [cx, cy] = [(left + right) / 2, (low + high) / 2];
  const to = (p) => [width / 2 + (p[0] - cx) * sx, height / 2 - (over(p)[1] - cy) * sy];
  const from = ([x, y]) => {
    const at = cx + (x - width / 2) / sx;
    return [at, cy - (y - height / 2) / sy + slope * at];
  };
  return { to, from, factor, sy, slope };
}

function arrow(context, from, to, stroke) {
  path(context, [from, to], { stroke, width: 2 });
  const up = Math.sign(to[1] - from[1]) || 1;
  const size = Math.min(6, Math.abs(to[1] - from[1]) / 2 + 2);
  path(context, [[to[0] - size / 2, to[1] - up * size], to, [to[0] + size / 2, to[1] - up * size]], { stroke, width: 2 });
}

/** @param {any} context @param {any} text @param {any} at @param {any} ink @param {any} align @param {any} placed
 * Writes on a ground of its own, so that lines below do not cross the letters; where a picture keeps its labels in
 * `placed`, at the nearest place above, below or beside that none of them covers. */
function label(context, text, [x, y], ink, align = "center", placed = null) {
  if (placed) {
    const width = context.measureText(text).width;
    const room = context.canvas.clientHeight;
    const boxAt = (/** @type {number[]} */ [dx, dy]) => [x + dx - width / 2, y + dy - 12, x + dx + width / 2, y + dy + 3];
    const isFree = (/** @type {number[]} */ [l, t, r, b]) => t > -2 && b < room && placed.every(([l2, t2, r2, b2]) => r <= l2 || r2 <= l || b <= t2 || b2 <= t);
    const tries = [[0, 0], [0, -14], [0, 15], [width / 2 + 10, 0], [-width / 2 - 10, 0], [0, -28], [0, 30], [width / 2 + 12, 15], [-width / 2 - 12, 15], [width / 2 + 12, -14], [-width / 2 - 12, -14]];
    const by = tries.find((by) => isFree(boxAt(by))) ?? tries[0];
    placed.push(boxAt(by));
    [x, y] = [x + by[0], y + by[1]];
  }
  context.textAlign = align;
  context.lineWidth = 4;
  context.strokeStyle = colour("paper");
  context.lineJoin = "round";
  context.strokeText(text, x, y);
  context.fillStyle = ink;
  context.fillText(text, x, y);
}

/** A contact node: filled in contact, open where it is not, a small dot where its status is not known. @param {any} context @param {any} at @param {any} dy @param {boolean} current */
function drawStatus(context, at, dy, current) {
  const fill = dy === 0 ? colour("paper") : dy === 1 ? colour("accent") : colour("stamp-ink");
  circle(context, at, dy === undefined ? 3 : 6, { fill, stroke: dy === undefined ? colour("stamp-ink") : colour("accent"), width: 2 });
  if (current) circle(context, at, 11, { stroke: colour("ink"), width: 2 });
}

function drawBodies(context, mesh, at, element = null) {
  mesh.triangles.forEach(([nodes, body], k) => {
    const [lit, name] = [k + 1 === element, body === mesh.target ? "target" : "stamp"];
    const style = { fill: colour(lit ? "lit" : name), stroke: colour(`${name}-ink`), width: lit ? 2.5 : 0.8, close: true };
    path(context, nodes.map(at), style);
  });
}

/** Whether a point is in a triangle, its rim too. */
function isIn(p, corners) {
  const sides = corners.map((a, k) => areaOf([a, corners[(k + 1) % 3], p]));
  return sides.every((area) => area >= 0) || sides.every((area) => area <= 0);
}

/** How far a node is from the nearest target edge, and whether it is inside the target. */
function fromTarget(mesh, n) {
  const p = mesh.at(n);
  const from = ([a, b]) => {
    const [ab, ap] = [[b[0] - a[0], b[1] - a[1]], [p[0] - a[0], p[1] - a[1]]];
    const along = Math.max(0, Math.min(1, (ap[0] * ab[0] + ap[1] * ab[1]) / (ab[0] ** 2 + ab[1] ** 2 || 1)));
    return Math.hypot(ap[0] - along * ab[0], ap[1] - along * ab[1]);
  };
  const isInside = mesh.triangles.some(([nodes, body]) => body === mesh.target && isIn(p, nodes.map(mesh.at)));
  return { distance: Math.min(...mesh.edges.map(([, ends]) => from(ends.map(mesh.at)))), isInside };
}

/** The contact nodes that are drawn, those that were chosen, and the target edges beside them. */
function zoneOf(mesh, chosen) {
  const nodes = chosen.length ? mesh.contact.filter((n) => chosen.includes(n)) : mesh.contact;
  const [left, right] = range(nodes.map((n) => mesh.at(n)[0]));
  const isNear = ([, ends]) => {
    const [from, to] = range(ends.map((n) => mesh.at(n)[0]));
    return to >= left - (right - left) && from <= right + (right - left);
  };
  return { nodes, edges: chosen.length ? mesh.edges.filter(isNear) : mesh.edges };
}

/** The height of a picture: figure, current line and question have room in one window. */
const pictureHeight = () => Math.max(150, Math.min(340, 0.44 * page.width, 0.3 * window.innerHeight));

/** Where an edge's name stands, between and below its ends. */
const besideEdge = (a, b) => [(a[0] + b[0]) / 2, Math.max(a[1], b[1]) + 22];

/** What a band of c_tll has at least, in pixels: the lines over it have two. */
const LEAST_BAND = 3;

/** The view of the zone: to scale, with its heights magnified, or where the band would still be hidden by lines, with the
 * target's slope taken out and what is left magnified more. */
function viewOfZone(points, ends, tolerance, width, height) {
  const view = viewOf(points, width, height, 42, true);
  const [[x1, y1], [x2, y2]] = [ends.reduce((a, b) => (b[0] < a[0] ? b : a), ends[0] ?? [0, 0]), ends.reduce((a, b) => (b[0] > a[0] ? b : a), ends[0] ?? [0, 0])];
  if (tolerance * view.sy >= LEAST_BAND || x1 === x2) return view;
  return viewOf(points, width, height, 42, true, (y2 - y1) / (x2 - x1));
}

/** Draws the zone: bodies, band of c_tll, search box of lines 5 to 7, arrow of line 10, links. The caption names what is there. */
function drawZone(mesh, pairs, zone, tolerance, turn, boxed) {
  const canvas = byId("zone");
  const { context, width, height } = prepared(canvas, pictureHeight(), page.width);
  const ends = zone.edges.flatMap(([, ends]) => ends).map(mesh.at);
  const points = [...zone.nodes.map(mesh.at), ...ends.flatMap(([x, y]) => [[x, y - tolerance], [x, y + tolerance]])];
  // While a node is dragged the view stays.
  page.view = page.dragged ? page.view : viewOfZone(points, ends, tolerance, width, height);
  const { to, factor, sy, slope } = page.view;
  drawBodies(context, mesh, (n) => to(mesh.at(n)));
  const placed = [];
  const labels = [];
  for (const [number, ends] of zone.edges) {
    const [a, b] = ends.map((n) => to(mesh.at(n)));
    const band = Math.min(tolerance * sy, height);
    const corners = [[a[0], a[1] - band], [b[0], b[1] - band], [b[0], b[1] + band], [a[0], a[1] + band]];
    path(context, corners, { fill: colour("band"), alpha: 0.28, close: true });
    const tried = boxed && number === mesh.edges[pairs.get("i2") - 1]?.[0];
    path(context, [a, b], { stroke: colour("target-ink"), width: tried ? 4 : 2 });
    const text = t("edge {edge}", { edge: number });
    const [x, y] = besideEdge(a, b);
    // The button that reverses the edge stands over its name, which keeps its place.
    placed.push([x - context.measureText(text).width / 2, y - 12, x + context.measureText(text).width / 2, y + 3]);
    labels.push([text, [x, y], "target-ink", null]);
  }
  const isBoxed = drawBox(context, to, pairs, boxed);
  const nodes = contactNodes(mesh, pairs).filter(({ node }) => zone.nodes.includes(node));
  for (const { node } of nodes) placed.push([to(mesh.at(node))[0] - 8, to(mesh.at(node))[1] - 8, to(mesh.at(node))[0] + 8, to(mesh.at(node))[1] + 8]);
  const seen = { links: false, arrows: false };
  for (const { node, place, ct, yt, row, toTarget } of nodes) {
    const [x, y] = mesh.at(node);
    for (const [mate, weight] of [[row[0], row[1]], [row[2], row[3]]]) {
      if (mate === 0) continue;
      seen.links = true;
      const [from, end] = [to([x, y]), to(mesh.at(mate))];
      path(context, [from, end], { stroke: colour("accent"), width: place === turn ? 2 : 1, dash: [4, 3] });
      if (place === turn) labels.push([short(weight), [(from[0] + end[0]) / 2, (from[1] + end[1]) / 2 - 4], "accent", placed]);
    }
    if (!(ct > 0) || yt === undefined || yt === 0) continue;
    seen.arrows = true;
    arrow(context, to([x, y]), to([x + toTarget[0], y + toTarget[1]]), colour(place === turn ? "accent" : "muted"));
  }
  for (const { node, place, dy } of nodes) {
    const [x, y] = to(mesh.at(node));
    drawStatus(context, [x, y], dy, place === turn);
    labels.push([mesh.name(node), [x, Math.max(14, y - 15)], "stamp-ink", placed]);
  }
  for (const n of new Set(zone.edges.flatMap(([, ends]) => ends))) {
    const [x, y] = to(mesh.at(n));
    path(context, [[x - 3, y], [x + 3, y]], { stroke: colour("target-ink"), width: 6 });
    labels.push([mesh.name(n), [x, y + 38 > height ? y - 10 : y + 38], "target-ink", placed]);
  }
  for (const [text, at, ink, placed] of labels) label(context, text, at, colour(ink), "center", placed);
  const is = (status) => nodes.some(({ dy }) => dy === status);
  say("zone-caption", [
    slope ? t("Heights are those over a line between the target’s ends, magnified {factor} times.", { factor }) : factor === 1 ? t("To scale.") : t("Heights are magnified {factor} times.", { factor }),
    ...(zone.edges.length ? [t("Green band: within c_tll of an edge’s line.")] : []),
    ...(isBoxed ? [t("Dashed box: where lines 5 to 7 search.")] : []),
    ...(seen.arrows ? [run().programs ? t("Arrow: yt, along the normal.") : t("Arrow: Y of line 10.")] : []),
    ...(is(1) ? [t("Filled: in contact.")] : []),
    ...(is(0) ? [t("Open: not in contact.")] : []),
    ...(is(undefined) ? [t("Dot: not decided yet.")] : []),
    ...(seen.links ? [t("Dashed lines: links with their weights.")] : []),
    ...(mesh.count > MOST_DRAGGED ? [] : [t("A node can be dragged, an edge’s name reverses the edge.")]),
  ].join(" "));
  placeButtons(zone);
  canvas.setAttribute("aria-label", t("The contact zone: {nodes}", { nodes: nodes.map((n) => t("node {name} {status}", { name: mesh.name(n.node), status: inWords(n) })).join("; ") }));
}

const inWords = ({ dy }) => (dy === undefined ? t("not decided") : dy === 1 ? t("in contact") : t("not in contact"));

/** Draws the box of lines 5 and 6, while lines 4 to 7 are executed; returns whether there is one. */
function drawBox(context, to, pairs, boxed) {
  const [x1, x2, y1, y2] = ["ntx[1]", "ntx[2]", "nty[1]", "nty[2]"].map((name) => pairs.get(name));
  if (!boxed || [x1, x2, y1, y2].includes(undefined)) return false;
  const corners = [[x1, y1], [x2, y1], [x2, y2], [x1, y2]].map(to);
  path(context, corners, { stroke: colour("ink"), width: 2, dash: [6, 4], close: true });
  return true;
}

/** A node's height over the line of the target edge above or below it, else of the one that ends nearest to it. */
function heightAsDrawn(mesh, zone, n) {
  const [x, y] = mesh.at(n);
  const lines = zone.edges.map(([, ends]) => ends.map(mesh.at)).filter(([a, b]) => a[0] !== b[0]);
  const over = ([a, b]) => y - a[1] - ((x - a[0]) * (b[1] - a[1])) / (b[0] - a[0]);
  const beside = ([a, b]) => Math.max(0, Math.min(a[0], b[0]) - x, x - Math.max(a[0], b[0]));
  const [nearest] = lines.sort((one, other) => beside(one) - beside(other) || Math.abs(over(one)) - Math.abs(over(other)));
  return nearest && over(nearest);
}

/** Draws each contact node at its height over its edge's line, the line drawn straight: by the listing's yt, else as the
 * scene is drawn. */
function drawGaps(mesh, pairs, zone, tolerance, turn) {
  const canvas = byId("gaps");
  const { context, width, height } = prepared(canvas, 170, page.width);
  const nodes = contactNodes(mesh, pairs).filter(({ node }) => zone.nodes.includes(node)).flatMap((n) => {
    const isKnown = n.ct > 0 && n.yt !== undefined;
    const above = isKnown ? n.height : heightAsDrawn(mesh, zone, n.node);
    return above === undefined ? [] : [{ ...n, isKnown, height: above }];
  });
  const known = nodes.filter(({ isKnown }) => isKnown);
  // A node that is far away stands at the rim, so that the band is seen.
  const most = Math.max(tolerance, ...nodes.map(({ isKnown, height }) => Math.min(Math.abs(height), isKnown ? Infinity : 3 * tolerance)));
  const [left, right] = range(zone.nodes.map((n) => mesh.at(n)[0]));
  const sx = (width - 120) / (right - left || 1);
  const factor = roundAtMost((height / 2 - 28) / (most || 1) / sx);
  const to = (x, gap) => [60 + (x - left) * sx, Math.min(height - 12, Math.max(12, height / 2 - gap * sx * factor))];
  const band = Math.max(tolerance * sx * factor, 1);
  const strip = (from, to, style) => path(context, [[0, from], [width, from], [width, to], [0, to]], style);
  strip(height / 2, mesh.side > 0 ? height : 0, { fill: colour("target") });
  strip(height / 2 - band, height / 2 + band, { fill: colour("band"), alpha: 0.28 });
  path(context, [[0, height / 2], [width, height / 2]], { stroke: colour("target-ink"), width: 3 });
  const placed = nodes.map(({ node, height: above }) => to(mesh.at(node)[0], above)).map(([x, y]) => [x - 7, y - 7, x + 7, y + 7]);
  for (const { node, place, height: above, dy, isKnown } of nodes) {
    const point = to(mesh.at(node)[0], above);
    if (isKnown) arrow(context, point, [point[0], height / 2], colour(place === turn ? "accent" : "muted"));
    drawStatus(context, point, dy, place === turn);
    const below = point[1] > height / 2;
    label(context, mesh.figure.get(node) ?? String(node), [point[0], point[1] + (below ? 24 : -13)], colour("stamp-ink"), "center", placed);
  }
  const scale = factor === 1 ? [] : [t("Gaps are drawn {factor} times as large as lengths along x.", { factor })];
  const signs = run().programs ? t("Apart: yt > 0; inside the target: yt < 0.") : t("Above the line: yt < 0; below it: yt > 0.");
  const drawn = known.length < nodes.length ? [t("Without an arrow: as the scene is drawn, where the listing has no yt.")] : [];
  say("gaps-caption", [...scale, t("The target's side is tinted."), ...(known.length ? [signs] : []), ...drawn].join(" "));
  canvas.setAttribute("aria-label", t("Gaps: {gaps}", { gaps: known.map((n) => `${mesh.name(n.node)} ${inProse(n.yt)}`).join("; ") || t("none yet") }));
}

/** Draws the whole scene to scale; `element` is lit, its equations' nodes V and W are ringed. */
function drawWhole(mesh, pairs, element, linked) {
  const canvas = byId("whole");
  const points = Array.from({ length: mesh.count }, (_, k) => mesh.at(k + 1));
  const { context, width, height } = prepared(canvas, pictureHeight(), page.width);
  const { to } = viewOf(points, width, height, 26, false);
  drawBodies(context, mesh, (n) => to(mesh.at(n)), element);
  const numbered = mesh.count <= 60;
  mesh.triangles.forEach(([nodes], k) => {
    if (!numbered && k + 1 !== element) return;
    const corners = nodes.map((n) => to(mesh.at(n)));
    const middle = [0, 1].map((j) => corners.reduce((sum, p) => sum + p[j], 0) / 3);
    label(context, String(k + 1), [middle[0], middle[1] + 4], colour("muted"));
  });
  const own = element ? mesh.triangles[element - 1][0] : [];
  for (let n = 1; n <= mesh.count; n += 1) {
    const [x, y] = to(mesh.at(n));
    const ringed = own.includes(n) || linked.includes(n);
    if (!numbered && !ringed) continue;
    const ink = colour(linked.includes(n) ? "accent" : "ink");
    circle(context, [x, y], ringed ? 6 : 2.5, ringed ? { stroke: ink, width: 2.5 } : { fill: ink });
    const up = mesh.contact.includes(n) || y < height / 2 ? -9 : 19;
    label(context, String(n), [x, y + up], ink);
  }
  const fixed = mesh.restrained.flatMap(([x, y], k) => (x || y ? [`${k + 1} (${[x && "x", y && "y"].filter(Boolean).join(", ")})`] : []));
  const restrained = fixed.slice(0, 12).join(", ");
  say("whole-caption", [
    t("Triangles and nodes with their numbers."),
    fixed.length > 12 ? t("Restrained: {restrained} and others.", { restrained }) : t("Restrained: {restrained}.", { restrained }),
    ...(element ? [t("Lit: triangle {element}, which Km adds. Red: the linked nodes of W.", { element })] : []),
  ].join(" "));
  canvas.setAttribute("aria-label", t("The scene: {nodes} nodes, {triangles} triangles", { nodes: mesh.count, triangles: mesh.triangles.length }));
}
