//! Every tolerance of the tests, each with its reason. None stands anywhere else.

/// A limit on an error, relative to the scale that the test names.
pub struct Tolerance {
    pub limit: f64,
    pub reason: &'static str,
}

const fn tolerance(limit: f64, reason: &'static str) -> Tolerance {
    Tolerance { limit, reason }
}

/// Floats of golden files, relative to the largest float of their line.
pub const GOLDEN: Tolerance = tolerance(
    1e-9,
    "the LU library sums in another order on another processor: 1e-16 times a condition number of 1e5 (strand), and two \
     decades of room; integers and statuses are exact",
);

/// Floats of golden files, absolute, in the scene's length unit.
pub const GOLDEN_FLOOR: Tolerance = tolerance(
    1e-13,
    "yt is a difference of coordinates of order 10, each rounded at 2e-15: on the strand it is 0 but for that where a stamp \
     node lies on its target edge",
);

/// `two-blocks` against its closed form, relative to the closed form.
pub const CLOSED_FORM: Tolerance =
    tolerance(1e-12, "some 40 equations of condition 1e2 in f64; the issue's own number");

/// A patch of triangles under constant strain, relative to the strain.
pub const PATCH: Tolerance =
    tolerance(1e-13, "a dozen roundings of 1e-16 each; the issue's own number");

/// B and D of random triangles against their closed form, relative to the largest entry.
pub const ELEMENT: Tolerance =
    tolerance(1e-12, "the area of a random triangle is a difference that may cancel three digits");

/// Strain of a rigid motion, relative to its largest term |B| |u|.
pub const RIGID: Tolerance = tolerance(1e-13, "a sum of six rounded products that cancel");

/// f32 beside f64, relative to the largest entry of the table or matrix.
pub const SINGLE: Tolerance = tolerance(
    2e-6,
    "inputs and a handful of operations rounded at 6e-8 each, sums of six elements",
);

/// f32 beside f64 for yt, relative to the coordinates, which it subtracts.
pub const SINGLE_GAP: Tolerance = tolerance(1e-6, "a difference of coordinates rounded at 6e-8");

/// A scene beside its mirror image, relative to the largest displacement.
pub const MIRRORED: Tolerance =
    tolerance(1e-11, "the same equations in another order: 1e-16 times a condition number of 1e3");

/// Relative residual of a solution.
pub const RESIDUAL: Tolerance =
    tolerance(1e-14, "LU with partial pivoting is backward stable: some eps = 2e-16 with growth");

/// Force that reaches the target against the load, relative to the load.
pub const BALANCE: Tolerance =
    tolerance(1e-10, "a residual of 1e-16 times |K| |u| / |F|, summed over the held nodes");

/// The number of a finding on its own scene, worked out by hand, relative to that number.
pub const FINDING: Tolerance =
    tolerance(1e-12, "a handful of operations, and LU of a few equations, on numbers of order 1");

/// CalculiX beside this program on the same equations, relative to the largest displacement, or von Mises stress.
pub const CCX_PRINTS: Tolerance = tolerance(
    1e-6,
    "ccx prints seven digits: each of two components is rounded by at most 5e-7 of itself, and so is each of the parts of a sum",
);

/// CalculiX's contact pair beside `unilateral`, node to segment, relative to the largest displacement.
pub const PENALTY: Tolerance = tolerance(
    1e-2,
    "bodies penetrate by pressure over penalty, h/(10 E) of the pressure: on two-blocks 3e-6 mm of 4.2e-4 mm",
);

/// The same for the largest von Mises stress of a body, relative to it.
pub const PENALTY_STRESS: Tolerance = tolerance(
    5e-2,
    "ccx pushes along the normal of the target's face, unilateral along one that turns from face to face: 2.3e-2 on the strand, \
     whatever the penalty; the default penalty adds 2e-3",
);

/// Areas and lengths of generated meshes with straight sides, relative to the exact ones.
pub const STRAIGHT: Tolerance =
    tolerance(1e-12, "a sum of some hundred areas or lengths, each a difference of coordinates");

/// Areas and lengths of generated meshes with curved sides, relative to the exact ones.
pub const CHORDS: Tolerance = tolerance(
    0.02,
    "chords of at most 15 degrees cut off 1.2 % of the sector, and half as much again at the ends",
);

/// Lamé: order of convergence, absolute.
pub const LAME_ORDER: Tolerance = tolerance(
    0.06,
    "theory gives 2 in the limit; 1.95, 2.00, 2.01 were measured between 4 and 32 divisions",
);

