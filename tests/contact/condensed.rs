//! Which nodes the bodies are condensed to, when factors serve again, and how a solution by them is
//! refined.

use std::cell::{Cell, RefCell};
use std::collections::BTreeSet;
use std::sync::{Arc, Barrier};

use nalgebra::DVector;
use plane_contact::engine::contact::{Pairing, Surfaces};
use plane_contact::engine::fast::condensation::{
    Bodies as Condensing, Condensation, Factored, refine,
};
use plane_contact::engine::{Constraint, Elimination, Motion, Session, Stiffness};
use plane_contact::numbers::solve::{Factors, SparseCholesky};
use plane_contact::problem::element::Plane;
use plane_contact::problem::model::{Model, NodeId};
use plane_contact::problem::modelling::{ContactModel, Coupling};
use plane_contact::problem::scene::{Axis, Scene};

use crate::common::tolerances::{GAPS, assert_near};
use crate::corners::{Bodies, Writing, grid};

/// What solves nearly the equation x = f: a part of the right-hand side.
struct Part(f64);

impl Factors<f64> for Part {
    fn solve(&self, b: &DVector<f64>) -> DVector<f64> {
        self.0 * b
    }
}

const EPSILON: f64 = f64::EPSILON;

/// Refines the solution of an equation without a norm, of which 1 is the right-hand side, so that its
/// relative residual is its rest: these ones in turn, in units of epsilon. Returns the solution, the
/// last relative residual in these units, and how many rests were asked for.
fn refined(rests: &[f64]) -> (Result<[f64; 2], [f64; 2]>, usize) {
    let asked = Cell::new(0);
    let times = |_: &DVector<f64>| {
        let rest = rests[asked.replace(asked.get() + 1)];
        DVector::from_element(1, 1.0 - rest * EPSILON)
    };
    let found = refine(&Part(1.0), times, 0.0, &DVector::from_element(1, 1.0));
    let of = |(q, error): (DVector<f64>, f64)| [q[0], error / EPSILON];
    (found.map(of).map_err(of), asked.get())
}

/// Four epsilons end it; thirty-two do where a step brought less than a fifth, which otherwise is a
/// failure. Each step adds what its rest solves to.
#[test]
fn refinement_ends_where_it_brings_no_more() {
    let at = |steps: f64, error: f64| [1.0 + steps * EPSILON, error];
    assert_eq!(refined(&[4.0]), (Ok(at(0.0, 4.0)), 1));
    assert_eq!(refined(&[5.0, 1.0]), (Ok(at(5.0, 1.0)), 2));
    assert_eq!(refined(&[100.0, 30.0]), (Ok(at(100.0, 30.0)), 2));
    assert_eq!(refined(&[100.0, 32.0]), (Ok(at(100.0, 32.0)), 2));
    assert_eq!(refined(&[100.0, 18.0, 3.0]), (Ok(at(118.0, 3.0)), 3));
    // A fifth is enough to go on.
    assert_eq!(refined(&[100.0, 20.0, 3.0]), (Ok(at(120.0, 3.0)), 3));
    assert_eq!(refined(&[1000.0, 200.0, 3.0]), (Ok(at(1200.0, 3.0)), 3));
    assert_eq!(refined(&[100.0, 36.0]), (Err(at(100.0, 36.0)), 2));
    assert_eq!(refined(&[1000.0, 150.0, 31.0]), (Ok(at(1150.0, 31.0)), 3));
    assert_eq!(refined(&[1000.0, 150.0, 30.0, 5.0, 0.5]), (Ok(at(1185.0, 0.5)), 5));
}

