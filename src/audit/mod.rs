//! The audit: what the ambiguities and the findings of the print do on a scene.

mod case;
pub mod listings;
pub mod trace;

pub use case::Case;
