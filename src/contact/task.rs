//! The task of a run.

use super::variant::Variant;
use crate::mirror::{Reading, Worksheet};
use crate::scene::Scene;
use crate::solve::Arithmetic;

/// What a run of a published variant is given.
pub(super) struct Task<'a> {
    pub scene: &'a Scene,
    pub sheet: &'a Worksheet<f64>,
    pub variant: Variant,
    pub reading: &'a Reading,
    pub arithmetic: Arithmetic,
}
