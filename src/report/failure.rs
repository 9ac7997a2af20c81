//! A failure as JSON.

use serde::Serialize;

use super::json;
use engine::error::{self, Error};

/// Why a command ended without a result.
#[derive(Serialize)]
pub struct Failure {
    /// The number of the exit status.
    exit_status: u8,
    #[serde(flatten)]
    cause: Cause,
    /// What standard error says.
    message: String,
}

/// Who is to blame, and for what.
#[derive(Serialize)]
#[serde(tag = "kind", rename_all = "lowercase")]
enum Cause {
    /// The input breaks a condition: what, where, and how to fix it.
    Input { what: String, r#where: String, fix: String },
    /// A listing fails: its line, from 1, and the values that caused it, where they are known.
    Listing {
        listing: String,
        line: usize,
        cause: String,
        #[serde(skip_serializing_if = "Option::is_none")]
        values: Option<String>,
    },
    /// The matrix of an iteration, from 1, is singular: at which equation, and how many contact
    /// nodes were in contact.
    Singular {
        variant: &'static str,
        iteration: usize,
        node: usize,
        direction: char,
        in_contact: usize,
    },
    /// There is no equilibrium, there are several, none was found, or the model leaves its range.
    Equilibrium { cause: error::Cause, what: String },
}

/// The document of a command that ended without a result.
#[derive(Serialize)]
pub struct Failed {
    failure: Failure,
}

impl From<&Error> for Failure {
    fn from(error: &Error) -> Self {
        Failure {
            exit_status: error.exit_status().number(),
            cause: cause(error),
            message: error.to_string(),
        }
    }
}

fn cause(error: &Error) -> Cause {
    match error {
        Error::Input(why) => Cause::Input {
            what: why.what.clone(),
            r#where: why.place.clone(),
            fix: why.fix.clone(),
        },
        Error::Listing(why) => Cause::Listing {
            listing: why.listing.into(),
            line: why.line,
            cause: why.cause.words().into(),
            values: Some(why.values.clone()),
        },
        Error::Execution(why) => Cause::Listing {
            listing: why.listing.clone(),
            line: why.line,
            cause: why.cause.to_string(),
            values: None,
        },
        Error::Singular(why) => Cause::Singular {
            variant: why.variant,
            iteration: why.iteration,
            node: why.node,
            direction: why.direction,
            in_contact: why.in_contact,
        },
        Error::Equilibrium(why) => Cause::Equilibrium { cause: why.cause, what: why.what.clone() },
    }
}

/// Returns why a command ended without a result.
pub fn failure(error: &Error) -> String {
    json::line(None, &Failed { failure: error.into() })
}
