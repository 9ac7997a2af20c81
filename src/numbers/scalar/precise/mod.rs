//! Scalars that the machine does not have: of more digits, exact.

mod exact;
mod f64x2;
mod field;
mod operators;
pub mod rational;

pub use exact::{Exact, scope};
pub use f64x2::F64x2;
pub use field::Field;
