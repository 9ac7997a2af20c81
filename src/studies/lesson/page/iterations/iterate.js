// The whole algorithm on a small scene: what stands around the listings in the paper's variants
// (src/engine/published.rs), and the corrected programs (listings/corrected). Each run gives its states: the
// contact nodes in contact, and the displacements, x and y of each node in turn.

const ITERATIONS = 20;

/** The paper's variants, and the corrected algorithm. */
const VARIANTS = ["printed", "tied", "stepped", "corrected"];

/** Runs a listing without a record; returns its value and its names. Throws a Failure. */
function called(listing, worksheet, settings, value) {
  const done = executed(listing, worksheet, settings, [value], MOST_SHOWN, null);
  const failure = done.failure ?? unexpected(listing, done);
  if (failure) throw failure;
  return done;
}

/** The solution of a system; one whose pivot is rounding beside its column is singular, as src/engine/linear/dense.rs has it. */
function solved(matrix, f) {
  const n = matrix.rows;
  const eliminated = factors(matrix);
  const isLost = (row, k) => {
    let largest = 0;
    for (let at = 0; at < n; at += 1) largest = Math.max(largest, Math.abs(matrix.entries[at * n + k]));
    return !(Math.abs(row[k]) > 16 * n * Number.EPSILON * largest);
  };
  if (eliminated.rows.some(isLost)) throw new Cause("The matrix is singular.");
  return substituted(eliminated, new Grid(n, 1, f)).entries;
}

/** The displacements T·q of a matrix that has eq. (1) in it. */
function underEquation(matrix, rows, load) {
  const f = load.map(() => 0);
  rows.forEach((row, i) => row.forEach(([p, weight]) => (f[p] += weight * load[i])));
  const q = solved(matrix, f);
  return rows.map((row) => row.reduce((sum, [p, weight]) => sum + weight * q[p], 0));
}

/** A scene's equations under a run's listings, which are given as read; `at(n)` is where node n stands. */
class Equations {
  listings; settings; own; plane; readsRestraintOfY; stiffness;
  constructor({ plane, settings, readsRestraintOfY }, listings, own, at, c_tll) {
    Object.assign(this, { listings, settings, own, plane, readsRestraintOfY });
    this.tables = (own) => worksheetOf(tablesOf(own, at, c_tll), plane, KNOWN);
    this.worksheet = this.tables(own);
    this.count = own.nodes.length;
    this.restrained = own.restrained.flat();
  }

  /** The matrix of Km without contact and without restraints. */
  get K() {
    if (this.stiffness) return this.stiffness;
    const free = this.tables({ ...this.own, restrained: this.own.nodes.map(() => [false, false]) });
    this.stiffness = called(this.listings.Km, free, this.settings, gridFrom(this.count, 4, () => 0)).value;
    return this.stiffness;
  }

  /** What c_cnt finds in the shape that is displaced by `u`: k_cnt, and the contact nodes in contact, each once. */
  pairs(u) {
    const node_n = this.worksheet.values.get("node").copy();
    u.forEach((x, e) => (node_n.entries[Math.floor(e / 2) * 4 + 1 + (e % 2)] += x));
    const { value, locals } = called(this.listings.c_cnt, this.worksheet, this.settings, share(node_n));
    const dy = locals.get("dy").entries;
    return { k_cnt: value, inContact: [...new Set(this.own.contact.filter((_, k) => dy[k] === 1))] };
  }

  /** The displacements under MJS as Km gives it; a node without triangles stays where it is. Where MJS has no entry at the
   * equations of the nodes in contact, eq. (1) is in it, and then in the load and in the displacements too. */
  printed({ k_cnt, inContact }, load) {
    const matrix = called(this.listings.Km, this.worksheet, this.settings, k_cnt).value.copy();
    for (const n of this.own.dropped) for (const e of [2 * n - 2, 2 * n - 1]) matrix.write(e, e, 1);
    const bound = inContact.flatMap((n) => [2 * n - 2, 2 * n - 1]).filter((e) => !this.restrained[e]);
    // Left without an entry, an equation has the 1 of line 13; one that has its own stiffness may lack others as printed too.
    const isEmpty = (e) => matrix.get(e, e) === 1 && load.every((_, j) => e === j || (matrix.get(e, j) === 0 && matrix.get(j, e) === 0));
    if (bound.every(isEmpty) && bound.some((e) => this.K.get(e, e) !== 1)) return underEquation(matrix, this.elimination(k_cnt, inContact), load);
    // Under reading R2 = printed, Km takes the restraint of y for that of x.
    const held = (e) => this.restrained[this.readsRestraintOfY ? e | 1 : e];
    return solved(matrix, load.map((f, e) => (held(e) ? 0 : f)));
  }

