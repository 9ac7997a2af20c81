//! Linear equations between displacements.

use crate::contact::Tie;
use crate::mirror::Worksheet;

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
    /// Eq. (1): u_c − Σ k u = 0 in each direction that S leaves free.
    pub fn of_ties(sheet: &Worksheet<f64>, ties: &[Tie]) -> Vec<Equation> {
        let free = |node: usize, direction: usize| sheet.S[2 * node - 1 + direction] == 0;
        let both = ties.iter().flat_map(|tie| [0, 1].map(|direction| (tie, direction)));
        both.filter(|(tie, direction)| free(tie.node, *direction)).map(Self::of_tie).collect()
    }

    fn of_tie((tie, direction): (&Tie, usize)) -> Equation {
        let dependent = Term { node: tie.node, direction, coefficient: 1.0 };
        let mates = tie.weights.iter().filter(|(_, weight)| *weight != 0.0);
        let mates = mates.map(|&(node, weight)| Term { node, direction, coefficient: -weight });
        Equation { terms: std::iter::once(dependent).chain(mates).collect(), constant: 0.0 }
    }
}
