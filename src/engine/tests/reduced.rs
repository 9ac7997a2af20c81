//! The stiffness reduced to the contact surfaces: states on it are those of the whole equations.

use std::sync::Arc;

use engine::contact::{Pairing, Surfaces};
use engine::held::{Held, Loaded};
use engine::linear::{Factors, SparseCholesky};
use engine::reduction::Reduction;
use engine::{Constraint, Elimination, Motion, Stiffness};
use nalgebra::DVector;
use problem::model::{Holds, Model, NodeId};
use problem::modelling::{ContactModel, Coupling};
use problem::scene::Axis;

use testing::bodies::{Bodies, Writing, grid};
use testing::tolerances::assert_near;

testing::tolerances! {
    /// Displacements by the stiffness reduced to the surfaces beside those by the whole, over the largest.
    REDUCED = 1e-10, "both leave a few epsilons of their residuals, times a condition number of some 1e4";
}

const BOTH: &[Axis] = &[Axis::X, Axis::Y];

/// `n` nodes below and on top of a held block; as many of one that stands over it, of which some are
/// `restrained` and the lower ones are the contact nodes.
fn blocks(n: usize, restrained: &[(usize, &[Axis])]) -> Arc<Model> {
    let row = |x: f64, y: f64| (0..n).map(move |k| [x + k as f64, y]);
    let bodies = Bodies {
        nodes: row(0.0, -1.0)
            .chain(row(0.0, 0.0))
            .chain(row(-0.4, 0.1))
            .chain(row(-0.4, 1.1))
            .collect(),
        triangles: [grid(0, n, 2), grid(2 * n, n, 2)],
        moduli: [(1.0, 0.25), (3.0, 0.1)],
        contact: (2 * n..3 * n).collect(),
        target: (0..n - 1).map(|k| [n + k, n + k + 1]).collect(),
        restrained: (0..n)
            .map(|k| (k, BOTH.to_vec()))
            .chain(restrained.iter().map(|(node, axes)| (*node, axes.to_vec())))
            .collect(),
        loads: Vec::new(),
    };
    let scene = bodies.modelled(&Writing::default(), ContactModel::default()).build();
    scene.expect("a sound scene").model
}

fn pairings(model: &Arc<Model>) -> Vec<Option<Pairing>> {
    Surfaces::new(model).expect("a chain").pairings(Coupling::Nts, &model.nodes)
}

/// The constraints that close entries, and those that stick them, by a shift of their own.
fn constraints(pairings: &[Option<Pairing>], closed: &[usize], stuck: &[usize]) -> Vec<Constraint> {
    let of = |i: usize, motion: fn(&Pairing, f64) -> Motion| {
        let pairing = pairings[i].as_ref().expect("it faces the target");
        let motion = motion(pairing, 0.01 * (i as f64 + 1.0));
        Constraint { node: pairing.node, masters: pairing.masters.clone(), motion }
    };
    let along = closed.iter().map(|i| of(*i, |p, s| Motion::Along(p.normal, -s)));
    along.chain(stuck.iter().map(|i| of(*i, |_, s| Motion::Both([s, -2.0 * s])))).collect()
}