/// Lamé at 64 divisions through the wall, displacement of the bore, relative to it.
pub const LAME_DISPLACEMENT: Tolerance =
    tolerance(2e-4, "second order: 1.2e-4 was measured, four times that at 32 divisions");

/// Lamé at 64 divisions, hoop stress of the bore, relative to it.
pub const LAME_STRESS: Tolerance = tolerance(
    6e-4,
    "second order by extrapolation: 3.9e-4 was measured, four times that at 32 divisions",
);

/// Kirsch at 64 divisions of the quarter, stress at the hole, relative to each value.
pub const KIRSCH: Tolerance = tolerance(
    4e-3,
    "2.5e-3 and 3.3e-3 were measured; on an axis of symmetry, which the mesh's diagonals do not share, extrapolation is not quite \
     second order",
);

/// Cook: half a unit of the last of the three decimals of the reference numbers, absolute.
pub const COOK: Tolerance =
    tolerance(5.1e-4, "the reference numbers are printed with three decimals");

/// LE1: half a unit of the last of the two decimals of the reference numbers, absolute.
pub const LE1_GRID: Tolerance =
    tolerance(5.1e-3, "the reference numbers are printed with two decimals");

/// LE1 at 64 divisions by extrapolation, relative to 92.7.
pub const LE1_LIMIT: Tolerance = tolerance(
    3e-3,
    "92.7 is rounded at 5e-4; extrapolation on the axis of symmetry leaves 1.4e-3 at 64 divisions, 2.6e-3 at 128",
);

/// Least effectivity, estimated / true error in the energy norm, of the discretisation error bar on smooth fields.
pub const EFFECTIVITY_LOW: Tolerance = tolerance(
    0.8,
    "the issue's own number; 0.88 is measured on the coarsest mesh, 0.97 and more on the finest",
);

/// Largest effectivity.
pub const EFFECTIVITY_HIGH: Tolerance =
    tolerance(1.3, "the issue's own number; below 1 is measured everywhere");

/// Widest bar of a largest von Mises stress, against the true stress error in the triangle that has it.
pub const BAR_WIDTH: Tolerance = tolerance(
    4.0,
    "a safety factor of 2, and as much again for the worst of a dozen neighbours standing in for one triangle",
);

/// Part of the bars of largest von Mises stresses that may miss the truth on random fields and meshes.
pub const BARS_MISSED: Tolerance =
    tolerance(0.03, "1.1 % of 4,000 such cases missed, 512 cases scatter");

/// The same where the estimated relative error in the energy norm is at most 0.2.
pub const BARS_MISSED_ON_FAIR_MESHES: Tolerance =
    tolerance(0.01, "0.13 % of 3,168 such cases missed, by at most 9 %; some 400 cases scatter");

/// Errors of a field that the triangle represents, relative to the field.
pub const CONSTANT_FIELD: Tolerance =
    tolerance(1e-12, "LU of 100 equations of condition 1e3: 1e-16 times it, and a decade of room");

/// A foot, its distance and its normal against the closed form, relative to coordinates of order 1.
pub const FOOT: Tolerance =
    tolerance(1e-14, "a dozen roundings of 1e-16, of turned coordinates too");

/// The contact patch test under mortar, relative to the exact value.
pub const PATCH_TEST: Tolerance =
    tolerance(1e-10, "the issue's own number; measured 1e-14, some 300 equations of condition 1e3");

/// sigma_y / p of the patch test under node to segment, absolute.
pub const KNOWN_NTS: Tolerance = tolerance(1e-4, "the known miss is stated to four digits");

/// Hertz's closed form beside the benchmark's printed numbers, relative.
pub const HERTZ_PRINTED: Tolerance = tolerance(1e-5, "they are printed with five and six digits");

/// Hertz's half width and peak at about 4,000 equations, relative.
pub const HERTZ_COARSE: Tolerance =
    tolerance(1e-2, "the issue's own number; measured 0.2 %, node to segment 0.4 %");

/// The same at about 30,000.
pub const HERTZ_FINE: Tolerance =
    tolerance(5e-3, "the issue's own number; measured 0.1 %, and 0.03 % at a tenth of the load");

/// Known departures of a curved or deformed surface from Hertz's half plane, relative.
pub const KNOWN_CURVATURE: Tolerance =
    tolerance(1e-3, "stated to three decimals, and a mesh error of 5e-4 at 40 and 59 edges");

