//! What a run takes: operations and bytes.
//!
//! Counted: operations of the factorisations, numbers in the matrices. Measured, on meshes of 13 to
//! 481,570 nodes, and stated as constants: what a node, a triangle, an entry takes besides.

use serde::Serialize;

use super::candidates::Candidates;
use engine::{Bytes, Request};
use numbers::solve::FactorSize;
use problem::model::Model;
use problem::modelling::{Coupling, Friction, Variant};

pub(super) struct Work<'a> {
    pub request: &'a Request,
    /// The model under the reading that is asked for.
    pub model: &'a Model,
    /// Dense matrices in memory at once.
    pub dense: usize,
    pub factors: FactorSize,
    /// One factorisation of the bodies by sparse Cholesky, for the reference solution.
    pub sparse: FactorSize,
    /// Who can come into contact; nothing where the scene has no contact.
    pub candidates: Option<&'a Candidates>,
}

#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Cost {
    /// Dense 2R x 2R matrices of `f64` in memory at once: what is compared with the free memory.
    pub dense_matrices: usize,
    /// Contact states that are likely to come in a step of the load.
    pub states: usize,
    /// The same for the reference solution that `solve` measures the run against; 0 where it runs
    /// nothing more.
    pub reference_states: usize,
    pub operations: f64,
    pub bytes: Bytes,
}

/// Bytes of an entry of the printed matrix while its error is bounded: the matrix with a bound on
/// each entry, its values, their factors.
const PRINTED_BOUND: f64 = 43.0;
/// Contact states of `unilateral` where nodes stick, measured on `strand`.
const STICKING_STATES: usize = 3;
/// Where nodes slide, one state more for each so many that do not touch yet: measured on Hertz's
/// contact with 5 to 59 elements on the half width.
const NODES_OF_A_STATE: usize = 2;

impl Work<'_> {
    /// What the run takes, with what `solve` adds: files, and the reference solution where there is
    /// contact and the run is not itself that.
    pub fn cost(&self) -> Cost {
        let (states, reference_states) = (self.states(), self.reference_states());
        let mut bytes = Bytes::estimate(self.request, self.model);
        bytes.matrices += self.dense_bytes();
        Cost {
            dense_matrices: self.dense * self.number_bytes().div_ceil(size_of::<f64>()),
            states,
            reference_states,
            operations: self.operations(states, reference_states),
            bytes,
        }
    }

    fn operations(&self, states: usize, reference_states: usize) -> f64 {
        let [run, reference] = [states, reference_states].map(|states| states as f64);
        run * self.factors.operations + reference * self.sparse.operations
    }

    /// Contact states that the run is likely to come to; of the paper's variants as on `strand`.
    fn states(&self) -> usize {
        let most = match self.request.variant {
            Variant::Unilateral => return self.unilateral_states(),
            Variant::Printed => 3,
            Variant::Stepped => 5,
            Variant::Tied => 8,
        };
        if self.settled() { 1 } else { most.min(self.request.iterations) }
    }

    fn unilateral_states(&self) -> usize {
        let is_frictionless = self.request.contact.friction == Friction::NONE;
        if let Some(found) = self.candidates.filter(|_| is_frictionless) {
            return 1 + (found.near - found.touching) / NODES_OF_A_STATE;
        }
        if self.settled() { 1 } else { STICKING_STATES }
    }

    /// Whether every node that can come to an edge touches one already: there is no contact, or the
    /// first state is likely the last.
    fn settled(&self) -> bool {
        self.candidates.is_none_or(|found| found.near == found.touching)
    }

    fn reference_states(&self) -> usize {
        let same = self.request.variant == Variant::Unilateral
            && self.request.contact.coupling == Coupling::Mortar;
        if self.candidates.is_none() || same { 0 } else { self.unilateral_states() }
    }

    /// The bytes of a number.
    fn number_bytes(&self) -> usize {
        self.request.arithmetic.scalar.properties().bytes
    }

    /// K is 2R x 2R, the others have the equations that are solved.
    fn dense_bytes(&self) -> f64 {
        let square = |n: usize| self.number_bytes() as f64 * (n as f64).powi(2);
        let (all, solved) = (2 * self.model.nodes.len(), self.factors.equations);
        if self.dense == 0 {
            return 0.0;
        }
        match self.request.variant {
            Variant::Printed => {
                (self.dense as f64 * square(all)).max(PRINTED_BOUND * (all as f64).powi(2))
            }
            Variant::Tied | Variant::Stepped | Variant::Unilateral => {
                square(all) + (self.dense - 1) as f64 * square(solved)
            }
        }
    }
}
