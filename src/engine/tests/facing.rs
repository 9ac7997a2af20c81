//! Which nodes pull, and where rounding decides which edge is faced.

use engine::contact::{ContactNode, pulling};
use engine::estimates::perturbed;
use engine::{Request, solve};
use problem::model::NodeId;
use problem::modelling::{ContactModel, Coupling, Variant};
use problem::scene::{Axis, Scene};

use testing::bodies::{Bodies, Writing};

/// A pull counts beyond a hundred thousand millionth of the largest force, pressing or pulling, of
/// a node in contact whose force is known.
#[test]
fn nodes_pull_by_more_than_rounding() {
    let scene = Scene::open("fig1").unwrap();
    let solution = solve(&Request::new(&scene), &mut |_| ()).unwrap();
    let node = |k: usize, force: Option<f64>, in_contact: bool| ContactNode {
        node: NodeId::new(k),
        in_contact,
        force,
        ..solution.contact[0].clone()
    };
    for largest in [1e3_f64, -1e3, 1e-3, -1e-3] {
        let part = |part: f64| Some(part * largest.abs());
        let surface = [
            node(0, Some(largest), true),
            node(1, part(-0.9e-11), true),
            node(2, part(-1.1e-11), true),
            node(3, part(-0.5), false),
            node(4, None, true),
            node(5, part(0.5), true),
        ];
        let found: Vec<usize> = pulling(&surface, 0.0).iter().map(|node| node.index()).collect();
        assert_eq!(found, if largest < 0.0 { vec![0, 2] } else { vec![2] });
    }
    assert_eq!(pulling(&[node(0, Some(0.0), true)], 0.0), []);
    let little = [node(0, Some(-1e-12), true)];
    assert_eq!([0.0, 0.09, 0.11].map(|load| pulling(&little, load).len()), [1, 1, 0]);
}

/// Two edges of the target over each other: only where they are as far as each other from the
/// contact edge does rounding decide which one it covers.
#[test]
fn two_target_edges_as_near_as_each_other_are_told() {
    let nodes_of = |height: f64| {
        let mut nodes = vec![[0.1, -1.0], [1.3, -1.0], [1.3, 0.0], [0.1, 0.0]];
        nodes.extend([[1.1, -1.0], [2.3, -1.0], [2.3, height], [1.1, height]]);
        nodes.extend([[0.7, 0.1], [1.7, 0.1], [1.7, 1.1], [0.7, 1.1]]);
        nodes
    };
    let quad = |n: usize| [[n, n + 1, n + 2], [n, n + 2, n + 3]];
    for (height, decides) in [(0.0, true), (0.05, false), (-0.05, false)] {
        let both = vec![Axis::X, Axis::Y];
        let bodies = Bodies {
            nodes: nodes_of(height),
            triangles: [[quad(0), quad(4)].concat(), quad(8).into()],
            moduli: [(1e3, 0.2); 2],
            contact: vec![8, 9],
            target: vec![[2, 3], [6, 7]],
            restrained: [0, 1, 4, 5, 10, 11].map(|node| (node, both.clone())).into(),
            loads: vec![(8, [0.0, -1.0])],
        };
        let scene = bodies.modelled(&Writing::default(), ContactModel::default()).build();
        let mut request = Request::new(&scene.expect("a sound scene")).variant(Variant::Tied);
        request.tolerance = Some(0.2);
        request.contact.coupling = Coupling::Mortar;
        let solution = solve(&request, &mut |_| ()).expect("it runs");
        let found = perturbed(&solution).expect("it is rounded");
        assert_eq!(found.decides(), decides, "{height}: {found:?}");
    }
}
