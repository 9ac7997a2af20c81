//! The paper: its listings as text and in Rust, Mathcad's semantics, its readings and its arrays.

pub mod door;
pub mod edited;
pub mod exports;
pub mod listings;
pub mod mathcad;
pub mod mirror;
