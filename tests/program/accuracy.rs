//! `solve --accuracy`: what it delivers is within what was asked of the numbers without rounding, or
//! it says that it cannot.

use std::cell::Cell;

use crate::common::golden_file::assert_rows;
use crate::common::json::build;
use crate::common::random::fixed;
use crate::common::rows::{scene_of, two_and_scene};
use dashu_ratio::RBig;
use plane_contact::engine::error::Error;
use plane_contact::engine::linear::{Arithmetic, Inputs, ScalarName};
use plane_contact::engine::{Request, Solution, max_displacement, solve};
use plane_contact::numbers::scalar::rational;
use plane_contact::problem::modelling::Variant;
use plane_contact::problem::scene::Scene;
use plane_contact::studies::trade::trial_tables as report;
use plane_contact::studies::trade::{Rounding, solve_to};
use proptest::prelude::*;
use proptest::test_runner::TestRunner;
use serde_json::{Value, json};

const PUBLISHED: [Variant; 3] = [Variant::Printed, Variant::Tied, Variant::Stepped];

/// A block of two by one squares under a stamp of the same size, both of which are held; exponents
/// are decimal.
#[derive(Clone, Debug)]
struct Drawn {
    variant: Variant,
    accuracy: i32,
    offset: Option<i32>,
    moduli: [i32; 2],
    /// The height of the block: a sliver where it is small.
    height: i32,
    /// The units of length and of stress.
    units: [i32; 2],
    load: i32,
    /// The gap between the bodies, in units of `c_tll`.
    gap: f64,
    moves: Vec<[f64; 2]>,
}

fn ten(exponent: i32) -> f64 {
    10f64.powi(exponent)
}

impl Drawn {
    fn json(&self) -> Value {
        const C_TLL: f64 = 1e-2;
        let (height, unit) = (ten(self.height), ten(self.units[0]));
        let offset = self.offset.map_or(0.0, ten);
        let rows = [1.0 - height, 1.0, 1.0 + self.gap * C_TLL, 2.0];
        let node = |k: usize| {
            let (row, column) = (k / 3, k % 3);
            let [dx, dy] = self.moves[k];
            // The block's nodes move by a part of its height.
            let part = if row < 2 { height } else { 1.0 };
            // Those of the two surfaces stay on them.
            let dy = if row == 1 || row == 2 { 0.0 } else { dy * part };
            let [x, y] = [column as f64 + dx, rows[row] + dy].map(|x| (offset + x) * unit);
            json!([k + 1, x, y, 0.0])
        };
        let edge =
            |n: usize, group: usize, a: usize, b: usize| json!([n, 1, 2, group, group, a, b]);
        let mut elem = vec![edge(1, 10, 4, 5), edge(2, 10, 5, 6), edge(3, 20, 10, 11)];
        elem.extend([edge(4, 20, 11, 12), edge(5, 21, 9, 12)]);
        for (body, first) in [(1, 1), (2, 7)] {
            for a in [first, first + 1] {
                for [b, c] in [[a + 1, a + 4], [a + 4, a + 3]] {
                    elem.push(json!([elem.len() + 1, 2, 2, body, body, a, b, c]));
                }
            }
        }
        let [e1, e2] = self.moduli.map(|e| ten(e + self.units[1]));
        let load = ten(self.load) * e2;
        json!({
            "plane": "strain",
            "node": (0..12).map(node).collect::<Vec<_>>(),
            "elem": elem,
            "materials": { "1": { "E": e1, "nu": 0.2 }, "2": { "E": e2, "nu": 0.3 } },
            "restraints": [
                { "node": 1, "fix": ["x", "y"] }, { "node": 2, "fix": ["x", "y"] },
                { "node": 3, "fix": ["x", "y"] }, { "node": 10, "fix": ["x", "y"] },
                { "node": 12, "fix": ["x"] }
            ],
            "loads": [{ "on": 20, "pressure": load }, { "on": 21, "traction": [-load, load / 3.0] }],
            "contact": { "cnt": [7, 8, 9], "trg": [1, 2], "c_tll": C_TLL * unit, "coupling": "nts" },
            "iterations": 3
        })
    }
}

