//! Points where the stress has no limit, on 4 x 4 cells, most often on a fixed edge, and on two
//! blocks that touch.

use plane_contact::engine::estimates::{Cause, singular};
use plane_contact::problem::element::Plane;
use plane_contact::problem::modelling::{Friction, Variant};
use plane_contact::problem::scene::{Axis, Contact, MeshBuilder, SceneBuilder};
use plane_contact::{Request, solve};

/// The number of a node by its place, from 1.
fn node([x, y]: [usize; 2]) -> usize {
    5 * y + x + 1
}

const MATERIALS: [(&str, f64, f64); 3] =
    [("soft", 1000.0, 0.3), ("hard", 30000.0, 0.2), ("steel", 210000.0, 0.3)];

/// Builds the cells, held nowhere. A node of the place (x, y) stands at `at` of it; a cell is of
/// that one of the materials that `of` names by its lower left corner.
fn cells(
    plane: Plane,
    at: impl Fn([f64; 2]) -> [f64; 2],
    of: impl Fn([usize; 2]) -> usize,
) -> SceneBuilder {
    let places = || (0..5).flat_map(|y| (0..5).map(move |x| [x, y]));
    let mut mesh = MeshBuilder::default();
    mesh.row(places().map(|place| at(place.map(|x| x as f64))));
    let own = |material: usize| {
        let cells = places().filter(|[x, y]| *x < 4 && *y < 4);
        cells.filter(|cell| of(*cell) == material).collect::<Vec<_>>()
    };
    let used: Vec<usize> = (0..MATERIALS.len()).filter(|k| !own(*k).is_empty()).collect();
    for k in &used {
        let triangles = own(*k).into_iter().flat_map(|[x, y]| {
            let [a, b, c, d] = [[x, y], [x + 1, y], [x + 1, y + 1], [x, y + 1]].map(node);
            [[a, b, c], [a, c, d]]
        });
        mesh.triangles(MATERIALS[*k].0, triangles);
    }
    let scene = SceneBuilder::new("square", mesh.finish(), plane).iterations(1);
    used.into_iter()
        .map(|k| MATERIALS[k])
        .fold(scene, |scene, (name, e, nu)| scene.material(name, e, nu))
}

/// Fixes the lowest row.
fn standing(cells: SceneBuilder) -> SceneBuilder {
    (0..5).fold(cells, |scene, x| scene.restrain_node(node([x, 0]), &[Axis::X, Axis::Y]))
}

/// Builds a square of unit cells, some of them hard.
fn square(is_hard: impl Fn([usize; 2]) -> bool) -> SceneBuilder {
    standing(cells(Plane::Strain, |place| place, |cell| usize::from(is_hard(cell))))
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
    let square = || square(|_| false);
    let loaded = |scene| found(scene, Cause::Load);
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
    let square = cells(Plane::Strain, |place| place, |_| 0)
        .restrain_node(node([0, 0]), &[Axis::X, Axis::Y])
        .restrain_node(node([4, 0]), &[Axis::Y]);
    assert_eq!(found(square.clone(), Cause::Support), [0; 0], "nothing to hold");
    let pressed = square.force(node([2, 4]), [0.0, -1e-4]);
    assert_eq!(found(pressed.clone(), Cause::Support), nodes(&[[0, 0], [4, 0]]));
    // Half a force that pulls up at one of them leaves it nothing to hold.
    let pulled = pressed.clone().force(node([0, 0]), [0.0, 0.5e-4]);
    assert_eq!(found(pulled, Cause::Support), nodes(&[[4, 0]]));
    let squeezed = pressed.force(node([2, 0]), [0.0, 1e-4]);
    assert_eq!(found(squeezed, Cause::Support), [0; 0]);
}

/// Where a fixed side ends at a free one, the stress has a limit up to an angle ω with
/// sin²ω = (κ + 1) / 4. At ν = 0.3 that is 56.8° in plane strain, where κ is 1.8, and 61.3° in
/// plane stress, where it is 2.7 / 1.3.
#[test]
fn the_end_of_a_fixed_edge_has_a_limit_in_a_sharp_corner() {
    for (plane, limit) in [(Plane::Strain, 56.8), (Plane::Stress, 61.3)] {
        let ends = |degrees: f64| {
            let lean = |[x, y]: [f64; 2]| [x + y / degrees.to_radians().tan(), y];
            found(standing(cells(plane, lean, |_| 0)), Cause::Restraint)
        };
        assert_eq!(ends(limit - 2.0), nodes(&[[4, 0]]), "{plane:?}: the other angle is obtuse");
        assert_eq!(ends(limit + 2.0), nodes(&[[0, 0], [4, 0]]), "{plane:?}");
    }
}

