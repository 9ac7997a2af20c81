//! The contact surface as it is listed: in any order, with a node twice, with one missing; and bodies
//! that lie in each other before they are loaded.

use crate::corners::Solved;
use engine::contact::ContactNode;
use engine::{Request, solve};
use problem::modelling::{Coupling, Geometry, Variant};
use testing::bodies::{Bodies, Writing, blocks, roof};
use testing::tolerances::{INVARIANCE, assert_near};

fn contact(bodies: &Bodies) -> Result<Vec<ContactNode>, String> {
    let solution = bodies.solved(&Writing::default(), Coupling::Nts, Geometry::Initial);
    solution.map(|solution| solution.contact).map_err(|error| error.to_string())
}

fn listed(bodies: Bodies, contact: &[usize]) -> Bodies {
    Bodies { contact: contact.to_vec(), ..bodies }
}

#[test]
fn the_order_of_the_list_does_not_matter() {
    let plain = contact(&blocks()).unwrap();
    for order in [
        [28, 27, 26, 25, 24, 23, 22, 21],
        [21, 23, 22, 24, 28, 25, 27, 26],
        [24, 25, 26, 27, 28, 21, 22, 23],
    ] {
        assert_eq!(contact(&listed(blocks(), &order)).unwrap(), plain);
    }
    let twice = [21, 21, 22, 23, 24, 25, 26, 27, 28, 24];
    assert_eq!(contact(&listed(blocks(), &twice)).unwrap(), plain);
    assert!(plain.is_sorted_by(|a, b| a.arc < b.arc), "they stand along the surface");
}

#[test]
fn a_list_with_a_gap_is_refused() {
    let error = contact(&listed(blocks(), &[21, 22, 23, 25, 27, 28])).unwrap_err();
    assert!(error.contains("no edge of the outline joins node 26"), "{error}");
    let error = contact(&listed(roof(0.7, 0.05), &[4, 5, 8])).unwrap_err();
    assert!(error.contains("no edge of the outline joins node 9"), "{error}");
}

/// Parts of one side of a body that are not joined, as two feet, stand one after the other.
#[test]
fn parts_of_the_outline_are_taken_one_after_the_other() {
    let of = |order: &[usize]| contact(&listed(blocks(), order)).unwrap();
    assert_eq!(of(&[28, 27, 21, 22]), of(&[21, 22, 27, 28]));
}

/// The variants that the paper describes visit the nodes as they are listed.
#[test]
fn published_variants_keep_the_list() {
    let reversed = listed(blocks(), &[28, 27, 26, 25, 24, 23, 22, 21]);
    let scene = reversed.scene(&Writing::default(), Coupling::Nts, Geometry::Initial);
    let request = Request::new(&scene.build().unwrap()).variant(Variant::Tied);
    let numbers = |request: &Request| -> Vec<usize> {
        request.model().unwrap().contact.nodes.iter().map(|n| n.index()).collect()
    };
    assert_eq!(numbers(&request), reversed.contact);
    assert_eq!(numbers(&request.variant(Variant::Unilateral)), blocks().contact);
}

/// One node has no surface: its force is a result, its pressure is none.
#[test]
fn one_node_has_a_force() {
    let plain = contact(&roof(0.7, 0.05)).unwrap();
    let one = contact(&listed(roof(0.7, 0.05), &[5])).unwrap();
    let force = plain.iter().find(|c| c.node.index() == 5).unwrap().force;
    assert_eq!(one.len(), 1);
    assert_near("force", one[0].force.unwrap(), force.unwrap(), force.unwrap(), &INVARIANCE);
    assert!(one[0].pressure.is_none());
}

/// A block below the roof that it should stand on is not lifted through it.
#[test]
fn a_deep_initial_penetration_is_refused() {
    let error = contact(&roof(0.7, -0.6)).unwrap_err();
    assert!(error.contains("contact node 6 lies 0.6000 inside the target"), "{error}");
    let scene = roof(0.7, -0.6).scene(&Writing::default(), Coupling::Mortar, Geometry::Current);
    let request = Request::new(&scene.build().unwrap());
    assert_eq!(solve(&request, &mut |_| ()).unwrap_err().exit_status().number(), 2);
    // An interference of a tenth of an edge is closed.
    assert!(contact(&roof(0.7, -0.1)).is_ok());
}
