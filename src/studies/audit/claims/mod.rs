//! The register of claims: what the paper says that can be checked.
//!
//! A claim is data (the paper's words and where they stand, what they claim, what is judged, the command
//! that reproduces its number) and a measure that runs on any scene. Where the verdict rests on the
//! listings it is true of any scene. Where it rests on a scene it is measured over the range of what
//! the paper leaves open too.

pub mod claim_tables;
mod measures;
mod register;

use std::sync::Arc;

use rayon::prelude::*;
use serde::Serialize;

pub(super) use measures::{NOTICEABLE, nearest};
pub use register::{CLAIMS, ClaimId};

use super::case::Case;
use super::evidence::{self, BY_ROUNDING, Outcome};
use super::findings::{Finding, FindingId, Presence};
use super::range::{ParameterValue, Range};
use super::readings::others;
use base::choices;
use base::error::InputError;
use output::layout::first_line;
use output::numbers::short;
use paper::mirror::Reading;
use problem::modelling::Variant;

/// Something that the paper says.
#[derive(Clone, Debug, Serialize)]
pub struct Claim {
    /// Its name: P1, P2, ...
    pub id: ClaimId,
    /// Where the words stand in the paper.
    pub place: &'static str,
    /// The paper's words.
    pub quote: &'static str,
    /// The same in English.
    pub translation: &'static str,
    /// What is judged, in this audit's words.
    pub judged: &'static str,
    /// The claim is true where this is so.
    pub condition: &'static str,
    /// The threshold of the condition, and where that comes from.
    pub threshold: &'static str,
    /// Whether the threshold, or a part of the wording, is this audit's and not the paper's.
    pub is_ours: bool,
    /// What the verdict rests on.
    pub basis: Basis,
    /// What the measured number is, with its unit.
    #[serde(rename = "of")]
    pub number: &'static str,
    /// The arguments of a command that prints the number in JSON; SCENE stands for the scene's name. None
    /// on random scenes, which a test draws.
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
    Refuted(FindingId),
    /// By a finding, on the finding's scene: if it is present, the claim has this verdict, with
    /// these words.
    Finding(FindingId, Verdict, &'static str),
    /// By an experiment on a scene.
    Scene(fn(&Case) -> Outcome<Evidence>),
    /// By an experiment on a scene, which more runs confirm.
    Confirmed(fn(&Case) -> Outcome<Evidence>, fn(&Case, Evidence) -> Evidence),
    /// By nothing, for this reason.
    Nothing(&'static str),
}

choices! {
    /// What a verdict rests on.
    Basis {
        /// The text of a listing: the verdict follows from its lines.
        Listing = "proved on the listing",
        /// Random scenes whose statuses are known: `golden/tables/statuses.md`.
        Random = "measured on random scenes",
        /// Runs of a scene.
        Runs = "measured on runs",
        /// Nothing: neither the paper nor a run can tell.
        Nothing = "not enough information",
    }
}

impl Basis {
    /// Whether a verdict may be another one where the paper is read otherwise.
    fn is_of_reading(self) -> bool {
        match self {
            Basis::Listing | Basis::Runs => true,
            Basis::Random | Basis::Nothing => false,
        }
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
        Nowhere = "cannot be checked",
    }
}

/// A verdict, the number that the claim names, and its condition or what else is to be said.
pub type Evidence = evidence::Evidence<Verdict>;

impl Evidence {
    /// Returns the verdict in words, with its condition.
    pub fn words(&self) -> String {
        match self.verdict {
            Verdict::TrueOnlyIf => {
                let least = self.figure(short);
                format!("true only for {} of {least} or more", self.detail)
            }
            Verdict::True | Verdict::False | Verdict::NotCheckable => self.verdict.to_string(),
        }
    }
}

/// A claim with its verdict on a scene and over the range.
#[derive(Clone, Debug, Serialize)]
pub struct JudgedClaim {
    /// The claim.
    #[serde(flatten)]
    pub claim: Claim,
    /// What the scene says of it.
    #[serde(flatten)]
    pub measured: Evidence,
    /// The arguments of a command that prints the number in JSON; none of what was measured on random scenes.
    pub command: Vec<String>,
    /// Where it stands there: a JSON pointer, or two of which it is the quotient; none where there is no
    /// number.
    pub at: Vec<String>,
    /// What the verdict rests on.
    pub scope: Scope,
    /// The verdicts over the range; empty where the scene has no part in the verdict.
    pub elsewhere: Vec<Elsewhere>,
}

/// A verdict at a place of the range.
#[derive(Clone, Debug, Serialize)]
pub struct Elsewhere {
    /// The parameter and its value.
    #[serde(flatten)]
    pub place: ParameterValue,
    /// What that scene says of the claim.
    #[serde(flatten)]
    pub measured: Evidence,
}

/// The verdicts where the paper is read otherwise.
#[derive(Clone, Debug, Serialize)]
pub struct UnderReading {
    /// The value of the reading, such as `R8 = m`, or the scene's own variant, such as `variant printed`.
    pub reading: String,
    /// The claims whose verdict may depend on it.
    pub claims: Vec<ClaimVerdict>,
}

/// A claim, and what a scene says of it.
#[derive(Clone, Debug, Serialize)]
pub struct ClaimVerdict {
    /// The claim's name.
    pub id: ClaimId,
    /// What the scene says of it.
    #[serde(flatten)]
    pub measured: Evidence,
}

/// Judges claims under each other value of a reading that `--reading` offers, and with each other variant
/// of the paper as the scene's own.
pub fn by_reading(claims: &[Claim], case: &Case) -> Vec<UnderReading> {
    case.prepare();
    let readings = others(case).into_iter().filter(|(row, _)| row.is_option());
    let readings = readings.map(|(row, (value, reading))| (row.label(value), case.under(reading)));
    let variants = Variant::OF_THE_PAPER.iter().filter(|v| **v != case.published_variant());
    let variants = variants.map(|v| (format!("variant {v}"), Ok(case.with_variant(*v))));
    let cases: Vec<(String, Result<Case, InputError>)> = readings.chain(variants).collect();
    let claims: Vec<&Claim> = claims.iter().filter(|claim| claim.basis.is_of_reading()).collect();
    // A case a job: see `Case::prepare`.
    let under = |(reading, case): (String, Result<Case, InputError>)| {
        let measure = |claim: &&Claim| match &case {
            Ok(case) => claim.measure(case),
            Err(why) => Evidence::new(Verdict::NotCheckable, None, why.to_string()),
        };
        let verdict = |claim: &&Claim| ClaimVerdict { id: claim.id, measured: measure(claim) };
        UnderReading { reading, claims: claims.iter().map(verdict).collect() }
    };
    cases.into_par_iter().map(under).collect()
}

/// Judges claims on a scene and at places of the range.
pub fn judge(claims: &[Claim], case: &Case, places: &Range) -> Vec<JudgedClaim> {
    std::iter::once(case).chain(places.iter().map(|(_, case)| &**case)).for_each(Case::prepare);
    claims.par_iter().map(|claim| claim.judge(case, places)).collect()
}

impl Claim {
    /// Returns the claim of a name.
    pub fn of(id: ClaimId) -> &'static Self {
        &CLAIMS[id as usize]
    }

    /// Measures the claim on a scene and on the inputs that mean the same. Where a run fails, the detail says
    /// so.
    pub fn measure(&self, case: &Case) -> Evidence {
        match self.measure {
            Measure::Refuted(id) => by_finding(id, Verdict::False, None, *case.reading()),
            Measure::Finding(id, verdict, words) => {
                by_finding(id, verdict, Some(words), *case.reading())
            }
            Measure::Scene(measure) => on_scene(case, measure),
            Measure::Confirmed(measure, confirmed) => confirmed(case, on_scene(case, measure)),
            Measure::Nothing(reason) => Evidence::new(Verdict::NotCheckable, None, reason),
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
        let command = self.command.iter().map(|word| word.replace("SCENE", &case.scene.word));
        let reading = case.reading().to_string();
        let reading = (!reading.is_empty() && self.basis.is_of_reading()).then_some(reading);
        let option = reading.into_iter().flat_map(|reading| ["--reading".to_string(), reading]);
        let variant = measured.variant.unwrap_or(Variant::ALL[0]);
        let place = Variant::ALL.iter().position(|other| *other == variant).unwrap_or_default();
        let at = if measured.number.is_some() { self.at } else { &[] };
        JudgedClaim {
            claim: self.clone(),
            command: command.chain(option).collect(),
            at: at.iter().map(|at| at.replace("VARIANT", &place.to_string())).collect(),
            measured,
            scope,
            elsewhere,
        }
    }
}

/// Measures on a scene, and on the inputs that mean the same; where these have no verdict in common there
/// is none.
fn on_scene(case: &Case, measure: fn(&Case) -> Outcome<Evidence>) -> Evidence {
    let measure = |case: &Case| {
        measure(case).unwrap_or_else(|why| {
            Evidence::new(Verdict::NotCheckable, None, first_line(&why.to_string()))
        })
    };
    let others: Vec<Evidence> = case.equivalents().iter().map(measure).collect();
    let own = measure(case);
    let numbers = || others.iter().chain([&own]).filter_map(|evidence| evidence.number);
    let range = numbers().reduce(f64::min).zip(numbers().reduce(f64::max));
    let is_common = others.iter().all(|other| other.verdict == own.verdict);
    let found = own.confirmed_by(&others);
    if !found.by_rounding {
        return found;
    }
    let verdict = if is_common { found.verdict } else { Verdict::NotCheckable };
    let detail = match verdict {
        Verdict::TrueOnlyIf => found.detail,
        Verdict::True | Verdict::False | Verdict::NotCheckable => BY_ROUNDING.into(),
    };
    Evidence { verdict, range: range.map(Into::into), detail, ..found }
}

/// Judges a claim by a finding on the finding's own scene under a reading; without words the finding's
/// title is the detail.
fn by_finding(id: FindingId, verdict: Verdict, words: Option<&str>, reading: Reading) -> Evidence {
    let finding = Finding::of(id);
    let case = match Case::new(finding.scene()).under(reading) {
        Ok(case) => case,
        Err(why) => return Evidence::new(Verdict::NotCheckable, None, why.to_string()),
    };
    let found = finding.measure(&case);
    match found.verdict {
        Presence::Present => Evidence::new(verdict, found.number, words.unwrap_or(finding.title)),
        Presence::NotTriggered | Presence::Contradicted => {
            let detail = format!("{id} does not show on its scene: {}", found.detail);
            Evidence::new(Verdict::NotCheckable, found.number, detail)
        }
    }
}
