//! What `unilateral` decides at its limits, worked out by hand: how often a step of the load is
//! divided, how many contact states are tried, which gaps are closed, and what is too much for it.

use std::collections::BTreeSet;

use plane_contact::engine::contact::{Sense, Status};
use plane_contact::engine::{self, Detail, Request, Solution, Step, Unilateral, Uniqueness};
use plane_contact::problem::modelling::{ContactModel, Coupling, Friction, Geometry};
use plane_contact::problem::scene::{Axis, SceneBuilder};

use crate::common::tolerances::{BALANCE, assert_near};
use crate::corners::{Bodies, Writing, grid};
use crate::unilateral::{flat, solved, stacked, with};

const BOTH: &[Axis] = &[Axis::X, Axis::Y];

fn own(step: &Step) -> &Unilateral {
    match &step.detail {
        Detail::Unilateral(own) => own,
        Detail::Published(_) => unreachable!("unilateral was asked for"),
    }
}

/// How many loads the path stops at.
fn stops(solution: &Solution) -> usize {
    let loads: BTreeSet<u64> = solution.steps.iter().map(|step| own(step).load.to_bits()).collect();
    loads.len()
}

/// Small displacements, friction, and one step of the load.
fn in_one_step(mu: f64) -> ContactModel {
    ContactModel {
        geometry: Geometry::Initial,
        friction: Friction::new(mu).expect("a coefficient"),
        load_steps: 1,
        ..ContactModel::default()
    }
}

/// Blocks that hang from a ceiling, a unit load on either lower corner, over a held one, above
/// which their left corners stand by `gaps`, and the right ones higher than they fall.
fn hanging(gaps: &[f64], model: ContactModel) -> SceneBuilder {
    let width = gaps.len() as f64;
    let mut nodes = vec![[0.0, -1.0], [width, -1.0], [0.0, 0.0], [width, 0.0]];
    for (k, gap) in gaps.iter().enumerate() {
        let x = k as f64;
        nodes.extend([[x + 0.2, *gap], [x + 0.8, gap + 0.1]]);
        nodes.extend([0.2, 0.5, 0.8].map(|dx| [x + dx, gap + 1.0]));
    }
    let blocks: Vec<usize> = (0..gaps.len()).map(|k| 4 + 5 * k).collect();
    let ceiling = blocks.iter().flat_map(|n| n + 2..n + 5);
    let corners: Vec<usize> = blocks.iter().flat_map(|n| [*n, n + 1]).collect();
    let block = |n: &usize| [[*n, n + 3, n + 2], [*n, n + 1, n + 3], [n + 1, n + 4, n + 3]];
    let bodies = Bodies {
        nodes,
        triangles: [grid(0, 2, 2), blocks.iter().flat_map(block).collect()],
        moduli: [(1e3, 0.0); 2],
        contact: corners.clone(),
        target: vec![[2, 3]],
        restrained: (0..4).chain(ceiling).map(|n| (n, BOTH.into())).collect(),
        loads: corners.iter().map(|n| (*n, [0.0, -1.0])).collect(),
    };
    bodies.modelled(&Writing::default(), model)
}

/// How far the left corner of such a block moves under the loads where nothing stops it.
fn fall() -> f64 {
    let solution = solved(&hanging(&[0.5], in_one_step(0.5))).expect("it hangs");
    0.5 - solution.contact[0].gap
}

/// A step of the load is divided where a node closes, but for a thousandth of it at either end.
#[test]
fn a_step_is_divided_where_a_node_closes_away_from_its_ends() {
    let fall = fall();
    for (part, expected) in [(0.0005, 1), (0.002, 2), (0.5, 2), (0.998, 2), (0.9995, 1), (2.0, 1)] {
        let solution = solved(&hanging(&[0.0, part * fall], in_one_step(0.5))).expect("it rests");
        assert_eq!(solution.contact[2].in_contact, part < 1.0, "{part}");
        assert_eq!(stops(&solution), expected, "{part}");
    }
}

/// However many nodes close one after another in a step, it is divided sixteen times.
#[test]
fn a_step_is_divided_sixteen_times() {
    let fall = fall();
    for (count, expected) in [(10, 10), (17, 17), (25, 17)] {
        let gaps: Vec<f64> = (0..count).map(|k| f64::from(k) / f64::from(count) * fall).collect();
        let solution = solved(&hanging(&gaps, in_one_step(0.5))).expect("they rest");
        assert_eq!(solution.in_contact().count(), gaps.len());
        assert_eq!(stops(&solution), expected, "{count}");
        let numbers = solution.steps.iter().map(|step| step.k);
        assert!(numbers.eq(1..=solution.steps.len()), "iterations count from 1");
    }
}

