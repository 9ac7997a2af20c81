//! Nodes that lie inside another body: how deep, and whether contact watches them, by hand.

use std::collections::HashMap;

use engine::contact::{InsideNode, Surfaces, Watched};
use engine::{Request, solve};
use problem::element::Plane;
use problem::modelling::{Coupling, Friction, Geometry, Variant};
use problem::scene::{Axis, Contact, MeshBuilder, Scene, SceneBuilder};
use testing::rows::scene_of;

/// A block on a wider one; the groups of contact, nodes 11 to 13 and edges 5 to 8, may have some of where they meet.
///
/// ```text
///          14--15--16       y = 2
///           |   |   |
///          11--12--13       y = 1
///       6---7---8---9--10   y = 1
///       |   |   |   |   |
///       1---2---3---4---5   y = 0
/// ```
fn blocks(row: &str) -> Scene {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../tests/contact/scenes");
    scene_of(folder, row).expect("it is sound")
}

/// The nodes inside where the upper block is moved down by a tenth, in order, with their depths.
fn inside(row: &str) -> Vec<(usize, Watched)> {
    let model = blocks(row).model;
    let mut shape = model.nodes.clone();
    shape[10..].iter_mut().for_each(|at| at[1] -= 0.1);
    let surfaces = Surfaces::new(&model).expect("edges of the outline");
    let facing = surfaces.pairings(Coupling::Mortar, &shape);
    let facing = facing.iter().flatten().map(|pairing| (pairing.node, false)).collect();
    let mut found = surfaces.inside(&model, &shape, &facing);
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
    assert_eq!(inside("foot"), all);
    let short = [(6, Target), (7, Not), (10, Contact), (11, Contact), (12, Not)];
    assert_eq!(inside("foot cnt=[11,12]"), short);
    let short = [(6, Target), (7, Target), (10, Not), (11, Contact), (12, Contact)];
    assert_eq!(inside("foot trg=[6,7,8]"), short);
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
    let found = surfaces.inside(&scene.model, &scene.model.nodes, &HashMap::new());
    let height = 10.0 * (1.0 - (1.0_f64 / 12.0).cos());
    assert!(found.iter().any(|inside| inside.depth > 0.5 * height), "{found:?}");
    // The ends of both arcs are the same points.
    for InsideNode { depth, height: said, .. } in found.into_iter().filter(|at| at.depth > 1e-9) {
        assert!(depth <= said && (said - height).abs() < 2e-3 * height, "{depth} {said} {height}");
    }
    let solution = solve(&Request::new(&scene), &mut |_| ()).expect("there is an equilibrium");
    assert_eq!(solution.overlap, None);
}

/// Without contact the lower block is pulled into the upper one, or away from it, or pushed through its own bottom.
#[test]
fn bodies_without_contact_are_searched_and_so_are_triangles_turned_inside_out() {
    for (pressure, [overlaps, inside_out]) in
        [("-10", [true, false]), ("10", [false, false]), ("3000", [false, true])]
    {
        let held = r#"/restraints/1={"on":21,"fix":["x","y"]}"#;
        let pulled = format!(r#"/loads/-={{"on":11,"pressure":{pressure}.0}}"#);
        let mut request = Request::new(&blocks(&format!("foot {held} {pulled} /contact=null")));
        // In the current geometry the step that turns a triangle inside out is refused.
        request.contact.geometry = Geometry::Initial;
        let solution = solve(&request, &mut |_| ()).expect("there are displacements");
        assert_eq!((solution.overlap.is_some(), solution.is_inside_out()), (overlaps, inside_out));
        let status = solution.exit_status().number();
        assert_eq!(status == 4, overlaps || inside_out, "{pressure}");
    }
}

/// The lower block is 1 thick: however short the edges, a node up to 0.5 deep is read as an interference, and a deeper
/// one as come from the other side; behind the block it faces nothing.
#[test]
fn a_scene_is_refused_where_a_node_is_nearer_to_the_other_side_of_the_target() {
    for (depth, is_refused, faces) in [(0.49, false, true), (0.51, true, true), (1.5, false, false)]
    {
        let mut model = (*blocks("foot").model).clone();
        model.nodes[10..].iter_mut().for_each(|at| at[1] -= depth);
        let surfaces = Surfaces::new(&model).expect("edges of the outline");
        let refused = surfaces.check_initial_penetration(&model).is_err();
        assert_eq!(refused, is_refused, "{depth}");
        for &coupling in Coupling::ALL {
            let pairings = surfaces.pairings(coupling, &model.nodes);
            assert_eq!(pairings.iter().any(Option::is_some), faces, "{depth} {coupling}");
        }
    }
}
