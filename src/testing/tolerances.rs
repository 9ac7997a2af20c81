//! Tolerances that several tests use, each with its reason; one of a single file stands there.

/// A limit on an error, relative to the scale that the test names.
pub struct Tolerance {
    pub limit: f64,
    pub reason: &'static str,
}

/// Makes a constant of each line.
macro_rules! tolerances {
    ($($(#[$doc:meta])+ $name:ident = $limit:literal, $reason:literal;)+) => {
        $($(#[$doc])+ pub const $name: Tolerance = Tolerance { limit: $limit, reason: $reason };)+
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
    /// Floats of golden files, relative to the largest float of their line.
    GOLDEN = 1e-9,
        "the LU library sums in another order on another processor: 1e-16 times a condition \
         number of 1e5 (strand), and two decades of room; integers and statuses are exact";

    /// Floats of golden files, absolute, in the scene's length unit.
    GOLDEN_FLOOR = 1e-13,
        "yt is a difference of coordinates of order 10, each rounded at 2e-15: on the strand it \
         is 0 but for that where a stamp node lies on its target edge";

    /// Displacements of the corrected algorithm beside the reference, relative to the largest.
    CORRECTED = 1e-9,
        "two factorisations of up to 2,300 equations in f64, with multipliers and by elimination: \
         1e-12 on strand; the issue's own number";

    /// Displacements by the stiffness reduced to the surfaces beside those by the whole, over the largest.
    REDUCED = 1e-10,
        "both leave a few epsilons of their residuals, times a condition number of some 1e4";

    /// Displacements by Octave's solver against ours, relative to the largest.
    OCTAVE = 1e-12,
        "two LU factorisations of some 30 equations of condition 1e3 in f64";

    /// B and D of random triangles against their closed form, relative to the largest entry.
    ELEMENT = 1e-12,
        "the area of a random triangle is a difference that may cancel three digits";

    /// Force that reaches the target against the load, relative to the load.
    BALANCE = 1e-10,
        "a residual of 1e-16 times |K| |u| / |F|, summed over the held nodes";

    /// Forces and gaps of an equilibrium in the shape that it reaches, relative to the largest force and to
    /// the size of the scene.
    HARD = 1e-8,
        "the shape may change by 1e-8 of the displacements after contact was measured in it";

    /// Displacements of a scene that is hard to solve in two numberings, over the largest.
    RENUMBERED = 1e-7,
        "thin and loosely held bodies amplify rounding by up to 1e8";

    /// The slip of a pulled strip beside that of a bar, in heights over the length of the slip for its
    /// end, in heights for its edge.
    SHEAR_LAG = 1.2,
        "a strip is no bar over one height, and slip ends at a node";

    /// The zone of stick under partial slip, relative to Cattaneo's and Mindlin's.
    CATTANEO = 0.035,
        "fitted on 15 to 25 nodes; 0.6, 1.4 and 3.3 % measured, 0.2 % with 70 nodes";

    /// How far a sticking node moves on a foundation of a modulus a million times as large.
    DISSIPATION = 1e-5,
        "the foundation yields by its modulus over the strip's";

    /// Displacements under a coefficient of 1000 beside those of nodes that never slide.
    LARGE_FRICTION = 1e-5,
        "what is left of the size of the steps";

    /// Displacements in 16 steps of the load beside those in 32.
    LOAD_STEP = 1e-5,
        "a node that slips and then sticks within a step; 3e-6 measured";

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

    /// A closest point, its distance and its normal against the closed form, relative to
    /// coordinates of order 1.
    CLOSEST_POINT = 1e-14,
        "a dozen roundings of 1e-16, of turned coordinates too";

    /// The contact patch test under mortar, relative to the exact value.
    PATCH_TEST = 1e-10,
        "the issue's own number; measured 1e-14, some 300 equations of condition 1e3";

    /// Hertz's closed form beside the benchmark's printed numbers, relative.
    HERTZ_PRINTED = 1e-5,
        "they are printed with five and six digits";

    /// The pressure of a flat punch away from its corner, relative to the closed form.
    PUNCH = 1.5e-2,
        "24 edges on the half width, a boundary at 20: measured 1 %";

    /// A displacement of one scene written in two ways, over the largest.
    INVARIANCE = 1e-9,
        "a scene a thousand sizes from the origin resolves 1e-13 of its size, and displacements \
         are 1e-4 of it";

    /// Displacements and contact forces of random scenes beside a quadratic programme, over the
    /// largest.
    PROGRAMME = 1e-9,
        "the issue's own number; measured 2e-11 and 6e-11 on scenes whose moduli differ by up to \
         100, where clamped plates have a condition number of 1e6";

    /// The same where a finite coefficient of friction and other rounding lead along another path,
    /// over the largest.
    OTHER_PATH = 2e-2,
        "an exception, not a promise: 1.3e-2 was measured with load in two to four steps";

    /// The distance of a block from the apex that holds it, over the block's size.
    APEX = 1e-9,
        "a gap is closed to 5e-13 of the scene, and the apex may be twenty times the block's size";

    /// f32 against exact numbers, displacements relative to the largest.
    LADDER_SINGLE = 1e-4,
        "eps = 6e-8 times a condition number of 1e2 to 1e3 of fig1 and two-blocks";

    /// f64 against exact numbers, displacements relative to the largest.
    LADDER_DOUBLE = 1e-13,
        "eps = 1e-16 times a condition number of 1e2 to 1e3 of fig1 and two-blocks";

    /// f64x2 against exact numbers, displacements relative to the largest.
    LADDER_DOUBLE_DOUBLE = 1e-28,
        "eps = 5e-32, iterations stop at 16 of it, times a condition number of 1e2 to 1e3 of fig1 \
         and two-blocks";

    /// What rounding is measured to do over what it does.
    MEASURED_ROUNDING = 1e3,
        "an error may be small by chance, where the changed last digits all add up";

    /// An estimate of a norm that no exact arithmetic would let it pass, relative to the norm.
    NORM_ESTIMATE = 1e-10,
        "estimate and norm are both rounded: 1e-16 times a condition number of 1e4";
}
