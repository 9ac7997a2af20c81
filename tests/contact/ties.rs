//! What rounding may decide under `unilateral`, looked at with displacements that are known much
//! worse than those of a run: every condition then has its margin and its bound, which are recorded.

use fastrand::Rng;
use nalgebra::DVector;
use plane_contact::engine::Decision;
use plane_contact::engine::contact::Status;
use plane_contact::engine::estimates::arithmetic::bounded;
use plane_contact::engine::estimates::ties::{BoundedState, StateCheck};
use plane_contact::engine::{Choice, Detail, Solution, Step, Unilateral};
use plane_contact::numbers::scalar::{Bounded, Scalar};
use plane_contact::problem::modelling::{ContactModel, Friction};
use plane_contact::problem::scene::Axis;
use serde_json::{Value, json};

use crate::common::draws::one_of;
use crate::common::recorded::{RECORDED_COUPLINGS, RECORDED_GEOMETRIES, assert_recorded};
use crate::corners::{Bodies, Writing, blocks, roof};
use crate::drawn::{KINDS, draw};
use crate::recorded::{folded, regular};
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

fn model(rng: &mut Rng) -> ContactModel {
    ContactModel {
        coupling: one_of(rng, &RECORDED_COUPLINGS),
        friction: Friction::new(one_of(rng, &[0.0, 0.2, 1.0, f64::INFINITY])).unwrap(),
        geometry: one_of(rng, &RECORDED_GEOMETRIES),
        load_steps: one_of(rng, &[1, 3]),
        ..ContactModel::default()
    }
}

/// Looks at a step as if it had ended with the displacements of the whole run, which were known within
/// `part` of the largest, and half of which were there before.
fn looked_at(solution: &Solution, step: &Step, part: f64) -> (Vec<Decision>, bool) {
    let Detail::Unilateral(detail) = &step.detail else { panic!("an equilibrium") };
    let error = part * solution.u.amax();
    let [before, u] = [0.5, 1.0].map(|scale| solution.u.map(|u| Bounded::new(scale * u, error)));
    let stiffness = bounded(&solution.model);
    let mut check = StateCheck::new(solution, &stiffness);
    let load = solution.model.load_after(detail.load).map(Bounded::from_f64);
    check.check(&BoundedState { step, load, before: &before, u: &u });
    (check.decisions, check.only_ties)
}

/// Returns every decision of which the sign or the part of the target is left open.
fn left_open(solution: &Solution, step: &Step) -> Vec<Value> {
    let within = |part: f64| {
        let (decisions, only_ties) = looked_at(solution, step, part);
        decisions.into_iter().map(move |decision| {
            json!({
                "node": decision.node.index(),
                "condition": decision.condition,
                "margin": decision.margin,
                "within": decision.bound,
                "only_ties": only_ties,
            })
        })
    };
    [1e-3, 0.03, 0.3].into_iter().flat_map(within).collect()
}

/// The same step as the first of a run, after which a node lies deep in the target.
fn first(step: &Step, violation: f64) -> Step {
    let mut step = Step { k: 1, ..step.clone() };
    own(&mut step).violation = violation;
    step
}

/// Records what every step of random runs leaves open. A contact node is loaded; one is restrained
/// along x or along y, or none is.
fn record(name: &str, seed: u64) {
    let mut rng = Rng::with_seed(72 + seed);
    let mut text = String::new();
    for k in 0..16 {
        let bodies =
            if rng.bool() { regular(&mut rng) } else { draw(&mut rng, KINDS[k % 8]).bodies };
        let contact = model(&mut rng);
        let writing = Writing { turns: k / 4 % 2, ..Writing::default() };
        let [loaded, held] = [0; 2].map(|_| one_of(&mut rng, &bodies.contact) + 1);
        let force = writing.vector([3.0, -2.0]);
        let scene = bodies.modelled(&writing, contact).force(loaded, force);
        let scene = match k % 4 {
            0 => scene.restrain_node(held, &[Axis::X]),
            1 => scene.restrain_node(held, &[Axis::Y]),
            _ => scene,
        };
        let Ok(solution) = solved(&scene) else { continue };
        let last = first(solution.last(), solution.u.amax());
        let steps = solution.steps.iter().chain([&last]);
        let all: Vec<Value> = steps.flat_map(|step| left_open(&solution, step)).collect();
        let ContactModel { coupling, friction, geometry, .. } = contact;
        text += &format!("{coupling} {friction} {geometry}{}\n", folded(&all.into()));
    }
    assert_recorded(name, &text);
}

macro_rules! recorded {
    ($($name:ident $seed:literal)+) => {
        $(
            #[test]
            fn $name() {
                record(concat!("ties-", $seed), $seed);
            }
        )+
    };
}

recorded! {
    what_first_runs_leave_open 1
    what_second_runs_leave_open 2
    what_third_runs_leave_open 3
    what_fourth_runs_leave_open 4
    what_fifth_runs_leave_open 5
    what_sixth_runs_leave_open 6
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

/// A step is far from other decisions where its forces are, its nodes face what they would also face a
/// little elsewhere, and friction rests on no force that restraints share; never the first one.
#[test]
fn steps_that_are_far_from_other_decisions() {
    let mut rng = Rng::with_seed(72);
    let mut text = String::new();
    for _ in 0..24 {
        let contact = model(&mut rng);
        let Some(mut solution) = equilibrium(&regular(&mut rng), contact) else { continue };
        let stiffness = bounded(&solution.model);
        let mut is_far = |k: usize, margin: f64, shared: bool, displacement: f64| {
            let mut step = solution.last().clone();
            (step.k, step.max_displacement) = (k, displacement);
            let own = own(&mut step);
            (own.margin, own.undetermined[0]) = (margin, shared);
            solution.steps = vec![step];
            StateCheck::new(&solution, &stiffness).are_far(&solution.steps)[0]
        };
        let cases = [
            (1, 1.0, false, 0.0),
            (2, 1.0, false, 0.0),
            (2, 1e-6, false, 0.0),
            (2, 1e-7, false, 0.0),
            (2, 1.0, true, 0.0),
            (2, 1.0, false, 1e-3),
            (2, 1.0, false, 1e3),
            (2, 1.0, false, 2e5),
            (2, 1.0, false, 4e6),
        ];
        let far = cases.map(|(k, margin, shared, moved)| is_far(k, margin, shared, moved));
        assert!(!far[0] && !far[2] && !far[3], "{contact:?}");
        let ContactModel { coupling, friction, geometry, .. } = contact;
        text += &format!("{coupling} {friction} {geometry} {far:?}\n");
    }
    assert_recorded("far-steps", &text);
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
