//! What the nodes of random shapes face, recorded: under either coupling, in numbers with a bound,
//! around each node, and how deep nodes lie in the other body. Nothing is solved.

use std::fmt::Write;

use fastrand::Rng;
use plane_contact::engine::contact::search::{Closest, Segment, closest};
use plane_contact::engine::contact::{ContactNode, Pairing, Surfaces, pulling};
use plane_contact::numbers::scalar::{Bounded, Scalar};
use plane_contact::problem::model::{Model, NodeId};
use plane_contact::problem::modelling::{ContactModel, Coupling};
use plane_contact::problem::scene::Axis;
use serde_json::{Value, json};

use crate::common::draws::one_of;
use crate::common::recorded::assert_recorded;
use crate::corners::{Bodies, Writing, grid};
use crate::drawn::{KINDS, draw};
use crate::recorded::{facing, folded, regular};

/// The number of shapes of each record.
const SHAPES: usize = 64;

/// Returns `model` with the nodes of its upper body, from `first`, moved by `by`.
fn moved(model: &Model, first: usize, by: [f64; 2]) -> Model {
    let mut model = model.clone();
    for [x, y] in &mut model.nodes[first..] {
        *x += by[0];
        *y += by[1];
    }
    model
}

/// Returns the line of what a body faces after a move of the upper one.
fn line(bodies: &Bodies, writing: &Writing, by: [f64; 2]) -> String {
    let scene = bodies.modelled(writing, ContactModel::default()).build().expect("a sound scene");
    let first = bodies.nodes.len() - upper_nodes(bodies);
    let Ok(surfaces) = Surfaces::new(&scene.model) else { return "no surfaces\n".into() };
    let model = moved(&scene.model, first, by);
    let shape = &model.nodes;
    let of = |pairings: Vec<Option<Pairing>>| -> Vec<Value> {
        pairings.iter().map(|one| one.as_ref().map_or(json!("none"), facing)).collect()
    };
    let mut text = String::new();
    for coupling in [Coupling::Nts, Coupling::Mortar] {
        let faced = of(surfaces.pairings(coupling, shape));
        let of = |field: &str| faced.iter().map(|one| one[field].clone()).collect::<Vec<_>>();
        let fields = ["edge", "gap", "length", "nodes", "normal", "weights"];
        let fields: serde_json::Map<String, Value> = fields
            .map(|field| (format!("faced_{field}"), Value::from(of(field))))
            .into_iter()
            .collect();
        write!(text, "{}\n  ", folded(&Value::from(fields))).expect("room");
    }
    let bounded: Vec<[Bounded; 2]> = shape.iter().map(|p| p.map(Bounded::from_decimal)).collect();
    let unsure: Vec<usize> =
        surfaces.mortar(&bounded).unsure.iter().map(|(node, _)| node.index()).collect();
    let around: Vec<Value> = [1e-9, 0.03, 0.6]
        .iter()
        .flat_map(|radius| surfaces.pairings_nearby(shape, *radius))
        .flat_map(|(node, other)| {
            let other = other.as_ref().map_or(json!(-1.5), |other| json!(other.gap));
            [json!(node.index()), other]
        })
        .collect();
    let deepest =
        surfaces.deepest_target_node(shape).map(|(node, depth)| json!([node.index(), depth]));
    let refused = surfaces.check_initial_penetration(&model).err();
    let refused = refused.map_or_else(String::new, |why| why.what);
    let rest = json!({ "around": around, "deepest": deepest, "unsure": unsure });
    text + &format!("{} {refused}\n", folded(&rest))
}

fn upper_nodes(bodies: &Bodies) -> usize {
    let first = bodies.triangles[1].iter().flatten().min().expect("it has triangles");
    bodies.nodes.len() - first
}

fn record(name: &str, seed: u64, bodies: impl Fn(&mut Rng, usize) -> Bodies, moves: &[[f64; 2]]) {
    let mut rng = Rng::with_seed(seed);
    let one = |k: usize| {
        let bodies = bodies(&mut rng, k);
        let writing = Writing {
            turns: rng.usize(..4),
            mirror: rng.bool(),
            contact_reversed: rng.bool(),
            target_reversed: rng.bool(),
            edges_turned: rng.bool(),
            ..Writing::default()
        };
        line(&bodies, &writing, one_of(&mut rng, moves))
    };
    assert_recorded(name, &(0..SHAPES).map(one).collect::<String>());
}

/// Every move keeps nodes over nodes and middles of edges, where comparisons are ties.
#[test]
fn regular_shapes_face_each_other_as_recorded() {
    let moves =
        [[0.0, 0.0], [0.5, 0.0], [-1.0, 0.0], [0.0, -0.5], [0.0, -0.25], [0.5, -1.0], [0.05, 0.5]];
    record("facing-regular", 41, |rng, _| regular(rng), &moves);
}

#[test]
fn random_shapes_face_each_other_as_recorded() {
    let moves = [[0.0, 0.0], [0.3, 0.1], [-0.7, 0.0], [0.0, -0.4], [0.0, -0.1], [0.6, -0.9]];
    let drawn = |rng: &mut Rng, k: usize| draw(rng, KINDS[k % KINDS.len()]).bodies;
    record("facing-random", 42, drawn, &moves);
}

