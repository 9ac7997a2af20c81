// MJS as a map of its entries: what is there, the block that is being added, and the block that never is.

/** Whether a listing borders the matrix by equations of contact, as the corrected one does. */
const isBordered = (lines) => lines.some(({ text }) => text.startsWith("MJS[q,v]"));

/** Whether a listing puts a contact node's stiffness at the equations of its target nodes, as the repair of K1 does. */
const isJoined = (lines) => lines.some(({ text }) => text.startsWith("MJS[V[i],W[j]]"));

/** The nodes whose equations the map shows: all of a small scene, else those that the steps write. */
function mappedNodes(mesh, machine) {
  const border = isBordered(machine.lines) ? mesh.contact.length : 0;
  if (mesh.count <= 40) return Array.from({ length: mesh.count + border }, (_, k) => k + 1);
  const found = new Set();
  for (const { writes } of machine.steps) {
    for (const { name } of writes) {
      const place = /^MJS\[(\d+),(\d+)\]$/.exec(name);
      if (place) [place[1], place[2]].forEach((e) => found.add(Math.ceil(Number(e) / 2)));
    }
  }
  return [...found].sort((a, b) => a - b);
}

/** The name of a node in the map; behind the last one stand the equations of contact, p1 those of the first contact node. */
const nodeInMap = (mesh, n) => (n > mesh.count ? `p${n - mesh.count}` : String(n));
const equationInWords = (mesh, e) => t("{axis} of node {n}", { axis: e % 2 ? "x" : "y", n: nodeInMap(mesh, Math.ceil(e / 2)) });

class MatrixMap {
  mesh; machine; border; cell;
  constructor(mesh, machine) {
    Object.assign(this, { mesh, machine, border: isBordered(machine.lines) });
    this.equations = mappedNodes(mesh, machine).flatMap((n) => [2 * n - 1, 2 * n]);
    this.cursor = [0, 0];
    this.joins = this.border || isJoined(machine.lines);
    this.places = new Map(this.equations.map((e, k) => [e, k]));
    this.brought = [];
    const bodies = new Map(mesh.triangles.flatMap(([nodes, body]) => nodes.map((n) => [n, body])));
    this.body = this.equations.map((e) => bodies.get(Math.ceil(e / 2)));
  }

  /** Whether the entry in a row and a column of the map would join the two bodies; those of contact are of both. */
  isJoint(row, column) { return this.body[row] !== this.body[column] && [row, column].every((k) => this.equations[k] <= 2 * this.mesh.count); }

  /** Where the middle of an entry, such as `MJS[3,4]`, is in the window; nothing for one that is not shown. */
  placeOf(name) {
    const [row, column] = name.match(/\d+/g).map((e) => this.places.get(Number(e)));
    const { left, top } = byId("mjs").getBoundingClientRect();
    return row === undefined || column === undefined ? undefined : [left + 22 + (column + 0.5) * this.cell, top + 22 + (row + 0.5) * this.cell];
  }

