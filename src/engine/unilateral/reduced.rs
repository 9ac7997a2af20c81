//! The bodies under imposed statuses: on the condensed bodies alone, or by the reduced equations
//! Tᵀ K T q = f, solved by the factors of the condensed bodies, by factors of their own, or by those of
//! nearly the same equations, with refinement.

use std::rc::Rc;

use nalgebra::DVector;

use crate::elimination::{Constraint, Elimination};
use crate::fast::condensation::{Bodies, Bound, Eliminated, Inside, OnKept, refined};
use crate::stiffness::Stiffness;
use numbers::solve::{Normed, Singular, SparseCholesky};
use problem::model::Model;

/// The bodies, and what was factored of them.
#[derive(Clone, Copy)]
pub(super) struct Elastic<'a> {
    pub(super) model: &'a Model,
    pub(super) stiffness: &'a Stiffness,
    pub(super) bodies: &'a Bodies,
}

/// What the bodies under imposed statuses do under a load.
pub(super) trait Responds {
    /// Returns whether its equations are those of the whole bodies.
    fn are_whole(&self) -> bool;

    /// Returns the displacements of its own equations, length, and their relative residual.
    ///
    /// # Errors
    /// The matrix is singular.
    fn displacements(&self) -> Result<(DVector<f64>, f64), Singular>;

    /// Returns the displacements by degree of freedom, length, from its own, and what gives those inside
    /// the bodies where these have none of its own and are 0.
    fn all(&self, u: DVector<f64>) -> (DVector<f64>, Option<Inside>);

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
    fn under(&self, load: &DVector<f64>) -> Result<[DVector<f64>; 2], Singular>;
}

/// The equations on the condensed bodies alone.
pub(super) struct OnSurface {
    state: OnKept,
    load: Rc<Eliminated>,
}

impl OnSurface {
    /// Factors the equations under a load by degree of freedom on the condensed bodies; None where that
    /// cannot be.
    pub(super) fn new(
        elastic: Elastic,
        constraints: &[Constraint],
        load: &DVector<f64>,
    ) -> Option<Self> {
        let state = elastic.bodies.state(elastic.stiffness, constraints)?;
        let load = elastic.bodies.eliminated(&state, load);
        Some(OnSurface { state, load })
    }
}

impl Responds for OnSurface {
    fn are_whole(&self) -> bool {
        false
    }

    fn displacements(&self) -> Result<(DVector<f64>, f64), Singular> {
        self.state.displacements(&self.load).ok_or(Singular { column: 0, pivot: f64::NAN })
    }

    fn all(&self, u: DVector<f64>) -> (DVector<f64>, Option<Inside>) {
        let inside = self.state.inside(&self.load, u);
        (inside.on_surfaces(), Some(inside))
    }

    fn reaction(&self, u: &DVector<f64>) -> DVector<f64> {
        self.state.reaction(u, &self.load)
    }

    fn response(&self, load: &DVector<f64>) -> Result<DVector<f64>, Singular> {
        Ok(self.state.response(load))
    }

    fn under(&self, load: &DVector<f64>) -> Result<[DVector<f64>; 2], Singular> {
        Ok(self.state.under(load))
    }
}

/// The equations of the whole bodies.
pub(super) struct Reduced<'a> {
    elastic: Elastic<'a>,
    t: &'a Elimination,
    /// By degree of freedom, force.
    load: &'a DVector<f64>,
    made: Made,
}

/// The factors of the reduced equations.
enum Made {
    Condensed(Bound),
    Whole(Box<SparseCholesky>),
}

impl<'a> Reduced<'a> {
    /// Factors on the condensed bodies; where that cannot be, factors the whole matrix.
    ///
    /// # Errors
    /// The matrix is singular.
    pub(super) fn new(
        elastic: Elastic<'a>,
        t: &'a Elimination,
        constraints: &[Constraint],
        load: &'a DVector<f64>,
    ) -> Result<Self, Singular> {
        let made = match elastic.bodies.bound(elastic.stiffness, t, constraints) {
            Some(bound) => Made::Condensed(bound),
            None => Made::Whole(Box::new(SparseCholesky::new(elastic.stiffness.reduced(t))?)),
        };
        Ok(Reduced { elastic, t, load, made })
    }

    /// Returns q, and its relative residual.
    fn solve(&self, f: &DVector<f64>) -> Result<(DVector<f64>, f64), Singular> {
        let stiffness = self.elastic.stiffness;
        let by = |factors: &dyn Normed| refined(stiffness, self.t, factors, f);
        match &self.made {
            Made::Condensed(bound) => match by(bound) {
                Ok(solved) => Ok(solved),
                Err(_) => by(&SparseCholesky::new(stiffness.reduced(self.t))?).or_else(Ok),
            },
            Made::Whole(whole) => by(&**whole).or_else(Ok),
        }
    }

    /// Returns K u − f, force.
    fn left(&self, u: &DVector<f64>, load: &DVector<f64>) -> DVector<f64> {
        self.elastic.stiffness.times(u) - load
    }

    /// Returns the displacements under a load, without the shift of the constraints, length.
    fn unshifted(&self, load: &DVector<f64>) -> Result<DVector<f64>, Singular> {
        let (q, _) = self.solve(&self.t.load(&self.elastic.model.free_part(load)))?;
        Ok(self.t.motion(&q))
    }
}

impl Responds for Reduced<'_> {
    fn are_whole(&self) -> bool {
        true
    }

    fn displacements(&self) -> Result<(DVector<f64>, f64), Singular> {
        let shifted = self.elastic.stiffness.times(self.t.shift());
        let f = self.t.load(&(self.elastic.model.free_part(self.load) - shifted));
        let (q, residual) = self.solve(&f)?;
        Ok((self.t.expand(&q), residual))
    }

    fn all(&self, u: DVector<f64>) -> (DVector<f64>, Option<Inside>) {
        (u, None)
    }

    fn reaction(&self, u: &DVector<f64>) -> DVector<f64> {
        self.left(u, self.load)
    }

    fn response(&self, load: &DVector<f64>) -> Result<DVector<f64>, Singular> {
        match &self.made {
            Made::Condensed(bound) => Ok(bound.response(load)),
            Made::Whole(_) => Ok(self.left(&self.unshifted(load)?, load)),
        }
    }

    fn under(&self, load: &DVector<f64>) -> Result<[DVector<f64>; 2], Singular> {
        let u = self.unshifted(load)?;
        let force = self.elastic.stiffness.times(&u);
        Ok([u, force])
    }
}
