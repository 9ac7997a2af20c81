//! The contact forces of an iteration, from what is left of the equations of equilibrium.
//!
//! ```text
//!   K u − F − friction = Σ p_i n_i·(e_c − Σ w e_t) + Σ q_i t_i·(e_c − Σ w e_t) + restraints
//! ```
//!
//! The equations of a contact node contain its own forces alone. Where restraints take them away,
//! the equations of the target nodes decide; a force that they leave open is not determined.

use std::collections::BTreeSet;

use nalgebra::{DMatrix, DVector};

use super::pairing::{Pairing, STEEP, Status};
use problem::model::{Dof, Model, NodeId};

/// A singular value, over that of a force on an equation of its own, below which a combination of
/// forces is not determined.
const UNDETERMINED: f64 = 1e-9;

/// The forces on a contact node.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct ContactForce {
    /// Whether restraints leave them undetermined: then they are the least of those that hold the
    /// bodies in equilibrium.
    pub(crate) undetermined: bool,
    /// The force along the normal, force; > 0 where it presses.
    pub(crate) normal: f64,
    /// The force along the tangent, which is the normal turned left, force.
    pub(crate) tangent: f64,
}

/// A closed contact node, and whether it sticks: its tangential force is a reaction then, else part of
/// `friction`.
type Contact<'a> = (&'a Pairing, bool);

impl ContactForce {
    /// Returns the force along normal and tangent, force; None where it is not determined.
    pub(crate) fn known(self) -> Option<[f64; 2]> {
        (!self.undetermined).then_some([self.normal, self.tangent])
    }
}

/// Returns the forces of all entries from `reaction`, which is K u − F − friction by degree of freedom; 0
/// where an entry is open.
pub(crate) fn contact_forces(
    model: &Model,
    pairings: &[Option<Pairing>],
    statuses: &[Status],
    reaction: &DVector<f64>,
) -> Vec<ContactForce> {
    let mut all = vec![ContactForce::default(); statuses.len()];
    let (mut rest, mut hard) = (reaction.clone(), Vec::new());
    for (i, status) in statuses.iter().enumerate().filter(|(_, status)| status.is_closed()) {
        let Some(pairing) = &pairings[i] else { continue };
        let contact = (pairing, *status == Status::Stick);
        match direct(model, contact, reaction) {
            Some(force) => {
                add(pairing, force, -1.0, &mut rest);
                all[i] = force;
            }
            None => hard.push((i, contact)),
        }
    }
    if !hard.is_empty() {
        let (places, contacts): (Vec<usize>, Vec<Contact>) = hard.into_iter().unzip();
        let forces = by_target(model, &contacts, &rest);
        places.into_iter().zip(forces).for_each(|(i, force)| all[i] = force);
    }
    all
}

/// Adds `factor` times the forces of a contact, on its node and reversed on its target, to `load`.
pub(crate) fn add(pairing: &Pairing, force: ContactForce, factor: f64, load: &mut DVector<f64>) {
    let (normal, tangent) = (pairing.normal, pairing.tangent());
    let force = [0, 1].map(|d| factor * (force.normal * normal[d] + force.tangent * tangent[d]));
    let mut on = |node: NodeId, weight: f64| {
        for dof in node.dofs() {
            load[dof.index()] += weight * force[dof.direction()];
        }
    };
    on(pairing.node, 1.0);
    pairing.masters.iter().for_each(|&(master, w)| on(master, -w));
}

/// Returns the forces on a contact node from its own equations; None where restraints take them.
fn direct(
    model: &Model,
    (pairing, sticks): Contact,
    reaction: &DVector<f64>,
) -> Option<ContactForce> {
    let ([nx, ny], [rx, ry]) = (pairing.normal, pairing.node.components(reaction));
    let along = |n: f64, r: f64| {
        (!sticks && n.abs() >= STEEP)
            .then(|| ContactForce { normal: r / n, ..ContactForce::default() })
    };
    match model.restraints_of(pairing.node) {
        [false, false] => {
            let tangent = if sticks { nx * ry - ny * rx } else { 0.0 };
            Some(ContactForce { normal: nx * rx + ny * ry, tangent, undetermined: false })
        }
        [true, false] => along(ny, ry),
        [false, true] => along(nx, rx),
        [true, true] => None,
    }
}

/// Returns the forces of contacts from all equations in which they occur, by least squares.
fn by_target(model: &Model, contacts: &[Contact], rest: &DVector<f64>) -> Vec<ContactForce> {
    let none = ContactForce::default();
    let units = [ContactForce { normal: 1.0, ..none }, ContactForce { tangent: 1.0, ..none }];
    let of_contact = |(i, (_, sticks)): (usize, &Contact)| {
        units.into_iter().take(1 + usize::from(*sticks)).map(move |unit| (i, unit))
    };
    let columns: Vec<(usize, ContactForce)> =
        contacts.iter().enumerate().flat_map(of_contact).collect();
    let nodes = contacts.iter().flat_map(|(pairing, _)| pairing.nodes());
    let equations: BTreeSet<Dof> =
        nodes.flat_map(NodeId::dofs).filter(|dof| !model.is_restrained(*dof)).collect();
    let equations: Vec<Dof> = equations.into_iter().collect();
    let mut matrix = DMatrix::zeros(equations.len().max(columns.len()), columns.len());
    let mut load = DVector::zeros(rest.len());
    for (column, (i, unit)) in columns.iter().enumerate() {
        add(contacts[*i].0, *unit, 1.0, &mut load);
        for (row, dof) in equations.iter().enumerate() {
            matrix[(row, column)] = load[dof.index()];
        }
        add(contacts[*i].0, *unit, -1.0, &mut load);
    }
    let right = DVector::from_fn(matrix.nrows(), |row, _| {
        equations.get(row).map_or(0.0, |dof| rest[dof.index()])
    });
    let svd = matrix.svd(true, true);
    let v = svd.v_t.as_ref().expect("V was asked for").transpose();
    let free: Vec<usize> =
        (0..columns.len()).filter(|&k| svd.singular_values[k] <= UNDETERMINED).collect();
    let value = svd.solve(&right, UNDETERMINED).expect("U and V were asked for");
    let mut forces = vec![none; contacts.len()];
    for (column, (i, unit)) in columns.iter().enumerate() {
        let open = free.iter().any(|&k| v[(column, k)].abs() > UNDETERMINED.sqrt());
        forces[*i].undetermined |= open;
        match unit.normal {
            0.0 => forces[*i].tangent = value[column],
            _ => forces[*i].normal = value[column],
        }
    }
    forces
}

/// Returns the contact forces by degree of freedom, force.
pub(crate) fn load_of(
    pairings: &[Option<Pairing>],
    forces: &[ContactForce],
    dofs: usize,
) -> DVector<f64> {
    let mut load = DVector::zeros(dofs);
    for (pairing, force) in pairings.iter().zip(forces) {
        pairing.iter().for_each(|pairing| add(pairing, *force, 1.0, &mut load));
    }
    load
}
