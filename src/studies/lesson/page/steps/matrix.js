// MJS as a map of its entries: what is there, the block that is being added, and the block that never is.

/** Whether a listing borders the matrix by equations of contact, as the corrected one does. */
const isBordered = (lines) => lines.some(({ text }) => text.startsWith("MJS[q,v]"));

/** Whether a listing puts a contact node's stiffness at the equations of its target nodes, as the repair of K1 does. */
const isJoined = (lines) => lines.some(({ text }) => text.startsWith("MJS[V[i],W[j]]"));

/** The nodes whose equations the map shows: all of a small scene, else those that the steps write. */
function mappedNodes(mesh, machine) {
  const border = isBordered(machine.lines) ? mesh.contact.length : 0;
  if (mesh.count <= 40) return Array.from({ length: mesh.count + border }, (_, k) => k + 1);
  const names = machine.steps.flatMap(({ writes }) => writes.map(({ name }) => name)).filter((name) => name.startsWith("MJS["));
  const nodes = names.flatMap((name) => name.match(/\d+/g).map((e) => Math.ceil(Number(e) / 2)));
  return [...new Set(nodes)].sort((a, b) => a - b);
}

/** The name of a node in the map; behind the last one stand the equations of contact, p1 those of the first contact node. */
const nodeInMap = (mesh, n) => (n > mesh.count ? `p${n - mesh.count}` : String(n));
const equationInWords = (mesh, e) => t("{axis} of node {n}", { axis: e % 2 ? "x" : "y", n: nodeInMap(mesh, Math.ceil(e / 2)) });

/** What the steps from `from` on brought into MJS of the last element: each entry with its cell of K. */
function broughtIn(machine, from) {
  const brought = machine.steps.slice(from, machine.at).flatMap(({ turn, all, writes }) => {
    const [source, place] = [all.find(({ name }) => name === "K"), writes.find(({ name }) => name.startsWith("MJS["))];
    return source && place ? [{ turn, from: `K[${source.subscripts}]`, to: place.name }] : [];
  });
  return brought.filter(({ turn }) => turn === brought.at(-1).turn);
}

class MatrixMap {
  mesh; machine; atStake; border; cell; context; brought; cursor;
  /** `atStake` has the names of the entries that the chapter's repair changes. */
  constructor(mesh, machine, atStake) {
    Object.assign(this, { mesh, machine, atStake, border: isBordered(machine.lines), cursor: [0, 0], brought: [] });
    this.equations = mappedNodes(mesh, machine).flatMap((n) => [2 * n - 1, 2 * n]);
    this.joins = this.border || isJoined(machine.lines);
    this.places = new Map(this.equations.map((e, k) => [e, k]));
    const bodies = new Map(mesh.triangles.flatMap(([nodes, body]) => nodes.map((n) => [n, body])));
    this.body = this.equations.map((e) => bodies.get(Math.ceil(e / 2)));
  }

  /** Whether the entry in a row and a column of the map would join the two bodies; those of contact are of both. */
  isJoint(row, column) { return this.body[row] !== this.body[column] && [row, column].every((k) => this.equations[k] <= 2 * this.mesh.count); }

  entry(i, j) { return this.machine.get(`MJS[${i},${j}]`) ?? (this.machine.get("MJS") === undefined ? undefined : 0); }

  /** The equations of a vector; W of the corrected listing has nodes. */
  vector(name) {
    const entries = [1, 2, 3, 4, 5, 6].map((k) => this.machine.get(`${name}[${k}]`)).filter((e) => e > 0);
    return this.border && name === "W" ? entries.flatMap((n) => [2 * n - 1, 2 * n]) : entries;
  }

