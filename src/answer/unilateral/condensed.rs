//! Coulomb friction in one step of the load as a linear complementarity problem on the contact
//! surface.
//!
//! ```text
//!   p = p0 + Snn g + Snt (a − b)        p ≥ 0,           g ≥ 0,  p g = 0
//!   q = q0 + Stn g + Stt (a − b)        μ p + q ≥ 0,     a ≥ 0,  (μ p + q) a = 0
//!                                       μ p − q ≥ 0,     b ≥ 0,  (μ p − q) b = 0
//! ```
//!
//! g are the gaps, a − b the slips of the step, p and q the forces along normal and tangent, and S
//! the stiffness of the bodies at the contact surface, from displacements with every node held to its
//! place on the target.
//!
//! Source: A. Klarbring, Ing.-Arch. 60 (1990) 529-541, in displacements in place of forces.

use nalgebra::{DMatrix, DVector};

use super::forces::tangent;
use super::lemke::lemke;
use super::problem::{Place, Problem, Setting, Solved};
use crate::answer::contact::{Pairing, Sense, Status};
use crate::answer::elimination::{Constraint, Motion};

/// The number of contact nodes up to which the problem is set up.
const MOST: usize = 150;

/// A gap, slip or force in the units of [`Problem::scaled`] up to which it is 0: rounding.
const STILL: f64 = 1e-10;

impl Problem<'_> {
    /// Looks for statuses in equilibrium by Lemke's method; None where it finds none, and where the
    /// problem is not of its kind: with nodes that never slide, of more than 150 nodes, or with a contact
    /// node that is restrained.
    pub(super) fn complementary(&self, place: &Place, setting: &Setting) -> Option<Vec<Status>> {
        let entries: Vec<usize> =
            (0..place.pairings.len()).filter(|i| place.pairings[*i].is_some()).collect();
        let pairing =
            |i: usize| place.pairings[i].as_ref().expect("only entries that face a target");
        let restrained = |i: &usize| self.model.restraints_of(pairing(*i).node).contains(&true);
        let mu = self.friction;
        if mu.is_infinite() || entries.len() > MOST || entries.iter().any(restrained) {
            return None;
        }
        if mu == 0.0 {
            return self.without_friction(place, &entries, setting);
        }
        let n = entries.len();
        let (stiffness, at_rest) = self.scaled(place, &entries, setting, 2 * n)?;
        let forces_of = DMatrix::from_fn(2 * n, 3 * n, |row, column| match column / n {
            0 | 1 => stiffness[(row, column)],
            _ => -stiffness[(row, column - n)],
        });
        let combine = |p: f64, q: f64, block: usize| match block {
            0 => p,
            1 => mu * p + q,
            _ => mu * p - q,
        };
        let matrix = DMatrix::from_fn(3 * n, 3 * n, |row, column| {
            let i = row % n;
            combine(forces_of[(i, column)], forces_of[(n + i, column)], row / n)
        });
        let right = DVector::from_fn(3 * n, |row, _| {
            combine(at_rest[row % n], at_rest[n + row % n], row / n)
        });
        let z = lemke(&matrix, &right)?;
        let force = &forces_of * &z + at_rest;
        let mut statuses = vec![Status::Open; place.pairings.len()];
        for (k, i) in entries.iter().enumerate() {
            let slip = z[n + k] - z[2 * n + k];
            statuses[*i] = match () {
                _ if force[k] <= STILL => Status::Open,
                _ if slip > STILL => Status::Slip(Sense::Forward),
                _ if slip < -STILL => Status::Slip(Sense::Backward),
                _ => Status::Stick,
            };
        }
        Some(statuses)
    }

    /// Looks for statuses without friction: p = p0 + S g, from displacements with every node held to
    /// the target along its normal alone.
    fn without_friction(
        &self,
        place: &Place,
        entries: &[usize],
        setting: &Setting,
    ) -> Option<Vec<Status>> {
        let n = entries.len();
        let (stiffness, at_rest) = self.scaled(place, entries, setting, n)?;
        let z = lemke(&stiffness, &at_rest)?;
        let mut statuses = vec![Status::Open; place.pairings.len()];
        for (k, i) in entries.iter().enumerate() {
            if z[k] <= STILL {
                statuses[*i] = Status::Slip(Sense::Free);
            }
        }
        Some(statuses)
    }

    /// Returns the stiffness of the first `size` gaps and slips, and the forces with every node held to
    /// the target: gaps and slips in the unit in which stiffness is 1, forces in that of the largest.
    /// None where there are no forces.
    fn scaled(
        &self,
        place: &Place,
        entries: &[usize],
        setting: &Setting,
        size: usize,
    ) -> Option<(DMatrix<f64>, DVector<f64>)> {
        let forces = |apart: &DVector<f64>, loaded: bool| {
            let all = self.held(place, entries, setting, apart, loaded)?;
            Some(all.rows(0, size).into_owned())
        };
        let at_rest = forces(&DVector::zeros(2 * entries.len()), true)?;
        let mut stiffness = DMatrix::zeros(size, size);
        for column in 0..size {
            let mut apart = DVector::zeros(2 * entries.len());
            apart[column] = 1.0;
            stiffness.set_column(column, &forces(&apart, false)?);
        }
        let (scale, unit) = (stiffness.diagonal().amax(), at_rest.amax());
        (unit > 0.0).then(|| (stiffness / scale, at_rest / unit))
    }

    /// Returns the forces along all normals, then along all tangents, with every node held `apart`
    /// from its place on the target: gaps, then slips; `loaded` or by that alone.
    fn held(
        &self,
        place: &Place,
        entries: &[usize],
        setting: &Setting,
        apart: &DVector<f64>,
        loaded: bool,
    ) -> Option<DVector<f64>> {
        let n = entries.len();
        let mut statuses = vec![Status::Open; place.pairings.len()];
        let held = if self.friction == 0.0 { Status::Slip(Sense::Free) } else { Status::Stick };
        entries.iter().for_each(|i| statuses[*i] = held);
        let mut constraints = self.constraints(place, &statuses, setting);
        let mut own = Setting { load: setting.load.clone(), ..*setting };
        if !loaded {
            own.load.fill(0.0);
        }
        for (k, (constraint, i)) in constraints.iter_mut().zip(entries).enumerate() {
            let pairing = place.pairings[*i].as_ref()?;
            shift(constraint, pairing, [apart[k], apart[n + k]], loaded);
        }
        let Ok(Solved::Moved(moved)) = self.solve(place, &statuses, &constraints, &own) else {
            return None;
        };
        let force = |row: usize| {
            let force = moved.forces[entries[row % n]];
            if row < n { force.normal } else { force.tangent }
        };
        Some(DVector::from_fn(2 * n, |row, _| force(row)))
    }
}

/// Moves the place to which a constraint binds by a gap and a slip; or binds to that alone.
fn shift(constraint: &mut Constraint, pairing: &Pairing, [gap, slip]: [f64; 2], added: bool) {
    let (n, t) = (pairing.normal, tangent(pairing));
    let apart = [0, 1].map(|d| gap * n[d] + slip * t[d]);
    match &mut constraint.motion {
        Motion::Both(shift) => {
            *shift = [0, 1].map(|d| apart[d] + if added { shift[d] } else { 0.0 });
        }
        Motion::Along(_, shift) => *shift = gap + if added { *shift } else { 0.0 },
    }
}
