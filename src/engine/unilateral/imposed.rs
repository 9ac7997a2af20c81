//! What imposed statuses lead to: displacements, the forces of contact, and the friction of nodes that
//! slide.

use nalgebra::{DMatrix, DVector};

use super::problem::{Configuration, Problem, StateSearch, StateSolution};
use crate::contact::{ContactForce, Pairing, Status, add, contact_forces};
use crate::elimination::{Constraint, Elimination};
use crate::error::{Cause, NoEquilibrium};
use crate::held::{Held, Loaded, Unheld};
use crate::linear::{Factors, SparseCholesky};
use problem::model::Dof;

impl StateSearch<'_> {
    fn loaded(&self) -> Loaded<'_> {
        let Problem { model, stiffness, .. } = self.problem;
        Loaded { model, stiffness, load: &self.setting.load }
    }

    /// Factors the equations of the surfaces; None where the setting has no load on them, and where the
    /// whole ones are to be factored.
    fn reduced(&self, constraints: &[Constraint]) -> Option<Held<'_>> {
        let by = self.problem.reduction.as_ref().zip(self.setting.reduced.as_ref())?;
        let held = Held::reduced(self.loaded(), by, constraints)?;
        Some(if self.setting.whole { held.of_all() } else { held })
    }

    /// Factors the whole equations.
    ///
    /// # Errors
    /// The constraints do not hold the bodies.
    pub(super) fn whole(&self, constraints: &[Constraint]) -> Result<Held<'_>, Unheld> {
        Held::new(self.loaded(), constraints, self.setting.part.min(1.0))
    }

    /// Solves under imposed statuses, by the equations of the surfaces, or where these do not serve by the whole
    /// ones; returns also the bodies with the factors that served, and where the constraints do not hold these,
    /// the equations under them.
    ///
    /// # Errors
    /// No friction agrees with its own normal forces.
    pub(super) fn held(
        &self,
        statuses: &[Status],
        constraints: &[Constraint],
    ) -> Result<Result<(Held<'_>, StateSolution), Unheld>, NoEquilibrium> {
        if let Some(bodies) = self.reduced(constraints)
            && let Some(solved) = self.solved(statuses, &bodies)?
        {
            return Ok(Ok((bodies, solved)));
        }
        Ok(match self.whole(constraints) {
            Ok(bodies) => {
                let solved = self.solved(statuses, &bodies)?;
                Ok((bodies, solved.expect("the whole equations have a solution")))
            }
            Err(unheld) => Err(unheld),
        })
    }

    /// Returns the motion under the load of bodies that constraints leave free, on soft springs.
    pub(super) fn motion(&self, t: &Elimination) -> Option<DVector<f64>> {
        let soft = self.problem.stiffness.reduced(t).softly_held();
        let load = t.load(&self.setting.load);
        SparseCholesky::new(&soft).ok().map(|k| t.motion(&k.solve(&load)))
    }

    /// Adds the forces of contact, and what friction does, to the bodies' own displacements; None where the
    /// equations of the surfaces do not serve.
    fn solved(
        &self,
        statuses: &[Status],
        bodies: &Held,
    ) -> Result<Option<StateSolution>, NoEquilibrium> {
        let none = DVector::zeros(self.setting.load.len());
        let Some((mut u, mut residual)) = bodies.displacements(&none) else { return Ok(None) };
        let mut reaction = bodies.reaction(&u);
        let Configuration { pairings, .. } = self.config;
        let mut forces = contact_forces(self.problem.model, pairings, statuses, &reaction);
        let mut friction = Vec::new();
        if let Some((slide, sizes)) = self.slide(statuses, &forces, bodies)? {
            let Some(solved) = bodies.displacements(&slide) else { return Ok(None) };
            (u, residual) = solved;
            reaction = bodies.reaction(&u);
            let rest = &reaction - &slide;
            forces = contact_forces(self.problem.model, pairings, statuses, &rest);
            sizes.iter().for_each(|(i, size)| forces[*i].tangent = *size);
            let of_dof = Dof::all(slide.len()).zip(slide.iter().copied());
            friction = of_dof.filter(|(_, force)| *force != 0.0).collect();
        }
        Ok(Some(StateSolution { u, forces, friction, reaction, residual }))
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
        bodies: &Held,
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
        let load = |(_, _, pairing): &(usize, f64, &Pairing)| {
            let mut load = DVector::zeros(dofs);
            add(pairing, unit, 1.0, &mut load);
            load
        };
        let loads: Vec<DVector<f64>> = sliding.iter().map(load).collect();
        let n = sliding.len();
        let mut matrix = DMatrix::identity(n, n);
        for (column, reaction) in bodies.responses(&loads).iter().enumerate() {
            let response =
                contact_forces(self.problem.model, &self.config.pairings, statuses, reaction);
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
        let sizes = sizes.ok_or_else(|| NoEquilibrium {
            cause: Cause::NotFound,
            what: "the sliding nodes jam: no friction agrees with its own normal forces".into(),
        })?;
        let mut friction = DVector::zeros(dofs);
        for (load, size) in loads.iter().zip(&sizes) {
            friction.axpy(*size, load, 1.0);
        }
        let sizes = sliding.iter().zip(&sizes).map(|((i, _, _), size)| (*i, *size)).collect();
        Ok(Some((friction, sizes)))
    }
}

/// What friction does to nodes that slide: by degree of freedom, and along the tangent of each entry that
/// slides, force.
type Slide = (DVector<f64>, Vec<(usize, f64)>);
