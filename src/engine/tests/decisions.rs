//! Who is in contact: wherever rounding decides it, the run has said so.

use std::cell::RefCell;
use std::collections::BTreeMap;

use engine::Decision;
use engine::estimates::arithmetic::{self, Rounding};
use engine::estimates::{Certainty, certain};
use engine::linear::{Arithmetic, ScalarName, Solver};
use engine::{Detail, Request, Solution, solve};
use problem::model::NodeId;
use problem::modelling::{ContactModel, Coupling, StatusRule, Variant};
use problem::scene::Scene;
use proptest::prelude::*;
use proptest::test_runner::TestRunner;
use serde_json::{Value, json};
use testing::embedded::scene_json;
use testing::json::build;
use testing::random::fixed;

fn rounding(solution: &Solution) -> Rounding {
    arithmetic::rounding(solution).expect("a variant of the paper")
}

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

/// The edge and the status of each contact node in each iteration.
fn history(solution: &Solution) -> Vec<(Vec<usize>, Vec<usize>)> {
    let found = |detail: &Detail| match detail {
        Detail::Published(step) => {
            (step.pairs.ct.as_slice().to_vec(), step.pairs.dy.as_slice().to_vec())
        }
        Detail::Unilateral(_) => panic!("a variant of the paper"),
    };
    solution.steps.iter().map(|step| found(&step.detail)).collect()
}

/// What came of the scenes of a status rule and a coupling.
#[derive(Default)]
struct Count {
    compared: usize,
    /// Rounding decided.
    turned: usize,
    /// It was said that rounding may have decided.
    said: usize,
    in_vain: usize,
    /// The run that would tell does not know either.
    unknown: usize,
}

/// Runs in f64, in f64x2 and in exact numbers, or where mortar takes square roots in double-doubles
/// with a bound: where one of the first two has another history than the last, it has said that
/// rounding may have decided; where it has not said so, its bound holds. `PROPTEST_CASES=2000` and
/// `--nocapture` tell how often on how many scenes.
#[test]
fn what_rounding_decides_is_said() {
    let counts: RefCell<BTreeMap<String, Count>> = RefCell::default();
    let check = |drawn: Drawn| {
        let scene = scene(&drawn);
        let run = |scalar| {
            let arithmetic = Arithmetic { scalar, ..Arithmetic::default() };
            let Drawn { rule: status, coupling, .. } = drawn;
            let contact = ContactModel { status, coupling, ..scene.contact };
            let request = Request::new(&scene).variant(drawn.variant).contact(contact);
            let request = request.arithmetic(arithmetic);
            solve(&request, &mut |_| ()).ok()
        };
        let has_roots = drawn.coupling == Coupling::Mortar && drawn.variant != Variant::Printed;
        let best = if has_roots { ScalarName::BoundedDouble } else { ScalarName::Exact };
        let Some(exact) = run(best) else { return Ok(()) };
        let mut counts = counts.borrow_mut();
        let count = counts.entry(format!("{}, {}", drawn.rule, drawn.coupling)).or_default();
        let of_exact = exact.error_bound.unwrap_or(0.0);
        if of_exact.is_infinite() {
            count.unknown += 1;
            return Ok(());
        }
        for scalar in [ScalarName::F64, ScalarName::F64x2] {
            let Some(solution) = run(scalar) else { continue };
            let found = rounding(&solution);
            let is_sure = found.decisions.as_ref().is_some_and(Vec::is_empty);
            let differs = history(&solution) != history(&exact);
            prop_assert!(!(differs && is_sure), "{scalar}: another history, and not a word of it");
            prop_assert!(found.decisions.is_some(), "{scalar}: {}: not known", drawn.rule);
            if is_sure {
                let written = f64::EPSILON / 2.0 * exact.u.amax() + of_exact;
                let error = (&solution.u - &exact.u).amax() - written;
                prop_assert!(
                    error <= found.displacement.unwrap_or(f64::INFINITY),
                    "{scalar}: error {error:e}: {found:?}"
                );
            } else {
                prop_assert!(found.displacement.is_none(), "a bound as if it held");
            }
            if scalar == ScalarName::F64 {
                count.compared += 1;
                count.turned += usize::from(differs);
                count.said += usize::from(!is_sure);
                count.in_vain += usize::from(!is_sure && !differs);
            }
        }
        Ok(())
    };
    TestRunner::new(fixed(240)).run(&drawn(), check).unwrap();
    for (what, Count { compared, turned, said, in_vain, unknown }) in &*counts.borrow() {
        println!(
            "{what}: {compared} scenes: rounding decided on {turned}, was said to on {said}, in \
             vain on {in_vain}; {unknown} more of which the best numbers do not know"
        );
        assert!(said < compared, "{what}: on some scene rounding does not decide");
    }
    let turned = |coupling: &str| {
        let counts = counts.borrow();
        counts
            .iter()
            .filter(|(what, _)| what.ends_with(coupling))
            .map(|c| c.1.turned)
            .sum::<usize>()
    };
    assert!(turned("nts") > 0 && turned("mortar") > 0, "on some scene rounding is here to decide");
}