/// A target of whole numbers with corners of every kind, sharp tips too, around which a small block
/// stands on a grid of half steps: many nodes are as near to two parts of it.
fn cornered(rng: &mut Rng, _: usize) -> Bodies {
    let n = rng.usize(3..7);
    let heights: Vec<f64> = (0..n).map(|_| one_of(rng, &[0.0, 0.0, 1.0, 2.0, -1.0, 6.0])).collect();
    let mut nodes: Vec<[f64; 2]> = (0..n).map(|k| [2.0 * k as f64, -3.0]).collect();
    nodes.extend((0..n).map(|k| [2.0 * k as f64, heights[k]]));
    let first = nodes.len();
    let (left, bottom) = (rng.i32(-2..8), rng.i32(-2..6));
    let (width, step) = (rng.usize(2..5), one_of(rng, &[0.5, 1.0, 2.0]));
    for y in [0.0, 1.0] {
        let x = |k: usize| f64::from(left) / 2.0 + step * k as f64;
        nodes.extend((0..width).map(|k| [x(k), f64::from(bottom) / 2.0 + y]));
    }
    let mut target: Vec<[usize; 2]> = (0..n - 1).map(|k| [n + k, n + k + 1]).collect();
    if rng.bool() {
        target.extend([[0, n], [n - 1, 2 * n - 1]]);
    }
    let mut contact: Vec<usize> = (first..first + width).collect();
    if rng.bool() {
        // Its right side and its top too.
        contact.extend((first + width..first + 2 * width).rev());
    }
    Bodies {
        nodes,
        triangles: [grid(0, n, 2), grid(first, width, 2)],
        moduli: [(1e4, 0.25); 2],
        contact,
        target,
        restrained: [0, 1, first].map(|node| (node, vec![Axis::X, Axis::Y])).into(),
        loads: vec![(first, [0.0, -1.0])],
    }
}

#[test]
fn shapes_with_corners_face_each_other_as_recorded() {
    record("facing-corners", 43, cornered, &[[0.0, 0.0], [0.25, 0.0], [0.0, 0.001], [0.0, -0.25]]);
}

/// Points of whole numbers around an open polygon of them: every order of two distances occurs, and
/// every tie.
#[test]
fn closest_points_on_whole_numbers_are_as_recorded() {
    let mut rng = Rng::with_seed(44);
    let mut text = String::new();
    for _ in 0..24 {
        let point = |rng: &mut Rng| [f64::from(rng.i32(-3..4)), f64::from(rng.i32(-3..4))];
        let corners: Vec<[f64; 2]> = (0..5).map(|_| point(&mut rng)).collect();
        let segments: Vec<Segment<f64>> = corners
            .windows(2)
            .filter(|ends| ends[0] != ends[1])
            .map(|ends| Segment::new([ends[0], ends[1]]))
            .collect();
        let (mut places, mut numbers) = (Vec::new(), Vec::new());
        for (x, y) in (-4..5).flat_map(|x| (-4..5).map(move |y| (x, y))) {
            let p = [f64::from(x), f64::from(y)];
            let within = |c: Closest<f64>| c.past() * c.past() * c.square <= 4.0;
            let (own, near): (Vec<usize>, Vec<Segment<f64>>) =
                segments.iter().enumerate().filter(|(_, s)| within(s.closest(p))).unzip();
            let Some((k, one)) = closest(&near, p) else { continue };
            places.extend([own[k], one.end()]);
            numbers.extend([one.xi, one.side, one.distance(), one.past(), one.distance_square]);
        }
        let line = folded(&json!({ "numbers": numbers, "places": places }));
        writeln!(text, "{line}").expect("room");
    }
    assert_recorded("closest", &text);
}

/// A pull counts beyond a hundred thousand millionth of the largest force, pressing or pulling, of
/// a node in contact whose force is known.
#[test]
fn nodes_pull_by_more_than_rounding() {
    let node = |k: usize, force: Option<f64>, in_contact: bool| ContactNode {
        node: NodeId::new(k),
        arc: 0.0,
        in_contact,
        gap: 0.0,
        status: None,
        force,
        pressure: None,
        shear: None,
        friction_needed: None,
    };
    for largest in [1e3, -1e3, 1e-3, -1e-3] {
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
/// contact edge may rounding decide which one it covers.
#[test]
fn two_target_edges_as_near_as_each_other_are_told() {
    let nodes_of = |height: f64| {
        let mut nodes = vec![[0.1, -1.0], [1.3, -1.0], [1.3, 0.0], [0.1, 0.0]];
        nodes.extend([[1.1, -1.0], [2.3, -1.0], [2.3, height], [1.1, height]]);
        nodes.extend([[0.7, 0.1], [1.7, 0.1], [1.7, 1.1], [0.7, 1.1]]);
        nodes
    };
    let quad = |n: usize| [[n, n + 1, n + 2], [n, n + 2, n + 3]];
    for (height, unsure) in [(0.0, vec![8, 9]), (0.05, vec![]), (-0.05, vec![])] {
        let both = vec![Axis::X, Axis::Y];
        let bodies = Bodies {
            nodes: nodes_of(height),
            triangles: [[quad(0), quad(4)].concat(), quad(8).into()],
            moduli: [(1e3, 0.2); 2],
            contact: vec![8, 9],
            target: vec![[2, 3], [6, 7]],
            restrained: [0, 1, 4, 5, 10, 11].map(|node| (node, both.clone())).into(),
            loads: vec![(11, [0.0, -1.0])],
        };
        let scene = bodies.modelled(&Writing::default(), ContactModel::default()).build();
        let model = scene.expect("a sound scene").model;
        let surfaces = Surfaces::new(&model).expect("edges of the outline");
        let shape: Vec<[Bounded; 2]> =
            model.nodes.iter().map(|p| p.map(Bounded::from_decimal)).collect();
        let mut found: Vec<usize> =
            surfaces.mortar(&shape).unsure.iter().map(|(node, _)| node.index()).collect();
        found.dedup();
        assert_eq!(found, unsure, "{height}");
    }
}
