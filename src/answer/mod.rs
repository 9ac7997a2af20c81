//! The answer: runs of a variant on a problem, and how far their numbers may be from the truth.

pub mod contact;
pub mod error;
pub mod estimates;