fn drawn() -> impl Strategy<Value = Drawn> {
    let exponent = |range| prop_oneof![2 => Just(0), 1 => range];
    let numbers = (
        prop_oneof![2 => -9..=-1, 1 => -34..=-10],
        prop::option::of(0..=9),
        [-5..=5, -5..=5],
        exponent(-8..=0),
        [exponent(-50..=40), exponent(-50..=40)],
        prop_oneof![3 => -5..=-2, 1 => -60..=-6],
    );
    let moves = prop::collection::vec([-0.2..0.2_f64, -0.2..0.2_f64], 12);
    let variant = prop::sample::select(&PUBLISHED[..]);
    (variant, numbers, -1.5..1.5_f64, moves).prop_map(|(variant, numbers, gap, moves)| {
        let (accuracy, offset, moduli, height, units, load) = numbers;
        Drawn { variant, accuracy, offset, moduli, height, units, load, gap, moves }
    })
}

fn exactly(request: &Request) -> Result<Solution, Error> {
    let exact = Arithmetic { scalar: ScalarName::Exact, ..Arithmetic::default() };
    solve(&request.clone().arithmetic(exact), &mut |_| ())
}

/// The largest error of a displacement component over the largest displacement, both without
/// rounding.
fn error(delivered: &Solution, exact: &Solution) -> f64 {
    let pairs = delivered.exact_displacements().into_iter().zip(exact.exact_displacements());
    let off = pairs.map(|(a, b)| (a - b).to_f64().value().abs()).fold(0.0, f64::max);
    if off == 0.0 { 0.0 } else { off / max_displacement(&exact.u) }
}

#[test]
fn an_accuracy_is_held_or_refused() {
    let [delivered, refused, unbuilt] = [(); 3].map(|()| Cell::new(0));
    let count = |of: &Cell<usize>| of.set(of.get() + 1);
    let held = TestRunner::new(fixed(120)).run(&drawn(), |drawn| {
        let Ok(scene) = build(&drawn.json()) else {
            count(&unbuilt);
            return Ok(());
        };
        let request = Request::new(&scene).variant(drawn.variant);
        let accuracy = ten(drawn.accuracy);
        match solve_to(&request, accuracy) {
            Ok(reached) => {
                let exact = exactly(&request);
                prop_assert!(exact.is_ok(), "a result where exact numbers fail: {:?}", exact.err());
                let error = error(&reached.solution, &exact.expect("it is sound"));
                prop_assert!(error <= accuracy, "{:e}: {:?}", error, reached.attempts);
                count(&delivered);
            }
            Err(why) => {
                let fails = exactly(&request).is_err();
                prop_assert!(
                    why.exit_status().number() == 2 || fails,
                    "exit {}: {}",
                    why.exit_status().number(),
                    why
                );
                count(&refused);
            }
        }
        Ok(())
    });
    let [delivered, refused, unbuilt] = [delivered, refused, unbuilt].map(Cell::into_inner);
    println!("{delivered} delivered, {refused} refused, {unbuilt} are no scenes");
    held.unwrap_or_else(|why| panic!("{why}"));
    assert!(delivered > refused + unbuilt, "{delivered}, {refused}, {unbuilt}");
}

/// The square of `accuracy/square.json`, changed.
fn square(changes: &str) -> Scene {
    scene_of("tests/program", &format!("accuracy/square {changes}")).expect("it is sound")
}

