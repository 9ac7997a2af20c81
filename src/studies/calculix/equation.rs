//! Linear equations between displacements.

use crate::answer::{Constraint, Motion, Step};
use crate::problem::model::{Dof, Model, NodeId};

/// Σ coefficient · displacement = constant. The first term is the dependent one: its displacement
/// is not restrained, and no other equation has it.
#[derive(Clone, Debug, PartialEq)]
pub struct Equation {
    /// The displacements and their coefficients, the dependent one first.
    pub terms: Vec<(Dof, f64)>,
    /// The right-hand side, length.
    pub constant: f64,
}

impl Equation {
    /// The equations that bound contact nodes in a step.
    pub fn of_step(model: &Model, step: &Step) -> Vec<Equation> {
        let of = |constraint: &Constraint| Equation::of_constraint(model, constraint);
        step.constraints.iter().flat_map(of).collect()
    }

    /// The equations of a constraint: one along its normal, or one in each direction in which its
    /// node is not restrained.
    pub fn of_constraint(model: &Model, constraint: &Constraint) -> Vec<Equation> {
        let along = |normal, shift| Equation::along(model, constraint, normal, shift);
        match constraint.motion {
            Motion::Along(normal, shift) => vec![along(normal, shift)],
            Motion::Both([x, y]) => {
                let [fixed_x, fixed_y] = model.restraints_of(constraint.node);
                let in_x = (!fixed_x).then(|| along([1.0, 0.0], x));
                let in_y = (!fixed_y).then(|| along([0.0, 1.0], y));
                in_x.into_iter().chain(in_y).collect()
            }
        }
    }

    /// n·u_c − Σ w n·u_t = `constant`: first those components of the contact node that are not
    /// restrained, the larger one of the normal before the other.
    fn along(model: &Model, constraint: &Constraint, normal: [f64; 2], constant: f64) -> Equation {
        let larger = usize::from(normal[1].abs() > normal[0].abs());
        let directions = [larger, 1 - larger].into_iter().filter(|&d| normal[d] != 0.0);
        let of_node = |node: NodeId, weight: f64| {
            directions.clone().map(move |d| (node.dofs()[d], weight * normal[d]))
        };
        let own = of_node(constraint.node, 1.0).filter(|(dof, _)| !model.is_restrained(*dof));
        let masters = constraint.masters.iter().filter(|(_, weight)| *weight != 0.0);
        let masters = masters.flat_map(|&(master, weight)| of_node(master, -weight));
        Equation { terms: own.chain(masters).collect(), constant }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::problem::scene::Scene;

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
}
