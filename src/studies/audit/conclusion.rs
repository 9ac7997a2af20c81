//! What follows from the results of an audit: whether the print couples the bodies, which run comes nearest, and
//! how far its fields are off.

use std::collections::BTreeSet;
use std::fmt::{self, Display, Formatter};

use serde::Serialize;

use super::Case;
use super::claims::nearest as least;
use super::evidence::{NoFigures, beyond_noise};
use super::findings::{Evidence, Finding, FindingId, Presence};
use super::readings::Effect;
use super::variants::VariantRow;
use engine::estimates::{ErrorEstimates, Estimates};
use engine::{BodySummary, over, summaries};
use paper::corrected::FAULTS;
use paper::mirror::Reading;
use problem::modelling::Variant;

/// What an audit concludes.
#[derive(Clone, Debug, Serialize)]
pub struct Conclusion {
    /// The reading under which the scene was audited.
    pub reading: Reading,
    /// Whether the printed algorithm couples the bodies.
    pub coupled: Option<Coupled>,
    /// The runs of the paper's algorithm that come nearest to the equilibrium; nothing where there is no
    /// equilibrium, or no run ended.
    pub nearest: Option<Nearest>,
    /// The fields of figure 5; nothing where there is no equilibrium.
    pub fields: Option<Fields>,
    /// The findings that are present here, and that no fault puts back into the corrected algorithm, so that
    /// they have no price: listings/corrected/README.md says what repairs each.
    pub unpriced: Vec<FindingId>,
}

/// Whether Km joins the bodies, and what passes between them.
#[derive(Clone, Debug, Serialize)]
pub struct Coupled {
    /// Entries of MJS that join two bodies; nothing where no node comes in contact.
    pub joins: Option<usize>,
    /// The force that contact passes on at the end of `printed` over the load; nothing where it stops.
    pub share: Option<f64>,
    /// Why `printed` has no such force.
    pub failure: Option<NoFigures>,
}

/// The runs of the paper's algorithm, and those of them that are nearest to the equilibrium.
#[derive(Clone, Debug, Serialize)]
pub struct Nearest {
    /// The nearest run, and those that are equally near.
    pub runs: Vec<NearRun>,
    /// The runs that differ: of the variants, and of the other readings that have a run of their own.
    pub tried: usize,
    /// Of those, the ones that ended without a result.
    pub failed: usize,
    /// Of those, the ones on whose results rounding decides.
    pub by_rounding: usize,
    /// The runs of another plane problem (R6), each against that problem's own equilibrium.
    pub apart: Vec<NearRun>,
}

/// A run under a reading, and its distance from the equilibrium.
#[derive(Clone, Debug, Serialize)]
pub struct NearRun {
    /// The variant that was run.
    pub variant: Variant,
    /// The value of a reading that is not the default; nothing where all are.
    pub reading: Option<String>,
    /// The distance from the equilibrium in the energy norm, relative.
    pub energy: f64,
    /// Whether its contact state alternates, so that the distance is that of one of several states.
    pub unsettled: bool,
}

/// Says what a run is, then names it, with its reading where that is not the default.
impl Display for NearRun {
    fn fmt(&self, out: &mut Formatter<'_>) -> fmt::Result {
        let NearRun { variant, reading, unsettled, .. } = self;
        let what = match variant {
            Variant::Stepped => "eq. (1) in load steps",
            Variant::Tied => "eq. (1) under the whole load",
            Variant::Printed => "Km as printed",
            Variant::Unilateral => "the contact solution",
        };
        let reading = reading.as_ref().map_or(String::new(), |reading| format!(", {reading}"));
        let unsettled = if *unsettled { ", does not settle" } else { "" };
        write!(out, "{what} ({variant}{reading}{unsettled})")
    }
}

/// How far the fields of the nearest variant are from those of the equilibrium.
#[derive(Clone, Debug, Serialize)]
pub struct Fields {
    /// The nearest of the paper's variants, and those that are equally near; none where none ran.
    pub variants: Vec<Variant>,
    /// The largest relative difference of a body's largest von Mises stress or strain between the two.
    pub difference: Option<f64>,
    /// How far the numbers of the equilibrium may be from the truth.
    pub errors: ErrorEstimates,
}

