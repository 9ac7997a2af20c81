//! What imposed statuses lead to: displacements, the forces of contact, and the friction of nodes that
//! slide.

use nalgebra::{DMatrix, DVector};

use super::forces::{self, Contact, Force, forces};
use super::problem::{Moved, Place, Problem, Setting, Solved};
use super::reduced::{Elastic, OnSurface, Reduced, Responds};
use crate::contact::{Pairing, Status};
use crate::elimination::{Constraint, Elimination};
use crate::error::{Cause, Error, NoEquilibrium};
use numbers::solve::{Singular, SparseCholesky, SparseSymmetric};
use problem::model::Dof;

/// The stiffness, over the diagonal, of the springs that show how an unrestrained body moves.
const SOFT: f64 = 1e-8;

impl Problem<'_> {
    /// Solves for the displacements and forces under imposed statuses.
    pub(super) fn solve(
        &self,
        place: &Place,
        statuses: &[Status],
        constraints: &[Constraint],
        setting: &Setting,
    ) -> Result<Solved, Error> {
        let load = &setting.load;
        let on_surface = match setting.whole {
            true => None,
            false => OnSurface::new(self.elastic(), constraints, load),
        };
        if let Some(surface) = on_surface
            && let Ok(solved) = surface.displacements()
        {
            return self.moved(place, statuses, solved, &surface);
        }
        let t = Elimination::closing(&self.model.restrained, constraints);
        let reduced = match Reduced::new(self.elastic(), &t, constraints, load) {
            Ok(reduced) => reduced,
            Err(singular) => return Ok(self.free(&t, singular, load)),
        };
        match reduced.displacements() {
            Ok(solved) => self.moved(place, statuses, solved, &reduced),
            Err(singular) => Ok(self.free(&t, singular, load)),
        }
    }

    /// Adds the forces of contact, and what friction does, to the bodies' own displacements.
    fn moved(
        &self,
        place: &Place,
        statuses: &[Status],
        (mut u, residual): (DVector<f64>, f64),
        bodies: &dyn Responds,
    ) -> Result<Solved, Error> {
        let mut reaction = bodies.reaction(&u);
        let mut forces = self.forces(place, statuses, &reaction);
        let (mut friction, mut feedback) = (Vec::new(), 0.0);
        if let Some(slide) = self.slide(place, statuses, &forces, bodies)? {
            let [more, force] = bodies.under(&slide.friction).map_err(|_| jammed())?;
            u += more;
            reaction += force;
            forces = self.forces(place, statuses, &(&reaction - &slide.friction));
            slide.sizes.iter().for_each(|(i, size)| forces[*i].tangent = *size);
            (friction, feedback) = (acting(&slide.friction), slide.feedback);
        }
        let ((u, inside), whole) = (bodies.all(u), bodies.are_whole());
        Ok(Solved::Moved(Moved {
            u,
            inside,
            forces,
            friction,
            feedback,
            reaction,
            residual,
            whole,
        }))
    }

    fn elastic(&self) -> Elastic<'_> {
        let Problem { model, stiffness, bodies, .. } = self;
        Elastic { model, stiffness, bodies }
    }

    fn free(&self, t: &Elimination, singular: Singular, load: &DVector<f64>) -> Solved {
        let motion = free_motion(t, &self.stiffness.reduced(t), &self.model.free_part(load));
        Solved::Free { dof: t.dof(singular.column), motion }
    }

    /// Returns the friction of sliding nodes, whose size is μ times the normal forces that it leads to,
    /// from the `forces` without it; None where no node slides against friction.
    ///
    /// # Errors
    /// No size of the friction agrees with its normal forces.
    fn slide(
        &self,
        place: &Place,
        statuses: &[Status],
        forces: &[Force],
        bodies: &dyn Responds,
    ) -> Result<Option<Slide>, NoEquilibrium> {
        let sliding: Vec<(usize, f64, &Pairing)> = (0..statuses.len())
            .filter_map(|i| match statuses[i] {
                Status::Slip(sense) if sense.sign() != 0.0 => {
                    Some((i, sense.sign(), place.pairings[i].as_ref()?))
                }
                _ => None,
            })
            .collect();
        if sliding.is_empty() {
            return Ok(None);
        }
        let dofs = self.model.dofs();
        let unit = Force { tangent: 1.0, ..Force::default() };
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
            let response = self.forces(place, statuses, reaction);
            for (row, (i, sign, _)) in sliding.iter().enumerate() {
                matrix[(row, column)] += sign * self.friction * response[*i].normal;
            }
        }
        let right = DVector::from_fn(n, |row, _| {
            let (i, sign, _) = sliding[row];
            -sign * self.friction * forces[i].normal
        });
        let matrix = matrix.lu();
        let sizes = matrix.solve(&right).filter(|sizes| sizes.iter().all(|x| x.is_finite()));
        let sizes = sizes.ok_or_else(jammed)?;
        let rows = matrix.try_inverse().ok_or_else(jammed)?;
        let feedback = rows.row_iter().map(|row| row.lp_norm(1)).fold(0.0, f64::max);
        let mut friction = DVector::zeros(dofs);
        for ((load, _), size) in responses.iter().zip(&sizes) {
            friction.axpy(*size, load, 1.0);
        }
        let sizes = sliding.iter().zip(&sizes).map(|((i, _, _), size)| (*i, *size)).collect();
        Ok(Some(Slide { friction, sizes, feedback }))
    }

    /// Returns the forces of all entries; 0 where an entry is open.
    pub(super) fn forces(
        &self,
        place: &Place,
        statuses: &[Status],
        reaction: &DVector<f64>,
    ) -> Vec<Force> {
        let closed: Vec<usize> = (0..statuses.len())
            .filter(|&i| statuses[i].is_closed() && place.pairings[i].is_some())
            .collect();
        let contact = |i: &usize| Contact {
            pairing: place.pairings[*i].as_ref().expect("closed entries face the target"),
            sticks: statuses[*i] == Status::Stick,
        };
        let contacts: Vec<Contact> = closed.iter().map(contact).collect();
        let mut all = vec![Force::default(); statuses.len()];
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
    /// See [`Moved::feedback`].
    feedback: f64,
}

/// Returns each degree of freedom on which a force acts, with it.
fn acting(force: &DVector<f64>) -> Vec<(Dof, f64)> {
    let of_dof = Dof::all(force.len()).zip(force.iter().copied());
    of_dof.filter(|(_, force)| *force != 0.0).collect()
}

fn jammed() -> NoEquilibrium {
    let what = "the sliding nodes jam: no friction agrees with its own normal forces".into();
    NoEquilibrium { cause: Cause::NotFound, what }
}

/// Returns the motion that constraints leave free where only soft springs oppose the load.
fn free_motion(t: &Elimination, k: &SparseSymmetric, load: &DVector<f64>) -> Option<DVector<f64>> {
    let q = SparseCholesky::new(k.with_diagonal(SOFT)).ok()?.solve(&t.load(load));
    Some(t.motion(&q))
}
