//! The variants side by side.

use rayon::prelude::*;
use serde::Serialize;

use super::case::Case;
use crate::answer::contact::{BodySummary, Cycle, Distance, Outcome, distance, summaries};
use crate::problem::modelling::Variant;

/// What a variant comes to on a scene.
#[derive(Clone, Debug, Serialize)]
pub struct VariantRow {
    /// The variant.
    pub variant: Variant,
    /// What came of it.
    #[serde(flatten)]
    pub end: End,
}

/// The end of a run.
#[derive(Clone, Debug, Serialize)]
#[serde(untagged)]
pub enum End {
    /// A result.
    Result {
        /// Contact nodes with dy = 1 at each iteration.
        in_contact: Vec<usize>,
        /// The contact nodes themselves at the last one.
        contact_set: Vec<usize>,
        /// Force that reaches the target at the end, against the load applied.
        target_share: f64,
        /// Residual of eq. (1) at the end, total displacements, length.
        eq1_residual: f64,
        /// Where the last contact state was met before.
        cycle: Option<Cycle>,
        /// The bodies.
        bodies: Vec<BodySummary>,
        /// How far this is from the converged answer; none without contact, and where there is none.
        distance: Option<Distance>,
        /// The largest friction coefficient that a node in contact would need not to slide.
        friction_needed: Option<f64>,
        /// Contact nodes in contact that pull.
        pulling: Vec<usize>,
    },
    /// The published algorithm fails.
    Failure {
        /// Why.
        failure: String,
    },
}

/// Every variant on a scene.
pub fn side_by_side(case: &Case) -> Vec<VariantRow> {
    let row = |variant: &Variant| {
        let end = match case.run(*variant) {
            Ok(outcome) => end(case, outcome),
            Err(why) => End::Failure { failure: why.to_string() },
        };
        VariantRow { variant: *variant, end }
    };
    Variant::ALL.par_iter().map(row).collect()
}

fn end(case: &Case, outcome: &Outcome) -> End {
    let last = outcome.iterations.last().expect("a run has an iteration");
    let [fx, fy] = case.scene.total_load();
    let load = fx.hypot(fy);
    let cnt = &outcome.sheet.cnt;
    let pulling = outcome.contact.iter().filter(|c| c.dy == 1 && c.force < 0.0);
    End::Result {
        in_contact: outcome.iterations.iter().map(|it| it.in_contact).collect(),
        contact_set: (1..=cnt.rows()).filter(|&i| last.pairs.dy[i] == 1).map(|i| cnt[i]).collect(),
        target_share: if load == 0.0 { 0.0 } else { last.target_force / load },
        eq1_residual: last.eq1_residual,
        cycle: last.cycle.clone(),
        bodies: summaries(&case.scene, outcome),
        distance: case
            .scene
            .target()
            .and_then(|_| case.converged().as_ref().ok())
            .map(|converged| distance(&case.scene, outcome, converged)),
        friction_needed: outcome.contact.iter().filter_map(|c| c.friction_needed).reduce(f64::max),
        pulling: pulling.map(|c| c.node).collect(),
    }
}