/// Of a model of many equations fewer contact states are tried: two million over its equations, and
/// one. Nodes of no triangle count too.
#[test]
fn of_a_large_model_fewer_contact_states_are_tried() {
    for (more, expected, is_all) in [(0, 256, true), (25_000, 1 + 500_000 / 50_038, false)] {
        let mut scene = hanging(&[0.0; 2], in_one_step(0.5));
        scene.description.drop_orphans = true;
        let mut mesh = scene.mesh.clone();
        for k in 0..more + 3 {
            let mut node = mesh.nodes[0].clone();
            node.number = mesh.nodes.len() + 1;
            node.xyz[0] = f64::from(k);
            mesh.nodes.push(node);
        }
        scene.mesh = mesh;
        let found = solved(&scene).expect("they rest").equilibrium.expect("it is one").uniqueness;
        let Uniqueness::Tried { states, all, .. } = found else { panic!("{found:?}") };
        assert_eq!((states, all), (expected, is_all));
    }
}

/// Without a load and friction nothing sticks, nor slides in a sense of its own.
#[test]
fn without_a_load_and_friction_nodes_slide_in_no_sense() {
    let scene = with(stacked([0.0, 0.0], &[Axis::X], Friction::NONE), flat);
    let solution = solved(&scene).unwrap();
    for node in &solution.contact {
        assert_eq!(node.status, Some(Status::Slip(Sense::Free)));
    }
}

/// Without a load no motion brings a node to the target: the nearest one closes where a body is not
/// held.
#[test]
fn without_a_load_the_nearest_node_closes() {
    let bodies = Bodies {
        nodes: [
            [-1.0, -1.0],
            [3.0, -1.0],
            [-1.0, 0.0],
            [3.0, 0.0],
            [0.0, 0.5],
            [1.0, 0.125],
            [2.0, 0.0],
            [1.0, 1.0],
        ]
        .into(),
        triangles: [grid(0, 2, 2), vec![[4, 5, 7], [5, 6, 7]]],
        moduli: [(1e3, 0.0); 2],
        contact: vec![4, 5, 6],
        target: vec![[2, 3]],
        restrained: [(0, BOTH), (1, BOTH), (7, &[Axis::X][..])].map(|(n, a)| (n, a.into())).into(),
        loads: Vec::new(),
    };
    let scene = bodies.modelled(&Writing::default(), in_one_step(0.0)).build();
    let request = Request::new(&scene.expect("a sound scene"));
    let mut first = None;
    let _ = engine::solve(&request, &mut |step| {
        first.get_or_insert_with(|| own(step).statuses.clone());
    });
    let first = first.expect("there is an iteration");
    let closed: Vec<bool> = first.iter().map(|status| status.is_closed()).collect();
    assert_eq!(closed, [false, true, true]);
}

/// A body that is lifted off is found to be, by however small a force.
#[test]
fn a_small_force_lifts_a_body_off_too() {
    for force in [1.0, 1e-7, 1e7] {
        let scene = stacked([0.0, force], &[Axis::X], Friction::NONE);
        let text = solved(&scene).expect_err("nothing holds it").to_string();
        assert!(text.starts_with("no equilibrium was found: "), "{text}");
        assert!(text.contains("; in the last the load moves node"), "{text}");
    }
}

/// A body over a block that hangs on a hinge and falls away from it.
#[test]
fn a_target_that_falls_away_has_no_equilibrium() {
    let mut scene = with(stacked([0.0, 0.0], BOTH, Friction::NONE), flat);
    scene.description.restraints.retain(|restraint| restraint.node != Some(2));
    let scene = scene.restrain_node(6, BOTH).restrain_node(7, BOTH);
    let falls = scene.clone().force(2, [0.0, -1.0]);
    let text = solved(&falls).expect_err("nothing holds it").to_string();
    assert!(text.starts_with("there is no equilibrium: the load moves node"), "{text}");
    assert!(solved(&scene.force(2, [0.0, 1.0])).is_ok(), "the body above holds it");
}

