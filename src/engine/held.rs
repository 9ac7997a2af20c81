//! The bodies under constraints, Tᵀ K u = Tᵀ F with u = T q + s: all equations, or those on the contact
//! surfaces, to which the stiffness was reduced. One way solves both: what is left of the load corrects u
//! until it is rounding.

use nalgebra::{DMatrix, DVector};

use super::elimination::{Constraint, Elimination};
use super::reduction::Reduction;
use super::stiffness::Stiffness;
use crate::linear::{DenseCholesky, EliminatedLoad, Factors, SparseCholesky, backward_error};
use problem::model::{Dof, Model};

/// The relative residual at which corrections end.
const REFINED: f64 = 4.0 * f64::EPSILON;

/// The part of its residual to which a correction must bring the next one.
const CONTRACTION: f64 = 0.2;

/// The relative residual that is enough by the factors of reduced equations.
const ENOUGH: f64 = 32.0 * f64::EPSILON;

/// The bodies and the load on them, by degree of freedom, restrained ones included, force.
#[derive(Clone, Copy)]
pub struct Loaded<'a> {
    /// The finite element model.
    pub model: &'a Model,
    /// Its stiffness.
    pub stiffness: &'a Stiffness,
    /// The load.
    pub load: &'a DVector<f64>,
}

/// Bodies that constraints hold, with factors of Tᵀ K T.
pub struct Held<'a> {
    bodies: Loaded<'a>,
    equations: Equations<'a>,
    t: Elimination,
    factors: Box<dyn Factors>,
    /// The largest row sum of the size of what is solved, force/length.
    norm: f64,
}

/// The equations that are solved, and those by whose factors.
enum Equations<'a> {
    /// All by their own.
    All,
    /// Those of the kept nodes by their own.
    Kept(&'a Reduction, &'a EliminatedLoad),
    /// All by those of the kept nodes.
    AllByKept(&'a Reduction),
}

/// Constraints that do not hold the bodies.
pub struct Unheld {
    /// The equations under them.
    pub t: Elimination,
    /// A degree of freedom that is free to move.
    pub dof: Dof,
}

impl<'a> Held<'a> {
    /// Factors all equations under constraints, and under a part of the displacements of restraints.
    ///
    /// # Errors
    /// They do not hold the bodies.
    pub fn new(bodies: Loaded<'a>, constraints: &[Constraint], part: f64) -> Result<Self, Unheld> {
        let t = Elimination::closing(&bodies.model.holds, part, constraints);
        match SparseCholesky::new(&bodies.stiffness.reduced(&t)) {
            Ok(factors) => {
                let (equations, norm) = (Equations::All, factors.norm());
                Ok(Held { bodies, equations, t, factors: Box::new(factors), norm })
            }
            Err(singular) => Err(Unheld { dof: t.dof(singular.column), t }),
        }
    }

    /// Factors reduced equations under constraints; None where these hardly hold the bodies, and where they
    /// bind a node that is not kept.
    pub fn reduced(
        bodies: Loaded<'a>,
        (reduction, load): (&'a Reduction, &'a EliminatedLoad),
        constraints: &[Constraint],
    ) -> Option<Self> {
        let t = reduction.closing(constraints)?;
        let factors = Box::new(DenseCholesky::new(&t.matrix(&reduction.stiffness))?);
        let equations = Equations::Kept(reduction, load);
        Some(Held { bodies, equations, t, factors, norm: reduction.norm })
    }

    /// Returns the same, by whose factors all equations are solved.
    pub fn of_all(self) -> Self {
        match self.equations {
            Equations::All => self,
            Equations::Kept(by, _) | Equations::AllByKept(by) => {
                Held { equations: Equations::AllByKept(by), norm: by.whole_norm, ..self }
            }
        }
    }

