//! Points where the stress has no limit, on squares of cells, on generated meshes and on strand.
//!
//! SOURCE: corners: M. L. Williams, J. Appl. Mech. 19 (1952) 526-528; a force on a node: Flamant, S. P.
//! Timoshenko, J. N. Goodier, Theory of Elasticity, art. 36.
//!
//! GOAL: each is found, with its cause, and no other.
//!
//! MESH, BOUNDARY CONDITIONS: those of `mesh annulus`, `mesh hole`, `mesh cook`; a square on a fixed row.

use std::f64::consts::PI;

use crate::common::annulus::annulus;
use crate::common::recovery::solved;
use crate::common::tolerances::assert_near;
use crate::cook::membrane;
use crate::kirsch::sheet;
use plane_contact::engine::estimates::{Cause, Estimates, NoLimit, singular};
use plane_contact::engine::{Assessment, Solution, max_displacement};
use plane_contact::output::tables;
use plane_contact::problem::element::Plane;
use plane_contact::problem::modelling::Variant;
use plane_contact::problem::scene::{Axis, MeshBuilder, Scene, SceneBuilder};
use plane_contact::{Request, solve};

testing::tolerances! {
    /// The growth of the displacement under a force on a node, from mesh to mesh.
    FLAMANT = 0.01, "on the third of four meshes the force is 24 edges from the nearest side";
}

/// The number of a node by its place, from 1.
fn node([x, y]: [usize; 2]) -> usize {
    5 * y + x + 1
}

/// Builds a square of 4 x 4 cells, held nowhere. A node of the place (x, y) stands at `at` of it.
fn cells(plane: Plane, at: impl Fn([f64; 2]) -> [f64; 2]) -> SceneBuilder {
    let places = || (0..5).flat_map(|y| (0..5).map(move |x| [x, y]));
    let mut mesh = MeshBuilder::default();
    mesh.row(places().map(|place| at(place.map(|x| x as f64))));
    let triangles = places().filter(|[x, y]| *x < 4 && *y < 4).flat_map(|[x, y]| {
        let [a, b, c, d] = [[x, y], [x + 1, y], [x + 1, y + 1], [x, y + 1]].map(node);
        [[a, b, c], [a, c, d]]
    });
    mesh.triangles("soft", triangles);
    SceneBuilder::new("square", mesh.finish(), plane)
        .variant(Variant::Stepped)
        .iterations(1)
        .material("soft", 1000.0, 0.3)
}

/// Fixes the lowest row.
fn standing(cells: SceneBuilder) -> SceneBuilder {
    (0..5).fold(cells, |scene, x| scene.restrain_node(node([x, 0]), &[Axis::X, Axis::Y]))
}

/// The numbers of nodes by their places.
fn nodes(places: &[[usize; 2]]) -> Vec<usize> {
    places.iter().copied().map(node).collect()
}

/// Returns the nodes that a cause makes singular.
fn found(scene: SceneBuilder, cause: Cause) -> Vec<usize> {
    let solution = solve(&Request::new(&scene.build().expect("it is sound")), &mut |_| ());
    let points = singular(&solution.expect("the square is held"));
    points.iter().filter(|point| point.cause == cause).map(|point| point.node.number()).collect()
}

/// A force counts where it moves a node that stands alone with it.
#[test]
fn forces_on_single_free_nodes_have_no_limit() {
    let square = || standing(cells(Plane::Strain, |place| place));
    let loaded = |scene| found(scene, Cause::Force);
    let top = |x| node([x, 4]);
    assert_eq!(loaded(square().force(top(2), [0.0, -1.0])), [top(2)]);
    assert_eq!(loaded(square().force(top(2), [1.0, 0.0])), [top(2)]);
    let edge = square().force(top(2), [0.0, -1.0]).force(top(3), [0.0, -1.0]);
    assert_eq!(loaded(edge), [0; 0], "a traction on an edge");
    let back = square().force(top(2), [0.0, -1.0]).force(top(2), [0.0, 1.0]);
    assert_eq!(loaded(back), [0; 0], "nothing in all");
    let held = square().restrain_node(top(2), &[Axis::X]);
    assert_eq!(loaded(held.force(top(2), [1.0, 0.0])), [0; 0], "along the held direction alone");
}

/// On three reactions, half of a force in the middle of the top goes to each end of the bottom. Two
/// forces against each other leave the reactions to rounding, which holds nothing.
#[test]
fn single_nodes_that_hold_a_force_have_no_limit() {
    let square = cells(Plane::Strain, |place| place)
        .restrain_node(node([0, 0]), &[Axis::X, Axis::Y])
        .restrain_node(node([4, 0]), &[Axis::Y]);
    assert_eq!(found(square.clone(), Cause::Force), [0; 0], "nothing to hold");
    let pressed = square.force(node([2, 4]), [0.0, -1e-4]);
    assert_eq!(found(pressed.clone(), Cause::Force), nodes(&[[0, 0], [4, 0], [2, 4]]));
    let squeezed = pressed.force(node([2, 0]), [0.0, 1e-4]);
    assert_eq!(found(squeezed, Cause::Force), nodes(&[[2, 0], [2, 4]]));
}