impl Conclusion {
    /// Draws the conclusion of what was found on a case.
    pub fn new(
        case: &Case,
        readings: &[Effect],
        findings: &[(&'static Finding, Evidence)],
        variants: &[VariantRow],
    ) -> Self {
        Conclusion {
            reading: *case.reading(),
            coupled: case.model().target().map(|_| coupled(findings, variants)),
            nearest: nearest(variants, readings, case.reading()),
            fields: fields(case, variants),
            unpriced: unpriced(findings),
        }
    }
}

fn coupled(findings: &[(&'static Finding, Evidence)], variants: &[VariantRow]) -> Coupled {
    let k1 = findings.iter().find(|(finding, _)| finding.id == FindingId::K1);
    let joins = k1.filter(|(_, measured)| measured.verdict != Presence::NotTriggered);
    let printed = variants.iter().find(|row| row.variant == Variant::Printed);
    let (share, failure) = match printed.map(|row| &row.outcome) {
        Some(Ok(run)) => (run.target_share, None),
        Some(Err(why)) => (None, Some(why.clone())),
        None => (None, None),
    };
    let joins = joins.and_then(|(_, measured)| measured.number);
    Coupled { joins: joins.map(|joins| joins as usize), share, failure }
}

/// Returns the rows of the paper's variants.
pub(super) fn of_the_paper(rows: &[VariantRow]) -> impl Iterator<Item = &VariantRow> {
    rows.iter().filter(|row| Variant::OF_THE_PAPER.contains(&row.variant))
}

/// Finds the nearest of all variants and readings; runs that end alike count once.
fn nearest(variants: &[VariantRow], readings: &[Effect], base: &Reading) -> Option<Nearest> {
    let mut failures: Vec<&NoFigures> = Vec::new();
    let mut found: Vec<NearRun> = Vec::new();
    for VariantRow { variant, outcome } in of_the_paper(variants) {
        match outcome {
            Err(why) => failures.push(why),
            Ok(run) => found.push(NearRun {
                variant: *variant,
                reading: None,
                energy: run.distance.as_ref()?.energy_relative,
                unsettled: run.is_unsettled(),
            }),
        }
    }
    let mut apart = Vec::new();
    for effect in readings {
        let Some(variant) = effect.variant else { continue };
        // The other load in each iteration makes `tied` of `stepped`, and the reverse.
        if effect.id == "R7" && base.r7.is_none() && variant != Variant::Printed {
            continue;
        }
        failures.extend(&effect.failure);
        let Some(energy) = effect.equilibrium_error else { continue };
        let run = NearRun {
            variant,
            reading: Some(effect.reading.clone()),
            energy,
            unsettled: effect.unsettled,
        };
        match effect.apart {
            true => apart.push(run),
            false if found.iter().all(|other| other.energy != energy) => found.push(run),
            false => (),
        }
    }
    let distances: Vec<(f64, &NearRun)> = found.iter().map(|run| (run.energy, run)).collect();
    let least = least(&distances)?;
    let by_rounding = failures.iter().filter(|why| ***why == NoFigures::Rounding).count();
    let stopped: BTreeSet<&str> = failures
        .iter()
        .filter_map(|why| match why {
            NoFigures::Fails(why) => Some(why.as_str()),
            NoFigures::Refused(_) | NoFigures::Rounding => None,
        })
        .collect();
    let ended: BTreeSet<u64> = found.iter().map(|run| run.energy.to_bits()).collect();
    Some(Nearest {
        tried: ended.len() + apart.len() + stopped.len() + by_rounding,
        failed: stopped.len(),
        by_rounding,
        runs: least.into_iter().map(|k| found[k].clone()).collect(),
        apart,
    })
}

/// Compares the fields of the nearest variants with those of the equilibrium.
fn fields(case: &Case, rows: &[VariantRow]) -> Option<Fields> {
    let equilibrium = case.equilibrium()?;
    let own = summaries(equilibrium);
    let ended = of_the_paper(rows).filter_map(|row| {
        let run = row.outcome.as_ref().ok()?;
        Some((run.distance.as_ref()?.energy_relative, (row.variant, &run.bodies)))
    });
    let ended: Vec<(f64, (Variant, &Vec<BodySummary>))> = ended.collect();
    let nearest = least(&ended).unwrap_or_default();
    let theirs = nearest.first().map_or(&[][..], |k| ended[*k].1.1);
    let largest = |body: &BodySummary| [body.max_von_mises_stress, body.max_von_mises_strain];
    let pairs = theirs.iter().zip(&own);
    let pairs = pairs.flat_map(|(theirs, own)| largest(theirs).into_iter().zip(largest(own)));
    let differences = pairs.map(|(theirs, own)| beyond_noise(over(theirs - own, own).abs()));
    Some(Fields {
        variants: nearest.iter().map(|k| ended[*k].1.0).collect(),
        difference: differences.filter(|x| x.is_finite()).reduce(f64::max),
        errors: Estimates::new(equilibrium).errors,
    })
}

/// Returns the findings that are present, and that no fault puts back into the corrected algorithm.
fn unpriced(findings: &[(&'static Finding, Evidence)]) -> Vec<FindingId> {
    let is_priced = |id| FAULTS.iter().any(|fault| fault.is_of(id));
    let present = findings.iter().filter(|(_, measured)| measured.verdict == Presence::Present);
    present.map(|(finding, _)| finding.id).filter(|id| !is_priced(*id)).collect()
}
