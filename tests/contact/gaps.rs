//! Contact states in terms of gaps and slips: which ones can be, and that their displacements are those
//! by elimination.

use std::sync::Arc;

use nalgebra::DVector;
use plane_contact::engine::contact::{Pairing, Surfaces};
use plane_contact::engine::fast::condensation::{Bodies as Condensing, Gaps};
use plane_contact::engine::{Constraint, Motion, Session, Stiffness};
use plane_contact::problem::model::{Model, NodeId};
use plane_contact::problem::modelling::{ContactModel, Coupling};
use plane_contact::problem::scene::Axis;

use crate::common::tolerances::{GAPS, assert_near};
use crate::corners::{Bodies, Writing, grid};

const Y: &[Axis] = &[Axis::Y];
const BOTH: &[Axis] = &[Axis::X, Axis::Y];

/// Nodes 0 to 3 below and 4 to 7 on top of a held block; 8 to 10 below, the contact nodes, and 11 to 13 on
/// top of one that stands over it, of which some are `restrained`.
fn blocks(restrained: &[(usize, &[Axis])]) -> Arc<Model> {
    let row = |count: usize, x: f64, y: f64| (0..count).map(move |k| [x + k as f64, y]);
    let bodies = Bodies {
        nodes: row(4, 0.0, -1.0)
            .chain(row(4, 0.0, 0.0))
            .chain(row(3, 0.6, 0.1))
            .chain(row(3, 0.6, 1.1))
            .collect(),
        triangles: [grid(0, 4, 2), grid(8, 3, 2)],
        moduli: [(1.0, 0.25), (3.0, 0.1)],
        contact: vec![8, 9, 10],
        target: vec![[4, 5], [5, 6], [6, 7]],
        restrained: (0..4)
            .map(|n| (n, BOTH.to_vec()))
            .chain(restrained.iter().map(|(n, axes)| (*n, axes.to_vec())))
            .collect(),
        loads: Vec::new(),
    };
    let scene = bodies.modelled(&Writing::default(), ContactModel::default()).build();
    scene.expect("a sound scene").model
}

fn pairings(model: &Arc<Model>) -> Vec<Option<Pairing>> {
    Surfaces::new(model).expect("a chain").pairings(Coupling::Nts, &model.nodes)
}

/// Each node turned to a normal of its own.
fn turned(model: &Arc<Model>, normals: [[f64; 2]; 3]) -> Vec<Option<Pairing>> {
    let of = |(pairing, normal): (Option<Pairing>, _)| pairing.map(|p| Pairing { normal, ..p });
    pairings(model).into_iter().zip(normals).map(of).collect()
}

/// The constraints that close an entry, or stick it: by a shift of its own.
fn closing(pairings: &[Option<Pairing>], closed: &[usize], sticking: &[usize]) -> Vec<Constraint> {
    let constraint = |i: usize, motion: fn(&Pairing, f64) -> Motion| {
        let pairing = pairings[i].as_ref().expect("it faces the target");
        let motion = motion(pairing, 0.01 * (i as f64 + 1.0));
        Constraint { node: pairing.node, masters: pairing.masters.clone(), motion }
    };
    let along = closed.iter().map(|i| constraint(*i, |p, s| Motion::Along(p.normal, -s)));
    let both = sticking.iter().map(|i| constraint(*i, |_, s| Motion::Both([s, -2.0 * s])));
    along.chain(both).collect()
}

/// Returns whether a state can be in terms of gaps and slips; either way its displacements are those by
/// elimination. None where neither can be.
fn in_gaps(
    model: &Arc<Model>,
    pairings: &[Option<Pairing>],
    sticks: bool,
    constraints: &[Constraint],
) -> Option<bool> {
    let stiffness = Stiffness::new(model, |x| x);
    let new = || Condensing::new(model, &Session::default());
    let (plain, facing) = (new(), new().with_gaps(pairings, sticks));
    let condensed = facing.condensed(&stiffness, constraints).expect("its target is held");
    let gaps = Gaps::new(&condensed, pairings, sticks).map(Arc::new);
    let is_held = gaps.is_some_and(|gaps| gaps.factor(constraints).is_some());
    let Some(plain_state) = plain.state(&stiffness, constraints) else {
        assert!(!is_held && facing.state(&stiffness, constraints).is_none());
        return None;
    };
    let state = facing.state(&stiffness, constraints).expect("it is held by elimination");
    for seed in 1..4 {
        let load = |e: usize| ((e * e + 3 * e) % (7 + seed)) as f64 - 3.0;
        let load = DVector::from_fn(model.dofs(), |e, _| if e < 8 { 0.0 } else { load(e) });
        let u = |bodies: &Condensing, state| {
            let eliminated = bodies.eliminated(state, &load);
            state.displacements(&eliminated).expect("it is refined").0
        };
        let (own, other) = (u(&facing, &state), u(&plain, &plain_state));
        assert!(other.amax() > 0.01);
        for (own, other) in own.iter().zip(&other) {
            assert_near("displacement", *own, *other, other.abs().max(1.0), &GAPS);
        }
    }
    Some(is_held)
}

/// Normals off the axes, of either side, and of either sign.
const SLANTED: [[f64; 2]; 3] = [[0.6, 0.8], [-0.8, 0.6], [0.28, -0.96]];

