//! What rounding does, measured by runs whose inputs differ in their last digits.

use crate::decisions::block_and_stamp;
use engine::estimates::{Perturbed, When, perturbed};
use engine::{Margin, NearestDecision, Request, last_under_each_load, solve};
use problem::model::NodeId;
use problem::modelling::Variant;
use problem::scene::Scene;

fn measured(request: &Request) -> Perturbed {
    let solution = solve(request, &mut |_| ()).expect("there is an equilibrium");
    let found = perturbed(&solution).expect("it is rounded");
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
            let Perturbed { runs, failures, other_steps, contact, displacement, stress, .. } =
                measured(&request);
            assert_eq!((runs, failures.len(), other_steps, contact), (3, 0, 0, None), "{name}");
            for part in [displacement, stress] {
                let part = part.expect("the runs have a result");
                assert!(0.0 < part && part < 1e-9, "{name}: {part:e}");
            }
        }
    }
}

/// In the first step the node sticks from the start of it where that presses it. Where it pulls, and the open node
/// penetrates, the step is divided, and slip counts from later on: at the limit the last digit decides.
#[test]
fn a_path_that_turns_on_the_last_digit_is_found() {
    let request = |gap: f64| {
        let contact = "coupling=nts friction=stick geometry=initial load_steps=2 /node/5/2=1.5";
        block_and_stamp(&format!("{contact} /node/4/2={gap:?}"), Variant::Unilateral)
    };
    let divides = |gap: f64| {
        let solution = solve(&request(gap), &mut |_| ()).expect("the stamp is held");
        last_under_each_load(&solution.steps).len() > 2
    };
    let (near, far) = last_digits_between(0.01, 0.03, |gap| !divides(gap));
    let at_the_limit = [near, far].map(|gap| measured(&request(gap))).into_iter();
    let at_the_limit = at_the_limit.max_by_key(|found| found.other_steps).expect("two runs");
    assert!(at_the_limit.other_steps > 0, "{at_the_limit:?}");
    assert!(at_the_limit.displacement > Some(1e-6), "{at_the_limit:?}");
}

/// Returns the last number of a range of which something holds, and the next one.
fn last_digits_between(mut near: f64, mut far: f64, holds: impl Fn(f64) -> bool) -> (f64, f64) {
    assert!(holds(near) && !holds(far));
    while near.next_up() < far {
        let middle = f64::midpoint(near, far);
        if holds(middle) { near = middle } else { far = middle }
    }
    (near, far)
}

/// The contact node rests past the target's end as far as 5 % of its edge. Where it stands at that limit, its
/// last digit decides whether it faces the target.
#[test]
fn a_node_at_the_limit_of_what_it_faces_is_found() {
    let request = |x: f64| {
        let contact = "coupling=nts friction=0 geometry=initial /node/4/2=0.0";
        block_and_stamp(&format!("{contact} /node/4/1={x:?}"), Variant::Unilateral)
    };
    let faces = |x: f64| {
        let solution = solve(&request(x), &mut |_| ()).expect("the stamp is held");
        solution.in_contact().count() == 1
    };
    assert_eq!(measured(&request(1.04)).contact, None);
    let (near, far) = last_digits_between(1.04, 1.06, faces);
    // The random numbers are the same: what they push over the limit from one side they do not from the other.
    let mut at_the_limit = [near, far].map(|x| measured(&request(x))).into_iter();
    let at_the_limit = at_the_limit.find(|found| found.contact.is_some());
    let at_the_limit = at_the_limit.expect("it faces the target or not");
    let change = at_the_limit.contact.expect("it was looked for");
    assert_eq!((change.node.number(), change.when, change.nodes), (5, When::Load(1.0), 1));
    assert!(at_the_limit.displacement > Some(0.01), "{:?}", at_the_limit.displacement);
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
