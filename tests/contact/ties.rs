//! What rounding may decide under `unilateral`.

use nalgebra::DVector;
use plane_contact::engine::contact::Status;
use plane_contact::engine::estimates::arithmetic::bounded;
use plane_contact::engine::estimates::ties::{BoundedState, StateCheck};
use plane_contact::engine::{Choice, Detail, Solution, Step, Unilateral};
use plane_contact::numbers::scalar::{Bounded, Scalar};
use plane_contact::problem::modelling::{ContactModel, Friction};

use crate::corners::{Bodies, Writing, blocks, roof};
use crate::unilateral::solved;

/// Returns an equilibrium of `bodies`; None where there is none.
fn equilibrium(bodies: &Bodies, contact: ContactModel) -> Option<Solution> {
    solved(&bodies.modelled(&Writing::default(), contact)).ok()
}

fn own(step: &mut Step) -> &mut Unilateral {
    match &mut step.detail {
        Detail::Unilateral(own) => own,
        Detail::Published(_) => unreachable!("unilateral was asked for"),
    }
}

/// The same step as the first of a run, after which a node lies deep in the target.
fn first(step: &Step, violation: f64) -> Step {
    let mut step = Step { k: 1, ..step.clone() };
    own(&mut step).violation = violation;
    step
}

/// The nodes of a block, all open, are 1e-3 lower, which is known within 2e-3: the middle one in
/// the apex of a roof. The first iteration closes what lies beyond nine tenths of the deepest
/// penetration, where that is more than rounding may be.
#[test]
fn a_penetration_that_rounding_may_be_closes_nothing() {
    let contact = ContactModel { friction: Friction::NONE, ..ContactModel::default() };
    let mut solution = equilibrium(&roof(1.0, 0.0), contact).expect("an equilibrium");
    let lower = |dof: usize| if dof >= 8 && dof % 2 == 1 { -1e-3 } else { 0.0 };
    let u = DVector::from_fn(solution.u.len(), |dof, _| Bounded::new(lower(dof), 1e-3));
    let mut left = |violation: f64| {
        solution.steps = vec![first(solution.last(), violation)];
        own(&mut solution.steps[0]).statuses.fill(Status::Open);
        let stiffness = bounded(&solution.model);
        let mut check = StateCheck::new(&solution, &stiffness);
        let load = solution.model.load.map(Bounded::from_f64);
        check.check(&BoundedState { step: solution.last(), load, before: &u, u: &u });
        check.decisions.swap_remove(0)
    };
    let touching = left(0.0);
    assert_eq!(touching.condition, "touches without force: gap > 0");
    let bound = touching.bound.expect("places are known within bounds");
    let from = bound / 0.9;
    let near = [from.next_down(), from, from.next_up()];
    let limit = near.into_iter().find(|deepest| 0.9 * deepest == bound).expect("a float between");
    assert_eq!(left(limit), touching);
    assert_eq!(left(1.01 * limit).condition, "gap > -0.9 of the deepest penetration");
}

/// Where the active set alone did not lead to a contact state, rounding may decide which one is found:
/// under friction by other ways and by halved steps, and always on springs.
#[test]
fn contact_states_that_the_active_set_does_not_find_are_told() {
    let with = |friction: f64, halved: usize, choice: Choice, springs: f64| {
        let friction = Friction::new(friction).unwrap();
        let contact = ContactModel { friction, load_steps: 2, ..ContactModel::default() };
        let mut solution = equilibrium(&blocks(), contact).expect("an equilibrium");
        for step in &mut solution.steps {
            (own(step).choice, own(step).springs) = (Choice::Asked, 0.0);
        }
        let mut first = solution.last().clone();
        (own(&mut first).choice, own(&mut first).springs) = (choice, springs);
        solution.steps.insert(0, first);
        let path = &mut solution.equilibrium.as_mut().expect("an equilibrium").path;
        path.iter_mut().for_each(|path| path.halved = halved);
        let stiffness = bounded(&solution.model);
        let mut check = StateCheck::new(&solution, &stiffness);
        check.check_searches();
        assert_eq!(check.decisions.is_empty(), check.only_ties);
        check.decisions.len()
    };
    assert_eq!(with(0.2, 0, Choice::Asked, 0.0), 0);
    assert_eq!(with(0.2, 0, Choice::Bounds, 0.0), 1);
    assert_eq!(with(0.2, 0, Choice::Enumerated, 0.0), 1);
    assert_eq!(with(0.2, 1, Choice::Asked, 0.0), 1);
    assert_eq!(with(0.0, 1, Choice::Bounds, 0.0), 0);
    assert_eq!(with(0.0, 0, Choice::Asked, 1e-3), 1);
    assert_eq!(with(f64::INFINITY, 1, Choice::Bounds, 0.0), 0);
}
