//! Solvers, error estimates, and contact: the reference solution and the status rules.

extern crate plane_contact_engine as engine;

#[path = "../../../tests/common/letter.rs"]
mod letter;

mod corners;
mod decisions;
mod error_estimates;
mod faced;
mod facing;
mod friction;
mod hard;
mod hard_scenes;
mod invariance;
mod overlap;
mod perturbed;
mod precisions;
mod quadratic_programme;
mod reduced;
mod searched;
mod solvers;
mod status;
mod stiffness;
mod supports;
mod systems;
