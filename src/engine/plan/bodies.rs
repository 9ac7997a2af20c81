//! The bodies of a scene, and which of them nothing can move.

use serde::Serialize;

use crate::locking;
use base::choices;
use problem::model::{Body, Bounds, Model};
use problem::modelling::Variant;

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

/// A body of a planned run.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct BodyPlan {
    /// The body's name.
    pub name: String,
    /// The number of its nodes.
    pub nodes: usize,
    /// The number of its triangles.
    pub triangles: usize,
    /// The number of its free degrees of freedom.
    pub free: usize,
    /// Width and height, length.
    pub size: [f64; 2],
    /// Whether it has contact nodes or target edges.
    pub in_contact: bool,
    /// Why it does not move; nothing where it may.
    pub idle: Option<Idle>,
    /// That its linear triangles lock, and why; nothing where they do not.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub locking: Option<String>,
}

/// The bodies of a model as `variant` runs it.
pub fn plan(model: &Model, variant: Variant) -> Vec<BodyPlan> {
    let surfaces = model.surface_nodes();
    let is_touched = |body: &Body| body.nodes.iter().any(|node| surfaces.contains(node));
    model.bodies.iter().map(|body| of_body(model, variant, body, is_touched(body))).collect()
}

fn of_body(model: &Model, variant: Variant, body: &Body, in_contact: bool) -> BodyPlan {
    let dofs = body.nodes.iter().flat_map(|n| n.dofs());
    let mut loaded = dofs.filter(|dof| model.load[dof.index()] != 0.0);
    let holds = body.nodes.iter().flat_map(|node| model.holds.of(*node));
    let moves = loaded.any(|dof| !model.is_restrained(dof))
        || holds.clone().any(|hold| hold.displacement != 0.0);
    let free = 2 * body.nodes.len() - holds.count();
    let idle = match (free == 0, moves, in_contact) {
        (true, ..) => Some(Idle::Restrained),
        (_, true, _) => None,
        (_, _, false) => Some(Idle::NoLoadNoContact),
        (_, _, true) => (variant == Variant::Printed).then_some(Idle::NotCoupled),
    };
    BodyPlan {
        name: body.name.clone(),
        nodes: body.nodes.len(),
        triangles: body.triangles.len(),
        free,
        size: size(model, body),
        in_contact,
        idle,
        locking: body
            .triangles
            .iter()
            .find_map(|id| locking(model.plane, model.triangle(*id).material.nu)),
    }
}

/// Returns width and height of a body, length.
fn size(model: &Model, body: &Body) -> [f64; 2] {
    Bounds::around(body.nodes.iter().map(|node| &model.nodes[node.index()])).size()
}

/// Returns the largest nominal strain of the bodies: of each the loads on it, without their signs, over
/// the section that they act on and its smallest elastic modulus. None without a load.
pub fn nominal_strain(model: &Model) -> Option<f64> {
    let strain = |body: &Body| {
        let [width, height] = size(model, body);
        let moduli = body.triangles.iter().map(|id| model.triangle(*id).material.e);
        let modulus = moduli.fold(f64::INFINITY, f64::min);
        let along = |direction: usize, section: f64| {
            let loads =
                body.nodes.iter().map(|node| model.load[node.dofs()[direction].index()].abs());
            loads.sum::<f64>() / (section * model.thickness * modulus)
        };
        along(0, height).max(along(1, width))
    };
    let strains = model.bodies.iter().map(strain).filter(|strain| strain.is_finite());
    strains.reduce(f64::max).filter(|strain| *strain > 0.0)
}
