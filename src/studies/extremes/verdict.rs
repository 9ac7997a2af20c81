//! What comes of one problem at one magnitude.

use std::fmt;

use serde::Serialize;

use engine::error::Error;

/// What a run was worth against the exact answer.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(tag = "verdict", content = "detail", rename_all = "lowercase")]
pub enum Verdict {
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

impl Verdict {
    /// From the relative error of an answer.
    pub fn of_error(error: f64) -> Self {
        if error.is_nan() {
            Verdict::Wrong("NaN")
        } else if error == 0.0 {
            Verdict::Exact
        } else if error > 0.1 {
            Verdict::Wrong("no digit")
        } else {
            Verdict::Digits(-error.log10())
        }
    }

    /// Returns the verdict on a status: exact if it is the right one, else wrong.
    pub fn of_status(same: bool) -> Self {
        if same { Verdict::Exact } else { Verdict::Wrong("contact") }
    }

    /// No more digits than the scalar carries: an error may be less than its rounding by chance.
    pub fn at_most(self, carried: f64) -> Self {
        match self {
            Verdict::Digits(digits) => Verdict::Digits(digits.min(carried)),
            other => other,
        }
    }

    /// Digits kept, of the exact answer all that are `carried`; nothing of a run that was refused or is
    /// compared with none.
    pub fn digits(&self, carried: f64) -> Option<f64> {
        match self {
            Verdict::Exact => Some(carried),
            Verdict::Digits(digits) => Some(*digits),
            Verdict::Wrong(_) => Some(0.0),
            Verdict::Refused(_) | Verdict::Unknown => None,
        }
    }

    /// Whether it is refused, or has fewer than `least` digits.
    pub fn breaks_down(&self, least: f64) -> bool {
        let refused = matches!(self, Verdict::Refused(_));
        refused || self.digits(f64::INFINITY).is_some_and(|digits| digits < least)
    }
}

impl From<Error> for Verdict {
    /// The error in a few words: its kind and its place.
    fn from(error: Error) -> Self {
        Verdict::Refused(match error {
            Error::Input(error) => format!("input: {}", error.place),
            Error::Listing(failure) => format!("{} line {}", failure.listing, failure.line),
            Error::Execution(_) => "the listing".into(),
            Error::Singular(_) => "singular".into(),
            Error::Equilibrium(_) => "no equilibrium".into(),
        })
    }
}

impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Verdict::Exact => f.write_str("exact"),
            Verdict::Digits(digits) => write!(f, "{:.0}", digits.floor()),
            Verdict::Wrong(why) => write!(f, "WRONG ({why})"),
            Verdict::Refused(why) => write!(f, "refused ({why})"),
            Verdict::Unknown => f.write_str("?"),
        }
    }
}
