//! The bodies under imposed statuses: on the contact surfaces alone, or by the whole equations
//! Tᵀ K T q = f.

use nalgebra::{DMatrix, DVector};

use super::problem::{Problem, Setting};
use crate::elimination::{Constraint, Elimination};
use crate::linear::{Singular, SparseCholesky};
use crate::reduction::{ReducedLoad, ReducedState};
use crate::refinement::refined;

/// The equations of the bodies under constraints and a load, factored.
pub(super) enum HeldBodies<'a> {
    /// Those of the surfaces.
    Reduced {
        problem: &'a Problem<'a>,
        state: ReducedState<'a>,
        setting: &'a Setting<'a>,
        load: &'a ReducedLoad,
    },
    /// The whole ones.
    Whole {
        problem: &'a Problem<'a>,
        t: Elimination,
        load: &'a DVector<f64>,
        factors: Box<SparseCholesky>,
    },
}

/// Constraints that do not hold the bodies.
pub(super) struct Unheld {
    pub(super) t: Elimination,
    pub(super) singular: Singular,
}

impl<'a> HeldBodies<'a> {
    /// Factors the equations of the surfaces; None where the setting has no load on them, and where the
    /// whole ones are to be factored.
    pub(super) fn reduced(
        problem: &'a Problem<'a>,
        setting: &'a Setting<'a>,
        constraints: &[Constraint],
    ) -> Option<Self> {
        let (reduction, load) = (problem.reduction.as_ref()?, setting.reduced.as_ref()?);
        let state = ReducedState::new(reduction, constraints)?;
        Some(HeldBodies::Reduced { problem, state, setting, load })
    }

    /// Factors the whole equations.
    ///
    /// # Errors
    /// The matrix is singular.
    pub(super) fn whole(
        problem: &'a Problem<'a>,
        setting: &'a Setting<'a>,
        constraints: &[Constraint],
    ) -> Result<Self, Unheld> {
        let load = &setting.load;
        let t = Elimination::closing(&problem.model.holds, setting.part.min(1.0), constraints);
        match SparseCholesky::new(problem.stiffness.reduced(&t)) {
            Ok(factors) => Ok(HeldBodies::Whole { problem, t, load, factors: Box::new(factors) }),
            Err(singular) => Err(Unheld { t, singular }),
        }
    }

    /// Returns the displacements by degree of freedom, length, under the load and `more` on the contact
    /// surface; and the relative residual. None where the equations of the surfaces do not serve.
    pub(super) fn displacements(&self, more: &DVector<f64>) -> Option<(DVector<f64>, f64)> {
        match self {
            HeldBodies::Reduced { problem, state, setting, load } => {
                if !setting.whole {
                    return state.displacements(load, more);
                }
                let all = &setting.load + more;
                state.refined(&problem.stiffness, &all, (load, more))
            }
            HeldBodies::Whole { problem, t, load, factors } => {
                let stiffness = &problem.stiffness;
                let f = t.load(&(*load + more - stiffness.times(t.shift())));
                let (q, residual) = refined(stiffness, t, &**factors, &f);
                Some((t.expand(&q), residual))
            }
        }
    }

    /// Returns K u − F under the load alone, force, which on the equations that contact can bind is that of
    /// contact.
    pub(super) fn reaction(&self, u: &DVector<f64>) -> DVector<f64> {
        match self {
            HeldBodies::Reduced { problem, setting, .. } if setting.whole => {
                problem.stiffness.times(u) - &setting.load
            }
            HeldBodies::Reduced { state, load, .. } => state.reaction(u, load),
            HeldBodies::Whole { problem, load, .. } => problem.stiffness.times(u) - *load,
        }
    }

    /// Returns for each of some loads on the contact surface, by degree of freedom, K u − f of the
    /// displacements under it without the shift of the constraints, force.
    pub(super) fn responses(&self, loads: &[DVector<f64>]) -> Vec<DVector<f64>> {
        let (problem, t, factors) = match self {
            HeldBodies::Reduced { state, .. } => return state.responses(loads),
            HeldBodies::Whole { problem, t, factors, .. } => (problem, t, factors),
        };
        let Problem { stiffness, surface_triangles, .. } = problem;
        let f: Vec<_> = loads.iter().map(|load| t.load(load)).collect();
        let q = factors.solve_all(DMatrix::from_columns(&f));
        let of_load = |(q, load): (_, &DVector<f64>)| {
            stiffness.times_of(surface_triangles.iter().copied(), &t.motion(&q)) - load
        };
        q.column_iter().map(|q| q.into_owned()).zip(loads).map(of_load).collect()
    }
}
