//! Tolerances that several tests use, each with its reason; one of a single file stands there.

/// A limit on an error, relative to the scale that the test names.
pub struct Tolerance {
    pub limit: f64,
    pub reason: &'static str,
}

/// Makes a constant of each line.
#[macro_export]
macro_rules! tolerances {
    ($($(#[$doc:meta])* $name:ident = $limit:expr, $reason:literal;)+) => {
        $($(#[$doc])*
        pub const $name: $crate::tolerances::Tolerance =
            $crate::tolerances::Tolerance { limit: $limit, reason: $reason };)+
    };
}

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

tolerances! {
    /// Displacements of the corrected algorithm beside the reference, relative to the largest.
    CORRECTED = 1e-9,
        "two factorisations of up to 2,300 equations in f64, with multipliers and by elimination: \
         1e-12 on strand; the issue's own number";

    /// Displacements by Octave's solver against ours, relative to the largest.
    OCTAVE = 1e-12,
        "two LU factorisations of some 30 equations of condition 1e3 in f64";

    /// B and D of random triangles against their closed form, relative to the largest entry.
    ELEMENT = 1e-12,
        "the area of a random triangle is a difference that may cancel three digits";

    /// Force that reaches the target against the load, relative to the load.
    BALANCE = 1e-10,
        "a residual of 1e-16 times |K| |u| / |F|, summed over the held nodes";

    /// The number of a claim beside the one that its command prints, relative to that.
    CLAIM = 1e-9,
        "1e-13 of the largest displacement by either solver, over a change of a thousandth of it";

    /// Areas and lengths of generated meshes with straight sides, relative to the exact ones.
    STRAIGHT = 1e-12,
        "a sum of some hundred areas or lengths, each a difference of coordinates";

    /// Kirsch at 64 divisions of the quarter, stress at the hole, relative to each value.
    KIRSCH = 4e-3,
        "2.5e-3 and 3.3e-3 were measured; on an axis of symmetry, which the mesh's diagonals do \
         not share, extrapolation is not quite second order";

    /// Errors of a field that the triangle represents, relative to the field.
    CONSTANT_FIELD = 1e-12,
        "LU of 100 equations of condition 1e3: 1e-16 times it, and a decade of room";

    /// The contact patch test under mortar, relative to the exact value.
    PATCH_TEST = 1e-10,
        "the issue's own number; measured 1e-14, some 300 equations of condition 1e3";

    /// Hertz's closed form beside the benchmark's printed numbers, relative.
    HERTZ_PRINTED = 1e-5,
        "they are printed with five and six digits";

    /// A displacement of one scene written in two ways, over the largest.
    INVARIANCE = 1e-9,
        "a scene a thousand sizes from the origin resolves 1e-13 of its size, and displacements \
         are 1e-4 of it";
}