    /// Returns the displacements by degree of freedom, length, under the load and `more` on the contact
    /// surfaces, force; and the relative residual. None where reduced equations do not serve.
    pub fn displacements(&self, more: &DVector<f64>) -> Option<(DVector<f64>, f64)> {
        let Held { bodies: Loaded { stiffness, load, .. }, t, .. } = self;
        let own = |rest: &DVector<f64>| t.motion(&self.factors.solve(&t.load(rest)));
        let left = |rest: &DVector<f64>| t.load(rest);
        match &self.equations {
            Equations::All => {
                let times = |u: &DVector<f64>| stiffness.times(u);
                Some(self.corrected(t.shift().clone(), *load + more, times, left, own))
            }
            Equations::Kept(by, load) => {
                let f = by.left(load) + by.part(more);
                let times = |u: &DVector<f64>| &by.stiffness * u;
                let (kept, error) = self.corrected(t.shift().clone(), f, times, left, own);
                (error <= ENOUGH).then(|| (by.expand(load, &kept), error))
            }
            Equations::AllByKept(by) => {
                let f = self.bodies.model.free_part(&(*load + more));
                let times = |u: &DVector<f64>| self.bodies.model.free_part(&stiffness.times(u));
                // The forces that keep constraints do no work.
                let left = |rest: &DVector<f64>| {
                    let kept = by.part(rest);
                    let inside = (rest - by.spread(&kept)).amax();
                    DVector::from_vec(vec![inside, t.load(&kept).amax()])
                };
                let correction = |rest: &DVector<f64>| {
                    let rest = by.eliminated(rest);
                    by.expand(&rest, &own(&by.left(&rest)))
                };
                let found = self.corrected(by.spread(t.shift()), f, times, left, correction);
                (found.1 <= ENOUGH).then_some(found)
            }
        }
    }

    /// Corrects u as long as that brings more: `times` returns K u, `left` what constraints leave of a
    /// residual, and `correction` what a residual adds to u. Returns u and the relative size of what is left.
    fn corrected(
        &self,
        mut u: DVector<f64>,
        f: DVector<f64>,
        times: impl Fn(&DVector<f64>) -> DVector<f64>,
        left: impl Fn(&DVector<f64>) -> DVector<f64>,
        correction: impl Fn(&DVector<f64>) -> DVector<f64>,
    ) -> (DVector<f64>, f64) {
        let mut before = f64::INFINITY;
        loop {
            let rest = &f - times(&u);
            let error = backward_error(&left(&rest), self.norm, &u, &f);
            if error <= REFINED || error.is_nan() || error > CONTRACTION * before {
                return (u, error);
            }
            before = error;
            u += correction(&rest);
        }
    }

    /// Returns K u − F, force: on the equations that contact can bind, the forces of contact.
    pub fn reaction(&self, u: &DVector<f64>) -> DVector<f64> {
        match &self.equations {
            Equations::All | Equations::AllByKept(_) => {
                self.bodies.stiffness.times(u) - self.bodies.load
            }
            Equations::Kept(by, load) => by.spread(&(&by.stiffness * by.part(u) - by.left(load))),
        }
    }

    /// Returns for each of some loads on the contact surfaces, by degree of freedom, K u − f of the
    /// displacements under it alone, without the shift of the constraints, force.
    pub fn responses(&self, loads: &[DVector<f64>]) -> Vec<DVector<f64>> {
        let moved = |f: &[DVector<f64>]| -> Vec<DVector<f64>> {
            let f: Vec<DVector<f64>> = f.iter().map(|f| self.t.load(f)).collect();
            let q = self.factors.solve_all(DMatrix::from_columns(&f));
            q.column_iter().map(|q| self.t.motion(&q.into_owned())).collect()
        };
        match &self.equations {
            Equations::All => {
                let of_load = |(u, f): (_, &DVector<f64>)| self.bodies.stiffness.times(&u) - f;
                moved(loads).into_iter().zip(loads).map(of_load).collect()
            }
            Equations::Kept(by, _) | Equations::AllByKept(by) => {
                let own: Vec<DVector<f64>> = loads.iter().map(|load| by.part(load)).collect();
                let force = &by.stiffness * DMatrix::from_columns(&moved(&own));
                force.column_iter().zip(&own).map(|(force, f)| by.spread(&(force - f))).collect()
            }
        }
    }

    /// Returns the displacements by degree of freedom, length, and K u, force, where the same nodes are bound to
    /// other places and nothing else acts; of reduced equations on the contact surfaces alone.
    pub fn moved(&self, constraints: &[Constraint]) -> Option<[DVector<f64>; 2]> {
        let Held { bodies: Loaded { model, stiffness, .. }, t, factors, .. } = self;
        let carried =
            |to: &DVector<f64>, force: DVector<f64>| to - t.motion(&factors.solve(&t.load(&force)));
        match &self.equations {
            Equations::All => {
                let to = Elimination::closing(&model.holds, 0.0, constraints);
                let u = carried(to.shift(), stiffness.times(to.shift()));
                let force = stiffness.times(&u);
                Some([u, force])
            }
            Equations::Kept(by, _) | Equations::AllByKept(by) => {
                let to = by.closing(constraints)?;
                let u = carried(to.shift(), &by.stiffness * to.shift());
                Some([by.spread(&u), by.spread(&(&by.stiffness * &u))])
            }
        }
    }
}
