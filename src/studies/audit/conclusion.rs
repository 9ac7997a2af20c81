//! The conclusion of an audit: five questions about the printed algorithm on a scene, and the facts
//! that answer them. The sentences are made of these in the report.

use serde::Serialize;

use super::claims::{JudgedClaim, Verdict as ClaimVerdict};
use super::findings::{Evidence, Finding, Verdict};
use super::variants::{End, VariantRow};
use super::{Assumption, Audit, Case};
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
    /// The run of the paper's algorithm that comes nearest to the equilibrium; nothing where there is no
    /// equilibrium, or no run ended.
    pub nearest: Option<Nearest>,
    /// The fields of figure 5; nothing where there is no equilibrium.
    pub fields: Option<Fields>,
    /// The findings that are present here, and that no fault puts back into the corrected algorithm, so that
    /// they have no price.
    pub unpriced: Vec<&'static str>,
    /// What the paper leaves open.
    pub open: Vec<&'static str>,
    /// How far that moves the verdicts; nothing where it was not tried.
    pub range: Option<Spread>,
}

/// Whether Km joins the bodies, and what passes between them.
#[derive(Clone, Debug, Serialize)]
pub struct Coupled {
    /// Entries of MJS that join two bodies; nothing where no node comes in contact.
    pub joins: Option<usize>,
    /// The force that contact passes on at the end of `printed` over the load; nothing where it stops.
    pub share: Option<f64>,
    /// Why `printed` stops.
    pub failure: Option<String>,
}

/// A run under a reading, and its distance from the equilibrium.
#[derive(Clone, Debug, Serialize)]
pub struct Nearest {
    /// The variant that was run.
    pub variant: Variant,
    /// The value of a reading that is not the default; nothing where all are.
    pub reading: Option<String>,
    /// Where the distance stands in the audit's JSON.
    pub at: String,
    /// The distance from the equilibrium in the energy norm, relative.
    pub energy: f64,
    /// The runs that were tried: every variant, and every other reading that has a run of its own.
    pub runs: usize,
    /// Of those, the ones that ended without a result.
    pub failed: usize,
}

/// The largest von Mises stress and strain of each body, under the nearest variant and in equilibrium.
#[derive(Clone, Debug, Serialize)]
pub struct Fields {
    /// The nearest of the paper's variants; nothing where none ran.
    pub variant: Option<Variant>,
    /// The largest relative difference of a body's largest von Mises stress or strain between the two.
    pub difference: Option<f64>,
    /// The bodies under that variant.
    pub theirs: Vec<BodySummary>,
    /// The bodies in equilibrium.
    pub own: Vec<BodySummary>,
    /// How far the numbers of the equilibrium may be from the truth.
    pub errors: ErrorEstimates,
}

/// The error of the paper's algorithm over the range of what the paper leaves open.
#[derive(Clone, Debug, Serialize)]
pub struct Spread {
    /// The places of the range.
    pub places: usize,
    /// The least and the largest number of claim P12.
    pub error: [f64; 2],
    /// The claims whose verdict is another one somewhere in the range.
    pub changes: Vec<&'static str>,
}

impl Conclusion {
    /// Draws the conclusion of what was found on a case.
    pub fn new(case: &Case, audit: &Audit) -> Self {
        let variant = NearestVariant::find(&audit.variants);
        Conclusion {
            reading: *case.reading(),
            coupled: case.model().target().map(|_| coupled(audit)),
            nearest: variant.as_ref().map(|variant| nearest(audit, variant)),
            fields: fields(case, variant.as_ref()),
            unpriced: unpriced(&audit.findings),
            open: audit.assumptions.iter().map(|Assumption { what, .. }| *what).collect(),
            range: spread(&audit.claims),
        }
    }
}

fn coupled(audit: &Audit) -> Coupled {
    let k1 = audit.findings.iter().find(|(finding, _)| finding.id == "K1");
    let joins = k1.filter(|(_, measured)| measured.verdict != Verdict::NotTriggered);
    let printed = audit.variants.iter().find(|row| row.variant == Variant::Printed);
    let (share, failure) = match printed.map(|row| &row.end) {
        Some(End::Result { target_share, .. }) => (Some(*target_share), None),
        Some(End::Failure { failure }) => (None, Some(failure.clone())),
        None => (None, None),
    };
    Coupled { joins: joins.map(|(_, measured)| measured.number as usize), share, failure }
}

