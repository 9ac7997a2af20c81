//! plane-contact
#![forbid(unsafe_code)]

pub mod mathcad;
pub mod scalar;
