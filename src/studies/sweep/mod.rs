//! Sweeps: one scene under many values of its fields, of options and of a generator's parameters.
//!
//! ```text
//!  sweep.json --Sweep--> Document of case k --case--> Request --row--> Row (a line of JSON)
//!                             |                                          ^
//!                             +--key (SHA-256) ---- known rows ----------+   nothing runs twice
//! ```

mod document;
mod row;
mod spec;

pub use document::{Document, key_of};
pub use row::{Row, crashed, row};
pub use spec::{Cases, Sweep};
