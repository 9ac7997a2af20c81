//! plane-contact: a Mathcad-faithful, executable, audited reimplementation of a published plane
//! contact algorithm (A. M. Filipov, M. V. Khomenko, «Решение плоской контактной задачи методом
//! конечных элементов»).
//!
//! ```text
//!  Scene (open a file, or build one in code) --> Request (what is asked) --> solve --> Solution
//!                                                                              |
//!                               ResultFile (written, read back) <--------------+--> compare
//! ```
//!
//! ```
//! use plane_contact::input::Variant;
//! use plane_contact::{Request, Scene, compare, solve};
//!
//! let scene = Scene::open("fig1")?;
//! let request = Request::new(&scene).variant(Variant::Tied);
//! let solution = solve(&request, &mut |step| assert!(step.k <= 20))?;
//! assert_eq!(solution.steps.len(), 20);
//!
//! let reference = solve(&request.reference(), &mut |_| ())?;
//! let distance = compare(&solution, &reference);
//! assert!(distance.energy_relative < 1.0);
//! # Ok::<(), plane_contact::Error>(())
//! ```
//!
//! The rest of the library is what the program is made of; it is open to tests and to the curious,
//! and promises nothing from version to version. Its folders, each importing those above it only:
//!
//! | folder | what stands there |
//! |---|---|
//! | `numbers` | scalars and solvers |
//! | `problem` | the finite element model, the element, scenes and their files |
//! | `paper` | Mathcad's semantics, the listings and their mirror in Rust, the door to the model |
//! | `answer` | request, solution, contact, error estimates |
//! | `studies` | audit, trade, extremes, plan, benchmarks, CalculiX |
//! | `report` | tables, pictures, files |
//!
//! The table of symbols, with shapes and units, is in `README.md`.
#![forbid(unsafe_code)]

#[doc(hidden)]
pub mod answer;
mod choices;
#[doc(hidden)]
pub mod error;
#[doc(hidden)]
pub mod files;
pub mod input;
#[doc(hidden)]
pub mod memory;
#[doc(hidden)]
pub mod numbers;
#[doc(hidden)]
pub mod paper;
#[doc(hidden)]
pub mod plain;
#[doc(hidden)]
pub mod problem;
#[doc(hidden)]
pub mod report;
#[doc(hidden)]
pub mod studies;
#[doc(hidden)]
pub mod suggestion;
#[doc(hidden)]
pub mod xml;

#[doc(inline)]
pub use answer::error::Error;
#[doc(inline)]
pub use answer::{Request, Solution, distance as compare, solve};
#[doc(inline)]
pub use problem::scene::{Scene, SceneBuilder};
#[doc(inline)]
pub use report::ResultFile;
