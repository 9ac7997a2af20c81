//! The audit: what the ambiguities and the findings of the print do on a scene.

mod case;
pub mod findings;

pub use case::Case;
