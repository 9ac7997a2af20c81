//! Mathcad's semantics.

pub mod array;