  draw() {
    const canvas = byId("mjs");
    const count = this.equations.length;
    const size = Math.min(canvas.parentElement.clientWidth, 460, Math.max(240, 0.32 * window.innerHeight));
    canvas.style.maxWidth = size + "px";
    this.context = prepared(canvas, size, size).context;
    this.cell = (size - 22) / count;
    const [low, high] = [22, 22 + this.cell * count];
    path(this.context, [[low, low], [high, low], [high, high], [low, high]], { fill: colour("paper") });
    const [V, W] = [this.vector("V"), this.vector("W")];
    this.block(V, V, (row, column) => this.square(row, column, "lit"));
    this.block(W, W, (row, column) => this.square(row, column, "written"));
    const written = new Set([...(this.machine.last?.writes ?? []).map(({ name }) => name), ...this.brought.map(({ to }) => to)]);
    const joints = { all: 0, filled: 0, atStake: 0 };
    const most = Math.max(1, ...this.equations.flatMap((i) => this.equations.map((j) => Math.abs(this.entry(i, j) ?? 0))));
    this.block(this.equations, this.equations, (row, column, name, value) => {
      const [now, isJoint] = [written.has(name), this.isJoint(row, column)];
      if (isJoint) {
        joints.all += 1;
        joints.filled += value ? 1 : 0;
        this.square(row, column, "joint");
      }
      // The darker the larger, by powers of ten.
      if (value) this.square(row, column, value < 0 ? "negative" : "positive", 0.25 + 0.75 * Math.max(0, 1 + Math.log10(Math.abs(value) / most) / 6));
      if (now || (value && isJoint)) this.frame(row, column, "ink", now ? 3 : 1);
      if (!isJoint || !this.atStake.has(name)) return;
      joints.atStake += 1;
      this.frame(row, column, "accent", 2);
    });
    if (!this.joins) for (const [rows, columns] of [[V, W], [W, V]]) this.block(rows, columns, (row, column) => this.frame(row, column, "accent", 1, [2, 2]));
    this.numbers();
    if (document.activeElement === canvas) this.frame(...this.cursor, "accent", 2);
    byId("matrix-caption").textContent = [
      t("Blue: above 0, red: below 0, the darker the larger. Yellow: the rows and columns of V; pink: of W."),
      this.border ? t("The rows and columns p1, p2, ... join the two bodies: the equations of contact.") : this.joins ? t("V and W have the equations of the target's nodes in place of the contact node's, as eq. (1) says: their blocks join the two bodies.") : t("Dashed: the block (V, W), which would join the two bodies and is never added (K1)."),
      joints.all ? t("Grey: the entries between the two bodies, {filled} of {all} filled; these are framed.", joints) : "",
      joints.atStake ? t("Framed red: the {atStake} entries at stake, which join the bodies once Km is repaired.", joints) : "",
    ].join(" ");
    canvas.setAttribute("aria-label", t("MJS, {count} by {count} entries; arrow keys go from entry to entry", { count }));
    this.say();
  }

  /** Does something with each entry in the rows and columns of two lists of equations that the map shows. */
  block(rows, columns, act) {
    for (const i of rows) for (const j of columns) {
      const [row, column] = [this.places.get(i), this.places.get(j)];
      if (row !== undefined && column !== undefined) act(row, column, `MJS[${i},${j}]`, this.entry(i, j));
    }
  }

  square(row, column, ink, alpha = 1) { path(this.context, this.corners(row, column), { fill: colour(ink), alpha }); }

  frame(row, column, ink, width, dash = []) { path(this.context, this.corners(row, column), { stroke: colour(ink), width, dash, close: true }); }

  /** The corners of an entry's square. */
  corners(row, column) {
    const [left, top] = [column, row].map((k) => 22 + k * this.cell);
    return [[left, top], [left + this.cell, top], [left + this.cell, top + this.cell], [left, top + this.cell]];
  }

  /** Writes the node's number over each second column and row that has room. */
  numbers() {
    const every = Math.ceil(14 / (2 * this.cell));
    this.context.font = "11px system-ui, sans-serif";
    this.context.fillStyle = colour("muted");
    this.equations.filter((e) => e % 2 === 1).forEach((e, k) => {
      if (k % every) return;
      const along = 22 + (2 * k + 1) * this.cell;
      const name = nodeInMap(this.mesh, (e + 1) / 2);
      this.context.textAlign = "center";
      this.context.fillText(name, along, 14);
      this.context.textAlign = "right";
      this.context.fillText(name, 18, along + 4);
    });
  }

  /** Says the entry under the cursor. */
  say() {
    const [i, j] = this.cursor.map((k) => this.equations[k]);
    const value = this.entry(i, j);
    byId("entry").textContent = `MJS[${i},${j}] = ${value === undefined ? t("not there yet") : exact(value)} (${equationInWords(this.mesh, i)}, ${equationInWords(this.mesh, j)})`;
  }

  /** Moves the cursor to a place on the canvas, or by a step. */
  moveTo(row, column) { this.cursor = [row, column].map((k) => Math.max(0, Math.min(this.equations.length - 1, k))); }
}

/** The way of an arrow key, right and down, which is then taken; nothing of another key. */
function byArrow(event) {
  const by = ARROWS[event.key];
  if (!by) return null;
  event.preventDefault();
  event.stopPropagation();
  return by;
}

/** Lets the pointer and the arrow keys choose an entry of the map that `map()` returns. */
function watchMatrix(map) {
  const canvas = byId("mjs");
  canvas.addEventListener("pointermove", (event) => {
    const place = [event.offsetY, event.offsetX].map((at) => Math.floor((at - 22) / map().cell));
    map().moveTo(...place);
    map().say();
  });
  canvas.addEventListener("keydown", (event) => {
    const by = byArrow(event);
    if (!by) return;
    const [row, column] = map().cursor;
    map().moveTo(row + by[1], column + by[0]);
    map().draw();
  });
  for (const name of ["focus", "blur"]) canvas.addEventListener(name, () => map().draw());
}
