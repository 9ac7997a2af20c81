//! The pairings of all contact nodes, by either coupling.

use super::pairing::{Pairing, Vector};
use super::surface::Surfaces;
use super::{mortar, nts};
use crate::problem::modelling::Coupling;

impl Surfaces {
    /// For each entry of the contact surface what it faces in a shape, the coordinates of each
    /// node. Nothing for a node that faces no edge, and for a node's second entry.
    pub fn pairings(&self, coupling: Coupling, shape: &[Vector]) -> Vec<Option<Pairing>> {
        match coupling {
            Coupling::Nts => nts::pairings(self, shape),
            Coupling::Mortar => mortar::pairings(self, shape),
        }
    }
}
