//! What rounding does under `unilateral`, measured by runs whose inputs differ in their last digits.

use crate::decisions::block_and_stamp;
use plane_contact::engine::estimates::{Perturbed, perturbed};
use plane_contact::engine::{Margin, NearestDecision, Request, solve};
use plane_contact::problem::model::NodeId;
use plane_contact::problem::modelling::Variant;
use plane_contact::problem::scene::Scene;
use serde_json::json;

fn measured(request: &Request) -> Perturbed {
    let solution = solve(request, &mut |_| ()).expect("there is an equilibrium");
    let found = perturbed(&solution).expect("it is unilateral");
    assert_eq!(perturbed(&solution).as_ref(), Some(&found), "the same each time");
    found
}

/// The solutions that an audit rests on. Their displacements are a thousandth of their size, so that the last
/// digit of a coordinate is that of the thirteenth digit of a displacement.
#[test]
fn rounding_decides_nothing_in_the_references() {
    for name in ["strand", "two-blocks"] {
        let request = Request::new(&Scene::open(name).unwrap());
        for request in [request.reference(), request.equilibrium()] {
            let Perturbed { runs, failures, other_steps, contact, displacement, stress } =
                measured(&request);
            assert_eq!((runs, failures.len(), other_steps, contact), (3, 0, 0, None), "{name}");
            for part in [displacement, stress] {
                let part = part.expect("the runs have a result");
                assert!(0.0 < part && part < 1e-9, "{name}: {part:e}");
            }
        }
    }
}

/// In fig1 nodes overlap, and whether they close before any load turns on the last digit.
#[test]
fn a_path_that_turns_on_the_last_digit_is_found() {
    let request = Request::new(&Scene::open("fig1").unwrap()).equilibrium();
    let found = measured(&request);
    assert!(found.other_steps > 0 && found.displacement > Some(1e-6), "{found:?}");
}

/// The contact node rests past the target's end as far as 5 % of its edge. Where it stands at that limit, its
/// last digit decides whether it faces the target.
#[test]
fn a_node_at_the_limit_of_what_it_faces_is_found() {
    let contact = json!({
        "cnt": [5], "trg": [1], "c_tll": 0.1, "friction": 0, "geometry": "initial"
    });
    let request = |x: f64| {
        let stamp = [[x, 0.0], [2.0, 1.0], [0.0, 1.0]];
        block_and_stamp(stamp, &contact, Variant::Unilateral)
    };
    let faces = |x: f64| {
        let solution = solve(&request(x), &mut |_| ()).expect("the stamp is held");
        solution.in_contact().count() == 1
    };
    let (mut near, mut far) = (1.04_f64, 1.06_f64);
    assert!(faces(near) && !faces(far));
    assert_eq!(measured(&request(near)).contact, None);
    while near.next_up() < far {
        let middle = f64::midpoint(near, far);
        if faces(middle) { near = middle } else { far = middle }
    }
    // The random numbers are the same: what they push over the limit from one side they do not from the other.
    let mut at_the_limit = [near, far].map(|x| measured(&request(x))).into_iter();
    let at_the_limit = at_the_limit.find(|found| found.contact.is_some());
    let at_the_limit = at_the_limit.expect("it faces the target or not");
    let change = at_the_limit.contact.expect("it was looked for");
    assert_eq!((change.node.number(), change.load, change.nodes), (5, 1.0, 1));
    assert!(at_the_limit.displacement > Some(0.01), "{:?}", at_the_limit.displacement);
}

#[test]
fn the_paper_s_variants_have_bounds_in_its_place() {
    let request = Request::new(&Scene::open("two-blocks").unwrap()).variant(Variant::Tied);
    assert_eq!(perturbed(&solve(&request, &mut |_| ()).expect("it runs")), None);
}

/// A pressure on two blocks of three nodes each: the middle node carries half, each end a quarter.
#[test]
fn the_nearest_decision_is_the_least_force() {
    let request = Request::new(&Scene::open("two-blocks").unwrap()).reference();
    let solution = solve(&request, &mut |_| ()).expect("there is an equilibrium");
    let found =
        solution.equilibrium.and_then(|found| found.nearest).expect("nodes face the target");
    let NearestDecision { node, of, relative } = found;
    assert_eq!((node, of), (NodeId::from_number(10), Margin::Force));
    assert!((relative - 0.5).abs() < 1e-9, "{relative}");
}
