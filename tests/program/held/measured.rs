//! What several passages need, computed once.

use std::path::Path;
use std::sync::LazyLock;

use plane_contact::engine::{Solution, distance, solve};
use plane_contact::numbers::solve::{Arithmetic, ScalarName};
use plane_contact::problem::modelling::{ContactModel, Coupling, Friction, Variant};
use plane_contact::studies::audit::statuses::{self, Measurement, Row};
use plane_contact::studies::calculix::{Comparison, Contact, Fields, Pair, Part, run};
use plane_contact::{Request, Scene};

pub static STRAND: LazyLock<Scene> =
    LazyLock::new(|| Scene::open("strand").expect("an embedded scene"));

/// The variants as `solve strand` runs them, in the order of README's first table, `mortar` and the
/// reference solution included.
pub static VARIANTS: LazyLock<[Solution; 6]> = LazyLock::new(|| {
    let request = Request::new(&STRAND);
    let of = |variant| solved(&request.clone().variant(variant));
    [
        of(Variant::Printed),
        of(Variant::Tied),
        of(Variant::Stepped),
        of(Variant::Unilateral),
        solve(&request.equilibrium(), &mut |_| ()).expect("strand has one"),
        solved(&request.reference()),
    ]
});

/// The equilibrium under the scene's own friction, which errors are against.
pub fn own_equilibrium() -> &'static Solution {
    &VARIANTS[4]
}

pub fn solved(request: &Request) -> Solution {
    solve(request, &mut |_| ()).expect("the variant runs")
}

/// A variant of the paper in numbers of type `scalar`, with a parameter turned.
pub fn turned(variant: Variant, scalar: ScalarName, turn: impl Fn(&mut Request)) -> Solution {
    let arithmetic = Arithmetic { scalar, ..Arithmetic::default() };
    let mut request = Request::new(&STRAND).variant(variant).arithmetic(arithmetic);
    turn(&mut request);
    solved(&request)
}

/// Largest difference of a displacement, in per cent of the largest of `other`.
pub fn apart(solution: &Solution, other: &Solution) -> f64 {
    100.0 * distance(solution, other).displacement_relative
}

/// Wrong statuses as `statuses` prints them without options.
pub static STATUSES: LazyLock<Measurement> = LazyLock::new(|| statuses::measure(200, 1));

/// The row of a depth of the jump, in c_tll, with the target `below` the stamp or `above`.
pub fn jump(depth: f64, target: &str) -> &'static Row {
    let mut rows = STATUSES.by_depth.iter();
    rows.find(|row| row.depth == depth && row.target == target).expect("a depth that is tried")
}

/// Every reading of README's table beside CalculiX's own contact under the same friction: how
/// contact is modelled here, and the two results. Nothing where `ccx` is not installed; where
/// `REQUIRE_CCX` is set it must be.
pub static BESIDE_CALCULIX: LazyLock<Option<Vec<Comparison>>> = LazyLock::new(|| {
    let theirs = |friction| {
        let pair = Pair::new(&STRAND.model, None, friction);
        let part = Part { contact: Contact::Pair(pair), share: 1.0 };
        run("ccx", &STRAND, &STRAND.model, &[part]).map(|ran| ran.fields)
    };
    let there = std::process::Command::new("ccx").arg("-v").output().is_ok();
    assert!(there || std::env::var_os("REQUIRE_CCX").is_none(), "ccx is not installed");
    let frictions = [Friction::STICK, Friction::new(0.2)?, Friction::NONE];
    let [stick, some, none] =
        frictions.map(|friction| there.then(|| theirs(friction).expect("ccx runs")));
    let under = |friction| {
        let contact = ContactModel { coupling: Coupling::Nts, friction, ..STRAND.contact };
        solved(&Request::new(&STRAND).variant(Variant::Unilateral).contact(contact))
    };
    let beside = |ours: &Solution, theirs: &Option<Fields>| {
        Some(Comparison::new(&STRAND.model, Fields::of(ours), theirs.clone()?))
    };
    let [printed, tied, stepped, nts, mortar, _] = &*VARIANTS;
    [
        beside(printed, &stick),
        beside(tied, &stick),
        beside(stepped, &stick),
        beside(nts, &stick),
        beside(&under(frictions[1]), &some),
        beside(&under(frictions[2]), &none),
        beside(mortar, &stick),
    ]
    .into_iter()
    .collect()
});

/// A column of a row of a table in `golden/`, which a test of its own holds to the program: the
/// first row that starts with `row` after the line that starts with `table`. Columns are apart by
/// two blanks or more.
pub fn golden(file: &str, table: &str, row: &str, column: usize) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("golden").join(file);
    let text = std::fs::read_to_string(path).expect("a golden file");
    let after = text.lines().skip_while(|line| !line.starts_with(table));
    let cells = |line: &str| -> Vec<String> {
        line.split("  ").map(str::trim).filter(|cell| !cell.is_empty()).map(String::from).collect()
    };
    let mut rows = after.map(cells).filter(|cells| cells.first().is_some_and(|name| name == row));
    rows.next().expect("the table has the row")[column].clone()
}

/// Mean length of the target's edges of `strand`, mm.
pub fn mean_edge() -> f64 {
    let lengths = STRAND.model.target_edges().map(|edge| {
        let [a, b] = edge.nodes.map(|node| STRAND.model.at(node));
        (b[0] - a[0]).hypot(b[1] - a[1])
    });
    lengths.sum::<f64>() / STRAND.model.contact.target.len() as f64
}

/// The largest elastic modulus of `strand`, MPa.
pub fn stiffest() -> f64 {
    STRAND.model.triangles.iter().map(|triangle| triangle.material.e).fold(0.0, f64::max)
}

/// Decimal digits of two f64.
pub fn digits_of_two() -> u32 {
    (f64::from(2 * f64::MANTISSA_DIGITS) * 2f64.log10()).floor() as u32
}

/// `limit`, once `value` has been found to be below it.
pub fn below(value: f64, limit: &str) -> &str {
    let bound: f64 = limit.parse().expect("a number");
    assert!(value.abs() < bound, "{value:e} is not below {limit}");
    limit
}
