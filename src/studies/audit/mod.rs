//! The audit: what the ambiguities and the findings of the print do on a scene.

mod case;
pub mod findings;
pub mod readings;
pub mod statuses;
pub mod trace;
pub mod variants;

use rayon::prelude::*;
use serde::Serialize;

pub use case::Case;

use crate::answer::contact::ContactNode;
use crate::answer::{BodySummary, summaries};
use crate::problem::modelling::{ContactModel, Friction};
use findings::{FINDINGS, Finding, Measured};
use readings::Effect;
use variants::VariantRow;

pub struct Audit {
    /// What each other reading changes, in the order of `listings/READING.md`, section 4.
    pub readings: Vec<Effect>,
    /// What the scene shows of each finding, in the order of the register.
    pub findings: Vec<(&'static Finding, Measured)>,
    /// The end of each variant, in the order of `Variant::ALL`.
    pub variants: Vec<VariantRow>,
    /// What the variants are measured against; nothing without contact, and where the reference
    /// solution does not run.
    pub reference: Option<ReferenceSummary>,
    /// The contact nodes of the reference solution that are in contact, where they stick: what
    /// friction that takes. Empty where they slide, and where there is no reference solution.
    pub sticking: Vec<ContactNode>,
}

#[derive(Clone, Debug, Serialize)]
pub struct ReferenceSummary {
    pub model: ContactModel,
    pub in_contact: usize,
    /// The largest displacement and stress of each body.
    pub bodies: Vec<BodySummary>,
}

/// Audits a scene: readings, findings and variants, each against the default.
pub fn audit(case: &Case) -> Audit {
    let variants = variants::side_by_side(case);
    let readings = readings::effects(case);
    let findings = FINDINGS.par_iter().map(|finding| (finding, finding.measure(case))).collect();
    let reference = case.reference();
    let sticks = case.scene.contact.friction != Friction::None;
    let sticking = reference.iter().filter(|_| sticks).flat_map(|solution| solution.in_contact());
    Audit {
        readings,
        findings,
        variants,
        reference: reference.map(|solution| ReferenceSummary {
            model: solution.request.contact,
            in_contact: solution.in_contact().count(),
            bodies: summaries(solution),
        }),
        sticking: sticking.cloned().collect(),
    }
}
