//! Mathcad's arrays and semantics: an interpreter for listings in the notation of `listings/README.md`.
//!
//! ```
//! use plane_contact::paper::mathcad::{Limits, Listing, Settings, Value};
//!
//! let listing = Listing::parse("twice", "twice(x) :=\n  for i ∈ 1 .. rows(x)\n    y[i] ← 2·x[i]\n  y")?;
//! let mut worksheet = listing.runner(&Settings::default(), &Limits::default());
//! let x = plane_contact::paper::mathcad::array::Column::from_vec(vec![1.5, 4.0]);
//! let outcome = worksheet.call(&[Value::from(&x)])?;
//! assert_eq!(outcome.value.to_string(), "3; 8");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! | module | what it holds |
//! |---|---|
//! | [`mod@array`] | arrays with `ORIGIN = 1`, the mirror's own |
//! | `syntax`, `lexer`, `parser`, [`listing`] | from text to syntax tree |
//! | [`value`], `arithmetic`, `function`, `state`, `entry`, `call`, `eval`, [`run`] | running a listing |
//! | [`settings`] | the worksheet's settings, and limits against hostile listings |
//! | [`failure`] | what can go wrong |
//! | [`observe`] | watching a run: traces and coverage |
//! | [`edit`] | the alternative readings of a listing |
//!
//! `README.md` in this directory lists Mathcad's semantics one by one, with the source of each.

pub mod array;
pub mod edit;
pub mod failure;
pub mod listing;
pub mod observe;
pub mod run;
pub mod settings;
pub mod value;

mod arithmetic;
mod call;
mod entry;
mod eval;
mod function;
mod lexer;
mod parser;
mod state;
mod syntax;

#[cfg(test)]
mod tests;

pub use edit::Edit;
pub use failure::{Cause, Failure, ParseError};
pub use listing::{Line, Listing};
pub use observe::{Coverage, Observer, Recorder};
pub use run::{Outcome, Runner};
pub use settings::{Conjunction, Descending, LastIf, Limits, Settings, ZeroOverZero};
pub use value::{Array, Value};