  entry(i, j) {
    return this.machine.get("MJS") === undefined && this.machine.get(`MJS[${i},${j}]`) === undefined
      ? undefined
      : (this.machine.get(`MJS[${i},${j}]`) ?? 0);
  }

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
    const { context } = prepared(canvas, size, size);
    this.cell = (size - 22) / count;
    context.fillStyle = colour("paper");
    context.fillRect(22, 22, this.cell * count, this.cell * count);
    this.tint("V", "V", "lit");
    if (this.vector("W").length) this.tint("W", "W", "written");
    const written = new Set([...(this.machine.last?.writes ?? []).map(({ name }) => name), ...this.brought.map(({ to }) => to)]);
    const joints = { all: 0, filled: 0 };
    let most = 1;
    for (const i of this.equations) for (const j of this.equations) most = Math.max(most, Math.abs(this.entry(i, j) ?? 0));
    this.equations.forEach((i, row) =>
      this.equations.forEach((j, column) => {
        const value = this.entry(i, j);
        const now = written.has(`MJS[${i},${j}]`);
        if (this.isJoint(row, column)) {
          joints.all += 1;
          joints.filled += value ? 1 : 0;
          context.fillStyle = colour("joint");
          context.fillRect(22 + column * this.cell, 22 + row * this.cell, this.cell, this.cell);
        }
        if (!value && !now) return;
        const weight = value ? 0.25 + 0.75 * Math.max(0, 1 + Math.log10(Math.abs(value) / most) / 6) : 0;
        context.globalAlpha = weight;
        context.fillStyle = colour(value < 0 ? "negative" : "positive");
        context.fillRect(22 + column * this.cell + 0.5, 22 + row * this.cell + 0.5, this.cell - 1, this.cell - 1);
        context.globalAlpha = 1;
        if (now) this.frame(context, row, column, "ink", 3);
        else if (value && this.isJoint(row, column)) this.frame(context, row, column, "ink", 1);
      }),
    );
    if (!this.joins) this.neverAdded(context);
    this.numbers(context);
    if (document.activeElement === canvas) this.frame(context, ...this.cursor, "accent", 2);
    byId("matrix-caption").textContent = [
      t("Blue: above 0, red: below 0, the darker the larger. Yellow: the rows and columns of V; pink: of W."),
      this.border ? t("The rows and columns p1, p2, ... join the two bodies: the equations of contact.") : this.joins ? t("V and W have the equations of the target's nodes in place of the contact node's, as eq. (1) says: their blocks join the two bodies.") : t("Dashed: the block (V, W), which would join the two bodies and is never added (K1)."),
      joints.all ? t("Grey: the entries between the two bodies, {filled} of {all} filled; these are framed.", joints) : "",
    ].join(" ");
    canvas.setAttribute("aria-label", t("MJS, {count} by {count} entries; arrow keys go from entry to entry", { count }));
    this.say();
  }

  /** Tints the block of two vectors' equations. */
  tint(rows, columns, ground) {
    const context = byId("mjs").getContext("2d");
    context.fillStyle = colour(ground);
    for (const i of this.vector(rows)) for (const j of this.vector(columns)) {
      if (!this.places.has(i) || !this.places.has(j)) continue;
      context.fillRect(22 + this.places.get(j) * this.cell, 22 + this.places.get(i) * this.cell, this.cell, this.cell);
    }
  }

  neverAdded(context) {
    for (const [rows, columns] of [["V", "W"], ["W", "V"]]) {
      for (const i of this.vector(rows)) for (const j of this.vector(columns)) {
        if (this.places.has(i) && this.places.has(j)) this.frame(context, this.places.get(i), this.places.get(j), "accent", 1, [2, 2]);
      }
    }
  }

  frame(context, row, column, ink, width, dash = []) {
    context.setLineDash(dash);
    context.lineWidth = width;
    context.strokeStyle = colour(ink);
    context.strokeRect(22 + column * this.cell, 22 + row * this.cell, this.cell, this.cell);
    context.setLineDash([]);
  }

  /** Writes the node's number over each second column and row that has room. */
  numbers(context) {
    const every = Math.ceil(14 / (2 * this.cell));
    context.font = "11px system-ui, sans-serif";
    context.fillStyle = colour("muted");
    this.equations.filter((e) => e % 2 === 1).forEach((e, k) => {
      if (k % every) return;
      const along = 22 + (2 * k + 1) * this.cell;
      context.textAlign = "center";
      const name = nodeInMap(this.mesh, (e + 1) / 2);
      context.fillText(name, along, 14);
      context.textAlign = "right";
      context.fillText(name, 18, along + 4);
    });
  }

  /** Says the entry under the cursor. */
  say() {
    const [i, j] = this.cursor.map((k) => this.equations[k]);
    const value = this.entry(i, j);
    byId("entry").textContent = `MJS[${i},${j}] = ${value === undefined ? t("not there yet") : exact(value)} (${equationInWords(this.mesh, i)}, ${equationInWords(this.mesh, j)})`;
  }

  /** Moves the cursor to a place on the canvas, or by a step. */
  moveTo(row, column) {
    const last = this.equations.length - 1;
    this.cursor = [row, column].map((k) => Math.max(0, Math.min(last, k)));
  }
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
    const by = { ArrowUp: [-1, 0], ArrowDown: [1, 0], ArrowLeft: [0, -1], ArrowRight: [0, 1] }[event.key];
    if (!by) return;
    event.preventDefault();
    event.stopPropagation();
    const [row, column] = map().cursor;
    map().moveTo(row + by[0], column + by[1]);
    map().draw();
  });
  for (const name of ["focus", "blur"]) canvas.addEventListener(name, () => map().draw());
}
