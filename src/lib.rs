//! plane-contact: a Mathcad-faithful, executable, audited reimplementation of a published plane contact algorithm
//! (A. M. Filipov, M. V. Khomenko, «Решение плоской контактной задачи методом конечных элементов»).
//!
//! Two layers, each checked against the other bit for bit: the **listing**, text executed with Mathcad's semantics
//! ([`paper::mathcad`]), and the **mirror**, the same in Rust, line by line ([`paper::mirror`]).
//!
//! | paper | text | Rust |
//! |---|---|---|
//! | fig. 2, `c_cnt` | `listings/c_cnt.txt` | [`paper::mirror::c_cnt`](fn@paper::mirror::c_cnt) |
//! | fig. 3, `Km` | `listings/Km.txt` | [`paper::mirror::Km`](fn@paper::mirror::Km) |
//! | eq. (1) | - | [`answer::contact::Elimination`] |
//! | "20 iterations" | - | [`answer::contact::run`](fn@answer::contact::run) |
//! | `Ae`, `B`, `D`, stresses: not printed | - | [`problem::element`] |
//! | fig. 4, fig. 5 | - | [`report::picture`] |
//!
//! From a scene to a result:
//!
//! ```text
//!  scene.json, mesh --> scene --> Worksheet (the paper's arrays) --> contact::run --> report
//!                                        |                              |
//!                                     mathcad (listings)             mirror, solve
//!                                        +------------ audit -----------+
//! ```
//!
//! The table of symbols, with shapes and units, is in `README.md`.
#![forbid(unsafe_code)]

pub mod answer;
mod choices;
pub mod error;
pub mod files;
pub mod numbers;
pub mod paper;
pub mod problem;
pub mod report;
pub mod studies;
