//! plane-contact
#![forbid(unsafe_code)]

pub mod audit;
mod choices;
pub mod contact;
pub mod element;
pub mod error;
pub mod mathcad;
pub mod mirror;
pub mod report;
pub mod scalar;
pub mod scene;
pub mod solve;
