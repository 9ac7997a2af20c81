//! What an answer keeps of the exact one.

use std::fmt;

use serde::Serialize;

use engine::error::Error;

/// What an answer keeps of the exact one.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(tag = "verdict", content = "detail", rename_all = "lowercase")]
pub enum Kept {
    /// The exact answer.
    Exact,
    /// An answer with so many right digits.
    Digits(f64),
    /// An answer without a right digit, and in what: a silent wrong answer.
    Wrong(&'static str),
    /// No answer, and by which error.
    Refused(String),
    /// An answer that no exact one stands beside: `unilateral` where a node opens.
    Unknown,
}

impl Kept {
    /// From the relative error of an answer.
    pub fn of_error(error: f64) -> Self {
        if error.is_nan() {
            Kept::Wrong("NaN")
        } else if error == 0.0 {
            Kept::Exact
        } else if error > 0.1 {
            Kept::Wrong("no digit")
        } else {
            Kept::Digits(-error.log10())
        }
    }

    /// Of a status: exact if it is the right one, else wrong.
    pub fn of_status(same: bool) -> Self {
        if same { Kept::Exact } else { Kept::Wrong("contact") }
    }

    /// No more digits than the scalar carries: an error may be less than its rounding by chance.
    pub fn at_most(self, carried: f64) -> Self {
        match self {
            Kept::Digits(digits) => Kept::Digits(digits.min(carried)),
            other => other,
        }
    }

    /// Digits kept, of the exact answer all that are `carried`; nothing of a run that was refused or is
    /// compared with none.
    pub fn digits(&self, carried: f64) -> Option<f64> {
        match self {
            Kept::Exact => Some(carried),
            Kept::Digits(digits) => Some(*digits),
            Kept::Wrong(_) => Some(0.0),
            Kept::Refused(_) | Kept::Unknown => None,
        }
    }

    /// Whether it is refused, or has fewer than `least` digits.
    pub fn breaks_down(&self, least: f64) -> bool {
        let refused = matches!(self, Kept::Refused(_));
        refused || self.digits(f64::INFINITY).is_some_and(|digits| digits < least)
    }
}

impl From<Error> for Kept {
    /// The error in a few words: its kind and its place.
    fn from(error: Error) -> Self {
        Kept::Refused(match error {
            Error::Input(error) => format!("input: {}", error.place),
            Error::Listing(failure) => format!("{} line {}", failure.listing, failure.line),
            Error::Execution(_) => "the listing".into(),
            Error::Singular(_) => "singular".into(),
            Error::Equilibrium(_) => "no equilibrium".into(),
        })
    }
}

impl fmt::Display for Kept {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Kept::Exact => f.write_str("exact"),
            Kept::Digits(digits) => write!(f, "{:.0}", digits.floor()),
            Kept::Wrong(why) => write!(f, "WRONG ({why})"),
            Kept::Refused(why) => write!(f, "refused ({why})"),
            Kept::Unknown => f.write_str("?"),
        }
    }
}