/// Where each solution is nine tenths of the right one, the rest is a tenth of the last.
#[test]
fn refinement_solves_by_factors_of_nearly_the_right_matrix() {
    let rests = RefCell::new(Vec::new());
    let times = |q: &DVector<f64>| {
        rests.borrow_mut().push(1.0 - q[0]);
        q.clone()
    };
    let found = refine(&Part(0.9), times, 1.0, &DVector::from_element(1, 1.0));
    let (q, error) = found.expect("each step leaves a tenth");
    assert!((q[0] - 1.0).abs() <= 8.0 * EPSILON && error <= 4.0 * EPSILON);
    let rests = rests.into_inner();
    assert!(rests.len() > 10 && (rests[1] - 0.01).abs() < 1e-9, "{rests:?}");
    let far = refine(&Part(0.5), |q| q.clone(), 1.0, &DVector::from_element(1, 1.0));
    assert!(far.is_err());
    // What is infinite over what is infinite is no number.
    let infinite = DVector::from_element(1, f64::INFINITY);
    assert!(refine(&Part(1.0), |_| -&infinite, f64::INFINITY, &infinite).is_err());
}

fn two_blocks() -> Arc<Model> {
    Scene::open("two-blocks").expect("embedded").model
}

fn bound(node: NodeId, masters: &[NodeId]) -> Constraint {
    let masters = masters.iter().map(|master| (*master, 1.0)).collect();
    Constraint { node, masters, motion: Motion::Both([0.0; 2]) }
}

#[test]
fn factors_serve_the_same_bodies_alone_and_the_nodes_that_they_keep() {
    let model = two_blocks();
    let nodes: Vec<NodeId> = model.node_ids().collect();
    let kept = BTreeSet::from([nodes[6], nodes[9], nodes[10], nodes[11]]);
    let factored = Factored::new(&Stiffness::new(&model, |x| x), &model, &kept).expect("held");
    let made = Condensation::new(&Arc::new(factored), &kept).expect("held");
    assert!(made.is_of(&model) && made.is_of(&model.as_ref().clone()));
    let others: [fn(&mut Model); 5] = [
        |model| model.plane = Plane::Stress,
        |model| model.thickness *= 2.0,
        |model| model.restrained[9] ^= true,
        |model| model.nodes[4][0] += 0.01,
        |model| model.triangles[0].material.e *= 2.0,
    ];
    for (k, change) in others.iter().enumerate() {
        let mut other = model.as_ref().clone();
        change(&mut other);
        assert!(!made.is_of(&other), "change {k}");
    }
    // A load changes no stiffness.
    let mut loaded = model.as_ref().clone();
    loaded.load *= 2.0;
    assert!(made.is_of(&loaded));
    assert!(made.has(&[]) && made.has(&[bound(nodes[9], &[nodes[6]])]));
    assert!(!made.has(&[bound(nodes[9], &[nodes[6], nodes[7]])]));
    assert!(!made.has(&[bound(nodes[9], &[]), bound(nodes[12], &[])]));
}

#[test]
fn of_small_surfaces_every_node_is_kept_and_the_factors_are_shared() {
    let model = two_blocks();
    let stiffness = Stiffness::new(&model, |x| x);
    let session = Session::default();
    let bodies = Condensing::new(&model, &session);
    assert!(bodies.last().is_none());
    let made = bodies.condensed(&stiffness, &[]).expect("both blocks are held");
    let of_surfaces = model.target_edges().flat_map(|edge| edge.nodes);
    let both: BTreeSet<NodeId> = of_surfaces.chain(model.contact.nodes.iter().copied()).collect();
    assert!(made.nodes().iter().eq(&both));
    let again = bodies.condensed(&stiffness, &[]).expect("it is known");
    assert!(Arc::ptr_eq(&made, &again));
    assert!(Arc::ptr_eq(&made, &bodies.last().expect("it was made")));
    let beside = Condensing::new(&model, &session).condensed(&stiffness, &[]);
    assert!(Arc::ptr_eq(&made, &beside.expect("it is known")));
    // Other bodies have factors of their own, and leave these where they are.
    let mut other = model.as_ref().clone();
    other.thickness *= 2.0;
    let other = Arc::new(other);
    let twice = Condensing::new(&other, &session).condensed(&Stiffness::new(&other, |x| x), &[]);
    assert!(!Arc::ptr_eq(&made, &twice.expect("both blocks are held")));
    let beside = Condensing::new(&model, &session).condensed(&stiffness, &[]);
    assert!(Arc::ptr_eq(&made, &beside.expect("it is still known")));
}