  /** The displacements under eq. (1), by elimination: u = T·q, Tᵀ·K·T·q = Tᵀ·f. */
  tied({ k_cnt, inContact }, load) {
    const rows = this.elimination(k_cnt, inContact);
    const matrix = gridFrom(rows.length, rows.length, () => 0);
    rows.forEach((row, i) => rows.forEach((column, j) => {
      const entry = this.K.get(i, j);
      if (entry !== 0) for (const [p, a] of row) for (const [q, b] of column) matrix.entries[p * rows.length + q] += a * entry * b;
    }));
    rows.forEach((row, e) => row[0]?.[0] !== e && matrix.write(e, e, 1));
    return underEquation(matrix, rows, load);
  }

  /** The rows of T, each its equations that remain with their weights: none of what is restrained. */
  elimination(k_cnt, inContact) {
    const isBound = (e) => this.restrained[e] || inContact.includes(Math.floor(e / 2) + 1);
    const rows = this.restrained.map((_, e) => (isBound(e) ? [] : [[e, 1]]));
    for (const n of inContact) {
      const [a, ka, b, kb] = [0, 1, 2, 3].map((j) => k_cnt.get(n - 1, j));
      for (const d of [-2, -1].filter((d) => !this.restrained[2 * n + d])) {
        rows[2 * n + d] = [[a, ka], [b, kb]].flatMap(([m, k]) => {
          if (!rows[2 * m + d]) throw new Cause(`k_cnt[${n}] names node ${inDigits(m)}, which is not there.`);
          return rows[2 * m + d].map(([p, weight]) => [p, k * weight]);
        });
      }
    }
    return rows;
  }

  /** The iterations of one of the paper's variants: each searches in the shape so far, then solves. */
  *published(variant) {
    const share = variant === "stepped" ? ITERATIONS : 1;
    const load = this.own.load.map((f) => f / share);
    // A contact state that returns has the same solution: on fig1 `printed` takes a tenth of the time.
    const known = new Map();
    let u = load.map(() => 0);
    for (let k = 1; k <= ITERATIONS; k += 1) {
      const pairs = this.pairs(u);
      const state = pairs.k_cnt.entries.join();
      if (!known.has(state)) known.set(state, variant === "printed" ? this.printed(pairs, load) : this.tied(pairs, load));
      const change = known.get(state);
      u = variant === "stepped" ? u.map((x, e) => x + change[e]) : change;
      yield { inContact: pairs.inContact, u };
    }
  }

  /** The iterations of the corrected programs, which end once the contact state is settled. */
  *corrected({ programs, settings }) {
    const { values, functions } = this.worksheet;
    const worksheet = { values: new Map(values).set("F", valueOf(this.own.load.map((f) => [f]))).set("both", 0), programs, functions, known: KNOWN };
    const done = executed(programs.get("iterate"), worksheet, settings, [ITERATIONS], MOST_SHOWN);
    let pairs;
    for (const { name, subscripts, value } of done.steps.flatMap(({ writes }) => writes)) {
      if (name === "k_cnt") pairs = value;
      if (name !== "U" || subscripts.length) continue;
      yield { inContact: this.own.contact.filter((n) => pairs.get(n - 1, 0) > 0), u: value.entries.slice(0, 2 * this.count) };
    }
    if (done.failure) throw done.failure;
  }
}

/** The states of a variant, and why it stopped before its end, if it did. */
function iterated(equations, variant, corrected) {
  const states = [];
  try {
    for (const state of variant === "corrected" ? equations.corrected(corrected) : equations.published(variant)) states.push(state);
    return { states, failure: null };
  } catch (failure) {
    if (!(failure instanceof Cause || failure instanceof Failure)) throw failure;
    return { states, failure: failure instanceof Cause ? failure.words : String(failure) };
  }
}

/** The energy norm √(uᵀ·K·u). */
function energyNorm(K, u) {
  const force = (i) => u.reduce((sum, x, j) => sum + K.entries[i * u.length + j] * x, 0);
  return Math.sqrt(Math.max(0, u.reduce((sum, x, i) => sum + x * force(i), 0)));
}

/** After how many iterations the contact state returns at the end: 1 where it is settled; nothing where it
 * does not, or not yet twice. */
function periodOf(states) {
  const names = states.map(({ inContact }) => inContact.join());
  const last = names.length - 1;
  for (let period = 1; 2 * period <= names.length; period += 1) {
    const again = Array.from({ length: period }, (_, k) => names[last - k] === names[last - k - period]);
    if (again.every(Boolean)) return period;
  }
  return null;
}
