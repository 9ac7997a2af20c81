//! The published algorithm failing as printed: an audit result.

use std::fmt::Write as _;

/// What went wrong on a listing's line, as Mathcad would put it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Cause {
    /// x/0 and 0/0.
    Singularity,
    /// A subscript below `ORIGIN` or past the last entry.
    InvalidIndex,
    /// A result too large for the scalar.
    Overflow,
}

impl Cause {
    /// Mathcad's words.
    pub fn words(self) -> &'static str {
        match self {
            Cause::Singularity => {
                "Found a singularity while evaluating this expression. You may be dividing by zero."
            }
            Cause::InvalidIndex => "This array index is invalid for this array.",
            Cause::Overflow => "The result of this expression is too large to represent.",
        }
    }
}

/// A listing that stops with an error: which line, and the values that made it stop.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{listing}, line {line}: {} {values}", .cause.words())]
pub struct Failure {
    /// `c_cnt` or `Km`.
    pub listing: &'static str,
    /// Printed line, from 1.
    pub line: usize,
    /// What went wrong.
    pub cause: Cause,
    /// Indices and values: `i1 = 3, ct[i1] = 12, ...`.
    pub values: String,
}

impl Failure {
    /// A failure on `line` of `listing`; `values` lists names and values in the order of their
    /// importance.
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