#[test]
fn several_runs_that_ask_at_once_have_the_same() {
    const RUNS: usize = 8;
    let (model, session) = (two_blocks(), Session::default());
    let start = Barrier::new(RUNS);
    let made = std::thread::scope(|scope| {
        let run = || {
            let stiffness = Stiffness::new(&model, |x| x);
            start.wait();
            Condensing::new(&model, &session).condensed(&stiffness, &[]).expect("held")
        };
        let runs = [(); RUNS].map(|()| scope.spawn(run));
        runs.map(|run| run.join().expect("it ends"))
    });
    assert!(made.iter().all(|other| other.nodes() == made[0].nodes()));
    let later = Condensing::new(&model, &session).condensed(&Stiffness::new(&model, |x| x), &[]);
    assert!(made.iter().any(|made| later.as_ref().is_some_and(|later| Arc::ptr_eq(made, later))));
}

/// The bodies of `strand` are factored for both surfaces, and of these a part is kept: the displacements of
/// a state are those of the whole matrix.
#[test]
fn of_small_bodies_a_part_of_the_surfaces_is_kept_after_one_factorisation() {
    let model = Scene::open("strand").expect("embedded").model;
    let stiffness = Stiffness::new(&model, |x| x);
    let surfaces = Surfaces::new(&model).expect("a chain");
    let shapes = [0.0, 1e-3].map(|turn: f64| {
        model.nodes.iter().map(|[x, y]| [x - turn * y, y + turn * x]).collect::<Vec<_>>()
    });
    let pairings = shapes.map(|shape| surfaces.pairings(Coupling::Nts, &shape));
    let middle = model.contact.nodes.len() / 2;
    let states = pairings.map(|pairings| -> Vec<Constraint> {
        let closed = pairings[middle - 2..middle + 3].iter().flatten();
        let of = |(i, p): (usize, &Pairing)| {
            let motion =
                if i % 2 == 0 { Motion::Along(p.normal, 1e-4) } else { Motion::Both([0.0; 2]) };
            Constraint { node: p.node, masters: p.masters.clone(), motion }
        };
        closed.enumerate().map(of).collect()
    });
    assert!(states[0].len() == 5 && states[0] != states[1]);
    let bodies = Condensing::new(&model, &Session::default());
    for constraints in &states {
        let state = bodies.state(&stiffness, constraints).expect("it is held");
        let made = bodies.condensed(&stiffness, constraints).expect("it is known");
        assert!((10..80).contains(&made.nodes().len()), "{} of 133", made.nodes().len());
        let eliminated = bodies.eliminated(&state, &model.load);
        let (own, residual) = state.displacements(&eliminated).expect("it is refined");
        assert!(residual <= 32.0 * EPSILON, "{residual:e}");
        let t = Elimination::closing(&model.restrained, constraints);
        let matrix = stiffness.reduced(&t);
        let f = t.load(&(&model.load - stiffness.times(t.shift())));
        let u = t.expand(&SparseCholesky::new(matrix).expect("it is held").solve(&f));
        let free = |dof: &usize| !model.restrained[*dof];
        let kept = made.nodes().iter().flat_map(|node| node.dofs()).map(|dof| dof.index());
        let kept: Vec<f64> = kept.filter(free).map(|dof| u[dof]).collect();
        assert_eq!(kept.len(), own.len());
        for (own, whole) in own.iter().zip(&kept) {
            assert_near(
                "displacement over the largest",
                *own / u.amax(),
                *whole / u.amax(),
                1.0,
                &GAPS,
            );
        }
    }
}

/// The columns of nodes of each of two long strips.
const COLUMNS: usize = 12_900;

