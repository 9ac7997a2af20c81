//! A failure as JSON.

use serde_json::{Value, json};

use super::json::headed;
use crate::answer::error::Error;

/// Returns why a command ended without a result.
pub fn failure(error: &Error) -> String {
    let (kind, more) = match error {
        Error::Input(why) => {
            ("input", json!({"what": why.what, "where": why.place, "fix": why.fix}))
        }
        Error::Listing(why) => (
            "listing",
            json!({
                "listing": why.listing,
                "line": why.line,
                "cause": why.cause.words(),
                "values": why.values,
            }),
        ),
        Error::Execution(_) => ("listing", json!({})),
        Error::Singular(why) => (
            "singular",
            json!({
                "variant": why.variant,
                "iteration": why.iteration,
                "node": why.node,
                "direction": why.direction.to_string(),
                "in_contact": why.in_contact,
            }),
        ),
        Error::Equilibrium(_) => ("equilibrium", json!({})),
    };
    let mut failure = json!({
        "exit_status": error.exit_status(),
        "kind": kind,
        "message": error.to_string(),
    });
    if let (Value::Object(failure), Value::Object(more)) = (&mut failure, more) {
        failure.extend(more);
    }
    headed(None, &json!({ "failure": failure }))
}
