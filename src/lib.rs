//! plane-contact: a Mathcad-faithful, executable, audited reimplementation of a published plane contact algorithm
//! (A. M. Filipov, M. V. Khomenko, «Решение плоской контактной задачи методом конечных элементов»).
//!
//! Two layers, each checked against the other bit for bit: the **listing**, text executed with Mathcad's semantics
//! ([`mathcad`]), and the **mirror**, the same in Rust, line by line ([`mirror`]).
//!
//! | paper | text | Rust |
//! |---|---|---|
//! | fig. 2, `c_cnt` | `listings/c_cnt.txt` | [`mirror::c_cnt`](fn@mirror::c_cnt) |
//! | fig. 3, `Km` | `listings/Km.txt` | [`mirror::Km`](fn@mirror::Km) |
//! | eq. (1) | - | [`contact::Elimination`] |
//! | "20 iterations" | - | [`contact::run`](fn@contact::run) |
//! | `Ae`, `B`, `D`, stresses: not printed | - | [`element`] |
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

pub mod audit;
pub mod benchmark;
pub mod calculix;
mod choices;
pub mod contact;
pub mod element;
pub mod error;
pub mod error_bars;
pub mod extremes;
pub mod mathcad;
pub mod mirror;
pub mod plan;
pub mod report;
pub mod scalar;
pub mod scene;
pub mod solve;
pub mod trade;