/// The lowest row is held in one direction, the middle node in the other. Where a side can move along
/// itself, the stress has a limit up to 90° and half of what chords turn; another one is fixed.
#[test]
fn the_end_of_a_side_that_can_move_along_itself_has_a_limit_up_to_a_right_angle() {
    let ends = |along: Axis, across: Axis, at: &dyn Fn([f64; 2]) -> [f64; 2]| {
        let cells = cells(Plane::Strain, at, |_| 0).restrain_node(node([2, 2]), &[across]);
        let row = (0..5).fold(cells, |scene, x| scene.restrain_node(node([x, 0]), &[along]));
        found(row.force(node([2, 4]), [1.0, 1.0]), Cause::Restraint)
    };
    let leaning =
        |degrees: f64| ends(Axis::Y, Axis::X, &|[x, y]| [x + y / degrees.to_radians().tan(), y]);
    assert_eq!(leaning(100.0), [0; 0]);
    assert_eq!(leaning(110.0), [node([0, 0])]);
    let both = nodes(&[[0, 0], [4, 0]]);
    assert_eq!(ends(Axis::X, Axis::Y, &|[x, y]| [x - y, x + y]), both, "a slope of 45°");
    // At half of 60° a side along no axis is fixed.
    let slope = std::f64::consts::PI / 6.0;
    let steep = ends(Axis::X, Axis::Y, &|[x, y]| [slope * x - y, x + slope * y]);
    assert!(steep.contains(&node([0, 0])), "{steep:?}");
    let flat = ends(Axis::Y, Axis::X, &|[x, y]| [x - slope * y, slope * x + y]);
    assert!(flat.contains(&node([0, 0])), "{flat:?}");
    let flatter = ends(Axis::Y, Axis::X, &|[x, y]| [x - 0.5 * y, 0.5 * x + y]);
    assert_eq!(flatter, [0; 0]);
}

/// An interface of two materials ends at the outline and turns inside; where it is straight, the
/// stress has a limit.
#[test]
fn interfaces_end_and_turn() {
    let interface = |is_hard: fn([usize; 2]) -> bool| found(square(is_hard), Cause::Interface);
    assert_eq!(interface(|[_, y]| y >= 2), nodes(&[[0, 2], [4, 2]]), "a straight layer");
    let turns = nodes(&[[2, 2], [4, 2], [2, 4]]);
    assert_eq!(interface(|[x, y]| x >= 2 && y >= 2), turns, "a corner");
    let board = interface(|[x, y]| (x >= 2) == (y >= 2));
    assert!(board.contains(&node([2, 2])), "four quarters meet: {board:?}");
}

/// A layer on another, both bent in the middle: by up to 30° for a chord of a curve, by more for a
/// corner. A slope is no bend.
#[test]
fn bent_interfaces_are_curves_or_corners() {
    let layers = |at: &dyn Fn(f64) -> f64| {
        let at = |[x, y]: [f64; 2]| [x / 2.0, y / 2.0 + at(x / 2.0)];
        let layers = cells(Plane::Strain, at, |[_, y]| usize::from(y < 2));
        found(standing(layers), Cause::Interface)
    };
    let bent = |degrees: f64| {
        let slope = (degrees / 2.0).to_radians().tan();
        layers(&|x| -slope * (x - 1.0).abs())
    };
    let ends = nodes(&[[0, 2], [4, 2]]);
    assert_eq!(layers(&|x| x), ends, "a slope of 45°");
    assert_eq!(bent(20.0), ends);
    assert_eq!(bent(40.0), nodes(&[[0, 2], [2, 2], [4, 2]]));
}

/// The interface of a layer is straight where that of the two blocks below it ends.
#[test]
fn interfaces_branch() {
    let branch = |[x, y]: [usize; 2]| if y >= 2 { 0 } else { 1 + usize::from(x >= 2) };
    let branch = standing(cells(Plane::Strain, |place| place, branch));
    assert_eq!(found(branch, Cause::Interface), nodes(&[[2, 0], [0, 2], [2, 2], [4, 2]]));
}

