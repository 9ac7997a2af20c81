//! Who is in contact: wherever rounding decides it, the run has said so.

use std::cell::RefCell;
use std::collections::BTreeMap;

use engine::estimates::{Certainty, When, certain, perturbed};
use engine::linear::{Arithmetic, ScalarName, Solver};
use engine::{Request, Solution, solve};
use problem::modelling::{ContactModel, Coupling, StatusRule, Variant};
use problem::scene::Scene;
use proptest::prelude::*;
use proptest::test_runner::TestRunner;
use serde_json::json;
use testing::embedded::scene_json;
use testing::json::build;
use testing::random::fixed;
use testing::rows::scene_of;

/// What is drawn of a scene of one block on another.
#[derive(Clone, Debug)]
struct Drawn {
    /// How far the nodes of the interface are moved: three of the target, then three of the stamp.
    moves: Vec<[f64; 2]>,
    /// The part of the moves that is kept, as a power of ten; none where it is 0.
    near: i32,
    /// The tolerance, as a power of ten.
    tolerance: i32,
    /// The gap, in units of the tolerance.
    gap: f64,
    /// The distance from the origin.
    offset: f64,
    /// Whether the right sides of both blocks are held, so that the stamp need not touch.
    held: bool,
    iterations: usize,
    variant: Variant,
    rule: StatusRule,
    coupling: Coupling,
}

fn drawn() -> impl Strategy<Value = Drawn> {
    let variants = [Variant::Printed, Variant::Tied, Variant::Stepped];
    let geometry = (
        prop::collection::vec([-0.3..0.3_f64, -0.3..0.3_f64], 6),
        prop_oneof![Just(0), 1..16_i32],
        3..17_i32,
        prop::sample::select(vec![-0.5, 0.0, 0.5, 1.0, 1.0, 3.0]),
    );
    let rest = (
        prop::sample::select(vec![0.0, 0.0, 0.1, 77.7, 12345.6]),
        prop::sample::select(vec![true, true, true, false]),
        1..9_usize,
        prop::sample::select(variants.to_vec()),
        prop::sample::select(StatusRule::ALL),
        prop::sample::select(Coupling::ALL),
    );
    (geometry, rest).prop_map(
        |((moves, near, tolerance, gap), (offset, held, iterations, variant, rule, coupling))| {
            Drawn {
                moves,
                near: -near,
                tolerance: -tolerance,
                gap,
                offset,
                held,
                iterations,
                variant,
                rule,
                coupling,
            }
        },
    )
}

fn scene(drawn: &Drawn) -> Scene {
    let mut json = scene_json("two-blocks");
    let tolerance = 10f64.powi(drawn.tolerance);
    let kept = if drawn.near == 0 { 0.0 } else { 10f64.powi(drawn.near) };
    for k in 0..18_usize {
        let [dx, dy] = if (6..12).contains(&k) { drawn.moves[k - 6] } else { [0.0; 2] };
        let lifted = if k >= 9 { drawn.gap * tolerance } else { 0.0 };
        // The ends keep their places along x, where restraints stand.
        let dx = if k % 3 == 1 { dx } else { 0.0 };
        let node = &mut json["node"][k];
        let moved = |x: &serde_json::Value, by: f64| (x.as_f64().unwrap() + by).into();
        node[1] = moved(&node[1], kept * dx + drawn.offset);
        node[2] = moved(&node[2], kept * dy + lifted + drawn.offset);
    }
    if drawn.held {
        json["restraints"][2]["fix"] = json!(["x", "y"]);
    }
    json["contact"]["c_tll"] = tolerance.into();
    json["iterations"] = drawn.iterations.into();
    build(&json).expect("a drawn scene is sound")
}

/// The status of each contact node in each iteration.
fn history(solution: &Solution) -> Vec<Vec<bool>> {
    solution.steps.iter().map(|step| step.closed().collect()).collect()
}

/// What came of the scenes of a status rule and a coupling.
#[derive(Default)]
struct Count {
    compared: usize,
    /// Rounding decided.
    turned: usize,
    /// It was said that rounding decides.
    said: usize,
    /// It decided, and three runs on other last digits did not show it.
    missed: usize,
}

