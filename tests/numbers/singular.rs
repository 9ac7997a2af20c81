//! Points where the stress has no limit, on a square of 4 x 4 cells that stands on a fixed edge.

use plane_contact::answer::estimates::{Cause, singular};
use plane_contact::problem::element::Plane;
use plane_contact::problem::scene::{Axis, MeshBuilder, SceneBuilder};
use plane_contact::{Request, solve};

/// The number of a node by its place, from 1.
fn node([x, y]: [usize; 2]) -> usize {
    5 * y + x + 1
}

/// Builds the square; the cells that `is_hard` names by their lower left corner are of a material of
/// their own.
fn square(is_hard: impl Fn([usize; 2]) -> bool) -> SceneBuilder {
    let places = || (0..5).flat_map(|y| (0..5).map(move |x| [x, y]));
    let mut mesh = MeshBuilder::default();
    mesh.row(places().map(|place| place.map(|x| x as f64)));
    for (name, hard) in [("soft", false), ("hard", true)] {
        let cells = places().filter(|[x, y]| *x < 4 && *y < 4 && is_hard([*x, *y]) == hard);
        let triangles = cells.flat_map(|[x, y]| {
            let [a, b, c, d] = [[x, y], [x + 1, y], [x + 1, y + 1], [x, y + 1]].map(node);
            [[a, b, c], [a, c, d]]
        });
        mesh.triangles(name, triangles);
    }
    let scene = SceneBuilder::new("square", mesh.finish(), Plane::Strain)
        .material("soft", 1000.0, 0.3)
        .iterations(1);
    (0..5).fold(scene, |scene, x| scene.restrain_node(node([x, 0]), &[Axis::X, Axis::Y]))
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
    let square = || square(|_| false);
    let loaded = |scene| found(scene, Cause::Load);
    let top = |x| node([x, 4]);
    assert_eq!(loaded(square().force(top(2), [0.0, -1.0])), [top(2)]);
    let edge = square().force(top(2), [0.0, -1.0]).force(top(3), [0.0, -1.0]);
    assert_eq!(loaded(edge), [0; 0], "a traction on an edge");
    let back = square().force(top(2), [0.0, -1.0]).force(top(2), [0.0, 1.0]);
    assert_eq!(loaded(back), [0; 0], "nothing in all");
    let held = square().restrain_node(top(2), &[Axis::X]);
    assert_eq!(loaded(held.force(top(2), [1.0, 0.0])), [0; 0], "along the held direction alone");
}

/// An interface of two materials ends at the outline and turns inside; where it is straight, the
/// stress has a limit.
#[test]
fn interfaces_end_and_turn() {
    let interface = |is_hard: fn([usize; 2]) -> bool| {
        found(square(is_hard).material("hard", 30000.0, 0.2), Cause::Interface)
    };
    let ends = |places: &[[usize; 2]]| places.iter().copied().map(node).collect::<Vec<_>>();
    assert_eq!(interface(|[_, y]| y >= 2), ends(&[[0, 2], [4, 2]]), "a straight layer");
    let turns = ends(&[[2, 2], [4, 2], [2, 4]]);
    assert_eq!(interface(|[x, y]| x >= 2 && y >= 2), turns, "a corner");
    let branches = ends(&[[2, 2]]);
    let board = interface(|[x, y]| (x >= 2) == (y >= 2));
    assert!(board.contains(&branches[0]), "four quarters meet: {board:?}");
}