/// A block of three unit cells in width on another: where their sides make one straight outline,
/// they are as one body; where the lower one is wider, contact ends at the edge of the upper one.
#[test]
fn contact_ends_at_the_edge_of_a_narrower_body() {
    let edges = |overhang: [f64; 2]| {
        let mut mesh = MeshBuilder::default();
        let upper = [0.0, 1.0, 2.0, 3.0];
        let lower = [-overhang[0], 1.0, 2.0, 3.0 + overhang[1]];
        let rows = [(lower, 0.0), (lower, 1.0), (upper, 1.0), (upper, 2.0)]
            .map(|(xs, y)| mesh.row(xs.map(|x| [x, y])));
        mesh.join("lower", &rows[0], &rows[1]);
        mesh.join("upper", &rows[2], &rows[3]);
        let names = ["bottom", "target", "contact", "top"];
        names.iter().zip(&rows).for_each(|(name, row)| mesh.edges(*name, row));
        let scene = SceneBuilder::new("blocks", mesh.finish(), Plane::Strain)
            .material("lower", 1000.0, 0.0)
            .material("upper", 1000.0, 0.0)
            .restrain("bottom", &[Axis::X, Axis::Y])
            .restrain("top", &[Axis::X])
            .pressure("top", 1.0)
            .contact(Contact::new("contact", "target", 0.01))
            .variant(Variant::Unilateral);
        found(scene, Cause::Edge).into_iter().map(|n| n - rows[2][0]).collect::<Vec<_>>()
    };
    assert_eq!(edges([0.0, 0.0]), [0; 0]);
    assert_eq!(edges([1.0, 0.0]), [0]);
    assert_eq!(edges([0.0, 1.0]), [3]);
    assert_eq!(edges([1.0, 1.0]), [0, 3]);
}

/// A tip of 90° is an edge where contact ends although the surface goes on, and so is the end of a
/// surface on a straight side.
#[test]
fn contact_ends_at_tips_and_where_the_surface_does() {
    let edges = |bottom: [f64; 5], entries: std::ops::Range<usize>| {
        let mut mesh = MeshBuilder::default();
        let lower = [-1.0, 0.0, 1.0, 2.0, 3.0, 4.0, 5.0];
        let xs = [0.0, 1.0, 2.0, 3.0, 4.0];
        let rows = [0.0, 1.0].map(|y| mesh.row(lower.map(|x| [x, y])));
        let contact = mesh.row(xs.into_iter().zip(bottom).map(|(x, y)| [x, 1.0 + y]));
        let top = mesh.row(xs.map(|x| [x, 5.0]));
        mesh.join("lower", &rows[0], &rows[1]);
        mesh.join("upper", &contact, &top);
        mesh.edges("bottom", &rows[0]);
        mesh.edges("target", &rows[1]);
        mesh.edges("top", &top);
        let scene = SceneBuilder::new("tip", mesh.finish(), Plane::Strain)
            .material("lower", 1000.0, 0.0)
            .material("upper", 1000.0, 0.0)
            .restrain("bottom", &[Axis::X, Axis::Y])
            .restrain("top", &[Axis::X, Axis::Y])
            .contact(Contact {
                friction: Friction::NONE,
                ..Contact::new(contact[entries].to_vec(), "target", 0.01)
            })
            .variant(Variant::Unilateral);
        let pressed = contact.iter().fold(scene, |scene, n| scene.force(*n, [0.0, -0.1]));
        found(pressed, Cause::Edge).into_iter().map(|n| n - contact[0]).collect::<Vec<_>>()
    };
    assert_eq!(edges([2.0, 1.0, 0.0, 1.0, 2.0], 0..5), [2]);
    // A bend of less than 30° is a chord of a curve.
    assert_eq!(edges([0.4, 0.2, 0.0, 0.2, 0.4], 0..5), [0; 0]);
    // So is one of just 30°, and one of 31° is a corner; node 4 is the end of the surface.
    let bend = |degrees: f64| {
        let slope = degrees.to_radians().tan();
        edges([2.0 * slope, slope, 0.0, 0.0, 0.0], 0..5)
    };
    assert_eq!(bend(30.0), [4]);
    assert_eq!(bend(31.0), [2, 4]);
    assert_eq!(edges([0.0; 5], 1..4), [1, 3]);
}
