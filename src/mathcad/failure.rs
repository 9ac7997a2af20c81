//! What can go wrong: a listing that cannot be read, and a listing that fails as it runs.

use std::borrow::Cow;
use std::fmt;

use thiserror::Error;

/// A listing that does not follow the notation of `listings/README.md`.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub struct ParseError {
    /// The name of the listing.
    pub listing: String,
    /// The number of the printed line, from 1; headers do not count.
    pub line: usize,
    /// The number of the line in the file, from 1.
    pub file_line: usize,
    /// The place in that line, in characters from 1.
    pub column: usize,
    /// The first 300 characters of the line, indentation included.
    pub text: String,
    /// What was found, and what was expected.
    pub message: String,
}

impl fmt::Display for ParseError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { listing, line, file_line, column, text, message } = self;
        writeln!(
            f,
            "{listing}, line {line} (line {file_line} of the file), column {column}: {message}"
        )?;
        write!(f, "    {text}\n    {}^", " ".repeat(column.saturating_sub(1)))
    }
}

/// A listing failed as it ran: the published algorithm's fault or the scene's, not the
/// interpreter's.
#[derive(Clone, Debug, PartialEq, Error)]
#[error(
    "{listing}, line {line}: {cause} In `{}`, column {column} of `{}`.",
    shown(text),
    shown(statement)
)]
pub struct Failure {
    /// The name of the listing.
    pub listing: String,
    /// The number of the printed line, from 1.
    pub line: usize,
    /// Where the failed expression starts in the line, in characters from 1, indentation aside.
    pub column: usize,
    /// The failed expression as the listing writes it.
    pub text: String,
    /// The text of the whole line, without indentation.
    pub statement: String,
    /// Why it failed.
    pub cause: Cause,
}

/// Returns as much of a text as a message shows.
fn shown(text: &str) -> Cow<'_, str> {
    const MOST: usize = 100;
    match text.char_indices().nth(MOST) {
        Some((end, _)) => format!("{} ...", &text[..end]).into(),
        None => text.into(),
    }
}

/// What the evaluation of a listing gives, or where and why it failed.
pub type Fallible<T> = Result<T, Box<Failure>>;

/// A failure without its place, on line 0, until the run adds where it was.
impl From<Cause> for Box<Failure> {
    fn from(cause: Cause) -> Self {
        let (listing, text, statement) = Default::default();
        Box::new(Failure { listing, line: 0, column: 0, text, statement, cause })
    }
}

impl Failure {
    /// Returns whether a limit was reached: no method of evaluating `∧` passes over that.
    pub fn is_limit(&self) -> bool {
        matches!(self.cause, Cause::Limit { .. })
    }
}

/// Why a listing failed. Where Mathcad's own words are known, the message begins with them.
#[derive(Clone, Debug, PartialEq, Error)]
#[expect(missing_docs, reason = "the message of each says what its values are")]
pub enum Cause {
    #[error(
        "This array index is invalid for this array. {name}{subscripts} of {rows} x {cols} entries."
    )]
    IndexOutside { name: String, subscripts: Subscripts, rows: usize, cols: usize },
    #[error(
        "This array index is invalid for this array. {name}{subscripts} lies below \
         ORIGIN = {origin}."
    )]
    IndexBelowOrigin { name: String, subscripts: Subscripts, origin: i32 },
    #[error("An array index must be an integer: {name}{subscripts}.")]
    IndexNotWhole { name: String, subscripts: Subscripts },
    #[error("Division by zero. («Деление на ноль.» in Mathcad 14.1.) {numerator}/{denominator}.")]
    Singularity { numerator: f64, denominator: f64 },
    #[error(
        "Found a number beyond 10^307. («Найдено число величиной более 10^307» in Mathcad 14.1.) \
         The result is {result}."
    )]
    Overflow {
        /// The result under IEEE 754.
        result: f64,
    },
    #[error("This variable or function is not defined above: {name}.")]
    Undefined { name: String },
    /// The interpreter does not have this of Mathcad.
    #[error("unsupported: {construct}.")]
    Unsupported { construct: String },
    #[error("Expected {expected}, found {found}.")]
    Kind { expected: &'static str, found: String },
    #[error("These array sizes do not match: {left} {operation} {right}.")]
    Sizes { operation: &'static str, left: String, right: String },
    #[error("This function has {expected} arguments; {found} were given.")]
    Arguments { expected: usize, found: usize },
    #[error("{name}: {message}.")]
    Function {
        name: String,
        /// The reason, in the function's own words.
        message: String,
    },
    #[error("The program has no value.")]
    NoValue,
    #[error("A range must lead from its start to its end: {from}, {second} .. {to}.")]
    Range { from: f64, second: f64, to: f64 },
    #[error("`break` and `continue` belong in a loop.")]
    OutsideLoop,
    #[error("The matrix is singular.")]
    Singular,
    #[error("The function is not defined at this point: {name} of {argument}.")]
    Domain { name: String, argument: f64 },
    #[error("unsupported: complex numbers, of which the result of {name} is one.")]
    Complex { name: String },
    /// The listing asks for more than [`Limits`](super::settings::Limits) allows.
    #[error("The limit of {limit} {of} is reached.")]
    Limit { limit: u64, of: &'static str },
}

impl Cause {
    /// Returns the failure of an operation on values of so many rows and columns.
    pub(super) fn sizes(
        operation: &'static str,
        left: (usize, usize),
        right: (usize, usize),
    ) -> Self {
        let [left, right] = [left, right].map(|(rows, cols)| format!("{rows} x {cols}"));
        Cause::Sizes { operation, left, right }
    }
}

/// One subscript or two, as evaluated; shown as `[i]` or `[i,j]`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Subscripts {
    /// The first subscript.
    pub row: f64,
    /// The second subscript, if there is one.
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
