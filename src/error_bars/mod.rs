//! Error bars: how far a printed number may be from the truth.
//!
//! ```text
//!  Worksheet, States --patches--> sites --recovery--> smoothed stresses --discretisation--> eta, bars
//! ```

pub mod discretisation;
mod patches;
mod recovery;
