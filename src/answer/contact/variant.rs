//! What load an iteration of a variant carries.

use crate::paper::mirror::{Reading, Schedule};
use crate::problem::modelling::Variant;

/// R7 where it is given, else the variant's own.
pub fn schedule(variant: Variant, reading: &Reading) -> Schedule {
    match variant {
        Variant::Unilateral => Schedule::Total,
        Variant::Printed | Variant::Tied => reading.r7.unwrap_or(Schedule::Total),
        Variant::Stepped => reading.r7.unwrap_or(Schedule::Stepped),
    }
}
