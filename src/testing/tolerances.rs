//! Every tolerance of the tests, each with its reason. None stands anywhere else.

/// A limit on an error, relative to the scale that the test names.
pub struct Tolerance {
    pub limit: f64,
    pub reason: &'static str,
}

/// Makes a constant of each line, and the table of all of them.
macro_rules! tolerances {
    ($($(#[$doc:meta])+ $name:ident = $limit:literal, $reason:literal;)+) => {
        $($(#[$doc])+ pub const $name: Tolerance = Tolerance { limit: $limit, reason: $reason };)+

        /// All tolerances by name.
        pub const TABLE: &[(&str, Tolerance)] = &[$((stringify!($name), $name)),+];
    };
}

/// Every test program has the whole table, and so checks it.
const _: () = {
    let mut row = 0;
    while row < TABLE.len() {
        let (_, Tolerance { limit, reason }) = &TABLE[row];
        assert!(*limit > 0.0 && !reason.is_empty(), "a tolerance is positive and has a reason");
        row += 1;
    }
};

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

    /// Displacements of the page's iterations beside the engine's, relative to the largest.
    PAGE_ITERATIONS = 1e-9,
        "two factorisations of up to 200 equations in f64, and a shape from which the coordinates are \
         taken off again: 1e-12; the issue's own number";

    /// What is left of the conditions of contact under the corrected algorithm, relative to the
    /// largest displacement, respectively load.
    CORRECTED_CONDITIONS = 1e-9,
        "a factorisation of up to 2,300 equations in f64, whose residual is 1e-12 of the loads";

    /// Displacements by the stiffness reduced to the surfaces beside those by the whole, over the largest.
    REDUCED = 1e-10,
        "both leave a few epsilons of their residuals, times a condition number of some 1e4";

    /// Displacements by Octave's solver against ours, relative to the largest.
    OCTAVE = 1e-12, "two LU factorisations of some 30 equations of condition 1e3 in f64";

    /// `two-blocks` against its closed form, relative to the closed form.
    CLOSED_FORM = 1e-12, "some 40 equations of condition 1e2 in f64; the issue's own number";

    /// A patch of triangles under constant strain, relative to the strain.
    PATCH = 1e-13, "a dozen roundings of 1e-16 each; the issue's own number";

    /// B and D of random triangles against their closed form, relative to the largest entry.
    ELEMENT = 1e-12, "the area of a random triangle is a difference that may cancel three digits";

    /// Strain of a rigid motion, relative to its largest term |B| |u|.
    RIGID = 1e-13, "a sum of six rounded products that cancel";

    /// f32 beside f64, relative to the largest entry of the table or matrix.
    SINGLE = 2e-6, "inputs and a handful of operations rounded at 6e-8 each, sums of six elements";

    /// f32 beside f64 for yt, relative to the coordinates, which it subtracts.
    SINGLE_GAP = 1e-6, "a difference of coordinates rounded at 6e-8";

    /// A scene beside its mirror image, relative to the largest displacement.
    MIRRORED = 1e-11, "the same equations in another order: 1e-16 times a condition number of 1e3";

    /// Relative residual of a solution.
    RESIDUAL = 1e-14, "LU with partial pivoting is backward stable: some eps = 2e-16 with growth";

    /// Force that reaches the target against the load, relative to the load.
    BALANCE = 1e-10, "a residual of 1e-16 times |K| |u| / |F|, summed over the held nodes";

    /// Forces and gaps of an equilibrium in the shape that it reaches, relative to the largest force and to
    /// the size of the scene.
    HARD = 1e-8, "the shape may change by 1e-8 of the displacements after contact was measured in it";

    /// Displacements of a scene that is hard to solve in two numberings, over the largest.
    RENUMBERED = 1e-7, "thin and loosely held bodies amplify rounding by up to 1e8";

    /// The slip of a pulled strip beside that of a bar, in heights over the length of the slip for its
    /// end, in heights for its edge.
    SHEAR_LAG = 1.2, "a strip is no bar over one height, and slip ends at a node";

    /// The zone of stick under partial slip, relative to Cattaneo's and Mindlin's.
    CATTANEO = 0.035, "fitted on 15 to 25 nodes; 0.6, 1.4 and 3.3 % measured, 0.2 % with 70 nodes";

    /// Displacements under friction beside those of ccx's own contact and friction, relative to the
    /// largest.
    CCX_FRICTION = 0.01, "its contact and its sticking yield by a penalty: 0.2 % measured at 0.2";

    /// Displacements of the corrected algorithm on the strand beside those of ccx's own contact, relative to
    /// the largest.
    CORRECTED_CCX = 0.01, "its contact yields by a penalty: 0.6 % measured, normal and both";

    /// How far a sticking node moves on a foundation of a modulus a million times as large.
    DISSIPATION = 1e-5, "the foundation yields by its modulus over the strip's";

    /// Displacements under a coefficient of 1000 beside those of nodes that never slide.
    LARGE_FRICTION = 1e-5, "what is left of the size of the steps";

    /// Displacements in 16 steps of the load beside those in 32.
    LOAD_STEP = 1e-5, "a node that slips and then sticks within a step; 3e-6 measured";

    /// The growth of the displacement under a force on a node, from mesh to mesh.
    FLAMANT = 0.01,
        "on the third of four meshes the force is 24 edges from the nearest side";

    /// The number of a claim beside the one that its command prints, relative to that.
    CLAIM = 1e-9,
        "1e-13 of the largest displacement by either solver, over a change of a thousandth of it";

    /// The number of a finding on its own scene, worked out by hand, relative to that number.
    FINDING = 1e-12, "a handful of operations, and LU of a few equations, on numbers of order 1";

    /// CalculiX beside this program on the same equations, relative to the largest displacement, or
    /// von Mises stress.
    CCX_PRINTS = 1e-6,
        "ccx prints seven digits: each of two components is rounded by at most 5e-7 of itself, \
         and so is each of the parts of a sum";

    /// CalculiX's contact pair beside `unilateral`, node to segment, relative to the largest
    /// displacement.
    PENALTY = 1e-2,
        "bodies penetrate by pressure over penalty, h/(10 E) of the pressure: on two-blocks 3e-6 \
         mm of 4.2e-4 mm";

    /// The same for the largest von Mises stress of a body, relative to it.
    PENALTY_STRESS = 5e-2,
        "ccx pushes along the normal of the target's face, unilateral along one that turns from \
         face to face: 2.3e-2 on the strand, whatever the penalty; the default penalty adds 2e-3";

    /// Areas and lengths of generated meshes with straight sides, relative to the exact ones.
    STRAIGHT = 1e-12, "a sum of some hundred areas or lengths, each a difference of coordinates";

    /// Areas and lengths of generated meshes with curved sides, relative to the exact ones.
    CHORDS = 0.02,
        "chords of at most 15 degrees cut off 1.2 % of the sector, and half as much again at the \
         ends";

    /// Lamé: order of convergence, absolute.
    LAME_ORDER = 0.06,
        "theory gives 2 in the limit; 1.95, 2.00, 2.01 were measured between 4 and 32 divisions";

    /// Lamé at 64 divisions through the wall, displacement of the bore, relative to it.
    LAME_DISPLACEMENT = 2e-4, "second order: 1.2e-4 was measured, four times that at 32 divisions";

    /// Lamé at 64 divisions, hoop stress of the bore, relative to it.
    LAME_STRESS = 6e-4,
        "second order by extrapolation: 3.9e-4 was measured, four times that at 32 divisions";

    /// Kirsch at 64 divisions of the quarter, stress at the hole, relative to each value.
    KIRSCH = 4e-3,
        "2.5e-3 and 3.3e-3 were measured; on an axis of symmetry, which the mesh's diagonals do \
         not share, extrapolation is not quite second order";

    /// Cook: half a unit of the last of the three decimals of the reference numbers, absolute.
    COOK = 5.1e-4, "the reference numbers are printed with three decimals";

    /// LE1: half a unit of the last of the two decimals of the reference numbers, absolute.
    LE1_GRID = 5.1e-3, "the reference numbers are printed with two decimals";

    /// LE1 at 64 divisions by extrapolation, relative to 92.7.
    LE1_LIMIT = 3e-3,
        "92.7 is rounded at 5e-4; extrapolation on the axis of symmetry leaves 1.4e-3 at 64 \
         divisions, 2.6e-3 at 128";

    /// Least effectivity, estimated / true error in the energy norm, of the discretisation error
    /// estimate on smooth fields.
    EFFECTIVITY_LOW = 0.8,
        "the issue's own number; 0.88 is measured on the coarsest mesh, 0.97 and more on the \
         finest";

    /// Largest effectivity.
    EFFECTIVITY_HIGH = 1.3, "the issue's own number; below 1 is measured everywhere";

    /// Errors of a field that the triangle represents, relative to the field.
    CONSTANT_FIELD = 1e-12,
        "LU of 100 equations of condition 1e3: 1e-16 times it, and a decade of room";

    /// A closest point, its distance and its normal against the closed form, relative to
    /// coordinates of order 1.
    CLOSEST_POINT = 1e-14, "a dozen roundings of 1e-16, of turned coordinates too";

    /// The contact patch test under mortar, relative to the exact value.
    PATCH_TEST = 1e-10,
        "the issue's own number; measured 1e-14, some 300 equations of condition 1e3";

    /// sigma_y / p of the patch test under node to segment, absolute.
    KNOWN_NTS = 1e-4, "the known miss is stated to four digits";

    /// Hertz's closed form beside the benchmark's printed numbers, relative.
    HERTZ_PRINTED = 1e-5, "they are printed with five and six digits";

    /// Hertz's half width and peak at about 4,000 equations, relative.
    HERTZ_COARSE = 1e-2, "the issue's own number; measured 0.2 %, node to segment 0.4 %";

    /// The same at about 30,000.
    HERTZ_FINE = 5e-3, "the issue's own number; measured 0.1 %, and 0.03 % at a tenth of the load";

    /// Known departures of a curved or deformed surface from Hertz's half plane, relative.
    KNOWN_CURVATURE = 1e-3, "stated to three decimals, and a mesh error of 5e-4 at 40 and 59 edges";

    /// Persson's pressure in the integral equation that it solves, relative to the equation's right side.
    INTEGRAL_EQUATION = 1e-4, "20,000 points of the midpoint rule, next to roots: measured 3e-5";

    /// Persson's half width and peak over Hertz's where the arc is small, relative.
    SMALL_ARC = 1e-3, "an arc of 0.01 radians: they part by its square";

    /// The peak pressure of the strand on meshes with true arcs, relative to a finer mesh's, and Hertz's.
    TRUE_ARCS = 1e-2, "the issue's own number; measured 0.7 % at 0.2 mm, 0.1 % of Hertz's";

    /// Persson's peak pressure of the strand, relative to that of fine meshes.
    CURVED = 2e-2, "it has not Dundurs' β, which is 0.30 here: measured 1.8 %";

    /// The pressure of a flat punch away from its corner, relative to the closed form.
    PUNCH = 1.5e-2, "24 edges on the half width, a boundary at 20: measured 1 %";

    /// Gap times force of a contact node relative to size times the largest force; penetration
    /// relative to the size.
    COMPLEMENTARITY = 1e-12, "the issue's own number";

    /// Contact in the current shape beside contact in the initial one at a load of a thousandth of
    /// CGS-1's, relative to the peak.
    CURRENT_LENGTHS = 2e-3, "strains of 1e-3 at the contact: the two differ by as much";

    /// The sum of normal forces beside the load along y, where the surface slopes a little:
    /// relative to the load.
    FORCE_OF_A_SLOPE = 1e-4, "the slope of a surface strained by 1e-3, squared, is 1e-6";

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

    /// A displacement in a scene a million of its sizes from the origin, relative to itself.
    FAR_FROM_THE_ORIGIN = 1e-6,
        "a coordinate of 3e6 resolves 5e-10; strains, and gaps over displacements of 1e-3, a \
         thousand times less";

    /// A double-double operation against exact arithmetic, relative to its result.
    DOUBLE_DOUBLE = 1.3e-31,
        "the proven errors, in units of u² = 2^-106 = 1.2e-32: sum 3, product 4, quotient 9.8, \
         root of a square 3.125 + 2";

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

    /// Half a symmetric scene beside the whole, and a refined scene's area and load, relative to
    /// the largest.
    HALF = 1e-9,
        "the strand's mesh is symmetric within 2e-11 mm of triangles of 0.2 mm; the same \
         equations in another order add 1e-13";

    /// Lamé: order of convergence in the energy norm, absolute.
    LAME_ENERGY_ORDER = 0.15,
        "1 where the solution is smooth; 0.89 was measured: the polygon's corners on the bore are \
         re-entrant and take some of it";

    /// Forces and pressures of the five problems meshed by Gmsh, relative to the textbook's.
    GMSH = 0.03,
        "meshes of 400 to 3,400 nodes: 0.3 % was measured at the press fit, 0.2 % at the cylinders, 1 % at the \
         punch and the ring, whose thickness is a tenth of its radius";

    /// Right digits in a cell of `extremes`, before they are cut off to whole ones.
    EXTREME_DIGITS = 0.5,
        "the LU library sums in another order on another processor: an error may be three times \
         larger or smaller by chance";

    /// The exponent of a breaking point of `extremes`.
    EXTREME_DECADES = 1.0,
        "half a digit more or less moves the point where three are left by half a decade; it is \
         bisected to half of one, and rounded";
}
