//! The way from the print to the right answer: the corrected programs with the faults that are left.

use crate::audit::Case;
use crate::audit::prices::{self, Price, needed};
use nalgebra::DVector;
use paper::corrected::{FAULTS, Fault};

/// The repairs of a scene.
pub struct Repairs {
    /// What came of the print, then of each repair with those before it.
    pub rows: Vec<Price>,
    /// The number of repairs that lead to the solution.
    pub needed: usize,
}

impl Repairs {
    /// Returns the repairs of a case whose faults alone have the prices `alone`, and the solution with which its
    /// iterations are compared; nothing where they lead to no solution.
    pub fn new(case: &Case, alone: &[Price]) -> Option<(Self, DVector<f64>)> {
        // A scene that has no solution has no way to it: the lesson shows that of fig. 1.
        let exact = case.corrected().ok()?;
        let rows = prices::repairs(case, alone, &|| ()).ok()?;
        let needed = needed(&rows)?;
        Some((Repairs { rows, needed }, exact.u.clone()))
    }

    /// Returns the numbers of repairs that a lesson shows: up to the solution, and all.
    pub fn shown(&self) -> impl Iterator<Item = usize> {
        let all = (self.needed < FAULTS.len()).then_some(FAULTS.len());
        (0..=self.needed).chain(all)
    }

    /// Returns the faults that are left after some repairs, in the order of [`FAULTS`].
    pub fn left(&self, repairs: usize) -> impl Iterator<Item = &'static Fault> {
        let later = &self.rows[repairs + 1..];
        FAULTS.iter().filter(|fault| later.iter().any(|row| row.name == Some(fault.name())))
    }

    /// Returns the fault that is repaired last of some; nothing before the first, and where all are repaired.
    pub fn last(&self, repairs: usize) -> Option<&'static Fault> {
        let row = self.rows[..=self.needed].get(repairs)?;
        FAULTS.iter().find(|fault| row.name == Some(fault.name()))
    }
}