/// The rows of `accuracy/rows.txt`: an accuracy, a variant and a scene, and what was tried, or why nothing meets it.
#[test]
fn precisions_are_tried_from_the_cheapest() {
    let answer = |row: &str| {
        let [accuracy, variant, scene] = two_and_scene(row);
        let scene = scene_of("tests/program", scene).expect("it is sound");
        let request = Request::new(&scene).variant(variant.parse().expect("a variant"));
        let accuracy = accuracy.parse().expect("a number");
        let reached = match solve_to(&request, accuracy) {
            Ok(reached) => reached,
            Err(why) => return format!("status {}: {why}", why.exit_status().number()),
        };
        assert!(report::reached(&reached, accuracy).text(usize::MAX).contains("mesh"));
        let last = reached.attempts.last().expect("an attempt");
        assert!(matches!(last.rounding, Rounding::Measured(bound) if bound <= accuracy));
        let tried = reached.attempts.iter().map(|attempt| match attempt.rounding {
            Rounding::Failed(_) => format!("{} fails", attempt.arithmetic.scalar),
            _ => attempt.arithmetic.scalar.to_string(),
        });
        tried.collect::<Vec<_>>().join(", ")
    };
    assert_rows("tests/program/accuracy/rows.txt", answer);
}

/// f32 rounds coordinates far from the origin: no number of its run shows that.
#[test]
fn rounded_coordinates_count() {
    let scene = square("shift=1e6,0 /node/1/1=1000000.7 /node/2/1=1000000.7");
    let request = Request::new(&scene).variant(Variant::Tied);
    let single = Arithmetic { scalar: ScalarName::F32, ..Arithmetic::default() };
    let single = solve(&request.clone().arithmetic(single), &mut |_| ()).unwrap();
    assert!(error(&single, &exactly(&request).unwrap()) > 1e-3, "f32 would do");
}

/// A matrix that is singular to the digits of a scalar only may be no fault of the print.
#[test]
fn singular_by_rounding_is_not_blamed_on_the_print() {
    // A stamp 1e18 times as soft as the spring that the last triangle makes of it.
    let scene =
        square(r#"/elem/2=[3,2,2,2,2,1,3,4] /materials/1/E=1e-18 /materials/2={"E":1.0,"nu":0.3}"#);
    let request = Request::new(&scene).variant(Variant::Printed);
    let error = solve(&request, &mut |_| ()).unwrap_err();
    assert_eq!(error.exit_status().number(), 3, "{error}");
    assert!(error.to_string().contains("f64 rounds: --scalar exact"), "{error}");
    let exact = Arithmetic { scalar: ScalarName::Exact, ..Arithmetic::default() };
    assert!(solve(&request.clone().arithmetic(exact), &mut |_| ()).is_ok());
    let single = Arithmetic { scalar: ScalarName::F32, ..Arithmetic::default() };
    let error = solve(&request.clone().arithmetic(single), &mut |_| ()).unwrap_err();
    assert_eq!(error.exit_status().number(), 2, "{error}");
    assert!(error.to_string().contains("f32 cannot represent what f64 does"), "{error}");
    assert!(solve_to(&request, 1e-3).is_ok());
}

/// 6.3 · 0.35 on an edge of length 1 and a thickness of 2 is 2.205 on each end, as decimals.
#[test]
fn decimal_loads_are_multiplied_exactly() {
    let scene = square("/loads/0/pressure=6.3 /thickness=0.7");
    let request = Request::new(&scene).variant(Variant::Tied);
    let number = |x| rational::of_decimal(x).unwrap();
    let forces = plane_contact::numbers::scalar::scope(|| {
        use plane_contact::numbers::scalar::{Exact, Scalar};
        let load = request.scene.model.load_in(Exact::from_decimal);
        load.iter().map(|f| f.to_rational().unwrap()).collect::<Vec<_>>()
    });
    assert_ne!(request.scene.model.load[5], -2.205);
    assert_eq!(forces[5], -number(2.205));
    assert_eq!(forces[4], RBig::ZERO);
    // And the run takes them: it is that of a nodal load of the same size.
    let decimals =
        Arithmetic { scalar: ScalarName::Exact, inputs: Inputs::Decimal, ..Arithmetic::default() };
    let run =
        |request: &Request| solve(&request.clone().arithmetic(decimals), &mut |_| ()).unwrap();
    let at = |node: usize| format!(r#"{{"node":{node},"force":[0.0,-2.205]}}"#);
    let nodal = square(&format!("/thickness=0.7 /loads=[{},{}]", at(3), at(4)));
    let nodal = Request::new(&nodal).variant(Variant::Tied);
    assert_eq!(run(&request).digits, run(&nodal).digits);
}
