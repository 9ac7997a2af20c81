//! All that exists only for speed, each part tested against the slow way.

pub mod condensation;
pub mod listings;
