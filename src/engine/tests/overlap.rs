//! Nodes that lie inside another body: how deep, and whether contact watches them, by hand.

use std::collections::HashSet;

use engine::contact::{InsideNode, Surfaces, Watched};
use engine::{Request, solve};
use problem::element::Plane;
use problem::model::NodeId;
use problem::modelling::{Coupling, Friction, Variant};
use problem::scene::{Axis, Contact, MeshBuilder, Scene, SceneBuilder};

/// A block on a wider one; the groups of contact have some of the nodes where they meet.
///
/// ```text
///          13--14--15       y = 2
///           |   |   |
///          10--11--12       y = 1
///       5---6---7---8---9   y = 1
///       |   |   |   |   |
///       0---1---2---3---4   y = 0
/// ```
fn blocks(contact: &[usize], target: &[usize]) -> Scene {
    let mut mesh = MeshBuilder::default();
    let mut row = |xs: &[f64], y: f64| mesh.row(xs.iter().map(|x| [*x, y]));
    let (wide, narrow) = ([0.0, 1.0, 2.0, 3.0, 4.0], [0.75, 1.75, 2.75]);
    let rows = [row(&wide, 0.0), row(&wide, 1.0), row(&narrow, 1.0), row(&narrow, 2.0)];
    mesh.join("lower", &rows[0], &rows[1]);
    mesh.join("upper", &rows[2], &rows[3]);
    let of = |row: &[_], kept: &[usize]| kept.iter().map(|k| row[*k]).collect::<Vec<_>>();
    mesh.edges("bottom", &rows[0]);
    mesh.edges("target", &of(&rows[1], target));
    mesh.edges("contact", &of(&rows[2], contact));
    mesh.edges("top", &rows[3]);
    let contact = Contact {
        friction: Some(Friction::NONE),
        coupling: Some(Coupling::Mortar),
        ..Contact::new("contact", "target", 0.01)
    };
    let scene = SceneBuilder::new("blocks", mesh.finish(), Plane::Stress)
        .variant(Variant::Unilateral)
        .material("lower", 1000.0, 0.3)
        .material("upper", 1000.0, 0.3)
        .restrain("bottom", &[Axis::X, Axis::Y])
        .restrain_node(15, &[Axis::X])
        .pressure("top", 1.0)
        .contact(contact);
    scene.build().expect("it is sound")
}

const ALL: [&[usize]; 2] = [&[0, 1, 2], &[0, 1, 2, 3, 4]];

/// The nodes inside where the upper block is moved down by a tenth, in order, with their depths.
fn inside([contact, target]: [&[usize]; 2]) -> Vec<(usize, Watched)> {
    let model = blocks(contact, target).model;
    let mut shape = model.nodes.clone();
    shape[10..].iter_mut().for_each(|at| at[1] -= 0.1);
    let surfaces = Surfaces::new(&model).expect("edges of the outline");
    let facing = surfaces.pairings(Coupling::Mortar, &shape);
    let facing: HashSet<NodeId> = facing.iter().flatten().map(|pairing| pairing.node).collect();
    let mut found = surfaces.inside(&model, &shape, [&facing, &HashSet::new()]);
    found.sort_by_key(|inside| inside.node);
    for InsideNode { depth, height, .. } in &found {
        assert!((depth - 0.1).abs() < 1e-12 && *height == 0.0, "{depth} {height}");
    }
    found.iter().map(|inside| (inside.node.index(), inside.watched)).collect()
}

#[test]
fn nodes_beyond_either_group_are_watched_by_nothing() {
    use Watched::{Contact, Not, Target};
    let all = [(6, Target), (7, Target), (10, Contact), (11, Contact), (12, Contact)];
    assert_eq!(inside(ALL), all);
    let short = [(6, Target), (7, Not), (10, Contact), (11, Contact), (12, Not)];
    assert_eq!(inside([&[0, 1], ALL[1]]), short);
    let short = [(6, Target), (7, Target), (10, Not), (11, Contact), (12, Contact)];
    assert_eq!(inside([ALL[0], &[1, 2, 3, 4]]), short);
}

/// A curved surface on another of the same radius enters it by the height of an arc over its edge, (1 − cos a/2) r.
#[test]
fn the_facets_of_flush_curved_surfaces_have_their_height() {
    let mut mesh = MeshBuilder::default();
    let arc = |count: usize, r: f64| {
        (0..=count).map(move |k| {
            let angle = 1.0 + k as f64 / count as f64;
            [r * angle.cos(), r * angle.sin()]
        })
    };
    let rows = [arc(9, 8.0), arc(9, 10.0), arc(6, 10.0), arc(6, 12.0)].map(|row| mesh.row(row));
    mesh.join("shaft", &rows[1], &rows[0]);
    mesh.join("hub", &rows[3], &rows[2]);
    for (name, nodes) in [
        ("inner", &rows[0][..]),
        ("contact", &rows[1][..3]),
        ("target", &rows[2][..3]),
        ("outer", &rows[3][..]),
    ] {
        mesh.edges(name, nodes);
    }
    let contact =
        Contact { friction: Some(Friction::NONE), ..Contact::new("contact", "target", 0.01) };
    let scene = SceneBuilder::new("fit", mesh.finish(), Plane::Stress)
        .variant(Variant::Unilateral)
        .material("shaft", 1000.0, 0.3)
        .material("hub", 1000.0, 0.3)
        .restrain("inner", &[Axis::X, Axis::Y])
        .restrain("outer", &[Axis::X, Axis::Y])
        .contact(contact);
    let scene = scene.build().expect("it is sound");
    let surfaces = Surfaces::new(&scene.model).expect("edges of the outline");
    let nothing = HashSet::new();
    let found = surfaces.inside(&scene.model, &scene.model.nodes, [&nothing, &nothing]);
    let height = 10.0 * (1.0 - (1.0_f64 / 12.0).cos());
    assert!(found.iter().any(|inside| inside.depth > 0.5 * height), "{found:?}");
    // The ends of both arcs are the same points.
    for InsideNode { depth, height: said, .. } in found.into_iter().filter(|at| at.depth > 1e-9) {
        assert!(depth <= said && (said - height).abs() < 2e-3 * height, "{depth} {said} {height}");
    }
    let solution = solve(&Request::new(&scene), &mut |_| ()).expect("there is an equilibrium");
    assert_eq!(solution.overlap, None);
}

#[test]
fn an_equilibrium_of_bodies_that_lie_in_each_other_is_none_of_the_scene() {
    let overlap = |[contact, target]: [&[usize]; 2]| {
        let request = Request::new(&blocks(contact, target));
        let solution = solve(&request, &mut |_| ()).expect("an equilibrium of the groups");
        assert_eq!(solution.exit_status().number() == 4, solution.overlap.is_some());
        solution.overlap.map(|overlap| (overlap.node.index(), overlap.nodes))
    };
    assert_eq!(overlap(ALL), None);
    assert_eq!(overlap([&[0, 1], ALL[1]]), Some((12, 2)));
    assert_eq!(overlap([ALL[0], &[1, 2, 3, 4]]).map(|found| found.0), Some(10));
}