#[test]
fn states_of_free_nodes_are_in_gaps_and_slips() {
    let model = blocks(&[(11, BOTH), (13, Y)]);
    for pairings in [pairings(&model), turned(&model, SLANTED)] {
        let all = |sticks, closed: &[usize], sticking: &[usize]| {
            in_gaps(&model, &pairings, sticks, &closing(&pairings, closed, sticking))
        };
        for closed in [&[][..], &[0], &[1], &[2], &[0, 2], &[0, 1, 2]] {
            assert_eq!(all(false, closed, &[]), Some(true));
            assert_eq!(all(true, closed, &[]), Some(true));
            assert_eq!(all(true, &[], closed), Some(true));
            // No slip is a column of its own where none may stick.
            assert_eq!(all(false, &[], closed), Some(closed.is_empty()));
        }
        assert_eq!(all(true, &[1], &[0, 2]), Some(true));
    }
}

/// A block that hangs on nothing is held by the contact that a state imposes.
#[test]
fn a_block_that_only_contact_holds_is_held_by_its_states_alone() {
    let model = blocks(&[]);
    let pairings = turned(&model, SLANTED);
    let state = |sticks, closed: &[usize], sticking: &[usize]| {
        in_gaps(&model, &pairings, sticks, &closing(&pairings, closed, sticking))
    };
    assert_eq!(state(false, &[0, 1, 2], &[]), Some(true));
    assert_eq!(state(true, &[0, 1, 2], &[]), Some(true));
    assert_eq!(state(true, &[], &[0, 2]), Some(true));
    assert_eq!(state(true, &[2], &[1]), Some(true));
    assert_eq!(state(true, &[], &[1]), None);
    assert_eq!(state(false, &[0, 1], &[]), None);
    assert_eq!(state(true, &[], &[]), None);
    // Upright normals leave it free to slide, whatever the state.
    let upright = self::pairings(&model);
    let all = closing(&upright, &[0, 1, 2], &[]);
    assert_eq!(in_gaps(&model, &upright, false, &all), None);
    assert_eq!(in_gaps(&model, &upright, true, &all), None);
    assert_eq!(in_gaps(&model, &upright, true, &closing(&upright, &[0], &[1, 2])), Some(true));
}

/// A node with one free motion has its gap in it, where that is more than a half of it.
#[test]
fn a_node_that_one_restraint_leaves_a_motion_is_held_along_it() {
    let with = |axis: Axis, normal: [f64; 2]| {
        let model = blocks(&[(11, BOTH), (12, BOTH), (9, &[axis])]);
        let pairings = turned(&model, [SLANTED[0], normal, SLANTED[2]]);
        [(true, &[1][..], &[][..]), (false, &[0, 1], &[]), (true, &[0], &[1]), (true, &[0], &[2])]
            .map(|(sticks, closed, sticking)| {
                in_gaps(&model, &pairings, sticks, &closing(&pairings, closed, sticking))
            })
    };
    let [yes, no] = [true, false].map(Some);
    assert_eq!(with(Axis::X, [0.6, 0.8]), [yes, yes, no, yes]);
    assert_eq!(with(Axis::X, [-0.6, -0.8]), [yes, yes, no, yes]);
    assert_eq!(with(Axis::Y, [0.6, 0.8]), [yes, yes, no, yes]);
    // At just a half: the other component is rounded.
    let other = 0.75_f64.sqrt();
    assert_eq!(with(Axis::X, [other, 0.5]), [yes, yes, no, yes]);
    assert_eq!(with(Axis::X, [other, -0.5]), [yes, yes, no, yes]);
    assert_eq!(with(Axis::Y, [0.5, other]), [yes, yes, no, yes]);
    // Where it is no candidate, states without it are in gaps.
    assert_eq!(with(Axis::X, [0.96, 0.28]), [no, no, no, yes]);
    assert_eq!(with(Axis::Y, [0.28, 0.96]), [no, no, no, yes]);
}

#[test]
fn a_held_node_is_none_of_them() {
    let model = blocks(&[(11, BOTH), (8, BOTH)]);
    let pairings = pairings(&model);
    let state =
        |closed: &[usize]| in_gaps(&model, &pairings, false, &closing(&pairings, closed, &[]));
    assert_eq!(state(&[1, 2]), Some(true));
    assert_eq!(state(&[0, 1]), Some(false));
}

/// A state of other directions or other target nodes is none of these.
#[test]
fn a_state_that_faces_elsewhere_is_by_elimination() {
    let model = blocks(&[(11, BOTH), (13, Y)]);
    let pairings = turned(&model, SLANTED);
    let mut elsewhere = closing(&pairings, &[1], &[]);
    elsewhere[0].masters[0].1 += 0.125;
    elsewhere[0].masters[1].1 -= 0.125;
    let mut others = turned(&model, [SLANTED[1], SLANTED[0], SLANTED[2]]);
    let upright = closing(&others, &[1], &[]);
    for sticks in [false, true] {
        assert_eq!(in_gaps(&model, &pairings, sticks, &elsewhere), Some(false));
        assert_eq!(in_gaps(&model, &pairings, sticks, &upright), Some(false));
    }
    // A node that faces nothing has no gap.
    others[1] = None;
    assert_eq!(in_gaps(&model, &others, false, &upright), Some(false));
    assert_eq!(in_gaps(&model, &others, false, &closing(&others, &[0, 2], &[])), Some(true));
}

/// Where a node is faced that faces others itself, gaps are no unknowns of their own.
#[test]
fn no_node_that_faces_others_is_faced() {
    let model = blocks(&[(11, BOTH), (13, Y)]);
    let nodes: Vec<NodeId> = model.node_ids().collect();
    let mut pairings = pairings(&model);
    let first = pairings[0].as_mut().expect("it faces the target");
    first.masters = vec![(nodes[10], 1.0)];
    assert_eq!(in_gaps(&model, &pairings, true, &closing(&pairings, &[1], &[])), Some(false));
    // It may be faced where what it faced is no candidate.
    pairings[2] = None;
    assert_eq!(in_gaps(&model, &pairings, true, &closing(&pairings, &[1], &[])), Some(true));
}