/// Runs in f64, and in exact numbers, or where mortar takes square roots in double-doubles: where the first has another
/// history or other displacements than the other, it is said that rounding decides. `PROPTEST_CASES=2000` and `--nocapture` tell how often on
/// how many scenes.
#[test]
fn what_rounding_decides_is_said() {
    let counts: RefCell<BTreeMap<String, Count>> = RefCell::default();
    let check = |drawn: Drawn| {
        let scene = scene(&drawn);
        let Drawn { rule: status, coupling, .. } = drawn;
        let contact = ContactModel { status, coupling, ..scene.contact };
        let request = Request::new(&scene).variant(drawn.variant).contact(contact);
        let run = |scalar| {
            let arithmetic = Arithmetic { scalar, ..Arithmetic::default() };
            solve(&request.clone().arithmetic(arithmetic), &mut |_| ()).ok()
        };
        let has_roots = request.bound_by().and_then(|by| ScalarName::Exact.refuses(by)).is_some();
        let best = if has_roots { ScalarName::F64x2 } else { ScalarName::Exact };
        let (Some(exact), Some(solution)) = (run(best), run(ScalarName::F64)) else {
            return Ok(());
        };
        let mut counts = counts.borrow_mut();
        let count = counts.entry(format!("{}, {}", drawn.rule, drawn.coupling)).or_default();
        let moved = (&solution.u - &exact.u).amax() > 1e-6 * exact.u.amax();
        let differs = moved || history(&solution) != history(&exact);
        let said = perturbed(&solution).expect("it is rounded").decides();
        count.compared += 1;
        count.turned += usize::from(differs);
        count.said += usize::from(said);
        count.missed += usize::from(differs && !said);
        Ok(())
    };
    TestRunner::new(fixed(1000)).run(&drawn(), check).unwrap();
    for (what, Count { compared, turned, said, missed }) in &*counts.borrow() {
        println!(
            "{what}: {compared} scenes: rounding decided on {turned}, was said to on {said}; missed: {missed}"
        );
        assert!(said < compared, "{what}: on some scene rounding does not decide");
        assert_eq!(*missed, 0, "{what}: another history, and not a word of it");
    }
    for coupling in Coupling::ALL {
        let counts = counts.borrow();
        let of = counts.iter().filter(|(what, _)| what.ends_with(coupling.name()));
        let turned: usize = of.map(|(_, count)| count.turned).sum();
        assert!(turned > 0, "{coupling}: on some scene rounding is here to decide");
    }
}

/// A block whose upper side, the target, ends at x = 1, and a stamp on it whose node 5 may touch, held at nodes 6 and 7.
pub fn block_and_stamp(changes: &str, variant: Variant) -> Request {
    let scene = scene_of("tests", &format!("stamp {changes}"));
    Request::new(&scene.expect("it is sound")).variant(variant)
}

/// A gap of 0.1 is below a tolerance of 0.1 + 1e-10, beyond any rounding of an `f64`; as `f32` the
/// two are one number.
#[test]
fn a_status_that_hangs_on_the_last_digit_is_said() {
    let found = |scalar: ScalarName| {
        let request = block_and_stamp("c_tll=0.1000000001", Variant::Tied);
        let request = request.arithmetic(Arithmetic { scalar, ..Arithmetic::default() });
        perturbed(&solve(&request, &mut |_| ()).expect("it runs"))
    };
    let contact = |scalar: ScalarName| found(scalar).expect("it is rounded").contact;
    assert_eq!([ScalarName::F64, ScalarName::F64x2].map(contact), [None, None]);
    let change = contact(ScalarName::F32).expect("one of three falls on the other side");
    assert_eq!((change.node.number(), change.when, change.nodes), (5, When::Iteration(1), 1));
    assert_eq!(found(ScalarName::Exact), None);
}

/// Two blocks lie flush at `c_tll` = 1e-17: in f64 the last digit decides who is in contact, and the run in
/// double-doubles is taken, by its own solver. Where it decides nothing, the run itself is.
#[test]
fn a_run_is_repeated_where_rounding_decides() {
    let taken = |tolerance: f64, arithmetic: Arithmetic| {
        let mut request = Request::new(&Scene::open("two-blocks").unwrap()).variant(Variant::Tied);
        request.tolerance = Some(tolerance);
        let solution = solve(&request.arithmetic(arithmetic), &mut |_| ()).expect("it runs");
        let (solution, how) = certain(solution);
        (solution.request.arithmetic.scalar, how)
    };
    for solver in [None, Some(Solver::SparseLu), Some(Solver::DenseLu)] {
        let own = Arithmetic { solver, ..Arithmetic::default() };
        assert_eq!(taken(1e-3, own), (ScalarName::F64, Certainty::Certain));
        assert_eq!(taken(1e-17, own), (ScalarName::F64x2, Certainty::InDoubleDouble), "{solver:?}");
    }
    let finest = Arithmetic { scalar: ScalarName::F64x2, ..Arithmetic::default() };
    assert_eq!(taken(1e-3, finest), (ScalarName::F64x2, Certainty::Certain));
    assert_eq!(taken(1e-17, finest), (ScalarName::F64x2, Certainty::Decided));
}
