//! The register of claims: what the paper says that can be checked.
//!
//! A claim is data (the paper's words and where they stand, what they claim, what is judged, the command
//! that reproduces its number) and a measure that runs on any scene. Where the verdict rests on the
//! listings it is true of any scene. Where it rests on a scene it is measured over the range of what
//! the paper leaves open too.

mod measures;
mod register;

use std::sync::Arc;

use rayon::prelude::*;
use schemars::JsonSchema;
use serde::Serialize;

pub use register::CLAIMS;

use super::case::{Case, variant_index};
use super::findings::{self, FINDINGS};
use super::range::{ParameterValue, Range};
use base::choices;
use engine::Request;
use paper::mirror::{Ambiguity, READINGS, Trial, Value};
use problem::modelling::Variant;

/// Something that the paper says.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct Claim {
    /// Its name: P1, P2, ...
    pub id: &'static str,
    /// Where the words stand in the paper.
    pub place: &'static str,
    /// The paper's words.
    pub quote: &'static str,
    /// The same in English.
    pub translation: &'static str,
    /// What they claim.
    pub says: &'static str,
    /// What is judged: the claim is true where this is so.
    pub condition: &'static str,
    /// The threshold of the condition, and where that comes from.
    pub threshold: &'static str,
    /// What the verdict rests on.
    pub basis: Basis,
    /// What the measured number is, with its unit.
    #[serde(rename = "of")]
    pub number: &'static str,
    /// The arguments of a command that prints the number in JSON; SCENE stands for the scene's name.
    #[serde(skip)]
    command: &'static [&'static str],
    /// Where it stands there: a JSON pointer, or two of which it is the quotient; VARIANT stands for
    /// the place of the measured variant.
    #[serde(skip)]
    at: &'static [&'static str],
    #[serde(skip)]
    measure: Measure,
}

/// How a claim is judged.
#[derive(Clone, Copy, Debug)]
enum Measure {
    /// By a finding, on the finding's scene: if it is present, the claim is false.
    Refuted(&'static str),
    /// By a finding, on the finding's scene: if it is present, the claim has this verdict, with
    /// these words.
    Finding(&'static str, Verdict, &'static str),
    /// By an experiment on a scene.
    Scene(fn(&Case) -> Outcome<'_>),
    /// By nothing, for this reason.
    Nothing(&'static str),
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
        /// Nothing: neither the paper nor a run can tell.
        Nothing = "not enough information",
    }
}

choices! {
    /// Whether what the paper says is so.
    #[expect(missing_docs, reason = "the names say it")]
    Verdict {
        True = "true",
        /// Under a condition, which the detail says.
        TrueOnlyIf = "true only if",
        False = "false",
        NotCheckable = "not checkable",
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
type Outcome<'a> = Result<Evidence, Box<dyn std::error::Error + 'a>>;

/// A verdict, the number that the claim names, and what else is to be said.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Evidence {
    /// The verdict.
    pub verdict: Verdict,
    /// The number that the claim names; None where it names none or cannot be checked.
    pub number: Option<f64>,
    /// The variant that was measured, where it is one of the paper's.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub variant: Option<Variant>,
    /// The condition of the verdict `true only if`; else what is to be said beside the number.
    pub detail: String,
}

impl Evidence {
    fn new(verdict: Verdict, number: Option<f64>, detail: impl Into<String>) -> Self {
        Evidence { verdict, number, variant: None, detail: detail.into() }
    }

    /// Returns the verdict in words, with its condition.
    pub fn words(&self) -> String {
        match self.verdict {
            Verdict::TrueOnlyIf => format!("{} {}", self.verdict, self.detail),
            Verdict::True | Verdict::False | Verdict::NotCheckable => self.verdict.to_string(),
        }
    }
}

/// A claim with its verdict on a scene and over the range.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct JudgedClaim {
    /// The claim.
    #[serde(flatten)]
    pub claim: Claim,
    /// What the scene says of it.
    #[serde(flatten)]
    pub measured: Evidence,
    /// The arguments of a command that prints the number in JSON.
    pub command: Vec<String>,
    /// Where it stands there: a JSON pointer, or two of which it is the quotient.
    pub at: Vec<String>,
    /// What the verdict rests on.
    pub scope: Scope,
    /// Where the verdict rests on runs: the estimated error of the mesh itself in the equilibrium under
    /// the scene's own friction, in the energy norm, relative. All runs are on this mesh.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mesh_error: Option<f64>,
    /// The verdicts over the range; empty where the scene has no part in the verdict.
    pub elsewhere: Vec<Elsewhere>,
}

/// A verdict at a place of the range.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct Elsewhere {
    /// The parameter and its value.
    #[serde(flatten)]
    pub place: ParameterValue,
    /// What that scene says of the claim.
    #[serde(flatten)]
    pub measured: Evidence,
}

/// A verdict under another reading of the print.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct UnderReading {
    /// The value of the reading that is not the default, such as `R8 = m`.
    pub reading: String,
    /// What the scene says under it.
    #[serde(flatten)]
    pub measured: Evidence,
}

