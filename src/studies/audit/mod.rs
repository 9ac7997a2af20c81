//! The audit: what the ambiguities and the findings of the print do on a scene.

mod case;
pub mod findings;
pub mod readings;
pub mod statuses;
pub mod trace;
pub mod variants;

pub use case::Case;

use crate::answer::contact::ContactNode;
use crate::answer::{BodySummary, summaries};
use crate::problem::modelling::{ContactModel, Friction};
use rayon::prelude::*;
use serde::Serialize;

use findings::{FINDINGS, Finding, Measured};
use readings::Effect;
use variants::VariantRow;

/// All that an audit finds.
pub struct Audit {
    /// A row a reading.
    pub readings: Vec<Effect>,
    /// A row a finding.
    pub findings: Vec<(&'static Finding, Measured)>,
    /// A row a variant.
    pub variants: Vec<VariantRow>,
    /// What the variants are measured against: the bodies of the converged answer; nothing without contact, and where there is none.
    pub converged: Option<Converged>,
    /// The contact nodes of the converged answer that are in contact, where they stick: what friction that takes. Empty where they slide, without
    /// contact, and where there is no converged answer.
    pub sticking: Vec<ContactNode>,
}

/// Audits a scene.
pub fn audit(case: &Case) -> Audit {
    let variants = variants::side_by_side(case);
    let readings = readings::effects(case);
    let findings = FINDINGS.par_iter().map(|finding| (finding, finding.measure(case))).collect();
    let converged = converged(case);
    Audit { readings, findings, variants, converged, sticking: sticking(case) }
}

/// The converged answer in short.
#[derive(Clone, Debug, Serialize)]
pub struct Converged {
    /// How contact was modelled.
    pub model: ContactModel,
    /// Its contact nodes in contact.
    pub in_contact: usize,
    /// Its bodies.
    pub bodies: Vec<BodySummary>,
}

fn converged(case: &Case) -> Option<Converged> {
    case.model().target()?;
    let reference = case.reference().as_ref().ok()?;
    Some(Converged {
        model: reference.request.contact,
        in_contact: reference.in_contact().count(),
        bodies: summaries(reference),
    })
}

fn sticking(case: &Case) -> Vec<ContactNode> {
    match case.reference() {
        Ok(reference)
            if case.model().target().is_some() && case.scene.contact.friction != Friction::None =>
        {
            reference.in_contact().cloned().collect()
        }
        _ => Vec::new(),
    }
}

/// A finding's row for machines.
#[derive(Serialize)]
pub struct FindingRow<'a> {
    /// `C4`.
    pub id: &'a str,
    /// The listing.
    pub listing: &'a str,
    /// Its lines.
    pub lines: &'a [usize],
    /// What the listing does that the text does not say.
    pub title: &'a str,
    /// On this scene: holds, does not arise, contradicted.
    pub verdict: String,
    /// The number.
    pub number: f64,
    /// What the number is.
    pub of: &'a str,
    /// The values.
    pub detail: &'a str,
}

impl<'a> FindingRow<'a> {
    /// The row of a finding and what was measured.
    pub fn new(finding: &'a Finding, measured: &'a Measured) -> Self {
        FindingRow {
            id: finding.id,
            listing: finding.listing,
            lines: finding.lines,
            title: finding.title,
            verdict: measured.verdict.name().to_string(),
            number: measured.number,
            of: finding.number,
            detail: &measured.detail,
        }
    }
}
