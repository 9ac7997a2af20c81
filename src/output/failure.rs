//! A failure as JSON.

use serde::Serialize;
use serde_json::{Value, json};

use super::json;
use engine::error::Error;

/// Why a command ended without a result.
#[derive(Serialize)]
pub struct Failure {
    /// The number of the exit status.
    exit_status: u8,
    /// Who is to blame, and for what.
    #[serde(flatten)]
    cause: Value,
    /// What standard error says.
    message: String,
}

impl From<&Error> for Failure {
    fn from(error: &Error) -> Self {
        let cause = match error {
            // The input breaks a condition: what, where, and how to fix it.
            Error::Input(why) => {
                json!({ "kind": "input", "what": why.what, "where": why.place, "fix": why.fix })
            }
            // A listing fails: its line, from 1, and the values that caused it, where they are known.
            Error::Listing(why) => json!({
                "kind": "listing",
                "listing": why.listing,
                "line": why.line,
                "cause": why.cause.words(),
                "values": why.values,
            }),
            Error::Execution(why) => json!({
                "kind": "listing",
                "listing": why.listing,
                "line": why.line,
                "cause": why.cause.to_string(),
            }),
            // The matrix of an iteration, from 1, is singular: at which equation, and how many nodes were in
            // contact.
            Error::Singular(why) => json!({
                "kind": "singular",
                "variant": why.variant,
                "iteration": why.iteration,
                "node": why.node,
                "direction": why.direction,
                "in_contact": why.in_contact,
            }),
            // There is no equilibrium, there are several, none was found, or the model leaves its range.
            Error::Equilibrium(why) => {
                json!({ "kind": "equilibrium", "cause": why.cause, "what": why.what })
            }
        };
        Failure { exit_status: error.exit_status().number(), cause, message: error.to_string() }
    }
}

/// Returns why a command ended without a result.
pub fn failure(error: &Error) -> String {
    json::line(None, &json!({ "failure": Failure::from(error) }))
}
