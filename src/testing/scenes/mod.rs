//! What needs models and scenes: packages that have none leave it out.

pub mod annulus;
pub mod bodies;
pub mod drawn;
pub mod embedded;
pub mod json;
pub mod rows;
pub mod shipped;
pub mod worksheets;
