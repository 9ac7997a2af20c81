//! The arithmetic error: the effect of rounding on displacements and stresses.
//!
//! A run is repeated in `f64` with a running bound on the error ([`Bounded`]), by the solver that
//! suits its matrix. The bound of that run and its distance from the assessed run bound the error
//! of the latter, whatever its numbers and its solver. Under `unilateral` the equilibrium of the
//! last contact state is solved again, with its normals and weights unchanged. Both bounds are
//! valid while rounding does not change which nodes are in contact.

use nalgebra::{DVector, SVector};

use crate::answer::{Detail, Elimination, Request, Solution, Stiffness, solve};
use crate::numbers::scalar::{Bounded, Scalar};
use crate::numbers::solve::{Arithmetic, ScalarName, Solver, SparseCholesky, error_bound};
use crate::problem::element::Plane;
use crate::problem::model::Model;
use crate::problem::modelling::Variant;

/// The number of roundings in a von Mises value from its stresses, in units of 2^-53.
const ROUNDINGS: f64 = 32.0;

/// Returns a bound on the error of any displacement, length; infinite where nothing is known.
pub fn displacement_bound(solution: &Solution) -> f64 {
    let again = match solution.request.variant {
        Variant::Unilateral => last_state(solution),
        _ => bounded_run(solution),
    };
    // What is left of the change of shape is no rounding, but no less an error of the displacements.
    let shape_change = solution.equilibrium.as_ref().map_or(0.0, |found| found.shape_change);
    again.map_or(f64::INFINITY, |u| {
        let error = |e: usize| (u[e].to_f64() - solution.u[e]).abs() + u[e].error();
        (0..u.len()).map(error).fold(shape_change, f64::max)
    })
}

/// Repeats the run with a bound on each displacement.
fn bounded_run(solution: &Solution) -> Option<DVector<Bounded>> {
    let solver = match solution.request.variant {
        Variant::Printed => Solver::DenseLu,
        _ => Solver::SparseCholesky,
    };
    let arithmetic = Arithmetic {
        scalar: ScalarName::Bounded,
        solver: Some(solver),
        inputs: solution.request.arithmetic.inputs,
        ..Arithmetic::default()
    };
    let request = Request { arithmetic, ..solution.request.clone() };
    let run = solve(&request, &mut |_| ()).ok()?;
    let bound = run.error_bound?;
    Some(run.u.map(|u| Bounded::new(u, bound)))
}

/// Solves the last contact state of `unilateral` again, under its friction, with a bound on each
/// displacement.
fn last_state(solution: &Solution) -> Option<DVector<Bounded>> {
    let model = &*solution.model;
    let constraints = solution.last().constraints.iter().map(|c| c.map(Bounded::from_f64));
    let constraints: Vec<_> = constraints.collect();
    let t = Elimination::closing(&model.restrained, &constraints);
    let stiffness = Stiffness::new(model, Bounded::from_f64);
    let Detail::Unilateral(detail) = &solution.last().detail else { return None };
    let load = model.free_part(&(&model.load + &detail.friction)).map(Bounded::from_f64);
    let (matrix, b) = (stiffness.reduced(&t), t.load(&(load - stiffness.times(t.shift()))));
    let factors = SparseCholesky::new(matrix.map(|a| a.to_f64())).ok()?;
    let x = factors.solve(&b.map(Scalar::to_f64));
    let bound = error_bound(&factors, matrix.both_triangles(), &b, &x);
    Some(t.expand(&x.map(|x| Bounded::new(x, bound))))
}

/// Returns, for each triangle, a bound on the error of its von Mises stress where displacements are
/// known to `displacement`, stress.
pub fn stress_bounds(solution: &Solution, displacement: f64) -> Vec<f64> {
    let model = &*solution.model;
    let u = solution.u.map(|u| Bounded::new(u, displacement));
    let stresses = Stiffness::new(model, Bounded::from_f64).stresses(&u);
    let triangles = model.triangles.iter().zip(&stresses).zip(&solution.elements);
    triangles
        .map(|((triangle, stress), state)| {
            let rounding = ROUNDINGS * f64::EPSILON / 2.0 * state.von_mises_stress;
            von_mises_bound(model, triangle.material.nu, stress) + rounding
        })
        .collect()
}

/// Returns the von Mises value of a stress's error bounds. The von Mises values of two stresses
/// differ by at most that of their difference, because it is a seminorm.
fn von_mises_bound(model: &Model, nu: f64, stress: &SVector<Bounded, 3>) -> f64 {
    let [x, y, xy] = [0, 1, 2].map(|k| stress[k].error());
    let z = match model.plane {
        Plane::Strain => nu.abs() * (x + y),
        Plane::Stress => 0.0,
    };
    let squares = (x + y).powi(2) + (y + z).powi(2) + (z + x).powi(2);
    (squares / 2.0 + 3.0 * xy * xy).sqrt()
}
