//! The variants side by side.

use rayon::prelude::*;
use serde::Serialize;

use super::case::Case;
use engine::contact::pulling;
use engine::estimates::Certainty;
use engine::{BodySummary, Cycle, Distance, Solution, distance, max_displacement, over, summaries};
use problem::model::NodeId;
use problem::modelling::Variant;

/// A variant and what came of its run.
#[derive(Clone, Debug, Serialize)]
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
#[derive(Clone, Debug, Serialize)]
#[serde(untagged)]
#[expect(clippy::large_enum_variant, reason = "there is one for each of four variants")]
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
        /// Whether contact passes no load on at the end, beyond rounding, though there is a load.
        transmits_nothing: bool,
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
        /// The deepest contact node at the end; nothing where none faces the target.
        penetration: Option<Penetration>,
    },
    /// It has none.
    Failure {
        /// Why the run ended without a result.
        failure: String,
    },
}

/// How deep the deepest contact node is inside the target at the end of a run.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Penetration {
    /// The node.
    pub node: NodeId,
    /// Whether it is in contact.
    pub in_contact: bool,
    /// Length; 0 where none is inside by more than rounding.
    pub depth: f64,
    /// The depth over the largest displacement of the target.
    pub relative: f64,
}

impl Penetration {
    /// Depths over the largest displacement that are rounding.
    const ROUNDING: f64 = 1e-9;

    /// Finds the deepest contact node; nothing where none faces the target.
    pub fn of(solution: &Solution) -> Option<Self> {
        let deepest = solution.contact.iter().min_by(|a, b| a.gap.total_cmp(&b.gap))?;
        let target = &solution.model.target()?.name;
        let target = summaries(solution).into_iter().find(|body| body.name == *target)?;
        let is_rounding = -deepest.gap <= Self::ROUNDING * max_displacement(&solution.u);
        let depth = if is_rounding { 0.0 } else { -deepest.gap };
        let relative = over(depth, target.max_displacement);
        let (node, in_contact) = (deepest.node, deepest.in_contact);
        Some(Penetration { node, in_contact, depth, relative })
    }
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
        transmits_nothing: solution.transmits_nothing(),
        eq1_residual: last.contact_residual(),
        cycle: last.cycle.clone(),
        bodies: summaries(solution),
        distance: case.equilibrium().map(|other| distance(solution, other)),
        friction_needed: needed.reduce(f64::max),
        pulling: pulling(&solution.contact, solution.model.load.amax()),
        penetration: Penetration::of(solution),
    }
}
