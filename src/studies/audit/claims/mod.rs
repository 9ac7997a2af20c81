//! The register of claims: what the paper says that can be checked.
//!
//! A claim is data (the paper's words, what they claim, what the verdict rests on, the command that
//! reproduces its number) and a measure that runs on any scene. Where the verdict rests on the
//! listings it is true of any scene. Where it rests on a scene it is measured over the range of what
//! the paper leaves open too.

mod measures;
mod register;

use std::sync::Arc;

use rayon::prelude::*;
use schemars::JsonSchema;
use serde::Serialize;

pub use register::CLAIMS;

use super::Case;
use super::range::{Place, Range};
use base::choices;

/// Something that the paper says.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct Claim {
    /// Its name: P1, P2, ...
    pub id: &'static str,
    /// The line of the paper's text on which the words stand.
    pub line: usize,
    /// The paper's words.
    pub quote: &'static str,
    /// What they claim.
    pub says: &'static str,
    /// What the verdict rests on.
    pub basis: Basis,
    /// What the measured number is, with its unit.
    #[serde(rename = "of")]
    pub number: &'static str,
    /// The arguments of a command that prints the number in JSON.
    pub command: &'static [&'static str],
    /// Where it stands there: a JSON pointer, or two of which it is the quotient.
    pub at: &'static [&'static str],
    #[serde(skip)]
    measure: fn(&Case) -> Outcome<'_>,
}

choices! {
    /// What a verdict rests on.
    Basis {
        /// The text of a listing: the verdict follows from its lines.
        Listing = "proved on the listing",
        /// Random scenes whose statuses are known.
        Random = "measured on random scenes",
        /// Runs of a scene.
        Runs = "measured on runs",
        /// Nothing that is at hand.
        Nothing = "what is needed is not at hand",
    }
}

choices! {
    /// Whether what the paper says is so.
    Verdict {
        Holds = "holds",
        Condition = "holds with a condition",
        Fails = "does not hold",
        Unknown = "cannot be checked",
    }
}

choices! {
    /// How far a verdict reaches.
    Scope {
        /// It does not depend on the scene.
        AnyScene = "any scene",
        /// It is the same at every place of the range.
        Range = "over the assumed range",
        /// It is another one elsewhere in the range, or that was not asked for.
        OneScene = "this scene only",
        /// It was measured on scenes drawn at random.
        Drawn = "random scenes",
        /// There is none.
        Nowhere = "-",
    }
}

/// What a scene says of a claim, or why a run failed.
type Outcome<'a> = Result<Measured, Box<dyn std::error::Error + 'a>>;

/// A verdict, the number that the claim names, and what else is to be said.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Measured {
    pub verdict: Verdict,
    pub number: Option<f64>,
    pub detail: String,
}

/// A claim with its verdict on a scene and over the range.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct Judged {
    #[serde(flatten)]
    pub claim: Claim,
    #[serde(flatten)]
    pub measured: Measured,
    pub scope: Scope,
    /// The verdicts over the range; empty where the scene has no part in the verdict.
    pub elsewhere: Vec<Elsewhere>,
}

/// A verdict at a place of the range.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct Elsewhere {
    #[serde(flatten)]
    pub place: Place,
    #[serde(flatten)]
    pub measured: Measured,
}

/// Judges claims on a scene and at places of the range.
pub fn judge(claims: &[Claim], case: &Case, places: &Range) -> Vec<Judged> {
    std::iter::once(case).chain(places.iter().map(|(_, case)| &**case)).for_each(Case::prepare);
    claims.par_iter().map(|claim| claim.judge(case, places)).collect()
}

impl Claim {
    /// Measures the claim on a scene. Where a run fails, the detail says so.
    pub fn measure(&self, case: &Case) -> Measured {
        (self.measure)(case).unwrap_or_else(|why| {
            let detail = why.to_string().lines().next().unwrap_or_default().into();
            Measured { verdict: Verdict::Unknown, number: None, detail }
        })
    }

    fn judge(&self, case: &Case, places: &Range) -> Judged {
        let measured = self.measure(case);
        let places = if self.basis == Basis::Runs { &places[..] } else { &[] };
        let elsewhere = |(place, case): &(Place, Arc<Case>)| Elsewhere {
            place: *place,
            measured: self.measure(case),
        };
        let elsewhere: Vec<Elsewhere> = places.par_iter().map(elsewhere).collect();
        let same = elsewhere.iter().all(|other| other.measured.verdict == measured.verdict);
        let scope = match self.basis {
            Basis::Listing => Scope::AnyScene,
            Basis::Random => Scope::Drawn,
            Basis::Nothing => Scope::Nowhere,
            Basis::Runs if !elsewhere.is_empty() && same => Scope::Range,
            Basis::Runs => Scope::OneScene,
        };
        Judged { claim: self.clone(), measured, scope, elsewhere }
    }
}