/// A unit square on a held block, and beside it a strip that is held along its upper side and
/// touches nothing: `count` contact nodes. Nodes 4 and 5 are the square's lower ones, 6 and 7 its
/// upper ones; `guided` ones move along y.
fn beside_a_strip(
    count: usize,
    guided: &[usize],
    load: (usize, [f64; 2]),
    mu: f64,
) -> SceneBuilder {
    let mut nodes = vec![[0.0, -1.0], [4.0, -1.0], [0.0, 0.0], [4.0, 0.0]];
    nodes.extend([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]]);
    let row = |y: f64| (2..count).map(move |k| [2.0 + k as f64 / count as f64, y]);
    nodes.extend(row(0.01).chain(row(0.02)));
    let (lower, upper) = (8..6 + count, 6 + count..nodes.len());
    let held = [0, 1, 2, 3].into_iter().chain(upper).map(|n| (n, BOTH.into()));
    let bodies = Bodies {
        nodes,
        triangles: [grid(0, 2, 2), [grid(4, 2, 2), grid(8, count - 2, 2)].concat()],
        moduli: [(1e3, 0.0); 2],
        contact: [4, 5].into_iter().chain(lower).collect(),
        target: vec![[2, 3]],
        restrained: held.chain(guided.iter().map(|n| (*n, vec![Axis::X]))).collect(),
        loads: vec![load],
    };
    bodies.modelled(&Writing::default(), in_one_step(mu))
}

/// Up to 150 contact nodes the motion that nothing opposes is looked for.
#[test]
fn why_a_body_has_no_equilibrium_is_told_of_up_to_150_contact_nodes() {
    for (count, is_told) in [(150, true), (151, false)] {
        let lifted = beside_a_strip(count, &[4, 6], (6, [0.0, 1.0]), 0.0);
        let text = solved(&lifted).expect_err("nothing holds it").to_string();
        assert_eq!(text.starts_with("there is no equilibrium: the load moves"), is_told, "{text}");
    }
}

/// Under friction an equilibrium that only a fixed point on its bounds finds is found of up to 150 contact
/// nodes. The square stands on its lower right corner, which carries the whole load of 1 along y.
/// As that acts above it, and the guide is as high as the load, the moments leave the corner no
/// friction.
#[test]
fn bounds_of_friction_are_tried_of_up_to_150_contact_nodes() {
    let scene = |count: usize| beside_a_strip(count, &[6], (7, [2.0, -1.0]), 0.3);
    let solution = solved(&scene(150)).expect("it stands on a corner");
    let [corner] = solution.in_contact().collect::<Vec<_>>()[..] else { panic!("not on a corner") };
    assert_near("force", corner.force.expect("it is determined"), 1.0, 1.0, &BALANCE);
    assert_near("friction", corner.friction_needed.expect("it presses"), 0.0, 1.0, &BALANCE);
    let solution = solved(&scene(151)).expect("it stands on a corner");
    let on_springs = solution.equilibrium.as_ref().expect("it is one").springs;
    assert!(on_springs.is_some(), "the bounds of friction are not tried");
}

/// A block that a force lifts off its target turns about its upper left corner: the 200 nodes
/// beside that one are guided along y, which leaves the same motion, and is so many restraints that
/// the stiffness of what they leave is no exact 0.
#[test]
fn a_body_that_turns_beside_many_restraints_is_told() {
    for height in [0.7, 1.3, 2.3] {
        let mut nodes = vec![[0.0, -1.0], [2.0, -1.0], [0.0, 0.0], [2.0, 0.0]];
        nodes.extend([[0.5, 0.0], [1.0, 0.0]]);
        nodes.extend((0..=200).map(|k| [f64::from(k) / 200.0, height]));
        let fan = (7..nodes.len()).map(|n| [4, n, n - 1]);
        let both = [0, 1, 2, 3, 6].map(|n| (n, BOTH.into()));
        let guided = (7..nodes.len()).map(|n| (n, vec![Axis::X]));
        let bodies = Bodies {
            triangles: [grid(0, 2, 2), fan.chain([[4, 5, nodes.len() - 1]]).collect()],
            moduli: [(1e3, 0.0); 2],
            contact: vec![4, 5],
            target: vec![[2, 3]],
            restrained: both.into_iter().chain(guided).collect(),
            loads: vec![(5, [0.0, 1.0])],
            nodes,
        };
        let scene = bodies.modelled(&Writing::default(), in_one_step(0.0));
        let text = solved(&scene).expect_err("nothing holds it").to_string();
        assert!(text.starts_with("there is no equilibrium: the load moves node"), "{text}");
    }
}

