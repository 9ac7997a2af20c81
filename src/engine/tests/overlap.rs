//! Nodes that lie inside another body: how deep, and whether contact watches them, by hand.

use std::collections::HashSet;
use std::sync::Arc;

use engine::contact::{InsideNode, Surfaces, Watched};
use engine::{Request, share_of_load, solve};
use problem::element::Plane;
use problem::model::NodeId;
use problem::modelling::{Coupling, Friction, Geometry, Variant};
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
    let contact_of = Contact {
        friction: Some(Friction::NONE),
        coupling: Some(Coupling::Mortar),
        ..Contact::new("contact", "target", 0.01)
    };
    let scene = pressed([contact, target]).restrain_node(15, &[Axis::X]).pressure("top", 1.0);
    scene.contact(contact_of).build().expect("it is sound")
}

/// The same without contact, load, and what holds the upper block.
fn pressed([contact, target]: [&[usize]; 2]) -> SceneBuilder {
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
    SceneBuilder::new("blocks", mesh.finish(), Plane::Stress)
        .variant(Variant::Unilateral)
        .material("lower", 1000.0, 0.3)
        .material("upper", 1000.0, 0.3)
        .restrain("bottom", &[Axis::X, Axis::Y])
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

/// Without contact the lower block is pulled into the upper one, or away from it, or pushed through its own bottom.
#[test]
fn bodies_without_contact_are_searched_and_so_are_triangles_turned_inside_out() {
    for (pressure, [overlaps, inside_out]) in
        [(-10.0, [true, false]), (10.0, [false, false]), (3000.0, [false, true])]
    {
        let scene = pressed(ALL).restrain("top", &[Axis::X, Axis::Y]).pressure("target", pressure);
        let mut request = Request::new(&scene.build().expect("it is sound"));
        // In the current geometry the step that turns a triangle inside out is refused.
        request.contact.geometry = Geometry::Initial;
        let solution = solve(&request, &mut |_| ()).expect("there are displacements");
        assert_eq!((solution.overlap.is_some(), solution.is_inside_out()), (overlaps, inside_out));
        let status = solution.exit_status().number();
        assert_eq!(status == 4, overlaps || inside_out, "{pressure}");
    }
}

/// Bodies lie in each other by what six digits leave of their coordinates; what the load adds is found all the same.
#[test]
fn rounded_coordinates_are_no_overlap() {
    for (depth, load, is_found) in
        [(0.0, 1e-6, true), (4e-6, 1e-6, false), (4e-6, 1.0, true), (4e-4, 1e-6, true)]
    {
        let mut scene = blocks(&[0, 1], ALL[1]);
        let model = Arc::make_mut(&mut scene.model);
        model.nodes[12][1] -= depth;
        model.stages.iter_mut().chain([&mut model.load]).for_each(|f| *f *= load);
        let solution = solve(&Request::new(&scene), &mut |_| ()).expect("an equilibrium");
        assert_eq!(solution.overlap.is_some(), is_found, "{depth} {load}");
    }
}

/// The lower block is 1 thick: however short the edges, a node up to 0.5 deep is read as an interference, and a deeper
/// one as come from the other side; behind the block it faces nothing.
#[test]
fn a_scene_is_refused_where_a_node_is_nearer_to_the_other_side_of_the_target() {
    for (depth, is_refused, faces) in [(0.49, false, true), (0.51, true, true), (1.5, false, false)]
    {
        let mut model = (*blocks(ALL[0], ALL[1]).model).clone();
        model.nodes[10..].iter_mut().for_each(|at| at[1] -= depth);
        let surfaces = Surfaces::new(&model).expect("edges of the outline");
        let refused = surfaces.check_initial_penetration(&model).is_err();
        assert_eq!(refused, is_refused, "{depth}");
        for coupling in [Coupling::Nts, Coupling::Mortar] {
            let pairings = surfaces.pairings(coupling, &model.nodes);
            assert_eq!(pairings.iter().any(Option::is_some), faces, "{depth} {coupling}");
        }
    }
}

/// Contact passes on the whole load, none where it acts across, and no share where the loads on a body cancel or act on
/// both.
#[test]
fn a_share_of_the_load_is_said_where_it_says_something() {
    let share = |forces: &[(usize, [f64; 2])]| {
        let mut scene = pressed(ALL).restrain_node(15, &[Axis::X]);
        for (node, force) in forces {
            scene = scene.force(*node, *force);
        }
        let contact =
            Contact { friction: Some(Friction::NONE), ..Contact::new("contact", "target", 0.01) };
        let scene = scene.contact(contact).build().expect("it is sound");
        let solution = solve(&Request::new(&scene), &mut |_| ()).expect("an equilibrium");
        assert!(!solution.transmits_nothing(), "{forces:?}");
        share_of_load(&solution.model, solution.target_force()).map(|share| share.round())
    };
    let (down, up, across) = ([0.0, -1.0], [0.0, 1.0], [0.1, 0.0]);
    assert_eq!(share(&[(15, down)]), Some(1.0));
    assert_eq!(share(&[(15, down), (6, up)]), None);
    assert_eq!(share(&[(15, [0.0, -1.0 - 1e-9]), (12, up)]), None);
    assert_eq!(share(&[(15, [10.0, -0.1])]), Some(0.0));
    assert_eq!(share(&[(15, down), (11, across)]), Some(1.0));
}
