// The worksheet of a run: the tables that the paper has above its listings, made of the mesh.

const words = (text) => new Set(text.split(/\s+/).filter(Boolean));
const KNOWN = { functions: words(data.known.functions), units: words(data.known.units) };

/** The tables of a mesh (listings/READING.md, section 8); `at(n)` is where node n stands. */
function tablesOf({ z, thickness, elem, E, ν, triangles, contact, edges, restrained, nodes }, at, c_tll) {
  const corners = triangles.map(([own]) => own.map(at));
  const column = (list) => list.map((x) => [x]);
  return {
    node: nodes.map((_, k) => [k + 1, ...at(k + 1), z]),
    elem,
    EL: elem.filter(([, kind]) => kind === 2),
    trg: column(edges.map(([number]) => number)),
    cnt: column(contact),
    c_tll,
    ind_1: 6,
    R: nodes.length,
    M: triangles.length,
    S: column(restrained.flat().map(Number)),
    Ae: column(corners.map((p) => areaOf(p) * thickness)),
    B: column(corners.map(strainMatrix)),
    E: column(E),
    ν: column(ν),
  };
}

/** The signed area of a triangle: negative where its corners run clockwise. */
const areaOf = ([a, b, c]) => ((b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1])) / 2;

/** The strain matrix of a triangle: strains = B · displacements. */
function strainMatrix(p) {
  const doubleArea = areaOf(p) + areaOf(p);
  const B = [Array(6).fill(0), Array(6).fill(0), Array(6).fill(0)];
  for (let k = 0; k < 3; k += 1) {
    const [next, last] = [p[(k + 1) % 3], p[(k + 2) % 3]];
    const [dx, dy] = [(next[1] - last[1]) / doubleArea, (last[0] - next[0]) / doubleArea];
    B[0][2 * k] = B[2][2 * k + 1] = dx;
    B[1][2 * k + 1] = B[2][2 * k] = dy;
  }
  return B;
}

/** What a page shows at most: the statements of a listing. */
const MOST_SHOWN = { ...LIMITS, steps: 4_000_000, kept: 20_000, entries: 1 << 23 };

/** Keeps the statements of the turns that are shown: over the contact nodes, or over the elements, of which
 * there are `count`; an edited loop may pass them by. */
class TurnRecorder extends Recorder {
  name; turns; count; turn;
  constructor({ name, lines }, turns, count) {
    super(lines);
    Object.assign(this, { name, turns, count, turn: null });
  }

  begin(line) {
    this.finish();
    super.begin(line);
  }

  /** Gives the statement that is done the turn that it begins or belongs to. */
  finish() {
    const done = this.steps.at(-1);
    if (!done || done.turn !== undefined) return;
    const { text } = this.lines[done.line];
    const [range, begun] = [text.startsWith("for ") ? text.slice(4) : "", done.writes[0]?.value];
    const isOuter = this.name === "Km" ? range.startsWith("n ") : range.startsWith("i1 ") && range.includes("rows(cnt)");
    if (isOuter && isNumber(begun)) this.turn = Number.isInteger(begun) && begun >= 1 && begun <= this.count ? begun : null;
    else if (this.name === "c_cnt" ? range.startsWith("i1 ") : range && this.lines[done.line].level === 1) this.turn = null;
    done.turn = this.turn;
    if (this.turns && !this.turns.has(this.turn)) this.steps.pop();
  }
}

/** The lines of the listing at a place, as given or as edited. */
function linesAt(place, edits = new Map()) {
  if (edits.has(place)) return linesOf(edits.get(place));
  return data.listings[place].map((line) => data.lines[line]).map(([number, inFile, level, text]) => ({ number, inFile, level, text }));
}

/** The listings that were read, by their lines: to read one takes as long as to execute it. */
const READ = new Map();
function listingOf(name, lines) {
  const key = JSON.stringify(lines);
  if (!READ.has(key)) READ.set(key, readListing(name, lines));
  return READ.get(key);
}

/** The two listings of a run, each executed when it is first asked for; `edits` has the texts of those that are
 * edited, by their place. */
class Programs {
  run; mesh; shown; c_tll; edits; done;
  constructor(run, mesh, shown, c_tll = run.c_tll, edits = new Map()) {
    Object.assign(this, { run, mesh, shown, c_tll, edits, done: new Map() });
    this.worksheet = worksheetOf(tablesOf(mesh.own, mesh.stands, c_tll), run.plane, KNOWN);
    if (run.programs) this.worksheet.values.set("both", 0);
  }

  /** `c_cnt` on the initial shape; nothing without contact. */
  get c_cnt() { return this.mesh.contact.length ? this.program("c_cnt", () => this.firstCall()) : null; }

  /** What the iterations give `c_cnt` first: the nodes; in the corrected programs also forces that press, and the normals. */
  firstCall() {
    const [node, { programs, settings }] = [this.worksheet.values.get("node"), this.run];
    if (!programs) return [node];
    // Where the normals stop, c_cnt stops without them.
    const { value = 0 } = executed(listingOf("normals", linesAt(programs.normals)), this.worksheet, settings, [node], MOST_SHOWN, null);
    return [node, share(gridFrom(this.mesh.contact.length, 1, () => 1)), share(value)];
  }

  /** `Km` on the pairs that `c_cnt` found; nothing where that stopped. */
  get Km() {
    if (this.c_cnt?.failure) return null;
    return this.program("Km", () => [this.c_cnt?.value ?? share(gridFrom(this.mesh.count, 4, () => 0))]);
  }

  program(name, values) {
    if (this.done.has(name)) return this.done.get(name);
    const lines = linesAt(this.run[name], this.edits);
    const listing = listingOf(name, lines);
    const nodesOf = name === "Km" ? this.mesh.triangles.map(([nodes]) => nodes) : this.mesh.contact.map((n) => [n]);
    const turns = nodesOf.flatMap((nodes, k) => (nodes.some((n) => this.shown.includes(n)) ? [k + 1] : []));
    const recorder = new TurnRecorder(listing, this.shown.length ? new Set(turns) : null, nodesOf.length);
    const done = executed(listing, this.worksheet, this.run.settings, values(), MOST_SHOWN, recorder);
    recorder.finish();
    this.done.set(name, { ...done, name, lines, failure: done.failure ?? unexpected(listing, done) });
    return this.done.get(name);
  }
}
