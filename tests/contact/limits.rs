//! What `unilateral` decides where forces and gaps are rounding, and where nothing holds a body: worked
//! out by hand.

use plane_contact::engine::contact::{Sense, Status};
use plane_contact::engine::{self, Detail, Request, Step, Unilateral};
use plane_contact::problem::modelling::{ContactModel, Friction, Geometry};
use plane_contact::problem::scene::{Axis, SceneBuilder};

use crate::unilateral::{flat, solved, stacked, with};
use testing::bodies::{Bodies, Writing, grid};

const BOTH: &[Axis] = &[Axis::X, Axis::Y];

fn own(step: &Step) -> &Unilateral {
    match &step.detail {
        Detail::Unilateral(own) => own,
        Detail::Published(_) => unreachable!("unilateral was asked for"),
    }
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
        assert!(text.starts_with("no equilibrium was found: the load moves node"), "{text}");
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
