//! SOURCE: the paper's example; what closed forms come near it, `conforming.rs` tests.
//!
//! GOAL: the scene of `golden/strand` on a mesh of our own, for any radii and edge length: exactly
//! mirror-symmetric, well-shaped, the two bodies side by side.
//!
//! MESH: eight ducts from nearly conforming to wide, three edge lengths.
//!
//! BOUNDARY CONDITIONS: those of `golden/strand/scene.json`.

use std::collections::BTreeSet;

use crate::common::tolerances::{STRAIGHT, assert_near};
use crate::meshes::least_angle;
use plane_contact::engine::{Request, solve};
use plane_contact::problem::element;
use plane_contact::problem::modelling::Variant;
use plane_contact::problem::scene::{Mesh, SceneBuilder};
use plane_contact::studies::benchmark::Strand;

const RADIUS: f64 = 7.6;
const DUCTS: [f64; 8] = [7.61, 7.62, 7.65, 7.7, 8.0, 8.5, 12.0, 20.0];
const SIZES: [f64; 3] = [0.9, 0.45, 0.25];
const GROUPS: &str = "bottom right top left duct_wall stamp_arc stamp_top stamp_axis block stamp";

/// Every duct at every size.
fn meshes() -> impl Iterator<Item = (f64, f64, Mesh)> {
    let pairs = DUCTS.into_iter().flat_map(|duct| SIZES.map(|size| (duct, size)));
    pairs.map(|(duct, size)| (duct, size, mesh(duct, size)))
}

fn mesh(duct: f64, size: f64) -> Mesh {
    Strand { duct, size, ..Strand::default() }.generate().expect("in range").mesh
}

/// The elements of a group, in their order.
fn group<'m>(mesh: &'m Mesh, name: &str) -> Vec<&'m [usize]> {
    let tag = mesh.names.iter().find(|n| n.name == name).expect("a group").tag;
    let of = mesh.elements.iter().filter(|e| e.physical[..] == [tag]);
    of.map(|element| element.nodes.as_slice()).collect()
}

/// The nodes along a group of edges, each of which begins where the last one ends.
fn chain(mesh: &Mesh, name: &str) -> Vec<usize> {
    let edges = group(mesh, name);
    assert!(edges.windows(2).all(|pair| pair[0][1] == pair[1][0]), "{name} is one chain");
    edges.iter().map(|edge| edge[0]).chain([edges[edges.len() - 1][1]]).collect()
}

fn places(mesh: &Mesh, name: &str) -> Vec<[f64; 2]> {
    chain(mesh, name).into_iter().map(|node| mesh.xy(node)).collect()
}

/// Twice the area of a triangle, positive where it runs counter-clockwise.
fn cross(a: [f64; 2], b: [f64; 2], p: [f64; 2]) -> f64 {
    (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0])
}

#[test]
fn triangles_are_well_shaped_and_run_counter_clockwise() {
    for (duct, size, mesh) in meshes() {
        let (angle, triangles) = (least_angle(&mesh), mesh.of_dimension(2).count());
        println!("{duct} {size}: {} nodes, {triangles} triangles, {angle:.1}", mesh.nodes.len());
        assert!(angle >= 20.0, "duct {duct}, size {size}: {angle} degrees");
    }
}

#[test]
fn parameters_at_their_limits_make_well_shaped_triangles() {
    for (duct, strand, size) in [
        (7.6, 7.6, 0.45),
        (22.0, 7.4, 1.1),
        (22.0, 22.0, 1.2),
        (1.0, 0.35, 0.05),
        (1.0, 1.0, 0.16),
        (7.7, 7.6, 0.025),
    ] {
        let made = Strand { duct, strand, size, ..Strand::default() }.generate().expect("in range");
        assert!(made.build().is_ok(), "duct {duct}, strand {strand}, size {size}");
        let angle = least_angle(&made.mesh);
        assert!(angle >= 20.0, "duct {duct}, strand {strand}, size {size}: {angle} degrees");
    }
}

