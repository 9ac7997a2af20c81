//! Corners of the target: no answer depends on the place, the direction or the order in which a
//! scene is written, and no apex passes through the other body.

use std::collections::HashMap;

use engine::contact::{InsideNode, Surfaces, Watched};
use engine::error::Error;
use engine::{Request, Solution, solve};
use problem::model::NodeId;
use problem::modelling::{Coupling, Geometry};
use problem::scene::Scene;
use testing::bodies::{Bodies, Writing, blocks, roof, writings};
use testing::tolerances::{INVARIANCE, assert_near};

testing::tolerances! {
    /// The distance of a block from the apex that holds it, over the block's size.
    APEX = 1e-9, "a gap is closed to 5e-13 of the scene, and the apex may be twenty times the block's size";
}

/// Solves bodies as they are written.
fn solved(
    bodies: &Bodies,
    writing: &Writing,
    coupling: Coupling,
    geometry: Geometry,
) -> Result<Solution, Error> {
    solve(&Request::new(&bodies.scene(writing, coupling, geometry).build()?), &mut |_| ())
}

fn displacement(solution: &Solution, node: usize) -> [f64; 2] {
    NodeId::new(node).components(&solution.u)
}

/// Asserts that displacements do not depend on the writing; `Err` must be one everywhere.
fn assert_invariant(name: &str, bodies: &Bodies, coupling: Coupling, geometry: Geometry) {
    let plain = solved(bodies, &Writing::default(), coupling, geometry);
    for writing in writings() {
        let what = format!("{name}, {coupling}, {geometry:?}, {writing:?}");
        let other = solved(bodies, &writing, coupling, geometry);
        let (plain, other) = match (&plain, &other) {
            (Ok(plain), Ok(other)) => (plain, other),
            (Err(_), Err(_)) => continue,
            (one, other) => panic!("{what}: {:?} {:?}", one.as_ref().err(), other.as_ref().err()),
        };
        for node in 0..bodies.nodes.len() {
            let expected = writing.vector(displacement(plain, node));
            let of = displacement(other, node);
            for d in [0, 1] {
                let scale = plain.u.amax();
                assert_near(&what, of[d] / writing.scale(), expected[d], scale, &INVARIANCE);
            }
        }
    }
}

#[test]
fn a_roof_has_one_answer_however_it_is_written() {
    for gap in [0.0, 0.05] {
        for apex in [0.7, 0.2, 1.1] {
            for geometry in [Geometry::Initial, Geometry::Current] {
                assert_invariant("roof", &roof(apex, gap), Coupling::Nts, geometry);
            }
        }
    }
}

#[test]
fn blocks_with_corners_have_one_answer_however_they_are_written() {
    for &coupling in Coupling::ALL {
        assert_invariant("blocks", &blocks(), coupling, Geometry::Initial);
    }
}

/// The answer of a symmetric scene is symmetric.
#[test]
fn a_symmetric_roof_has_a_symmetric_answer() {
    for (apex, gap) in [(0.7, 0.05), (0.7, 0.0), (1.1, 0.05), (1.1, 0.0), (3.0, 0.05)] {
        let bodies = roof(apex, gap);
        let solution =
            solved(&bodies, &Writing::default(), Coupling::Nts, Geometry::Initial).unwrap();
        let of = |node| displacement(&solution, node);
        let scale = solution.u.amax();
        assert_near("apex", of(5)[0], 0.0, scale, &INVARIANCE);
        assert_near("sides", of(4)[1], of(6)[1], scale, &INVARIANCE);
    }
}

