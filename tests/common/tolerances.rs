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
