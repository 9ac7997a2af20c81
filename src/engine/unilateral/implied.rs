//! What displacements from elsewhere imply on the mesh of a solution: stresses, gaps, contact forces,
//! reactions.

use nalgebra::DVector;

use crate::contact::{NodeEnd, Sense, Status, Surfaces, contact_forces, load_of};
use crate::reactions::{reactions, support_force, transmitted_force};
use crate::solution::{APART, Solution, max_displacement};
use crate::stiffness::Stiffness;
use base::error::Result;
use problem::model::NodeId;
use problem::modelling::{Coupling, Variant};

/// What displacements imply.
pub struct Implied {
    /// The solution with these displacements in place of its own, and all that follows from them.
    pub solution: Solution,
    /// The node inside the bodies with the largest force that nothing balances, and that force over the
    /// largest of a node's forces by its triangles; None where nothing is deformed.
    pub unbalanced: Option<(NodeId, f64)>,
}

/// Returns what displacements `u`, length, imply where `reference` measures contact: in the undeformed
/// shape, or in that to which they lead. A node is in contact where its gap is no more than rounding.
///
/// # Errors
/// The contact surfaces bound no body.
pub fn implied(reference: &Solution, u: DVector<f64>) -> Result<Implied> {
    let (request, model) = (&reference.request, &*reference.model);
    let stiffness = Stiffness::new(model, |x| x);
    let inner = stiffness.times(&u);
    let force = &inner - &model.load;
    let shape = model.shape(&u);
    let (coupling, is_current) = match request.variant {
        Variant::Unilateral => (request.contact.coupling, request.contact.geometry.is_current()),
        Variant::Printed | Variant::Tied | Variant::Stepped => (Coupling::Nts, true),
    };
    let measured_in = if is_current { &shape } else { &model.nodes };
    let surfaces = Surfaces::new(model)?;
    let pairings = surfaces.pairings(coupling, measured_in);
    // Where a restraint takes a part of a node's force, the rest is that along its normal.
    let statuses: Vec<Status> = pairings
        .iter()
        .map(|pairing| match pairing {
            None => Status::Open,
            Some(p) if model.restraints_of(p.node) == [false, false] => Status::Stick,
            Some(_) => Status::Slip(Sense::Free),
        })
        .collect();
    let forces = contact_forces(model, &pairings, &statuses, &force);
    let closed = APART * max_displacement(&u);
    let contact = surfaces.nodes_at_end((model, &u), (measured_in, &pairings), |i, pairing| {
        let gap = pairing.gap_after(model, &u);
        NodeEnd { gap, in_contact: gap <= closed, status: None, force: forces[i].known() }
    });
    let rest = force - load_of(&pairings, &forces, u.len());
    let unbalanced = unbalanced(reference, &inner, &rest);
    let held = support_force(model, &rest, &model.load);
    let mut steps = reference.steps.clone();
    let last = steps.last_mut().expect("a run has a step");
    (last.target_force, last.max_displacement) =
        (transmitted_force(model, held), max_displacement(&u));
    let states = stiffness.states(&u);
    let reactions = reactions(model, rest);
    let solution = Solution { steps, contact, reactions, ..reference.with_fields(u, states) };
    Ok(Implied { solution, unbalanced })
}

/// Returns the node, neither held nor of a contact surface, on which what is left of the forces is largest,
/// and that over the largest of `inner`, the forces by which triangles keep their shape; None where there are
/// none.
fn unbalanced(
    reference: &Solution,
    inner: &DVector<f64>,
    rest: &DVector<f64>,
) -> Option<(NodeId, f64)> {
    let model = &reference.model;
    let size = |of: &DVector<f64>, node: NodeId| {
        let [x, y] = node.components(of);
        x.hypot(y)
    };
    let largest = model.node_ids().map(|node| size(inner, node)).fold(0.0, f64::max);
    let surface = model.surface_nodes();
    let free = model.node_ids().filter(|n| model.holds.of(*n).is_empty() && !surface.contains(n));
    let worst = free.max_by(|a, b| size(rest, *a).total_cmp(&size(rest, *b)))?;
    (largest > 0.0).then(|| (worst, size(rest, worst) / largest))
}
