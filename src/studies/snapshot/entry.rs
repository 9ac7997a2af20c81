//! What is recorded: a quantity, of an iteration or of the whole run.

use std::fmt;

use serde::{Deserialize, Serialize};

use base::choices;

choices! {
    /// A quantity that is recorded, in the order of computation.
    Quantity {
        /// Nodes of the contact surface.
        Cnt = "cnt",
        /// Edges of the target.
        Trg = "trg",
        /// Tolerance of the contact search.
        Tolerance = "c_tll",
        /// Restrained degrees of freedom.
        Restrained = "restrained",
        /// Sum of the loads; of an iteration the part of the load.
        Load = "load",
        /// Target edge of each contact node.
        Ct = "ct",
        /// Distance of each contact node.
        Yt = "yt",
        /// Whether each contact node is in contact.
        Dy = "dy",
        /// Status of each contact node under `unilateral`.
        Statuses = "statuses",
        /// Numbers of the nodes in contact.
        InContact = "in contact",
        /// Target nodes to which each node is bound.
        Mates = "mates",
        /// Their weights.
        Weights = "weights",
        /// The matrix that is solved.
        Mjs = "MJS",
        /// Exit status of `solve`.
        ExitStatus = "exit status",
        /// Why there is no solution.
        Failure = "failure",
        /// Number of iterations.
        Iterations = "iterations",
        /// Displacements; of an iteration the largest one.
        U = "u",
        /// Iterations of the cycle in which the contact state is.
        Cycle = "cycle",
        /// Stress of each triangle.
        Stress = "stress",
        /// Largest von Mises stress of each body.
        VonMisesStress = "largest von Mises stress",
        /// Largest von Mises strain of each body.
        VonMisesStrain = "largest von Mises strain",
        /// Forces on restrained nodes.
        Reactions = "reactions",
        /// Gap of each contact node.
        Gap = "gap",
        /// Pressure on each contact node.
        Pressure = "pressure",
        /// Force on the target.
        ContactForce = "contact force",
    }
}

/// The numbers that are recorded at the end.
pub const FIELDS: [Quantity; 8] = [
    Quantity::U,
    Quantity::Stress,
    Quantity::VonMisesStress,
    Quantity::VonMisesStrain,
    Quantity::Reactions,
    Quantity::Gap,
    Quantity::Pressure,
    Quantity::ContactForce,
];

/// The facts that are recorded with some of these alone.
pub const FACTS: [Quantity; 5] =
    [Quantity::Cnt, Quantity::Trg, Quantity::Restrained, Quantity::ExitStatus, Quantity::Failure];

/// The key of what is recorded; as text `u`, `iteration 2 yt`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(into = "String", try_from = "String")]
pub struct Entry {
    /// The iteration, from 1; None of what is of the whole run.
    pub iteration: Option<usize>,
    /// What is recorded.
    pub quantity: Quantity,
}

impl Entry {
    /// Returns the place in the order of computation: what the run starts from, the iterations, the end.
    pub(super) fn place(self) -> (usize, usize) {
        let rank = self.quantity as usize;
        let end = if rank <= Quantity::Load as usize { 0 } else { usize::MAX };
        (self.iteration.unwrap_or(end), rank)
    }
}

impl From<Quantity> for Entry {
    fn from(quantity: Quantity) -> Self {
        Entry { iteration: None, quantity }
    }
}

impl fmt::Display for Entry {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self.iteration {
            Some(k) => write!(f, "iteration {k} {}", self.quantity),
            None => self.quantity.fmt(f),
        }
    }
}

impl From<Entry> for String {
    fn from(entry: Entry) -> Self {
        entry.to_string()
    }
}

impl TryFrom<String> for Entry {
    type Error = String;

    fn try_from(text: String) -> Result<Self, String> {
        let of_iteration = text.strip_prefix("iteration ").and_then(|rest| rest.split_once(' '));
        let Some((k, quantity)) = of_iteration else { return Ok(text.parse::<Quantity>()?.into()) };
        let k = k.parse().map_err(|_| format!("{k:?} is no number of an iteration"))?;
        Ok(Entry { iteration: Some(k), quantity: quantity.parse()? })
    }
}
