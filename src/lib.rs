//! plane-contact: an audited, executable reimplementation of a published plane contact algorithm (A. M.
//! Filipov, M. V. Khomenko, «Решение плоской контактной задачи методом конечных элементов»).
//!
//! ```text
//!  Scene (open a file, or build one in code) --> Request (what is asked) --> solve --> Solution
//!                                                                              |
//!                                                ResultFile (result.json) <---+--> compare
//! ```
//!
//! The reference solution of a scene of your own, which is a file with its mesh beside it
//! ([how to write one](guide::scenes)), or a [`SceneBuilder`]:
//!
//! ```
//! use plane_contact::{Request, Scene, solve};
//!
//! let scene = Scene::open("golden/strand/scene.json")?;
//! let reference = solve(&Request::new(&scene).reference(), &mut |_| ())?;
//! let [_, uy] = reference.displacement(1).expect("there is a node 1");
//! let [x, y] = scene.model.nodes[0];
//! let [_, sigma_y, _] = reference.stress_at(x, y).expect("a node is in a triangle");
//! let [_, force] = reference.reaction("bottom").expect("the scene holds it");
//! println!("node 1 moves by {uy} and has a stress of {sigma_y}; the bottom carries {force}");
//! # Ok::<(), plane_contact::Error>(())
//! ```
//!
//! A variant of the paper, and how far it is from that:
//!
//! ```
//! use plane_contact::input::Variant;
//! use plane_contact::{Request, Scene, compare, solve};
//!
//! // The contact solution without friction: gaps close, and nothing pulls.
//! let scene = Scene::open("fig1")?;
//! let reference = solve(&Request::new(&scene).reference(), &mut |_| ())?;
//! assert!(reference.in_contact().all(|node| node.force.is_some_and(|force| force >= 0.0)));
//!
//! // The paper's algorithm is asked for by name.
//! let tied = Request::new(&scene).variant(Variant::Tied);
//! let tied = solve(&tied, &mut |step| assert!(step.k <= 20))?;
//! assert!(compare(&tied, &reference).energy_relative < 1.0);
//! # Ok::<(), plane_contact::Error>(())
//! ```
//!
//! Three places to start:
//!
//! - The names below and [`input`] are the library; `examples/compare_variants.rs` uses them.
//! - [`guide`] is for users of the program: scenes, auditing, snapshots, teaching, and a [`guide::glossary`].
//! - [`paper::mirror`] is the reference: each line of the paper's listings stands quoted above the line of Rust
//!   that computes it.
//!
//! # How to depend on it
//!
//! ```toml
//! [dependencies]
//! # The address of the repository of plane-contact; without its feature cli there is no command line, and no clap.
//! plane-contact = { git = "https://example.org/plane-contact.git", default-features = false }
//! ```
//!
//! The feature `cli`, on by default, is the program and its studies, snapshots among them.
//!
//! `examples/own_scene.rs` matches an error and writes a file for ParaView, `examples/snapshot_in_a_test.rs`
//! has a snapshot in a test of Cargo.
//!
//! # What is stable
//!
//! The names at the root of this library, [`input`], and the files of JSON, whose `format` changes with them.
//! The public fields that are vectors of nalgebra or numbers of dashu are not: read them by
//! [`Solution::displacement`], [`Solution::stress_at`] and [`Solution::reaction`]. The other modules are the
//! parts of the program, each of which uses those above it only. Tests use them; they are private in the
//! sense that they may change with any version.
//!
//! | part | what it has |
//! |---|---|
//! | [`error`], [`exit`], [`files`], [`child`], [`mod@choices`] | errors of the input, files, other programs, closed sets |
//! | [`numbers`] | kinds of numbers |
//! | [`mathcad`] | Mathcad's notation, interpreter and worksheets |
//! | [`problem`] | the finite element model, the element, scenes and their files |
//! | [`paper`] | the listings, their mirror, readings, and how the model reaches them |
//! | [`engine`] | solvers, requests, solutions, the published iterations, unilateral contact, error estimates |
//! | [`studies`] | audit, snapshots, trade, extremes, lesson, plan, benchmarks, CalculiX |
//! | [`output`] | tables, pictures, pages, documents |
#![forbid(unsafe_code)]

pub mod input;

/// The guide: pages for users of the program.
pub mod guide {
    #[doc = include_str!("guide/scenes.md")]
    pub mod scenes {}

    #[doc = include_str!("guide/auditing.md")]
    #[doc = include_str!("../golden/tables/claims.md")]
    #[doc = include_str!("../golden/tables/calculix.md")]
    #[doc = include_str!("../golden/tables/range.md")]
    #[doc = include_str!("../golden/tables/prices.md")]
    pub mod auditing {}

    #[doc = include_str!("guide/snapshots.md")]
    pub mod snapshots {}

    #[doc = include_str!("guide/teaching.md")]
    pub mod teaching {}

    #[doc = include_str!("guide/mathcad.md")]
    pub mod mathcad {}

    #[doc = include_str!("guide/sweeps.md")]
    pub mod sweeps {}

    #[doc = include_str!("guide/accuracy.md")]
    #[doc = include_str!("../golden/tables/trade.md")]
    #[doc = include_str!("../golden/tables/limit.md")]
    #[doc = include_str!("../golden/tables/statuses.md")]
    pub mod accuracy {}

    #[doc = include_str!("guide/benchmarks.md")]
    #[doc = include_str!("../golden/tables/benchmarks.md")]
    pub mod benchmarks {}

    #[doc = include_str!("guide/glossary.md")]
    pub mod glossary {}
}

pub use base::{child, choices, error, exit, files, limits, plain, suggestion, xml};
#[cfg(feature = "cli")]
pub use {commands, studies};
pub use {engine, mathcad, numbers, output, paper, problem};

#[doc(inline)]
pub use engine::error::Error;
#[doc(inline)]
pub use engine::{Request, Solution, distance as compare, solve};
#[doc(inline)]
pub use output::ResultFile;
#[doc(inline)]
pub use problem::scene::{Scene, SceneBuilder};
