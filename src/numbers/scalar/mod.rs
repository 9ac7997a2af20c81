//! The number types of the mirror, and what may stand in their subscripts.
//!
//! | scalar | digits | what it is for |
//! |---|---|---|
//! | `f32` | 7 | how much the answer hangs on the precision |
//! | `f64` | 16 | Mathcad's own |
//! | `F64x2` | 31 | a reference for scenes of any size |
//! | `Exact` | all | rational numbers: a reference without doubt, for small scenes |
//!
//! The traits are in `number`, which imports none of the others. Those below `f64` have the feature
//! `precise`.

mod native;
mod number;
#[cfg(feature = "precise")]
mod precise;

pub use number::{Scalar, Subscript};
#[cfg(feature = "precise")]
pub use precise::*;