/// The left corner of a block under a force of its own, which nothing else moves: it sticks up to
/// half its normal force, opens where it pulls, and a pull that is rounding beside the force on
/// another block neither opens nor moves it.
#[test]
fn a_node_sticks_up_to_its_friction_but_for_rounding() {
    let (forward, backward) = (Status::Slip(Sense::Forward), Status::Slip(Sense::Backward));
    for (load, expected) in [
        ([0.5, -1.0], Status::Stick),
        ([0.5 * (1.0 + 5e-13), -1.0], Status::Stick),
        ([0.5 * (1.0 + 2e-12), -1.0], backward),
        ([-0.5 * (1.0 + 5e-13), -1.0], Status::Stick),
        ([-0.5 * (1.0 + 2e-12), -1.0], forward),
        ([0.0, 5e-12], Status::Stick),
        ([0.0, 2e-11], Status::Open),
    ] {
        let mut scene = hanging(&[0.0; 2], in_one_step(0.5));
        scene.description.loads.clear();
        let solution = solved(&scene.force(5, load).force(10, [0.0, -1.0])).expect("it hangs");
        assert_eq!(solution.contact[0].status, Some(expected), "{load:?}");
    }
}

/// Between two restraints a gap does not close: the node is open, and the gap is the violation of
/// the first contact state, in which it was closed. Of a gap that is rounding it stays closed, and
/// what passes there is not known.
#[test]
fn a_gap_between_two_restraints_stays_open() {
    let scene = |gap: f64| {
        let nodes = [
            [-1.0, -1.0],
            [3.0, -1.0],
            [-1.0, 0.0],
            [3.0, 0.0],
            [0.0, gap],
            [1.0, gap],
            [0.5, 1.0],
        ];
        let bodies = Bodies {
            nodes: nodes.into(),
            triangles: [grid(0, 2, 2), vec![[4, 5, 6]]],
            moduli: [(1e3, 0.0); 2],
            contact: vec![4, 5],
            target: vec![[2, 3]],
            restrained: [0, 1, 2, 3, 4, 5].map(|n| (n, BOTH.into())).into(),
            loads: vec![(6, [0.0, -1.0])],
        };
        bodies.modelled(&Writing::default(), in_one_step(0.0))
    };
    // The size of the scene is 4: gaps count as closed up to 2e-12.
    for (gap, closed) in [(0.0, 2), (2e-12, 2), (2.1e-12, 0), (0.1, 0)] {
        let solution = solved(&scene(gap)).expect("it is held");
        assert_eq!(solution.in_contact().count(), closed, "{gap}");
        assert!(own(&solution.steps[0]).violation >= gap, "{gap}");
        assert_eq!(solution.contact[0].force.is_none(), closed > 0, "{gap}");
    }
}

/// Three held nodes over an edge whose two nodes alone are free: of the forces of all three nothing
/// is known, also where one of them is open but touches.
#[test]
fn an_open_node_that_touches_may_carry_a_part_too() {
    let nodes = [
        [0.0, -3.0],
        [3.0, -3.0],
        [0.0, 0.0],
        [3.0, 0.0],
        [0.5, 0.0],
        [1.0, 0.0],
        [2.5, 0.0],
        [1.0, 2.0],
    ];
    let bodies = Bodies {
        nodes: nodes.into(),
        triangles: [grid(0, 2, 2), vec![[4, 5, 7], [5, 6, 7]]],
        moduli: [(1e3, 0.0); 2],
        contact: vec![4, 5, 6],
        target: vec![[2, 3]],
        restrained: [0, 1, 4, 5, 6, 7].map(|n| (n, BOTH.into())).into(),
        loads: vec![(2, [0.0, 4.0]), (3, [0.0, 1.0])],
    };
    let scene = bodies.modelled(&Writing::default(), in_one_step(0.0));
    let solution = solved(&scene).expect("it is held");
    let in_contact: Vec<bool> = solution.contact.iter().map(|node| node.in_contact).collect();
    assert_eq!(in_contact, [true, true, false]);
    assert!(solution.contact.iter().all(|node| node.gap.abs() < 1e-12 && node.force.is_none()));
}

