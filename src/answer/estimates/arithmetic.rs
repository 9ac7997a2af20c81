//! The algebraic error: what rounding does to displacements and stresses.
//!
//! A run is done again in `f64` with a running bound on the error ([`Bounded`]), by the solver that suits its matrix: the bound of that run and
//! its distance from the run in question bound the error of the latter, in whatever numbers and by whatever solver it was done.
//! Under `unilateral` it is the equilibrium of the last contact state, normals and weights as they stand, that is solved again.
//! Either holds while rounding does not change who is in contact.

use nalgebra::{DVector, SVector};

use crate::answer::contact::{self, Elimination, Outcome, Stiffness};
use crate::numbers::scalar::{Bounded, Scalar};
use crate::numbers::solve::{Arithmetic, ScalarName, Solver, SparseCholesky, error_bound};
use crate::paper::mirror::Worksheet;
use crate::problem::element::D;
use crate::problem::element::Plane;
use crate::problem::modelling::Variant;
use crate::problem::scene::Scene;

/// Roundings in a von Mises value from its stresses, in units of 2^-53.
const ROUNDINGS: f64 = 32.0;

/// A bound on the largest error of an entry of `outcome.u`, length; infinite where nothing is known.
pub fn displacement_bound(scene: &Scene, outcome: &Outcome) -> f64 {
    let again = match outcome.variant {
        Variant::Unilateral => last_state(scene, outcome),
        _ => bounded_run(scene, outcome),
    };
    again.map_or(f64::INFINITY, |u| {
        let off = |e: usize| (u[e].to_f64() - outcome.u[e]).abs() + u[e].error();
        (0..u.len()).map(off).fold(0.0, f64::max)
    })
}

/// The run again, with a bound on each displacement.
fn bounded_run(scene: &Scene, outcome: &Outcome) -> Option<DVector<Bounded>> {
    let solver = match outcome.variant {
        Variant::Printed => Solver::DenseLu,
        _ => Solver::SparseCholesky,
    };
    let arithmetic = Arithmetic {
        scalar: ScalarName::Bounded,
        solver: Some(solver),
        inputs: outcome.arithmetic.inputs,
        ..Arithmetic::default()
    };
    let run = contact::run_in(scene, outcome.variant, &outcome.reading, arithmetic, |_| ()).ok()?;
    let bound = run.error_bound?;
    Some(run.u.map(|u| Bounded::new(u, bound)))
}

/// The equilibrium of the last contact state of `unilateral`, with a bound on each displacement.
fn last_state(scene: &Scene, outcome: &Outcome) -> Option<DVector<Bounded>> {
    let sheet = outcome.sheet.recomputed(Bounded::from_f64, scene.thickness);
    let ties = outcome.iterations.last()?.ties.iter().map(|tie| tie.map(Bounded::from_f64));
    let t = Elimination::with_normals(&sheet, &ties.collect::<Vec<_>>()).ok()?;
    let stiffness = Stiffness::new(&sheet);
    let load = scene.free_load().map(Bounded::from_f64);
    let (matrix, b) = (stiffness.reduced(&t), t.load(&(load - stiffness.times(t.shift()))));
    let factors = SparseCholesky::new(matrix.map(|a| a.to_f64())).ok()?;
    let x = factors.solve(&b.map(Scalar::to_f64));
    let bound = error_bound(&factors, matrix.both_triangles(), &b, &x);
    Some(t.expand(&x.map(|x| Bounded::new(x, bound))))
}

/// For each triangle a bound on the error of its von Mises stress where displacements are known to `displacement`; stress.
pub fn stress_bounds(outcome: &Outcome, thickness: f64, displacement: f64) -> Vec<f64> {
    let sheet = outcome.sheet.recomputed(Bounded::from_f64, thickness);
    let u = outcome.u.map(|u| Bounded::new(u, displacement));
    let of_triangle = |n: usize| {
        let rounding = ROUNDINGS * f64::EPSILON / 2.0 * outcome.elements[n - 1].von_mises_stress;
        von_mises_bound(&sheet, n, &u) + rounding
    };
    (1..=sheet.M()).map(of_triangle).collect()
}

/// Of two stresses the von Mises values differ by at most the von Mises value of their difference: it is a seminorm.
fn von_mises_bound(sheet: &Worksheet<Bounded>, n: usize, u: &DVector<Bounded>) -> f64 {
    let of_element = SVector::<Bounded, 6>::from_fn(|k, _| {
        u[2 * sheet.EL[(n, sheet.ind_1 + k / 2)] - 2 + k % 2]
    });
    let sigma = D(sheet.plane, sheet.E[n], sheet.nu[n]) * (sheet.B[n] * of_element);
    let [x, y, xy] = [0, 1, 2].map(|k| sigma[k].error());
    let z = match sheet.plane {
        Plane::Strain => sheet.nu[n].to_f64().abs() * (x + y),
        Plane::Stress => 0.0,
    };
    let squares = (x + y).powi(2) + (y + z).powi(2) + (z + x).powi(2);
    (squares / 2.0 + 3.0 * xy * xy).sqrt()
}
