//! The bodies of a scene, and which of them nothing can move.

use schemars::JsonSchema;
use serde::Serialize;

use crate::choices;
use crate::problem::model::{Body, Dof, Model};
use crate::problem::modelling::Variant;

choices! {
    /// Why nothing moves a body: its displacements are exactly 0.
    Idle {
        /// No load acts on a free equation of it, and no contact surface lies on it.
        NoLoadNoContact = "no load, no contact",
        /// No load acts on a free equation of it, and `Km` as printed passes none between bodies
        /// (finding K1).
        NotCoupled = "no load, and Km as printed couples no bodies (K1)",
        /// All its equations are restrained, so that nothing can.
        Restrained = "all its equations are restrained",
    }
}

#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct BodyPlan {
    pub name: String,
    pub nodes: usize,
    pub triangles: usize,
    pub free: usize,
    pub in_contact: bool,
    /// Why it does not move; nothing where it may.
    pub idle: Option<Idle>,
}

/// The bodies of a model as `variant` runs it.
pub fn plan(model: &Model, variant: Variant) -> Vec<BodyPlan> {
    model.bodies.iter().map(|body| of_body(model, variant, body)).collect()
}

fn of_body(model: &Model, variant: Variant, body: &Body) -> BodyPlan {
    let dofs = body.nodes.iter().flat_map(|n| n.dofs());
    let free: Vec<Dof> = dofs.filter(|dof| !model.is_restrained(*dof)).collect();
    let loaded = free.iter().any(|dof| model.load[dof.index()] != 0.0);
    let in_contact = touched(model, body);
    let idle = match (free.is_empty(), loaded, in_contact) {
        (true, ..) => Some(Idle::Restrained),
        (_, true, _) => None,
        (_, _, false) => Some(Idle::NoLoadNoContact),
        (_, _, true) => (variant == Variant::Printed).then_some(Idle::NotCoupled),
    };
    BodyPlan {
        name: body.name.clone(),
        nodes: body.nodes.len(),
        triangles: body.triangles.len(),
        free: free.len(),
        in_contact,
        idle,
    }
}

/// Whether an entry of the contact surface or an end of a target edge lies on it.
fn touched(model: &Model, body: &Body) -> bool {
    let ends = model.target_edges().flat_map(|edge| edge.nodes);
    model.contact.nodes.iter().copied().chain(ends).any(|n| body.has(n))
}
