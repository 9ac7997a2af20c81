//! plane-contact: an audited, executable reimplementation of a published plane contact algorithm (A. M. Filipov,
//! M. V. Khomenko, «Решение плоской контактной задачи методом конечных элементов»).
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
//! The other modules are the parts of the program, each of which uses those above it only. Tests use them; they are
//! private in the sense that they may change with any version.
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
//! | [`report`] | tables, pictures, pages, documents |
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
pub use {commands, engine, mathcad, numbers, paper, problem, report, studies};

#[doc(inline)]
pub use engine::error::Error;
#[doc(inline)]
pub use engine::{Request, Solution, distance as compare, solve};
#[doc(inline)]
pub use problem::scene::{Scene, SceneBuilder};
#[doc(inline)]
pub use report::ResultFile;
