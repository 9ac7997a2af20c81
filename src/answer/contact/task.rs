//! The task of a run.

use crate::numbers::solve::Arithmetic;
use crate::paper::mirror::{Reading, Worksheet};
use crate::problem::modelling::Variant;
use crate::problem::scene::Scene;

/// What a run of a published variant is given.
pub(super) struct Task<'a> {
    pub scene: &'a Scene,
    pub sheet: &'a Worksheet<f64>,
    pub variant: Variant,
    pub reading: &'a Reading,
    pub arithmetic: Arithmetic,
}