/// A disc cut anywhere lies in the duct, and its top is where it was asked for: to an edge below the
/// centre, where it ends at a node of the arc.
#[test]
fn stamps_of_all_heights_are_well_shaped() {
    for (duct, size, top) in DUCTS.into_iter().flat_map(|duct| {
        [0.3, 0.5, 0.9, 1.1, 1.5, 1.7]
            .into_iter()
            .flat_map(move |top| [(duct, 0.9, top), (duct, 0.45, top)])
    }) {
        let made = Strand { duct, size, top, ..Strand::default() };
        let what = format!("duct {duct}, size {size}, top {top}");
        let mesh = match made.generate() {
            Ok(made) => made.mesh,
            // The wall's chords would cut into the disc.
            Err(why) => {
                assert!(top > 1.0 && duct < 7.7 && why.place == "top", "{what}: {why}");
                continue;
            }
        };
        assert!(least_angle(&mesh) >= 20.0, "{what}: {} degrees", least_angle(&mesh));
        let flat = places(&mesh, "stamp_top");
        let (height, ends) = (flat[0][1] + duct, flat[flat.len() - 1]);
        assert!(flat.iter().all(|p| p[1] == flat[0][1]) && ends[0] == -flat[0][0], "{what}");
        let edge = if top < 1.0 { size } else { STRAIGHT.limit };
        assert!((height - top * RADIUS).abs() <= edge, "{what}: {height}");
        let wall = places(&mesh, "duct_wall");
        for node in group(&mesh, "stamp").into_iter().flatten() {
            let p = mesh.xy(*node);
            let depth = wall.windows(2).map(|w| cross(w[0], w[1], p)).fold(f64::INFINITY, f64::min);
            assert!(depth > -STRAIGHT.limit * duct, "{what}: {p:?} is {depth} inside");
        }
        let arc = places(&mesh, "stamp_arc");
        assert!(arc.iter().all(|p| p[1] <= RADIUS - duct + STRAIGHT.limit), "{what}");
    }
}

/// Triangles and groups are their own mirror image, to the bit.
#[test]
fn meshes_are_exactly_symmetric() {
    let bits = |p: [f64; 2]| p.map(|x| (x + 0.0).to_bits());
    for (duct, size, mesh) in meshes() {
        for name in GROUPS.split(' ') {
            let image_of = match name {
                "left" => "right",
                "right" => "left",
                other => other,
            };
            let elements = |name: &str, sign: f64| -> BTreeSet<Vec<[u64; 2]>> {
                let corner = |&node: &usize| {
                    let [x, y] = mesh.xy(node);
                    bits([sign * x, y])
                };
                let sorted = |nodes: &[usize]| {
                    let mut corners: Vec<[u64; 2]> = nodes.iter().map(corner).collect();
                    corners.sort_unstable();
                    corners
                };
                group(&mesh, name).into_iter().map(sorted).collect()
            };
            let (here, there) = (elements(name, 1.0), elements(image_of, -1.0));
            assert!(here == there, "duct {duct}, size {size}: {name}");
        }
    }
}

#[test]
fn the_block_has_its_square_without_the_polygon_of_the_duct() {
    for (duct, size, mesh) in meshes() {
        let area = |body: &str| -> f64 {
            let corners = |t: &&[usize]| [t[0], t[1], t[2]].map(|node| mesh.xy(node));
            group(&mesh, body).iter().map(|t| element::area(&corners(t))).sum()
        };
        let polygon = |nodes: &[[f64; 2]]| -> f64 {
            nodes.windows(2).map(|w| cross([0.0; 2], w[0], w[1]) / 2.0).sum()
        };
        let exact = 2500.0 - polygon(&places(&mesh, "duct_wall"));
        let what = format!("duct {duct}, size {size}");
        assert_near(&what, area("block"), exact, exact, &STRAIGHT);
        // A fan from the lowest point to the arc leaves the triangle under the flat top.
        let arc: Vec<_> = places(&mesh, "stamp_arc").iter().map(|p| [p[0], p[1] + duct]).collect();
        let flat = RADIUS * RADIUS;
        assert_near(&what, area("stamp"), polygon(&arc) + flat, flat, &STRAIGHT);
    }
}