/// The pressure of a flat punch away from its corner, relative to the closed form.
pub const PUNCH: Tolerance =
    tolerance(1.5e-2, "24 edges on the half width, a boundary at 20: measured 1 %");

/// Gap times force of a contact node relative to size times the largest force; penetration relative to the size.
pub const COMPLEMENTARITY: Tolerance = tolerance(1e-12, "the issue's own number");

/// Contact in the current shape beside contact in the initial one at a load of a thousandth of CGS-1's, relative to the peak.
pub const CURRENT_LENGTHS: Tolerance =
    tolerance(2e-3, "strains of 1e-3 at the contact: the two differ by as much");

/// The sum of normal forces beside the load along y, where the surface slopes a little: relative to the load.
pub const FORCE_OF_A_SLOPE: Tolerance =
    tolerance(1e-4, "the slope of a surface strained by 1e-3, squared, is 1e-6");

/// A displacement in a scene a million of its sizes from the origin, relative to itself.
pub const FAR_FROM_THE_ORIGIN: Tolerance = tolerance(
    1e-6,
    "a coordinate of 3e6 resolves 5e-10; strains, and gaps over displacements of 1e-3, a thousand times less",
);

/// A double-double operation against exact arithmetic, relative to its result.
pub const DOUBLE_DOUBLE: Tolerance = tolerance(
    1.3e-31,
    "the proven errors, in units of u² = 2^-106 = 1.2e-32: sum 3, product 4, quotient 9.8, root of a square 3.125 + 2",
);

/// f32 against exact numbers, displacements relative to the largest.
pub const LADDER_SINGLE: Tolerance =
    tolerance(1e-4, "eps = 6e-8 times a condition number of 1e2 to 1e3 of fig1 and two-blocks");

/// f64 against exact numbers, displacements relative to the largest.
pub const LADDER_DOUBLE: Tolerance =
    tolerance(1e-13, "eps = 1e-16 times a condition number of 1e2 to 1e3 of fig1 and two-blocks");

/// f64x2 against exact numbers, displacements relative to the largest.
pub const LADDER_DOUBLE_DOUBLE: Tolerance = tolerance(
    1e-28,
    "eps = 5e-32, iterations stop at 16 of it, times a condition number of 1e2 to 1e3 of fig1 and two-blocks",
);

/// The bound on an error over the error.
pub const BOUND_WIDTH: Tolerance = tolerance(
    1e3,
    "roundings add up in the bound and cancel in fact; the issue's own number on well-scaled scenes",
);

/// An estimate of a norm that no exact arithmetic would let it pass, relative to the norm.
pub const NORM_ESTIMATE: Tolerance =
    tolerance(1e-10, "estimate and norm are both rounded: 1e-16 times a condition number of 1e4");

/// Widest bar of rounding on a well-scaled scene, against the true error.
pub const BAR_WIDTH_OF_ROUNDING: Tolerance = tolerance(
    1e3,
    "the issue's own number; below half a unit in the last place of the largest displacement the error itself is luck",
);

/// Half a symmetric scene beside the whole, and a refined scene's area and load, relative to the largest.
pub const HALF: Tolerance = tolerance(
    1e-9,
    "the strand's mesh is symmetric within 2e-11 mm of triangles of 0.2 mm; the same equations in another order add 1e-13",
);

/// Lamé: order of convergence in the energy norm, absolute.
pub const LAME_ENERGY_ORDER: Tolerance = tolerance(
    0.15,
    "1 where the solution is smooth; 0.89 was measured: the polygon's corners on the bore are re-entrant and take some of it",
);

/// Asserts |value − expected| ≤ limit · scale, or prints value, expected, error and limit.
#[track_caller]
pub fn assert_near(what: &str, value: f64, expected: f64, scale: f64, tolerance: &Tolerance) {
    let (error, limit) = ((value - expected).abs(), tolerance.limit * scale.abs());
    assert!(
        error <= limit,
        "{what}: value {value:e}, expected {expected:e}, error {error:e}, limit {limit:e} ({})",
        tolerance.reason
    );
}

/// Right digits in a cell of `extremes`.
pub const EXTREME_DIGITS: Tolerance = tolerance(
    2.0,
    "the LU library sums in another order on another processor: an error may be some times larger or smaller by chance, and a digit is cut off",
);

/// The exponent of a breaking point of `extremes`.
pub const EXTREME_DECADES: Tolerance = tolerance(
    2.0,
    "a digit more or less moves the point where three are left by a decade; it is bisected to half of one, and rounded",
);