/// Where a fixed side ends at a free one, the stress has a limit up to an angle ω with
/// sin²ω = (κ + 1) / 4. At ν = 0.3 that is 56.8° in plane strain, where κ is 1.8, and 61.3° in
/// plane stress, where it is 2.7 / 1.3.
#[test]
fn the_end_of_a_fixed_edge_has_a_limit_in_a_sharp_corner() {
    for (plane, limit) in [(Plane::Strain, 56.8), (Plane::Stress, 61.3)] {
        let ends = |degrees: f64| {
            let lean = |[x, y]: [f64; 2]| [x + y / degrees.to_radians().tan(), y];
            found(standing(cells(plane, lean)), Cause::Corner)
        };
        assert_eq!(ends(limit - 2.0), nodes(&[[4, 0]]), "{plane:?}: the other angle is obtuse");
        assert_eq!(ends(limit + 2.0), nodes(&[[0, 0], [4, 0]]), "{plane:?}");
    }
}

/// The limit of each body's largest stress.
fn limits(solution: &Solution) -> Vec<Option<NoLimit>> {
    Estimates::new(solution).errors.bodies.into_iter().map(|body| body.no_limit).collect()
}

/// Cook's membrane has an angle of 108 degrees where its held side ends above, one of 48 below: the
/// stress has a limit below 60.
#[test]
fn a_held_side_has_a_limit_only_where_its_corner_is_sharp() {
    let solution = solved(membrane(16));
    let [Some(found)] = &limits(&solution)[..] else { panic!("the corner is not found") };
    assert_eq!(found.cause, Cause::Corner);
    assert_eq!(solution.model.coordinates(found.node), [0.0, 44.0]);
    assert!(found.is_largest);
}

/// Symmetry and a circle of chords make no corner.
#[test]
fn what_is_smooth_has_a_limit() {
    for smooth in [annulus(8, 16), sheet(16, 5.0)] {
        assert_eq!(limits(&solved(smooth)), [None]);
    }
}

/// Contact that sticks has no limit where it ends; without friction it fades away.
#[test]
fn sticking_contact_has_none_where_it_ends() {
    let request = Request::new(&Scene::open("strand").unwrap());
    let run = |request: &Request| limits(&solve(request, &mut |_| ()).unwrap());
    for body in run(&request.equilibrium()) {
        assert_eq!(body.expect("no limit").cause, Cause::Sticking);
    }
    assert_eq!(run(&request.reference()), [None, None]);
}

/// A block of unit width on a fixed side, six by six squares, with a force on the middle of its top.
fn pushed() -> Scene {
    let mut mesh = MeshBuilder::default();
    let row = |j: usize| (0..7).map(move |i| [i, j].map(|k| k as f64 / 6.0));
    let rows: Vec<_> = (0..7).map(|j| mesh.row(row(j))).collect();
    mesh.join_all("body", &rows);
    mesh.edges("bottom", &rows[0]);
    SceneBuilder::new("pushed", mesh.finish(), Plane::Strain)
        .variant(Variant::Tied)
        .iterations(1)
        .material("body", E, NU)
        .restrain("bottom", &[Axis::X, Axis::Y])
        .force(rows[6][3], [0.0, -P])
        .build()
        .expect("a sound scene")
}

const E: f64 = 1000.0;
const NU: f64 = 0.25;
const P: f64 = 3.0;

/// Flamant: each mesh of half the element size adds 2 (1 − ν²) P ln 2 / (π E) under the force.
#[test]
fn under_a_force_on_a_node_neither_stress_nor_displacement_has_a_limit() {
    let mut scene = pushed();
    let mut largest = Vec::new();
    for _ in 0..4 {
        let solution = solve(&Request::new(&scene), &mut |_| ()).expect("it is held");
        largest.push(max_displacement(&solution.u));
        let estimates = Estimates::new(&solution).errors;
        let limits = estimates.bodies.iter().map(|body| body.no_limit.clone());
        let loaded = limits.flatten().find(|limit| limit.cause == Cause::Force).expect("the force");
        assert_eq!(solution.model.coordinates(loaded.node), [0.5, 1.0]);
        assert_eq!(estimates.displacement_no_limit, Some((loaded.node, Cause::Force)));
        let assessment = Assessment::new(&solution);
        let words = tables::solution(&solution, &assessment).text(usize::MAX);
        assert!(words.contains("unbounded under refinement (node"), "{words}");
        scene = scene.refined().expect("a sound scene").scene;
    }
    let expected = 2.0 * (1.0 - NU * NU) * P * 2f64.ln() / (PI * E);
    let grows = largest[3] - largest[2];
    assert_near("growth", grows, expected, expected, &FLAMANT);
}
