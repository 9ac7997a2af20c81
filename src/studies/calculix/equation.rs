//! Linear equations between displacements.

use crate::answer::contact::{Iteration, Motion, Tie};
use crate::paper::mirror::Worksheet;

/// A coefficient on one displacement.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Term {
    /// The node, from 1.
    pub node: usize,
    /// 0 for x, 1 for y.
    pub direction: usize,
    /// Its coefficient.
    pub coefficient: f64,
}

/// Σ coefficient · displacement = constant. The first term is the dependent one: S restrains it nowhere, and no other equation
/// has it.
#[derive(Clone, Debug, PartialEq)]
pub struct Equation {
    /// The terms, the dependent one first.
    pub terms: Vec<Term>,
    /// The right-hand side, length.
    pub constant: f64,
}

impl Equation {
    /// What held in an iteration of a run.
    pub fn of_iteration(sheet: &Worksheet<f64>, iteration: &Iteration) -> Vec<Equation> {
        iteration.ties.iter().flat_map(|tie| Equation::of_tie(sheet, tie)).collect()
    }

    /// A tie: an equation along its normal, or one in each direction that S leaves free.
    pub fn of_tie(sheet: &Worksheet<f64>, tie: &Tie) -> Vec<Equation> {
        match tie.motion {
            Motion::Along(normal, shift) => vec![Equation::along(sheet, tie, normal, shift)],
            Motion::Both(shift) => [[1.0, 0.0], [0.0, 1.0]]
                .into_iter()
                .zip(shift)
                .enumerate()
                .filter(|(direction, _)| sheet.S[2 * tie.node - 1 + direction] == 0)
                .map(|(_, (normal, shift))| Equation::along(sheet, tie, normal, shift))
                .collect(),
        }
    }

    /// n·u_c − Σ w n·u_t = `constant`: first the contact node's free components, the larger one of the normal before the other.
    fn along(sheet: &Worksheet<f64>, tie: &Tie, normal: [f64; 2], constant: f64) -> Equation {
        let larger = usize::from(normal[1].abs() > normal[0].abs());
        let directions = [larger, 1 - larger].into_iter().filter(|&d| normal[d] != 0.0);
        let of_node = |node: usize, weight: f64| {
            directions.clone().map(move |direction| Term {
                node,
                direction,
                coefficient: weight * normal[direction],
            })
        };
        let held = |term: &Term| sheet.S[2 * term.node - 1 + term.direction] == 1;
        let own = of_node(tie.node, 1.0).filter(|term| !held(term));
        let mates = tie.weights.iter().filter(|(_, weight)| *weight != 0.0);
        let mates = mates.flat_map(|&(mate, weight)| of_node(mate, -weight));
        Equation { terms: own.chain(mates).collect(), constant }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::paper::mirror::Reading;
    use crate::problem::scene::Scene;

    /// Terms (node, direction, coefficient) and the constant.
    type Plain = (Vec<(usize, usize, f64)>, f64);

    /// The equations of one tie of node 11 of `two-blocks` (free in x and y) or 10 (held in x).
    fn equations(node: usize, motion: Motion) -> Vec<Plain> {
        let sheet = Scene::open("two-blocks").unwrap().worksheet(&Reading::default()).unwrap();
        let tie = Tie { node, weights: vec![(7, 0.25), (8, 0.75), (9, 0.0)], motion };
        let terms = |equation: &Equation| {
            equation.terms.iter().map(|t| (t.node, t.direction, t.coefficient)).collect()
        };
        Equation::of_tie(&sheet, &tie).iter().map(|e| (terms(e), e.constant)).collect()
    }

    #[test]
    fn a_tie_of_both_components_is_an_equation_in_each_free_direction() {
        let x = (vec![(11, 0, 1.0), (7, 0, -0.25), (8, 0, -0.75)], 0.5);
        let y = (vec![(11, 1, 1.0), (7, 1, -0.25), (8, 1, -0.75)], 2.0);
        assert_eq!(equations(11, Motion::Both([0.5, 2.0])), [x, y]);
        assert_eq!(equations(10, Motion::Both([0.5, 2.0])).len(), 1);
    }

    #[test]
    fn a_tie_along_a_normal_depends_on_its_larger_free_component() {
        let along = |node| equations(node, Motion::Along([0.6, -0.8], 0.1));
        let mates =
            [(7, 1, 0.2), (7, 0, -0.15), (8, 1, 0.6000000000000001), (8, 0, -0.44999999999999996)];
        let free = [&[(11, 1, -0.8), (11, 0, 0.6)], &mates[..]].concat();
        assert_eq!(along(11), [(free, 0.1)]);
        let held = [&[(10, 1, -0.8)], &mates[..]].concat();
        assert_eq!(along(10), [(held, 0.1)]);
    }
}