/// A target node that stands in the contact body is reported beyond a thousandth of the scene's
/// size, which is 4.
#[test]
fn a_target_node_is_reported_beyond_a_thousandth_of_the_size() {
    for (height, is_reported) in [(0.004, false), (0.00401, true)] {
        let nodes = [
            [0.0, -1.0],
            [2.0, -1.0],
            [4.0, -1.0],
            [0.0, 0.0],
            [2.0, height],
            [4.0, 0.0],
            [1.0, 0.0],
            [3.0, 0.0],
            [2.0, 1.0],
        ];
        let bodies = Bodies {
            nodes: nodes.into(),
            triangles: [grid(0, 3, 2), vec![[6, 7, 8]]],
            moduli: [(1e3, 0.0); 2],
            contact: vec![6, 7],
            target: vec![[3, 4], [4, 5]],
            restrained: (0..9).map(|n| (n, BOTH.into())).collect(),
            loads: Vec::new(),
        };
        let model = ContactModel { coupling: Coupling::Nts, ..in_one_step(0.0) };
        let solution = solved(&bodies.modelled(&Writing::default(), model)).expect("it is held");
        let unseen = solution.equilibrium.expect("it is one").unseen;
        assert_eq!(unseen.is_some(), is_reported, "{height}");
    }
}

/// A block over one of which a thousand nodes are held, without friction, turned by any angle.
#[test]
fn that_a_body_can_slide_is_seen_beside_many_restraints() {
    let lower = |y: f64| (0..500).map(move |k| [f64::from(k) / 10.0, y]);
    let mut nodes: Vec<[f64; 2]> = lower(-1.0).chain(lower(0.0)).collect();
    let first = nodes.len();
    nodes.extend([[20.03, 0.0], [21.03, 0.0], [20.03, 1.0], [21.03, 1.0]]);
    let bodies = Bodies {
        nodes,
        triangles: [grid(0, first / 2, 2), grid(first, 2, 2)],
        moduli: [(1e3, 0.0); 2],
        contact: vec![first, first + 1],
        target: (first / 2..first - 1).map(|n| [n, n + 1]).collect(),
        restrained: (0..first).map(|n| (n, BOTH.into())).collect(),
        loads: [first + 2, first + 3].map(|n| (n, [0.0, -1.0])).into(),
    };
    for degrees in [10.0, 20.0, 35.0, 50.0, 65.0] {
        let writing = Writing { degrees, ..Writing::default() };
        let text = solved(&bodies.modelled(&writing, in_one_step(0.0))).expect_err("it slides");
        assert!(text.to_string().contains("with every contact node in contact"), "{text}");
    }
}

/// Known: a node that closes at the very beginning of a step hides later ones, where the step should be
/// divided too. Divided there, the zone of stick that is compared with Cattaneo's came out worse on a
/// coarse mesh, by 8.9 % and not 3.3 %, and on finer ones as well as before: why is not known yet.
#[test]
fn a_node_that_closes_at_the_beginning_hides_a_later_one() {
    let fall = fall();
    for (first, expected) in [(0.0, 2), (0.0002, 1)] {
        let gaps = [0.0, first * fall, 0.5 * fall];
        let solution = solved(&hanging(&gaps, in_one_step(0.5))).expect("they rest");
        assert_eq!(stops(&solution), expected, "{first}");
    }
}

/// Where no node may slide, one that carries nothing but rounding does not either.
#[test]
fn a_node_that_carries_rounding_does_not_slide_under_stick() {
    let nodes = [
        [0.0, -1.0],
        [5.0, -1.0],
        [0.0, 0.0],
        [5.0, 0.0],
        [1.0, 0.0],
        [2.0, 0.0],
        [1.0, 1.0],
        [2.0, 1.0],
        [3.1, 0.1],
        [4.2, 0.1],
        [3.1, 1.1],
        [4.2, 1.1],
    ];
    let bodies = Bodies {
        nodes: nodes.into(),
        triangles: [grid(0, 2, 2), [grid(4, 2, 2), grid(8, 2, 2)].concat()],
        moduli: [(1e3, 0.0); 2],
        contact: vec![4, 5, 8, 9],
        target: vec![[2, 3]],
        restrained: (0..4).map(|n| (n, BOTH.into())).collect(),
        loads: vec![(6, [0.0, -1.0]), (7, [0.0, -1.0])],
    };
    for degrees in 0..12 {
        let writing = Writing { degrees: 7.0 * f64::from(degrees), ..Writing::default() };
        let model = ContactModel { friction: Friction::STICK, ..in_one_step(0.0) };
        let solution = solved(&bodies.modelled(&writing, model)).expect("it sticks");
        assert_eq!(solution.in_contact().count(), 4);
    }
}