/// All groups of the golden scene in its order; nodes on the circles, one after the other.
#[test]
fn groups_are_those_of_the_golden_scene() {
    for (duct, size, mesh) in meshes() {
        let names: Vec<&str> = mesh.names.iter().map(|n| n.name.as_str()).collect();
        assert_eq!(names.join(" "), GROUPS);
        let wall = chain(&mesh, "duct_wall");
        assert_eq!(wall.first(), wall.last(), "the wall is closed");
        let arc = chain(&mesh, "stamp_arc");
        let from = |node: &usize, y: f64| mesh.xy(*node)[0].hypot(mesh.xy(*node)[1] - y);
        wall.iter().for_each(|node| assert_near("wall", from(node, 0.0), duct, duct, &STRAIGHT));
        let centre = RADIUS - duct;
        arc.iter().for_each(|node| assert_near("arc", from(node, centre), RADIUS, duct, &STRAIGHT));
        assert_eq!(mesh.xy(wall[0]), [-duct, 0.0], "the wall begins at the left");
        assert!(mesh.xy(wall[1])[1] < 0.0, "and runs down");
        for (name, length) in [("stamp_arc", arc.len()), ("duct_wall", wall.len())] {
            let distinct: BTreeSet<usize> = chain(&mesh, name).into_iter().collect();
            let closed = usize::from(name == "duct_wall");
            assert_eq!(distinct.len(), length - closed, "duct {duct}, size {size}: {name}");
        }
        ["bottom", "right", "top", "left", "stamp_top", "stamp_axis"]
            .iter()
            .for_each(|name| assert!(chain(&mesh, name).len() > 3));
    }
}

#[test]
fn bodies_share_no_node_and_do_not_overlap() {
    for (duct, size, mesh) in meshes() {
        assert!(mesh.orphans().is_empty());
        let nodes = |body| group(&mesh, body).into_iter().flatten().collect::<BTreeSet<_>>();
        assert!(nodes("block").is_disjoint(&nodes("stamp")));
        let (wall, arc) = (places(&mesh, "duct_wall"), places(&mesh, "stamp_arc"));
        let lowest = [0.0, -duct];
        assert!(wall.contains(&lowest) && arc.contains(&lowest), "duct {duct}, size {size}");
        for p in arc {
            let depth = wall.windows(2).map(|w| cross(w[0], w[1], p)).fold(f64::INFINITY, f64::min);
            let rounding = STRAIGHT.limit * duct;
            assert!(depth > -rounding, "duct {duct}, size {size}: {p:?} is {depth} inside");
            assert!(!wall.contains(&p) || p == lowest, "duct {duct}, size {size}: {p:?}");
        }
    }
}

#[test]
fn the_default_scene_is_the_golden_one_but_for_its_mesh_and_title() {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("golden/strand");
    let beside = |file: &str| std::fs::read(folder.join(file)).map_err(|why| why.to_string());
    let text = beside("scene.json").expect("the golden scene");
    let golden = SceneBuilder::read("strand", &text, beside).expect("a sound scene");
    let mut made = Strand::default().generate().expect("the defaults are in range");
    assert!(made.mesh.nodes.len().abs_diff(golden.mesh.nodes.len()) < 100);
    assert_eq!(chain(&made.mesh, "stamp_arc").len(), chain(&golden.mesh, "stamp_arc").len());
    made.description.title.clone_from(&golden.description.title);
    assert_eq!(made.description, golden.description);
}

#[test]
fn the_default_scene_runs() {
    let scene = Strand::default().generate().and_then(|made| made.build()).expect("a sound scene");
    for variant in [Variant::Unilateral, Variant::Stepped] {
        let solution = solve(&Request::new(&scene).variant(variant), &mut |_| ());
        let solution = solution.unwrap_or_else(|why| panic!("{variant:?}: {why}"));
        assert!(solution.in_contact().count() > 3, "{variant:?}");
    }
}
