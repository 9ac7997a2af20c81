//! The bodies under imposed statuses: on the condensed bodies alone, or by the reduced equations
//! Tᵀ K T q = f of the whole ones.

use std::rc::Rc;

use nalgebra::DVector;

use super::problem::Problem;
use crate::elimination::{Constraint, Elimination};
use crate::fast::condensation::{Eliminated, Interior, KeptState, WholeFactors, refined};
use numbers::solve::{Normed, Singular, SparseCholesky};

/// What the bodies under imposed statuses do under a load.
pub(super) trait Response {
    /// Returns the displacements by degree of freedom, length, from those of its own equations, and what
    /// gives those inside the bodies where its equations have none of them and they are 0.
    fn all(&self, u: DVector<f64>) -> (DVector<f64>, Option<Interior>);

    /// Returns K u − f by degree of freedom, force, for displacements of its own, which is that of contact
    /// on the equations that contact can bind.
    fn reaction(&self, u: &DVector<f64>) -> DVector<f64>;

    /// Returns the same for the displacements under another load, on the contact surface alone, without
    /// the shift of the constraints.
    ///
    /// # Errors
    /// The matrix is singular.
    fn response(&self, load: &DVector<f64>) -> Result<DVector<f64>, Singular>;

    /// Returns those displacements of its own, and K u by degree of freedom.
    ///
    /// # Errors
    /// The matrix is singular.
    fn unshifted(&self, load: &DVector<f64>) -> Result<[DVector<f64>; 2], Singular>;
}

/// The equations on the condensed bodies alone.
pub(super) struct OnSurface {
    pub(super) state: KeptState,
    pub(super) load: Rc<Eliminated>,
}

impl Response for OnSurface {
    fn all(&self, u: DVector<f64>) -> (DVector<f64>, Option<Interior>) {
        let interior = self.state.interior(&self.load, u);
        (interior.on_surfaces(), Some(interior))
    }

    fn reaction(&self, u: &DVector<f64>) -> DVector<f64> {
        self.state.reaction(u, &self.load)
    }

    fn response(&self, load: &DVector<f64>) -> Result<DVector<f64>, Singular> {
        Ok(self.state.response(load))
    }

    fn unshifted(&self, load: &DVector<f64>) -> Result<[DVector<f64>; 2], Singular> {
        Ok(self.state.unshifted(load))
    }
}

/// The equations of the whole bodies.
pub(super) struct WholeBodies<'a> {
    problem: &'a Problem<'a>,
    t: &'a Elimination,
    /// By degree of freedom, force.
    load: &'a DVector<f64>,
    factors: Factors,
}

/// The factors of Tᵀ K T.
enum Factors {
    Condensed(WholeFactors),
    Sparse(Box<SparseCholesky>),
}

impl<'a> WholeBodies<'a> {
    /// Factors on the condensed bodies; where that cannot be, factors the whole matrix.
    ///
    /// # Errors
    /// The matrix is singular.
    pub(super) fn new(
        problem: &'a Problem<'a>,
        t: &'a Elimination,
        constraints: &[Constraint],
        load: &'a DVector<f64>,
    ) -> Result<Self, Singular> {
        let stiffness = &problem.stiffness;
        let factors = match problem.bodies.whole_factors(stiffness, t, constraints) {
            Some(condensed) => Factors::Condensed(condensed),
            None => Factors::Sparse(Box::new(SparseCholesky::new(stiffness.reduced(t))?)),
        };
        Ok(WholeBodies { problem, t, load, factors })
    }

    /// Returns the displacements by degree of freedom, length, and their relative residual.
    ///
    /// # Errors
    /// The matrix is singular.
    pub(super) fn displacements(&self) -> Result<(DVector<f64>, f64), Singular> {
        let shifted = self.problem.stiffness.times(self.t.shift());
        let f = self.t.load(&(self.problem.model.free_part(self.load) - shifted));
        let (q, residual) = self.solve(&f)?;
        Ok((self.t.expand(&q), residual))
    }

    /// Returns q, and its relative residual.
    fn solve(&self, f: &DVector<f64>) -> Result<(DVector<f64>, f64), Singular> {
        let stiffness = &self.problem.stiffness;
        let by = |factors: &dyn Normed| refined(stiffness, self.t, factors, f);
        match &self.factors {
            Factors::Condensed(condensed) => match by(condensed) {
                Ok(solved) => Ok(solved),
                Err(_) => by(&SparseCholesky::new(stiffness.reduced(self.t))?).or_else(Ok),
            },
            Factors::Sparse(sparse) => by(&**sparse).or_else(Ok),
        }
    }
}

impl Response for WholeBodies<'_> {
    fn all(&self, u: DVector<f64>) -> (DVector<f64>, Option<Interior>) {
        (u, None)
    }

    fn reaction(&self, u: &DVector<f64>) -> DVector<f64> {
        self.problem.stiffness.times(u) - self.load
    }

    fn response(&self, load: &DVector<f64>) -> Result<DVector<f64>, Singular> {
        match &self.factors {
            Factors::Condensed(condensed) => Ok(condensed.response(load)),
            Factors::Sparse(_) => {
                let [_, force] = self.unshifted(load)?;
                Ok(force - load)
            }
        }
    }

    fn unshifted(&self, load: &DVector<f64>) -> Result<[DVector<f64>; 2], Singular> {
        let (q, _) = self.solve(&self.t.load(&self.problem.model.free_part(load)))?;
        let u = self.t.motion(&q);
        let force = self.problem.stiffness.times(&u);
        Ok([u, force])
    }
}
