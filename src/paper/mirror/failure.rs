//! The failures of the published algorithm as printed, which are audit results.

use std::fmt::Write as _;

/// The cause of a failure on a line of a listing, as Mathcad would report it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Cause {
    /// A division by zero: x/0 or 0/0.
    Singularity,
    /// A subscript below `ORIGIN` or past the last entry.
    InvalidIndex,
    /// A result too large for the scalar.
    Overflow,
}

impl Cause {
    /// Returns the message of Mathcad 14.1, in English.
    pub fn words(self) -> &'static str {
        match self {
            Cause::Singularity => "Division by zero.",
            Cause::InvalidIndex => "This array index is invalid for this array.",
            Cause::Overflow => "Found a number beyond 10^307.",
        }
    }
}

/// The failure of a listing: its line, and the values that caused it.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{listing}, line {line}: {} {values}", .cause.words())]
pub struct Failure {
    /// The name of the listing, `c_cnt` or `Km`.
    pub listing: &'static str,
    /// The printed line, from 1.
    pub line: usize,
    /// The cause of the failure.
    pub cause: Cause,
    /// The indices and values: `i1 = 3, ct[i1] = 12, ...`.
    pub values: String,
}

impl Failure {
    /// Describes a failure on `line`; `values` lists names and values by importance.
    pub fn new(
        listing: &'static str,
        line: usize,
        cause: Cause,
        values: &[(&str, &dyn std::fmt::Display)],
    ) -> Self {
        let mut text = String::new();
        for (name, value) in values {
            let separator = if text.is_empty() { "" } else { ", " };
            write!(text, "{separator}{name} = {value}").expect("a String takes any text");
        }
        Failure { listing, line, cause, values: text }
    }
}
