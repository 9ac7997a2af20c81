//! What can go wrong: a listing that cannot be read, and a listing that fails as it runs.

use std::fmt;

use thiserror::Error;

/// A listing that does not follow the notation of `listings/README.md`.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub struct ParseError {
    /// The listing's name.
    pub listing: String,
    /// The printed line, from 1; headers do not count.
    pub line: usize,
    /// The line of the file, from 1.
    pub file_line: usize,
    /// The character of that line, from 1.
    pub column: usize,
    /// The line itself.
    pub text: String,
    /// What was found and what was expected.
    pub message: String,
}

impl fmt::Display for ParseError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { listing, line, file_line, column, text, message } = self;
        writeln!(
            f,
            "{listing}, line {line} (line {file_line} of the file), column {column}: {message}"
        )?;
        write!(f, "    {text}\n    {:>column$}", "^")
    }
}

/// A listing failed as it ran: the published algorithm's fault or the scene's, not the interpreter's.
#[derive(Clone, Debug, PartialEq, Error)]
#[error("{listing}, line {line}: {cause} In `{text}`, column {column} of `{statement}`.")]
pub struct Failure {
    /// The listing's name.
    pub listing: String,
    /// The printed line.
    pub line: usize,
    /// The character of the line at which the failed expression starts, from 1, indentation aside.
    pub column: usize,
    /// The failed expression as the listing writes it.
    pub text: String,
    /// The whole statement.
    pub statement: String,
    /// What happened, with the values that made it happen.
    pub cause: Cause,
}

/// A result, or the listing's failure.
pub type Fallible<T> = Result<T, Box<Failure>>;

impl Failure {
    /// Returns whether a limit was reached: no method of evaluating `∧` passes over that.
    pub(super) fn is_limit(&self) -> bool {
        matches!(self.cause, Cause::Limit { .. })
    }
}

/// Why a listing failed. Where Mathcad's own words are known, the message begins with them.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum Cause {
    /// An entry that the array does not have.
    #[error(
        "This array index is invalid for this array. {name}{subscripts} of {rows} x {cols} entries."
    )]
    IndexOutside {
        /// The array.
        name: String,
        /// The subscripts.
        subscripts: Subscripts,
        /// Rows that it has.
        rows: usize,
        /// Columns that it has.
        cols: usize,
    },
    /// A subscript below `ORIGIN`.
    #[error(
        "This array index is invalid for this array. {name}{subscripts} lies below ORIGIN = {origin}."
    )]
    IndexBelowOrigin {
        /// The array.
        name: String,
        /// The subscripts.
        subscripts: Subscripts,
        /// The worksheet's `ORIGIN`.
        origin: i32,
    },
    /// A subscript that is no whole number.
    #[error("An array index must be an integer: {name}{subscripts}.")]
    IndexNotWhole {
        /// The array.
        name: String,
        /// The subscripts.
        subscripts: Subscripts,
    },
    /// A division by zero.
    #[error(
        "Found a singularity while evaluating this expression. You may be dividing by zero. \
         {numerator}/{denominator}."
    )]
    Singularity {
        /// What was divided.
        numerator: f64,
        /// The zero.
        denominator: f64,
    },
    /// A result that is not a finite number.
    #[error("The result is {result}, no number that Mathcad can hold.")]
    Overflow {
        /// The result under IEEE 754.
        result: f64,
    },
    /// A name read before it has a value.
    #[error("This variable or function is not defined above: {name}.")]
    Undefined {
        /// The name.
        name: String,
    },
    /// A value of the wrong kind.
    #[error("Expected {expected}, found {found}.")]
    Kind {
        /// The kind needed.
        expected: &'static str,
        /// What the value is.
        found: String,
    },
    /// Arrays whose sizes do not go together.
    #[error("These array sizes do not match: {left} {operation} {right}.")]
    Sizes {
        /// The operation.
        operation: &'static str,
        /// What stands on its left.
        left: String,
        /// What stands on its right.
        right: String,
    },
    /// A function called with another number of arguments than it takes.
    #[error("This function has {expected} arguments; {found} were given.")]
    Arguments {
        /// The number it takes.
        expected: usize,
        /// The number given.
        found: usize,
    },
    /// A function from outside refused its arguments.
    #[error("{name}: {message}.")]
    Function {
        /// The function.
        name: String,
        /// Its own words.
        message: String,
    },
    /// A program that ended without evaluating a statement.
    #[error("The program has no value.")]
    NoValue,
    /// The listing asks for more than [`Limits`](super::Limits) allows.
    #[error("The limit of {limit} {of} is reached.")]
    Limit {
        /// The limit.
        limit: u64,
        /// What it limits.
        of: &'static str,
    },
}

/// One subscript or two, as evaluated; shown as `[i]` or `[i,j]`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Subscripts {
    /// The row.
    pub row: f64,
    /// The column, unless the array is a column.
    pub col: Option<f64>,
}

impl fmt::Display for Subscripts {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.col {
            None => write!(f, "[{}]", self.row),
            Some(col) => write!(f, "[{},{}]", self.row, col),
        }
    }
}
