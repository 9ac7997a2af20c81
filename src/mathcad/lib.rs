//! Mathcad's arrays and semantics: an interpreter for listings in the notation of
//! `listings/README.md`.
//!
//! ```
//! use plane_contact_mathcad::{Limits, Listing, Settings, Sheet, Value};
//!
//! let text = "twice(x) :=\n  for i ∈ 1 .. rows(x)\n    y[i] ← 2·x[i]\n  y";
//! let listing = Listing::parse("twice", text)?;
//! let sheet = Sheet::default();
//! let mut worksheet = listing.runner(&sheet, &Settings::default(), &Limits::default());
//! let x = plane_contact_mathcad::array::Column::from_vec(vec![1.5, 4.0]);
//! let outcome = worksheet.call(&[Value::from(&x)])?;
//! assert_eq!(outcome.value.to_string(), "3; 8");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! | modules, each using only those above it | what they contain |
//! |---|---|
//! | [`settings`] | the worksheet's settings, and limits against hostile listings |
//! | [`failure`] | what can go wrong |
//! | [`mod@array`], [`value`] | the mirror's arrays with `ORIGIN = 1`, a listing's values |
//! | `syntax`, `lexer`, `parser`, [`listing`] | from text to syntax tree |
//! | [`edit`], [`mod@file`] | the alternative readings of a listing; files of several listings |
//! | [`observe`] | watching a run: traces and coverage |
//! | `arithmetic`, `matrices`, `x87`, `function` | operations on values, and the functions a listing may call |
//! | [`unsupported`] | Mathcad's functions and units that are not here |
//! | [`json`] | values as JSON |
//! | [`sheet`] | what a worksheet defines above a program |
//! | `state`, `eval`, [`run`] | a listing as it runs: its names and what it has used, its program, the worksheet around it |
//! | [`xmcd`] | the second notation: worksheets as Mathcad saves them |
//! | `words` | what Mathcad's error messages mean |
//! | [`worksheet`] | executing a worksheet beside its saved results |
//!
//! `README.md` in this directory lists Mathcad's semantics one by one, with the source of each.
#![forbid(unsafe_code)]

pub mod array;
pub mod edit;
pub mod failure;
pub mod file;
#[cfg(feature = "files")]
pub mod json;
pub mod listing;
pub mod observe;
pub mod run;
pub mod settings;
pub mod sheet;
pub mod value;
#[cfg(feature = "files")]
pub mod worksheet;
#[cfg(feature = "files")]
pub mod xmcd;

mod arithmetic;
mod eval;
mod function;
mod lexer;
mod matrices;
mod parser;
mod state;
pub mod syntax;
pub mod unsupported;
#[cfg(feature = "files")]
mod words;
mod x87;

pub use edit::Edit;
pub use failure::{Cause, Failure, ParseError};
pub use lexer::name_length;
pub use listing::{Line, Listing};
pub use observe::Recorder;
pub use run::{Runner, evaluate};
pub use settings::{Conjunction, Limits, Settings};
pub use sheet::Sheet;
pub use state::Ended;
pub use value::{Array, Value};
