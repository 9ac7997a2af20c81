//! The failures of the published algorithm as printed, which are audit results.

use std::fmt::{Display, Write as _};

use mathcad::array::Column;
use numbers::scalar::Scalar;

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
        values: &[(&str, &dyn Display)],
    ) -> Self {
        let mut text = String::new();
        for (name, value) in values {
            let separator = if text.is_empty() { "" } else { ", " };
            write!(text, "{separator}{name} = {value}").expect("a String takes any text");
        }
        Failure { listing, line, cause, values: text }
    }
}

/// The place in `c_cnt` that a failure reports.
#[derive(Clone, Copy, Default)]
pub(super) struct Line {
    pub line: usize,
    /// The row of `cnt`.
    pub i1: usize,
    /// The `elem` number of the target edge.
    pub ct: usize,
}

impl Line {
    pub fn at_line(self, line: usize) -> Self {
        Line { line, ..self }
    }

    fn failure(self, cause: Cause, values: &[(&str, &dyn Display)]) -> Failure {
        let edge = if self.line < 8 { "trg[i2]" } else { "ct[i1]" };
        let place: [(&str, &dyn Display); 2] = [("i1", &self.i1), (edge, &self.ct)];
        Failure::new("c_cnt", self.line, cause, &[&place, values].concat())
    }

    /// Returns `numerator / denominator`; x/0 and 0/0 are errors.
    pub fn quotient<T: Scalar>(self, numerator: T, denominator: T) -> Result<T, Failure> {
        let (numerator, denominator) = (self.finite(numerator)?, self.finite(denominator)?);
        if denominator == T::zero() {
            let values: [(&str, &dyn Display); 2] =
                [("numerator", &numerator), ("denominator", &denominator)];
            return Err(self.failure(Cause::Singularity, &values));
        }
        self.finite(numerator / denominator)
    }

    /// Returns `value`, unless it overflowed.
    pub fn finite<T: Scalar>(self, value: T) -> Result<T, Failure> {
        if value.is_finite() {
            return Ok(value);
        }
        Err(self.failure(Cause::Overflow, &[("value", &value)]))
    }

    /// Returns `yt[index]`, or an error outside 1 .. rows(yt).
    pub fn entry<T: Scalar>(self, yt: &Column<T>, index: usize) -> Result<T, Failure> {
        let values: [(&str, &dyn Display); 2] = [("index of yt", &index), ("rows(yt)", &yt.rows())];
        yt.get(index).copied().ok_or_else(|| self.failure(Cause::InvalidIndex, &values))
    }
}
