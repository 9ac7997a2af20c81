//! What came of a program in the notation of the listings, as JSON.

use serde::Serialize;

use super::json;
use mathcad::json::Written;
use mathcad::{Failure, Outcome};

/// What came of a program.
#[derive(Serialize)]
#[serde(untagged)]
#[expect(missing_docs, reason = "the type of JSON document has a form for each end of a program")]
pub enum Document<'a> {
    Result {
        /// A number, words, or a list of rows.
        value: Written<'a>,
        /// What the program's own `trace` wrote.
        trace: &'a [String],
    },
    Failure {
        /// Why and where the program failed.
        error: ErrorRow<'a>,
    },
}

/// Why a program failed, and where.
#[derive(Serialize)]
pub struct ErrorRow<'a> {
    cause: String,
    /// The function.
    listing: &'a str,
    /// The line, from 1.
    line: usize,
    /// Where the failed expression starts in the line, from 1, indentation aside.
    column: usize,
    /// The failed expression.
    text: &'a str,
    /// The whole line.
    statement: &'a str,
}

/// Returns what a program computed.
pub fn json(outcome: &Outcome) -> String {
    let value = Written(&outcome.value);
    json::streamed(&Document::Result { value, trace: &outcome.trace_output })
}

/// Returns why a program failed.
pub fn error_json(failure: &Failure) -> String {
    let Failure { listing, line, column, text, statement, cause } = failure;
    let (line, column, cause) = (*line, *column, cause.to_string());
    json::line(
        None,
        &Document::Failure { error: ErrorRow { cause, listing, line, column, text, statement } },
    )
}