/// A block whose upper side, the target, ends at x = 1, and a stamp on it that its nodes 6 and 7 hold;
/// `stamp` is where its three nodes stand.
pub fn block_and_stamp(stamp: [[f64; 2]; 3], contact: &Value, variant: Variant) -> Request {
    let [[x5, y5], [x6, y6], [x7, y7]] = stamp;
    let scene = build(&json!({
        "plane": "strain",
        "node": [
            [1, 0.0, 0.0, 0.0], [2, 1.0, 0.0, 0.0], [3, 0.0, -1.0, 0.0], [4, 1.0, -1.0, 0.0],
            [5, x5, y5, 0.0], [6, x6, y6, 0.0], [7, x7, y7, 0.0]
        ],
        "elem": [
            [1, 1, 2, 10, 10, 1, 2], [2, 2, 2, 1, 1, 1, 3, 2], [3, 2, 2, 1, 1, 3, 4, 2],
            [4, 2, 2, 2, 2, 5, 6, 7]
        ],
        "materials": { "1": { "E": 4.0, "nu": 0.0 }, "2": { "E": 4.0, "nu": 0.0 } },
        "restraints": [
            { "node": 3, "fix": ["x", "y"] }, { "node": 4, "fix": ["x", "y"] },
            { "node": 6, "fix": ["x", "y"] }, { "node": 7, "fix": ["x", "y"] }
        ],
        "loads": [{ "node": 5, "force": [0.0, -0.2] }],
        "contact": contact
    }));
    Request::new(&scene.expect("it is sound")).variant(variant)
}

/// A stamp that mortar binds, whose contact edge of length 1 starts at `x`.
fn bound_by_mortar(x: f64, scalar: ScalarName) -> Request {
    let contact = json!({ "cnt": [5, 6], "trg": [1], "c_tll": 0.1, "coupling": "mortar" });
    let stamp = [[x, 0.0], [x + 1.0, 0.0], [x, 1.0]];
    let arithmetic = Arithmetic { scalar, ..Arithmetic::default() };
    block_and_stamp(stamp, &contact, Variant::Stepped).arithmetic(arithmetic)
}

/// A gap of 0.1 is below a tolerance of 0.1 + 1e-10, beyond any rounding of an `f64`; as `f32` the
/// two are one number.
#[test]
fn a_status_that_is_another_one_in_more_digits_is_said() {
    let contact = json!({ "cnt": [5], "trg": [1], "c_tll": 0.1000000001 });
    let found = |scalar: ScalarName| {
        let request =
            block_and_stamp([[0.3, 0.1], [2.0, 1.0], [0.0, 1.0]], &contact, Variant::Tied);
        let request = request.arithmetic(Arithmetic { scalar, ..Arithmetic::default() });
        rounding(&solve(&request, &mut |_| ()).expect("it runs"))
    };
    assert_eq!(found(ScalarName::F64).decisions, Some(Vec::new()));
    let found = found(ScalarName::F32);
    let other = Decision {
        iteration: 1,
        node: NodeId::from_number(5),
        condition: "the edge or status is another one in f64-bounded".into(),
        margin: None,
        bound: None,
    };
    assert_eq!(found.decisions, Some(vec![other]));
    assert!(found.displacement.is_none());
}

/// The contact edge of length 1 starts at x. Its first node is covered by s − s²/2 of its half, where
/// s = 1 − x: by 5 %, which is the limit, at x = √0.95. In f64 rounding decides there whether mortar
/// binds the node, in f64x2 it does not.
#[test]
fn what_rounding_decides_of_mortar_is_said() {
    let left = |x: f64, scalar: ScalarName| {
        let request = bound_by_mortar(x, scalar);
        let found = rounding(&solve(&request, &mut |_| ()).expect("it runs"));
        let left = found.decisions.expect("it is looked at");
        assert_eq!(found.displacement.is_some(), left.is_empty(), "{x}");
        left
    };
    let limit = 0.95_f64.sqrt();
    for scalar in [ScalarName::F64, ScalarName::Bounded, ScalarName::F64x2] {
        assert!(left(0.9, scalar).is_empty() && left(0.99, scalar).is_empty(), "{scalar}");
    }
    assert!(left(limit, ScalarName::F64x2).is_empty());
    let left = left(limit, ScalarName::F64);
    let of_mortar = |one: &Decision| {
        one.condition == "a comparison of mortar's integrals" && one.node.number() == 5
    };
    assert!(!left.is_empty() && left.iter().all(of_mortar), "{left:?}");
}

/// Where rounding decides in `f64` and not in double-doubles, the latter's run is taken; where it
/// decides nothing, the run itself.
#[test]
fn a_run_is_repeated_where_rounding_decides() {
    let taken = |x: f64, scalar: ScalarName| {
        let request = bound_by_mortar(x, scalar);
        let (solution, how) = certain(solve(&request, &mut |_| ()).expect("it runs"));
        (solution.request.arithmetic.scalar, how)
    };
    let limit = 0.95_f64.sqrt();
    assert_eq!(taken(0.9, ScalarName::F64), (ScalarName::F64, Certainty::Certain));
    assert_eq!(taken(limit, ScalarName::F64x2), (ScalarName::F64x2, Certainty::Certain));
    let again = (ScalarName::BoundedDouble, Certainty::InDoubleDouble);
    assert_eq!(taken(limit, ScalarName::F64), again);
    // The solver is that of the first run alone.
    for solver in [Solver::SparseLu, Solver::DenseLu] {
        let arithmetic = Arithmetic { solver: Some(solver), ..Arithmetic::default() };
        let request = bound_by_mortar(limit, ScalarName::F64).arithmetic(arithmetic);
        let (_, how) = certain(solve(&request, &mut |_| ()).expect("it runs"));
        assert_eq!(how, Certainty::InDoubleDouble, "{solver}");
    }
    // The gap is the tolerance in every number.
    let tie = json!({ "cnt": [5], "trg": [1], "c_tll": 0.1 });
    let request = block_and_stamp([[0.3, 0.1], [2.0, 1.0], [0.0, 1.0]], &tie, Variant::Tied);
    let (_, how) = certain(solve(&request, &mut |_| ()).expect("it runs"));
    assert_eq!(how, Certainty::Unknown);
}
