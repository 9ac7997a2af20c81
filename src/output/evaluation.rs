//! What came of a program in the notation of the listings, as JSON.

use serde::Serialize;
use serde_json::json;

use super::json;
use mathcad::{Ended, Failure, Value};

/// What a program computed.
#[derive(Serialize)]
struct Evaluation<'a> {
    /// A number, words, or a list of rows.
    value: &'a Value,
    /// What the program's own `trace` wrote.
    trace: &'a [String],
}

/// Returns what a program computed.
pub fn json(outcome: &Ended) -> String {
    json::streamed(&Evaluation { value: &outcome.value, trace: &outcome.trace_output })
}

/// Returns why a program failed, and where: the function, its line and where the failed expression starts in
/// it, from 1 and indentation aside, that expression and the whole line.
pub fn error_json(failure: &Failure) -> String {
    let Failure { listing, line, column, text, statement, cause } = failure;
    let error = json!({
        "cause": cause.to_string(),
        "listing": listing,
        "line": line,
        "column": column,
        "text": text,
        "statement": statement,
    });
    json::line(None, &json!({ "error": error }))
}
