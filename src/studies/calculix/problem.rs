//! What a deck describes: the scene, and how its bodies touch.

use crate::answer::{Constraint, Motion, Solution, Step};
use crate::choices;
use crate::error::InputError;
use crate::paper::mirror::Schedule;
use crate::problem::model::{Dof, Edge, Model, NodeId};
use crate::problem::modelling::{Friction, Variant};
use crate::problem::scene::Scene;

choices! {
    /// How the deck has the bodies touch.
    ContactKind {
        /// `*EQUATION`: eq. (1) as an iteration has it.
        Equation = "equation",
        /// `*CONTACT PAIR`: node to surface, linear penalty.
        Pair = "pair",
    }
}

/// The problem that a deck describes.
pub struct Problem<'a> {
    /// The scene, whose title the deck has.
    pub scene: &'a Scene,
    /// The scene's model under the reading that was asked for.
    pub model: &'a Model,
    /// How the bodies touch in the deck.
    pub contact: &'a Contact,
}

/// How the bodies touch.
#[derive(Clone, Debug)]
pub enum Contact {
    /// By these equations, which `ccx` satisfies.
    Equations(Vec<Equation>),
    /// `ccx` looks for contact itself.
    Pair(Pair),
}

/// A contact pair of `ccx`, node to surface.
#[derive(Clone, Copy, Debug)]
pub struct Pair {
    /// Pressure over penetration, stress/length.
    pub penalty: f64,
    /// Whether nodes in contact slide or stick.
    pub friction: Friction,
}

/// One of the problems whose sum is a run: the whole load on one contact state.
pub struct Part {
    /// How the bodies touch in it.
    pub contact: Contact,
    /// Its share of the run, from 0 to 1.
    pub share: f64,
}

impl Contact {
    /// The problems whose sum a solution is. With total load that is its last step. With stepped
    /// load it is the sum of the increments: each contact state that came, with the whole load,
    /// times its share of the steps. The last step's state comes last.
    ///
    /// # Errors
    /// The variant is `printed`, which constrains nothing.
    pub fn parts(solution: &Solution) -> Result<Vec<Part>, InputError> {
        if solution.request.variant == Variant::Printed {
            let what = "the variant printed adds stiffness and ties nothing: there are no \
                        equations to write";
            let fix = "choose tied, stepped or unilateral, or --contact pair";
            return Err(InputError::new("--variant", what, fix));
        }
        let steps = solution.steps.len();
        let carried = match solution.request.schedule() {
            Schedule::Total => steps - 1..steps,
            Schedule::Stepped => 0..steps,
        };
        let share = 1.0 / carried.len() as f64;
        let mut states: Vec<(Vec<Equation>, f64)> = Vec::new();
        for step in &solution.steps[carried] {
            let equations = Equation::of_step(&solution.model, step);
            let same = states.iter().position(|(other, _)| *other == equations);
            let before = same.map_or(0.0, |k| states.remove(k).1);
            states.push((equations, before + share));
        }
        let part = |(equations, share)| Part { contact: Contact::Equations(equations), share };
        Ok(states.into_iter().map(part).collect())
    }
}

impl Pair {
    /// Penalty times edge length over elastic modulus, unless a penalty is given: the manual
    /// advises 5 to 50 times the modulus, in mm. With more, ccx takes many more iterations, and may
    /// settle on another contact zone.
    const STIFFNESS: f64 = 10.0;

    /// A pair with `penalty`, or with one that suits the model: 10 E / h, E the largest modulus and
    /// h the mean length of the target's edges.
    pub fn new(model: &Model, penalty: Option<f64>, friction: Friction) -> Self {
        let suits = || {
            let moduli = model.triangles.iter().map(|triangle| triangle.material.e);
            Self::STIFFNESS * moduli.fold(0.0, f64::max) / mean_edge(model)
        };
        Pair { penalty: penalty.unwrap_or_else(suits), friction }
    }
}

/// Mean length of the target's edges; 1 where there is none.
fn mean_edge(model: &Model) -> f64 {
    let length = |edge: &Edge| {
        let [[ax, ay], [bx, by]] = edge.nodes.map(|node| model.at(node));
        (bx - ax).hypot(by - ay)
    };
    match model.contact.target.len() {
        0 => 1.0,
        count => model.target_edges().map(length).sum::<f64>() / count as f64,
    }
}

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