/// Judges claims on a scene and at places of the range.
pub fn judge(claims: &[Claim], case: &Case, places: &Range) -> Vec<JudgedClaim> {
    std::iter::once(case).chain(places.iter().map(|(_, case)| &**case)).for_each(Case::prepare);
    claims.par_iter().map(|claim| claim.judge(case, places)).collect()
}

impl Claim {
    /// Measures the claim on a scene. Where a run fails, the detail says so.
    pub fn measure(&self, case: &Case) -> Evidence {
        let not_checkable = |why: &str| Evidence::new(Verdict::NotCheckable, None, why);
        match self.measure {
            Measure::Refuted(id) => by_finding(id, Verdict::False, None),
            Measure::Finding(id, verdict, words) => by_finding(id, verdict, Some(words)),
            Measure::Scene(measure) => measure(case).unwrap_or_else(|why| {
                not_checkable(why.to_string().lines().next().unwrap_or_default())
            }),
            Measure::Nothing(reason) => not_checkable(reason),
        }
    }

    /// Judges the claim on a scene and at places of the range.
    pub fn judge(&self, case: &Case, places: &Range) -> JudgedClaim {
        let measured = self.measure(case);
        let places = if self.basis == Basis::Runs { &places[..] } else { &[] };
        let elsewhere = |(place, case): &(ParameterValue, Arc<Case>)| Elsewhere {
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
        let is_on_runs = self.basis == Basis::Runs;
        JudgedClaim {
            claim: self.clone(),
            command: self
                .command
                .iter()
                .map(|word| word.replace("SCENE", &case.scene.name))
                .collect(),
            at: self.pointers(&measured),
            measured,
            scope,
            mesh_error: is_on_runs.then(|| case.mesh_error()).flatten(),
            elsewhere,
        }
    }

    /// Judges the claim under each other reading that may change a run; of a verdict that does not rest
    /// on runs there is nothing to judge.
    pub fn by_reading(&self, case: &Case) -> Vec<UnderReading> {
        let (plane, own) = (case.model().plane, case.request(case.published_variant()));
        let schedule = own.schedule();
        let rows = READINGS.iter().filter(|row| {
            self.basis == Basis::Runs && matches!(row.trial, Trial::OwnVariant | Trial::Printed)
        });
        let others: Vec<_> = rows
            .flat_map(|row| row.others(plane, schedule).map(move |value| (row, value)))
            .collect();
        let under = |(row, value): (&Ambiguity, &Value)| {
            let other = Case::from_request(Request::new(&case.scene).reading(row.reading(value)));
            UnderReading { reading: row.label(value), measured: self.measure(&other) }
        };
        others.into_par_iter().map(under).collect()
    }

    fn pointers(&self, measured: &Evidence) -> Vec<String> {
        let place = measured.variant.map_or(0, variant_index).to_string();
        self.at.iter().map(|pointer| pointer.replace("VARIANT", &place)).collect()
    }
}

/// Judges a claim by a finding on the finding's own scene; without words the finding's title is the
/// detail.
fn by_finding(id: &str, verdict: Verdict, words: Option<&str>) -> Evidence {
    let finding = FINDINGS.iter().find(|finding| finding.id == id).expect("an id of the register");
    let found = finding.measure(&Case::new(finding.scene()));
    let verdict = match found.verdict {
        findings::Verdict::Present => verdict,
        findings::Verdict::NotTriggered | findings::Verdict::Contradicted => Verdict::NotCheckable,
    };
    Evidence::new(verdict, Some(found.number), words.unwrap_or(finding.title))
}
