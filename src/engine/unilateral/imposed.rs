//! What imposed statuses lead to: displacements, the forces of contact, and the friction of nodes that
//! slide.

use nalgebra::{DMatrix, DVector};

use super::forces::{self, Contact, ContactForce, forces};
use super::problem::{Configuration, Outcome, Problem, StateSolution};
use super::reduced::{OnSurface, Response, WholeBodies};
use super::search::StateSearch;
use crate::contact::{Pairing, Status};
use crate::elimination::{Constraint, Elimination};
use crate::error::{Cause, Error, NoEquilibrium};
use numbers::solve::{Singular, SparseCholesky};
use problem::model::Dof;

/// The stiffness, over the diagonal, of the springs that show how an unrestrained body moves.
const SOFT: f64 = 1e-8;

impl StateSearch<'_> {
    /// Solves for the displacements and forces under imposed statuses: on the condensed bodies, or where
    /// that cannot be, or `self.setting` asks for it, on the whole ones.
    ///
    /// # Errors
    /// No friction agrees with its own normal forces.
    pub(super) fn solve(
        &self,
        statuses: &[Status],
        constraints: &[Constraint],
    ) -> Result<Outcome, Error> {
        let load = &self.setting.load;
        if !self.setting.whole
            && let Some(state) = self.problem.bodies.state(&self.problem.stiffness, constraints)
        {
            let load = self.problem.bodies.eliminated(&state, load);
            if let Some(solved) = state.displacements(&load) {
                return self.solved(statuses, solved, &OnSurface { state, load });
            }
        }
        let t = Elimination::closing(&self.problem.model.restrained, constraints);
        let whole = WholeBodies::new(self.problem, &t, constraints, load);
        match whole.and_then(|whole| Ok((whole.displacements()?, whole))) {
            Ok((solved, whole)) => self.solved(statuses, solved, &whole),
            Err(singular) => {
                let soft = self.problem.stiffness.reduced(&t).with_diagonal(SOFT);
                let load = t.load(&self.problem.model.free_part(load));
                let motion = SparseCholesky::new(soft).ok().map(|k| t.motion(&k.solve(&load)));
                Ok(Outcome::Free { dof: t.dof(singular.column), motion })
            }
        }
    }

    /// Adds the forces of contact, and what friction does, to the bodies' own displacements.
    fn solved(
        &self,
        statuses: &[Status],
        (mut u, residual): (DVector<f64>, f64),
        bodies: &dyn Response,
    ) -> Result<Outcome, Error> {
        let mut reaction = bodies.reaction(&u);
        let mut forces = self.problem.forces(self.config, statuses, &reaction);
        let mut friction = Vec::new();
        if let Some(slide) = self.slide(statuses, &forces, bodies)? {
            let [more, force] = bodies.unshifted(&slide.friction).map_err(|_| jammed())?;
            u += more;
            reaction += force;
            forces = self.problem.forces(self.config, statuses, &(&reaction - &slide.friction));
            slide.sizes.iter().for_each(|(i, size)| forces[*i].tangent = *size);
            let of_dof = Dof::all(slide.friction.len()).zip(slide.friction.iter().copied());
            friction = of_dof.filter(|(_, force)| *force != 0.0).collect();
        }
        let (u, interior) = bodies.all(u);
        let whole = interior.is_none();
        Ok(Outcome::Solved(StateSolution {
            u,
            interior,
            forces,
            friction,
            reaction,
            residual,
            whole,
        }))
    }

    /// Returns the friction of sliding nodes, whose size is μ times the normal forces that it leads to,
    /// from the `forces` without it; None where no node slides against friction.
    ///
    /// # Errors
    /// No size of the friction agrees with its normal forces.
    fn slide(
        &self,
        statuses: &[Status],
        forces: &[ContactForce],
        bodies: &dyn Response,
    ) -> Result<Option<Slide>, NoEquilibrium> {
        let sliding: Vec<(usize, f64, &Pairing)> = (0..statuses.len())
            .filter_map(|i| match statuses[i] {
                Status::Slip(sense) if sense.sign() != 0.0 => {
                    Some((i, sense.sign(), self.config.pairings[i].as_ref()?))
                }
                Status::Open | Status::Stick | Status::Slip(_) => None,
            })
            .collect();
        if sliding.is_empty() {
            return Ok(None);
        }
        let dofs = self.problem.model.dofs();
        let unit = ContactForce { tangent: 1.0, ..ContactForce::default() };
        let response = |(_, _, pairing): &(usize, f64, &Pairing)| {
            let mut load = DVector::zeros(dofs);
            forces::add(pairing, unit, 1.0, &mut load);
            let reaction = bodies.response(&load)?;
            Ok((load, reaction))
        };
        let responses: Result<Vec<_>, Singular> = sliding.iter().map(response).collect();
        let responses = responses.map_err(|_| jammed())?;
        let n = sliding.len();
        let mut matrix = DMatrix::identity(n, n);
        for (column, (_, reaction)) in responses.iter().enumerate() {
            let response = self.problem.forces(self.config, statuses, reaction);
            for (row, (i, sign, _)) in sliding.iter().enumerate() {
                matrix[(row, column)] += sign * self.problem.friction * response[*i].normal;
            }
        }
        let right = DVector::from_fn(n, |row, _| {
            let (i, sign, _) = sliding[row];
            -sign * self.problem.friction * forces[i].normal
        });
        let matrix = matrix.lu();
        let sizes = matrix.solve(&right).filter(|sizes| sizes.iter().all(|x| x.is_finite()));
        let sizes = sizes.ok_or_else(jammed)?;
        let mut friction = DVector::zeros(dofs);
        for ((load, _), size) in responses.iter().zip(&sizes) {
            friction.axpy(*size, load, 1.0);
        }
        let sizes = sliding.iter().zip(&sizes).map(|((i, _, _), size)| (*i, *size)).collect();
        Ok(Some(Slide { friction, sizes }))
    }
}

impl Problem<'_> {
    /// Returns the forces of all entries; 0 where an entry is open.
    pub(super) fn forces(
        &self,
        config: &Configuration,
        statuses: &[Status],
        reaction: &DVector<f64>,
    ) -> Vec<ContactForce> {
        let closed: Vec<usize> = (0..statuses.len())
            .filter(|&i| statuses[i].is_closed() && config.pairings[i].is_some())
            .collect();
        let contact = |i: &usize| Contact {
            pairing: config.pairings[*i].as_ref().expect("closed entries face the target"),
            sticks: statuses[*i] == Status::Stick,
        };
        let contacts: Vec<Contact> = closed.iter().map(contact).collect();
        let mut all = vec![ContactForce::default(); statuses.len()];
        for (i, force) in closed.into_iter().zip(forces(self.model, &contacts, reaction)) {
            all[i] = force;
        }
        all
    }
}

/// What friction does to nodes that slide.
struct Slide {
    /// By degree of freedom, force.
    friction: DVector<f64>,
    /// The entries that slide, each with its force along the tangent.
    sizes: Vec<(usize, f64)>,
}

fn jammed() -> NoEquilibrium {
    let what = "the sliding nodes jam: no friction agrees with its own normal forces".into();
    NoEquilibrium { cause: Cause::NotFound, what }
}
