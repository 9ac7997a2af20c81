//! The variants side by side.

use rayon::prelude::*;
use schemars::JsonSchema;
use serde::Serialize;

use super::case::Case;
use engine::contact::pulling;
use engine::estimates::Certainty;
use engine::{BodySummary, Cycle, Distance, Solution, distance, summaries};
use problem::model::NodeId;
use problem::modelling::Variant;

/// A variant and what came of its run.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct VariantRow {
    /// The variant.
    pub variant: Variant,
    /// Whether rounding decides who is in contact; nothing of a failure.
    pub certainty: Option<Certainty>,
    /// What came of it.
    #[serde(flatten)]
    pub end: End,
}

/// What came of the run of a variant.
#[derive(Clone, Debug, Serialize, JsonSchema)]
#[serde(untagged)]
pub enum End {
    /// It has a result.
    Result {
        /// Number of contact nodes with dy = 1, by iteration.
        in_contact: Vec<usize>,
        /// The contact nodes themselves at the last one.
        contact_set: Vec<NodeId>,
        /// The force that contact passes on at the end over the size of the whole load; 0 without a
        /// load.
        target_share: f64,
        /// Residual of eq. (1) at the end, total displacements, length.
        eq1_residual: f64,
        /// Where the last contact state came before.
        cycle: Option<Cycle>,
        /// The largest displacement and stress of each body.
        bodies: Vec<BodySummary>,
        /// How far this is from the equilibrium under the scene's own friction; nothing where there is
        /// none.
        distance: Option<Distance>,
        /// The largest friction coefficient that a node in contact would need not to slide.
        friction_needed: Option<f64>,
        /// The nodes in contact that the target pulls.
        pulling: Vec<NodeId>,
    },
    /// It has none.
    Failure {
        /// Why the run ended without a result.
        failure: String,
    },
}

/// Every variant on a scene, in the order of `Variant::ALL`.
pub fn side_by_side(case: &Case) -> Vec<VariantRow> {
    let row = |variant: &Variant| match case.certain(*variant) {
        Ok((solution, certainty)) => {
            let end = end(case, solution);
            VariantRow { variant: *variant, certainty: Some(*certainty), end }
        }
        Err(why) => {
            let end = End::Failure { failure: why.to_string() };
            VariantRow { variant: *variant, certainty: None, end }
        }
    };
    Variant::ALL.par_iter().map(row).collect()
}

fn end(case: &Case, solution: &Solution) -> End {
    let (model, last) = (&*solution.model, solution.last());
    let [fx, fy] = model.total_load();
    let load = fx.hypot(fy);
    let needed = solution.contact.iter().filter_map(|c| c.friction_needed);
    End::Result {
        in_contact: solution.steps.iter().map(|step| step.in_contact).collect(),
        contact_set: last.contact_set(model),
        target_share: if load == 0.0 { 0.0 } else { solution.target_force() / load },
        eq1_residual: last.contact_residual(),
        cycle: last.cycle.clone(),
        bodies: summaries(solution),
        distance: case.equilibrium().map(|other| distance(solution, other)),
        friction_needed: needed.reduce(f64::max),
        pulling: pulling(&solution.contact, solution.model.load.amax()),
    }
}
