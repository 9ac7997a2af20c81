//! plane-contact
#![forbid(unsafe_code)]

pub mod element;
pub mod error;
pub mod mathcad;
pub mod mirror;
pub mod scalar;
pub mod solve;
