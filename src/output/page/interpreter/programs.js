// The paper's two listings and the worksheet around them.

/** `D`, which the paper does not print: the elasticity matrix of a plane problem, "stress" or "strain". */
const elasticity = (plane) => (values) => {
  const [e, nu] = values;
  if (values.length !== 2 || !values.every(isNumber)) throw new Cause("D: D takes an elastic modulus and a Poisson's ratio.");
  const isStrain = plane === "strain";
  const factor = isStrain ? e / ((1 + nu) * (1 - 2 * nu)) : e / (1 - nu * nu);
  const [diagonal, shear] = isStrain ? [1 - nu, (1 - 2 * nu) / 2] : [1, (1 - nu) / 2];
  return new Grid(3, 3, [factor * diagonal, factor * nu, 0, factor * nu, factor * diagonal, 0, 0, 0, factor * shear]);
};

/** The worksheet above the listings: its tables by name, and Mathcad's names that nothing here defines. */
function worksheetOf(tables, plane, known) {
  const values = new Map(Object.entries(tables).map(([name, json]) => [name, valueOf(json)]));
  // ν, where a listing is typed in ASCII.
  values.set("nu", values.get("ν"));
  return { values, programs: new Map(), functions: new Map([["D", elasticity(plane)]]), known };
}

/** Executes a listing on its argument. Returns its steps (none without a recorder), its output, its value and
 * the values of the names that it wrote, or the failure that stopped it. @returns {any} */
function executed(listing, worksheet, settings, values, limits = LIMITS, recorder = new Recorder(listing.lines)) {
  const run = new Run(listing, worksheet, settings, { recorder, limits });
  const done = { steps: recorder?.steps, output: run.output, locals: run.values, failure: null };
  try {
    return { ...done, value: run.execute(values) };
  } catch (failure) {
    if (!(failure instanceof Failure)) throw failure;
    return { ...done, failure };
  }
}

/** Checks that a listing ended with what the paper's has: of `c_cnt` the columns ct, yt and dy, and an array
 * as its value; returns the failure of one that did not. */
function unexpected(listing, { value, locals }) {
  const failure = (expected, name) => {
    const cause = new Cause(`Expected ${expected}, found something else in ${name}.`);
    return Object.assign(new Failure(listing.name, listing.lines.at(-1), { start: 0, end: 0 }, cause), { text: name });
  };
  const names = listing.name === "c_cnt" ? ["ct", "yt", "dy"] : [];
  for (const name of names) {
    const column = locals.get(name);
    if (!isArrayOfNumbers(column) || column.cols !== 1) return failure("a column", name);
    if (name !== "yt" && column.entries.some((x) => x < 0 || !Number.isInteger(x))) return failure("whole numbers", name);
  }
  return isArrayOfNumbers(value) ? null : failure("an array", "value of the program");
}
