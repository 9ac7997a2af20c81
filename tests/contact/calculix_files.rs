//! The equations of a CalculiX deck, and the numbers of its files.

use plane_contact::engine::{Constraint, Motion};
use plane_contact::problem::model::{Dof, NodeId};
use plane_contact::problem::scene::Scene;
use plane_contact::studies::calculix::deck::field;
use plane_contact::studies::calculix::{Equation, float};

/// Terms (number of the node, direction, coefficient) and the constant.
type Plain = (Vec<(usize, usize, f64)>, f64);

/// The equations of a constraint of node 11 of `two-blocks`, which is free in x and y, or of
/// node 10, which is restrained in x.
fn equations(node: usize, motion: Motion) -> Vec<Plain> {
    let masters = [(7, 0.25), (8, 0.75), (9, 0.0)];
    let masters = masters.map(|(number, weight)| (NodeId::from_number(number), weight));
    let node = NodeId::from_number(node);
    let constraint = Constraint { node, masters: masters.to_vec(), motion };
    let term = |(dof, x): &(Dof, f64)| (dof.node().number(), dof.direction(), *x);
    let plain = |e: &Equation| (e.terms.iter().map(term).collect(), e.constant);
    let scene = Scene::open("two-blocks").unwrap();
    Equation::of_constraint(&scene.model, &constraint).iter().map(plain).collect()
}

#[test]
fn a_constraint_of_both_components_is_an_equation_in_each_free_direction() {
    let x = (vec![(11, 0, 1.0), (7, 0, -0.25), (8, 0, -0.75)], 0.5);
    let y = (vec![(11, 1, 1.0), (7, 1, -0.25), (8, 1, -0.75)], 2.0);
    assert_eq!(equations(11, Motion::Both([0.5, 2.0])), [x, y]);
    assert_eq!(equations(10, Motion::Both([0.5, 2.0])).len(), 1);
}

#[test]
fn a_constraint_along_a_normal_depends_on_its_larger_free_component() {
    let along = |node| equations(node, Motion::Along([0.6, -0.8], 0.1));
    let masters =
        [(7, 1, 0.2), (7, 0, -0.15), (8, 1, 0.6000000000000001), (8, 0, -0.44999999999999996)];
    let free = [&[(11, 1, -0.8), (11, 0, 0.6)], &masters[..]].concat();
    assert_eq!(along(11), [(free, 0.1)]);
    let restrained = [&[(10, 1, -0.8)], &masters[..]].concat();
    assert_eq!(along(10), [(restrained, 0.1)]);
}

#[test]
fn a_number_keeps_the_digits_that_fit() {
    assert_eq!(field(0.1), "0.1");
    assert_eq!(field(-210000.0), "-210000");
    assert_eq!(field(-0.1234567890123456), "-0.1234567890123456");
    assert_eq!(field(1.0 / 3.0), "0.3333333333333333");
    assert_eq!(field(1e300), "1e300");
    assert_eq!(field(-1.2345678901234567e-4), "-1.23456789012346e-4");
    assert_eq!(field(-1.2345678901234567e-300), "-1.234567890123e-300");
}

#[test]
fn fortran_leaves_out_the_e_of_a_long_exponent() {
    assert_eq!(float("-1.500000E-03"), Some(-1.5e-3));
    assert_eq!(float("-1.500000-103"), Some(-1.5e-103));
    assert_eq!(float("1.500000+103"), Some(1.5e103));
    for word in ["NaN", "Infinity", "1.5E+299", "*************", "-", ""] {
        assert_eq!(float(word), None, "{word}");
    }
}
