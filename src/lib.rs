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
//! The rest of the library is what the program is made of: a workspace of parts, each of which uses those
//! above it only. They are open to tests and to the curious, and promise nothing from version to version.
//!
//! | part | what stands there |
//! |---|---|
//! | [`base`](error) | errors of the input, files, closed sets |
//! | [`numbers`] | scalars and solvers |
//! | [`mathcad`] | Mathcad's notation, its interpreter and its worksheets |
//! | [`problem`] | the finite element model, the element, scenes and their files |
//! | [`paper`] | **the reference**: the listings, their mirror in Rust, readings, printed conditions, the door to the model |
//! | [`engine`] | request, solution, the published iterations, unilateral contact, error estimates |
//! | [`studies`] | audit, snapshots, trade, extremes, lesson, plan, benchmarks, CalculiX |
//! | [`report`] | tables, pictures, pages, documents |
//!
//! To read what the paper computes, begin with [`paper::mirror`]: each line of the listings stands quoted
//! above the line of Rust that computes it. The table of symbols, with shapes and units, is in `README.md`.
#![forbid(unsafe_code)]

pub mod input;

pub use base::{choices, error, files, memory, plain, suggestion, xml};
pub use {engine, mathcad, numbers, paper, problem, report, studies};

#[doc(inline)]
pub use engine::error::Error;
#[doc(inline)]
pub use engine::{Request, Solution, distance as compare, solve};
#[doc(inline)]
pub use problem::scene::{Scene, SceneBuilder};
#[doc(inline)]
pub use report::ResultFile;
