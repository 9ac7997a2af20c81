//! What a run leaves: tables for people, pictures for the eye, files for machines.
//!
//! The same input gives the same bytes: no clock, no hash order, no machine in them.

pub mod audit;
pub mod comparison;
pub mod extremes;
pub mod folder;
pub mod json;
pub mod matrix_market;
pub mod picture;
pub mod plan;
pub mod pressure;
pub mod statuses;
pub mod tables;
pub mod trace;
pub mod trade;
pub mod uncertain;
pub mod vtu;
mod xml;