/// The apex holds the block, however sharp it is and whether or not it touches at the start.
#[test]
fn no_apex_passes_through_the_block() {
    for apex in [0.5, 0.99, 1.0, 1.01, 1.1, 2.0, 5.0, 20.0] {
        for gap in [0.0, 0.05] {
            for geometry in [Geometry::Initial, Geometry::Current] {
                let bodies = roof(apex, gap);
                let solution =
                    solved(&bodies, &Writing::default(), Coupling::Nts, geometry).unwrap();
                let pressing: Vec<usize> = solution.in_contact().map(|c| c.node.index()).collect();
                assert_eq!(pressing, [5], "apex {apex}, gap {gap}, {geometry:?}");
                let (block, tip) = (displacement(&solution, 5)[1], displacement(&solution, 3)[1]);
                assert_near("gap", gap + block - tip, 0.0, 1.0, &APEX);
            }
        }
    }
}

fn surfaces(scene: &Scene) -> Surfaces {
    Surfaces::new(&scene.model).unwrap()
}

/// A shape turned by any angle has the same pairings, turned.
#[test]
fn pairings_turn_with_the_shape() {
    for bodies in [blocks(), roof(0.7, 0.05), roof(1.1, 0.0)] {
        let scene =
            bodies.scene(&Writing::default(), Coupling::Nts, Geometry::Initial).build().unwrap();
        let of = |shape: &[[f64; 2]], coupling| surfaces(&scene).pairings(coupling, shape);
        // The shape alone turns; which surfaces face each other is decided without it.
        for angle in [0.1_f64, 0.7, 1.0, 2.5] {
            let (s, c) = angle.sin_cos();
            let turn = |[x, y]: [f64; 2]| [c * x - s * y, s * x + c * y];
            let turned: Vec<[f64; 2]> = scene.model.nodes.iter().map(|p| turn(*p)).collect();
            for &coupling in Coupling::ALL {
                let pairs = of(&scene.model.nodes, coupling).into_iter().zip(of(&turned, coupling));
                for (one, other) in pairs {
                    let (Some(one), Some(other)) = (&one, &other) else {
                        // The cone of a vertex faces the node by the direction in the shape.
                        continue;
                    };
                    let expected = turn(one.normal);
                    assert_near("gap", other.gap, one.gap, 1.0, &INVARIANCE);
                    for d in [0, 1] {
                        assert_near("normal", other.normal[d], expected[d], 1.0, &INVARIANCE);
                    }
                }
            }
        }
    }
}

/// A node inside a convex corner and equally near to both faces is paired with the vertex.
#[test]
fn a_node_on_the_bisector_is_paired_with_the_vertex() {
    let bodies = roof(0.7, 0.05);
    let scene =
        bodies.scene(&Writing::default(), Coupling::Nts, Geometry::Initial).build().unwrap();
    for (depth, gap) in [(0.2, -0.2), (0.0, 0.0), (-0.3, 0.3)] {
        let mut shape = scene.model.nodes.clone();
        shape[5] = [1.0, 0.7 - depth];
        let pairing = surfaces(&scene).pairings(Coupling::Nts, &shape)[1].clone().unwrap();
        assert_eq!(pairing.masters, [(NodeId::new(3), 1.0)]);
        assert_near("gap", pairing.gap, gap, 1.0, &INVARIANCE);
        assert_near("normal", pairing.normal[1], 1.0, 1.0, &INVARIANCE);
    }
}

/// A tip of the target that enters the block between two contact nodes is found.
#[test]
fn a_target_node_in_the_contact_body_is_found() {
    let mut bodies = roof(0.7, 0.05);
    bodies.nodes[3][0] = 1.4;
    let scene =
        bodies.scene(&Writing::default(), Coupling::Nts, Geometry::Initial).build().unwrap();
    let mut shape = scene.model.nodes.clone();
    let inside = |shape: &[[f64; 2]]| surfaces(&scene).inside(&scene.model, shape, &HashMap::new());
    assert_eq!(inside(&shape), []);
    shape[3][1] = 0.85;
    let found = inside(&shape);
    let [InsideNode { node, depth, watched, .. }] = found[..] else { panic!("{found:?}") };
    assert_eq!((node, watched), (NodeId::new(3), Watched::Target));
    assert_near("depth", depth, 0.1, 1.0, &INVARIANCE);
}
