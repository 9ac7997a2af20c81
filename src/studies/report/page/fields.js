// The fields of the runs: what is stored as bytes, opened when it is first shown.

/** The numbers that a text in base64 holds. */
function numbers(Kind, text) {
  const bytes = /** @type {any} */ (Uint8Array).fromBase64?.(text) ?? Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
  return new Kind(bytes.buffer);
}

const mesh = {
  at: numbers(Float32Array, data.mesh.nodes),
  triangles: numbers(Uint32Array, data.mesh.triangles),
  body: numbers(Uint8Array, data.mesh.body),
};
mesh.nodes = mesh.at.length / 2;
mesh.count = mesh.triangles.length / 3;

/** What can be shown: its name, its unit, and where its values are: a component of a quantity of the
 * triangles, what is taken of a node's displacement, or what is known of a contact node. */
const FIELDS = [
  ...data.quantities.triangle.flatMap((quantity) => componentsOf(quantity).map((name, component, { length }) => (
    { name, unit: quantity.unit, triangle: quantity.name, component, components: length }))),
  { name: t("displacement {component}", { component: "|u|" }), unit: "length", of: Math.hypot },
  { name: t("displacement {component}", { component: "ux" }), unit: "length", of: (x) => x },
  { name: t("displacement {component}", { component: "uy" }), unit: "length", of: (x, y) => y },
  ...data.quantities.contact.filter(({ unit }) => unit).map(({ name, title, unit }) => ({ name: title, unit, contact: name })),
];

/** The names of the components of a quantity; its title where it has only one. */
function componentsOf({ title, symbols }) { return symbols.length > 1 ? symbols.map((symbol) => `${title} ${symbol}`) : [title]; }

const unitOf = (field) => (field.unit ? (data.units[field.unit] ?? "") : "");

/** A number of a field in words, with its unit where it has one. */
const inUnit = (text, field) => [text, unitOf(field)].filter(Boolean).join(" ");

/** The runs that have fields. */
const shownRuns = data.runs.filter((run) => run.u !== undefined);

/** The displacements of a run at its end. */
const displacements = (run) => (run.opened ??= numbers(Float32Array, run.u));

/** The numbers of which a text in base64 holds the first 24 bits each. */
function firstBits(text) {
  const kept = numbers(Uint8Array, text);
  const whole = new Uint8Array((kept.length / 3) * 4);
  for (let k = 0; k < kept.length; k += 1) whole[k + Math.floor(k / 3) + 1] = kept[k];
  return new Float32Array(whole.buffer);
}

/** The values of a field by triangle; null where they are not known. */
function valuesOf(run, field) {
  if (field.contact) return null;
  if (field.of) return ofTriangles(displacements(run), field.of);
  const { triangle, component, components } = field;
  if (!run.triangles[triangle]) return null;
  const all = ((run.opened_triangles ??= {})[triangle] ??= firstBits(run.triangles[triangle]));
  return all.filter((_, k) => k % components === component);
}

/** The mean over each triangle's nodes of what `of` takes of a displacement. */
function ofTriangles(u, of) {
  const { triangles } = mesh;
  const at = Float32Array.from({ length: mesh.nodes }, (_, n) => of(u[2 * n], u[2 * n + 1]));
  const mean = (_, t) => (at[triangles[3 * t]] + at[triangles[3 * t + 1]] + at[triangles[3 * t + 2]]) / 3;
  return new Float32Array(mesh.count).map(mean);
}

/** The values of a field at contact nodes, by node from 0, in order along the surface; null where
 * they are not known. */
function marksOf(run, field) {
  if (!field.contact) return null;
  const known = (run.result?.contact ?? []).map((node) => [node.node - 1, node[field.contact]]);
  const marks = new Map(known.filter(([, value]) => typeof value === "number"));
  return marks.size > 0 ? marks : null;
}

/** The nodes' places under displacements drawn `factor` times. */
function placesOf(run, factor) {
  if (factor === 0) return mesh.at;
  const u = displacements(run);
  return mesh.at.map((x, j) => x + factor * u[j]);
}

/** The triangle that a point is in, from 0; −1 outside. */
function triangleAt(places, x, y) {
  const { triangles } = mesh;
  for (let t = 0; t < mesh.count; t += 1) {
    const [a, b, c] = [2 * triangles[3 * t], 2 * triangles[3 * t + 1], 2 * triangles[3 * t + 2]];
    const side = (p, q) => (places[q] - places[p]) * (y - places[p + 1]) - (places[q + 1] - places[p + 1]) * (x - places[p]);
    const [d, e, f] = [side(a, b), side(b, c), side(c, a)];
    if ((d >= 0 && e >= 0 && f >= 0) || (d <= 0 && e <= 0 && f <= 0)) return t;
  }
  return -1;
}