/// Two strips of two rows of nodes, held at every tenth node of their outer sides; the contact nodes
/// stand over the middles of the target's edges, and the gap grows along the strip.
fn strips() -> Arc<Model> {
    let row = |from: f64, y: f64, rise: f64| {
        (0..COLUMNS).map(move |k| [from + k as f64, y + rise * k as f64])
    };
    let held =
        |first: usize| (0..COLUMNS).step_by(10).map(move |k| (first + k, vec![Axis::X, Axis::Y]));
    let bodies = Bodies {
        nodes: row(0.0, -1.0, 0.0)
            .chain(row(0.0, 0.0, 0.0))
            .chain(row(0.5, 0.0, 1e-6))
            .chain(row(0.5, 1.0, 0.0))
            .collect(),
        triangles: [grid(0, COLUMNS, 2), grid(2 * COLUMNS, COLUMNS, 2)],
        moduli: [(1.0, 0.25); 2],
        contact: (2 * COLUMNS..3 * COLUMNS - 1).collect(),
        target: (COLUMNS..2 * COLUMNS - 1).map(|k| [k, k + 1]).collect(),
        restrained: held(0).chain(held(3 * COLUMNS)).collect(),
        loads: Vec::new(),
    };
    let scene = bodies.modelled(&Writing::default(), ContactModel::default()).build();
    scene.expect("a sound scene").model
}

/// Returns the places of the contact nodes and of the target nodes that are kept, in their rows.
fn kept(made: &Condensation) -> [Vec<usize>; 2] {
    let of = |first: usize| {
        let places = made.nodes().iter().map(|node| node.index());
        places.filter(|n| (first..first + COLUMNS).contains(n)).map(|n| n - first).collect()
    };
    [of(2 * COLUMNS), of(COLUMNS)]
}

/// Of 98,040 equations 0.85 √n are 266 contact nodes that are expected, and 2 √n are 626 nodes that are
/// kept at most. Beside what is bound stand 8 and a tenth of its number.
#[test]
fn of_large_surfaces_what_is_bound_or_expected_is_kept_and_its_neighbours() {
    let model = strips();
    assert_eq!(model.free_dofs(), 98_040);
    let stiffness = Stiffness::new(&model, |x| x);
    let session = Session::default();
    let pairings = Surfaces::new(&model).expect("a chain").pairings(Coupling::Nts, &model.nodes);
    let constraints = |entries: std::ops::Range<usize>| -> Vec<Constraint> {
        let pairings = pairings[entries].iter().flatten();
        let masters = |masters: &[(NodeId, f64)]| masters.iter().map(|m| m.0).collect::<Vec<_>>();
        pairings.map(|p| bound(p.node, &masters(&p.masters))).collect()
    };
    let made = |bodies: &Condensing, entries| {
        bodies.condensed(&stiffness, &constraints(entries)).map(|made| kept(&made))
    };
    let all = |end: usize| (0..end).collect::<Vec<usize>>();
    let expecting = || Condensing::new(&model, &session).expecting(&pairings);
    let bodies = expecting();
    // 266 + 8 + 26, and of the target 267 + 8 + 26.
    assert_eq!(made(&bodies, 0..0), Some([all(300), all(301)]));
    // What was expected is kept once.
    let beside = [991..1019, 991..1020].map(Vec::from_iter);
    assert_eq!(made(&bodies, 1000..1010), Some(beside));
    // With ten more nodes far from them there would be 764: of what is expected, only the nearer half.
    let nearer = |end: usize, beside: std::ops::Range<usize>| all(end).into_iter().chain(beside);
    let found = made(&expecting(), 5000..5010).expect("it is few enough");
    let by_hand = [nearer(133 + 22, 4978..5032), nearer(134 + 22, 4978..5033)];
    assert_eq!(found, by_hand.map(Vec::from_iter));
    // Those of 277 contact nodes are 625, and those of 278 too many.
    let alone = || Condensing::new(&model, &session);
    assert_eq!(made(&alone(), 0..277), Some([all(277 + 35), all(278 + 35)]));
    assert_eq!(made(&alone(), 0..278), None);
    let mut one_more = constraints(0..277);
    one_more[0].masters.extend(&constraints(277..278)[0].masters);
    let made = alone().condensed(&stiffness, &one_more).expect("626 are not too many");
    assert_eq!(made.nodes().len(), 626);
}