/// Compares displacements, the forces of contact and responses with those of the whole equations.
fn is_as_the_whole(model: &Arc<Model>, pairings: &[Option<Pairing>], constraints: &[Constraint]) {
    let stiffness = Stiffness::new(model, |x| x);
    let reduction = Reduction::new(&stiffness, model, pairings).expect("the surfaces hold it");
    let t = Elimination::closing(&model.holds, 1.0, constraints);
    let factors = SparseCholesky::new(&stiffness.reduced(&t)).expect("the bodies are held");
    let near = |what: &str, own: &DVector<f64>, whole: &DVector<f64>| {
        assert!(whole.amax() > 1e-3, "{what}");
        for (own, other) in own.iter().zip(whole) {
            assert_near(what, *own, *other, whole.amax(), &REDUCED);
        }
    };
    let on_surface = |all: &DVector<f64>| {
        let nodes = model.contact.nodes.iter().flat_map(|node| node.dofs());
        let free = nodes.filter(|dof| !model.is_restrained(*dof));
        DVector::from_vec(free.map(|dof| all[dof.index()]).collect())
    };
    for seed in 1..4 {
        let load = |e: usize| ((e * e + 3 * e) % (7 + seed)) as f64 - 3.0;
        let load = DVector::from_fn(model.dofs(), |e, _| load(e));
        let rub = &constraints[0];
        let mut more = DVector::zeros(model.dofs());
        more[rub.node.dofs()[0].index()] = 1.5;
        rub.masters.iter().for_each(|(node, w)| more[node.dofs()[0].index()] = -1.5 * w);
        let reduced = reduction.eliminated(&load);
        let bodies = Loaded { model, stiffness: &stiffness, load: &load };
        let held = || Held::reduced(bodies, (&reduction, &reduced), constraints).expect("it is");
        let (state, of_all) = (held(), held().of_all());
        let all = Held::new(bodies, constraints, 1.0).ok().expect("the bodies are held");
        let (own, _) = state.displacements(&more).expect("it has its digits");
        let f = &load + &more - stiffness.times(t.shift());
        let whole = t.expand(&factors.solve(&t.load(&f)));
        near("displacement", &own, &whole);
        for held in [&of_all, &all] {
            let (refined, residual) = held.displacements(&more).expect("so");
            near("refined displacement", &refined, &whole);
            assert!(residual < 1e-14, "{residual:e}");
        }
        let reaction = stiffness.times(&whole) - &load;
        for held in [&state, &of_all, &all] {
            near("force", &on_surface(&held.reaction(&own)), &on_surface(&reaction));
        }
        let moved = t.motion(&factors.solve(&t.load(&more)));
        for held in [&state, &of_all, &all] {
            let own = &held.responses(std::slice::from_ref(&more))[0];
            near("response", &on_surface(own), &on_surface(&(stiffness.times(&moved) - &more)));
        }
    }
}

#[test]
fn states_on_the_surfaces_are_those_of_the_whole() {
    let (x, y) = (&[Axis::X][..], &[Axis::Y][..]);
    // Free but for contact; guided; held; and with restrained contact nodes.
    let held: [&[(usize, &[Axis])]; 4] =
        [&[], &[(15, x)], &[(12, BOTH), (15, y)], &[(8, x), (11, BOTH)]];
    for restrained in held {
        let model = blocks(4, restrained);
        let pairings = pairings(&model);
        for (closed, stuck) in [(&[][..], &[1, 2][..]), (&[1], &[2, 3]), (&[2, 3], &[1])] {
            is_as_the_whole(&model, &pairings, &constraints(&pairings, closed, stuck));
        }
    }
}

/// Of 700 nodes of both surfaces the 400 about the least gaps are kept: a state that binds others is left
/// to the whole equations, as is one in which nothing holds a body.
#[test]
fn of_large_surfaces_the_nodes_near_the_contact_are_kept() {
    let guided: Vec<(usize, &[Axis])> = (1050..1400).map(|k| (k, &[Axis::Y][..])).collect();
    let model = blocks(350, &guided);
    let mut pairings = pairings(&model);
    pairings.iter_mut().flatten().for_each(|pairing| {
        // The last of them are the nearest.
        pairing.gap = 400.0 - pairing.node.index() as f64;
    });
    is_as_the_whole(&model, &pairings, &constraints(&pairings, &[300], &[310, 340]));
    let stiffness = Stiffness::new(&model, |x| x);
    let reduction = Reduction::new(&stiffness, &model, &pairings).expect("the surfaces hold it");
    let load = DVector::zeros(model.dofs());
    let bodies = Loaded { model: &model, stiffness: &stiffness, load: &load };
    let is_reduced = |closed: &[usize], stuck: &[usize]| {
        let by = (&reduction, &reduction.eliminated(&load));
        Held::reduced(bodies, by, &constraints(&pairings, closed, stuck)).is_some()
    };
    assert!(is_reduced(&[], &[300, 301]));
    assert!(!is_reduced(&[], &[20, 301]), "node 20 is not kept");
    assert!(!is_reduced(&[300, 301], &[]), "it slides away");
}

/// A node that is bound twice would leave an empty column, which reads as a singular matrix.
#[test]
#[should_panic(expected = "node 1 is bound once")]
fn a_node_is_bound_once() {
    let node = NodeId::new(0);
    let constraint = Constraint { node, masters: Vec::new(), motion: Motion::Both([0.0; 2]) };
    Elimination::new(&Holds::new(1, Vec::new()), &[constraint.clone(), constraint]);
}
