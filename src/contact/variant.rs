//! What can be run: `READING.md` section 6.

use crate::choices;
use crate::mirror::{Reading, Schedule};

choices! {
    /// A variant: how the contact pairs enter the equations, and what load an iteration carries.
    #[derive(Default)]
    Variant {
        /// Eq. (1) on increments: equal steps of the load, the shape updated after each.
        #[default]
        Stepped = "stepped",
        /// Eq. (1) imposed on total displacements.
        Tied = "tied",
        /// `Km` exactly as printed.
        Printed = "printed",
    }
}

/// How the contact pairs enter the equations.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Coupling {
    /// `Km` adds weighted blocks to the mates' equations.
    Printed,
    /// Eq. (1) by elimination.
    Eliminated,
}

impl Variant {
    /// How the contact pairs enter the equations.
    pub fn coupling(self) -> Coupling {
        match self {
            Variant::Printed => Coupling::Printed,
            Variant::Tied | Variant::Stepped => Coupling::Eliminated,
        }
    }

    /// What load an iteration carries: R7 where it is given, else the variant's own.
    pub fn schedule(self, reading: &Reading) -> Schedule {
        reading.r7.unwrap_or(match self {
            Variant::Printed | Variant::Tied => Schedule::Total,
            Variant::Stepped => Schedule::Stepped,
        })
    }
}