/// The variant of the paper that is nearest to the equilibrium.
struct NearestVariant<'a> {
    variant: Variant,
    /// The index of its row.
    row: usize,
    energy: f64,
    bodies: &'a [BodySummary],
}

impl<'a> NearestVariant<'a> {
    fn find(rows: &'a [VariantRow]) -> Option<Self> {
        let of_paper =
            |(_, row): &(usize, &VariantRow)| Variant::OF_THE_PAPER.contains(&row.variant);
        let ended = rows.iter().enumerate().filter(of_paper).filter_map(
            |(row, VariantRow { variant, end, .. })| match end {
                End::Result { distance, bodies, .. } => {
                    let energy = distance.as_ref()?.energy_relative;
                    Some(NearestVariant { variant: *variant, row, energy, bodies })
                }
                End::Failure { .. } => None,
            },
        );
        ended.filter(|one| one.energy.is_finite()).min_by(|a, b| a.energy.total_cmp(&b.energy))
    }
}

/// Finds the nearest of all variants and readings.
fn nearest(audit: &Audit, nearest: &NearestVariant) -> Nearest {
    let variants = audit.variants.iter().filter(|r| Variant::OF_THE_PAPER.contains(&r.variant));
    let failed_variants =
        variants.clone().filter(|row| matches!(row.end, End::Failure { .. })).count();
    let readings = audit.readings.iter().enumerate().filter(|(_, e)| e.variant.is_some());
    let failed = failed_variants + readings.clone().filter(|(_, e)| e.failure.is_some()).count();
    let runs = variants.count() + readings.clone().count();
    let default = Nearest {
        variant: nearest.variant,
        reading: None,
        at: format!("/variants/{}/distance/energy_relative", nearest.row),
        energy: nearest.energy,
        runs,
        failed,
    };
    let others = readings.filter_map(|(k, effect)| {
        Some(Nearest {
            variant: effect.variant?,
            reading: Some(effect.reading.clone()),
            at: format!("/readings/{k}/equilibrium_error"),
            energy: effect.equilibrium_error?,
            runs,
            failed,
        })
    });
    // Of those that are equally near the default reading.
    others.fold(default, |best, other| if other.energy < best.energy { other } else { best })
}

fn fields(case: &Case, nearest: Option<&NearestVariant>) -> Option<Fields> {
    let equilibrium = case.equilibrium()?;
    let own = summaries(equilibrium);
    let theirs = nearest.map_or(&[][..], |nearest| nearest.bodies);
    let differences = theirs.iter().zip(&own).flat_map(|(theirs, own)| {
        [
            over(theirs.max_von_mises_stress - own.max_von_mises_stress, own.max_von_mises_stress),
            over(theirs.max_von_mises_strain - own.max_von_mises_strain, own.max_von_mises_strain),
        ]
    });
    Some(Fields {
        variant: nearest.map(|nearest| nearest.variant),
        difference: differences.map(f64::abs).filter(|x| x.is_finite()).reduce(f64::max),
        theirs: theirs.to_vec(),
        errors: Estimates::new(equilibrium).errors,
        own,
    })
}

/// Returns the findings that are present, and that no fault puts back into the corrected algorithm.
fn unpriced(findings: &[(&'static Finding, Evidence)]) -> Vec<&'static str> {
    let is_priced = |id| FAULTS.iter().any(|fault| fault.is_of(id));
    let present = findings.iter().filter(|(_, measured)| measured.verdict == Verdict::Present);
    present.map(|(finding, _)| finding.id).filter(|id| !is_priced(*id)).collect()
}

/// Returns how far the range moves the verdicts; nothing where it was not tried.
fn spread(claims: &[JudgedClaim]) -> Option<Spread> {
    let tried = || claims.iter().filter(|judged| !judged.elsewhere.is_empty());
    let p12 = tried().find(|judged| judged.claim.id == "P12")?;
    let numbers = || p12.elsewhere.iter().filter_map(|other| other.measured.number);
    let verdicts = |judged: &&JudgedClaim| {
        let verdicts = judged.elsewhere.iter().map(|other| other.measured.verdict);
        let first: Option<ClaimVerdict> = verdicts.clone().next();
        verdicts.into_iter().any(|verdict| Some(verdict) != first)
    };
    Some(Spread {
        places: p12.elsewhere.len(),
        error: [numbers().reduce(f64::min)?, numbers().reduce(f64::max)?],
        changes: tried().filter(verdicts).map(|judged| judged.claim.id).collect(),
    })
}
