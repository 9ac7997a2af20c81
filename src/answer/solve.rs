//! The solution of a request by the requested variant in the requested numbers.

use std::sync::Arc;

use super::error::Error;
use super::published::published;
use super::request::Request;
use super::solution::{Solution, Step};
use super::sparse::{Condensing, Sparse, Whole};
use super::unilateral::unilateral;
use crate::error::InputError;
use crate::numbers::scalar::{self, Bounded, BoundedDouble, Exact, F64x2};
use crate::numbers::solve::{ScalarName, Solver};
use crate::problem::element::State;
use crate::problem::model::Model;
use crate::problem::modelling::Variant;

/// Solves `request`; `watch` is called after each step.
///
/// # Errors
/// The published algorithm fails as printed; a matrix cannot be solved; a dense matrix does not fit
/// in memory; the scalar does not have the solver; the scene is too large for exact numbers; or
/// under `unilateral` contact and restraints do not restrain the bodies.
pub fn solve(request: &Request, watch: &mut dyn FnMut(&Step)) -> Result<Solution, Error> {
    request.arithmetic.check()?;
    let solution = match (request.variant, request.arithmetic.scalar) {
        (Variant::Unilateral, _) => {
            check_unilateral(request)?;
            unilateral(request, watch)?
        }
        (_, ScalarName::F64) => published::<f64>(request, Some(condensing), watch)?,
        (_, ScalarName::F32) => published::<f32>(request, Some(|_, _| Box::new(Whole)), watch)?,
        (_, ScalarName::F64x2) => published::<F64x2>(request, Some(condensing), watch)?,
        (_, ScalarName::Bounded) => published::<Bounded>(request, Some(condensing), watch)?,
        (_, ScalarName::BoundedDouble) => {
            published::<BoundedDouble>(request, Some(condensing), watch)?
        }
        (_, ScalarName::Exact) => scalar::scope(|| published::<Exact>(request, None, watch))?,
    };
    check_finite(&solution)?;
    Ok(solution)
}

fn condensing<T>(request: &Request, model: &Arc<Model>) -> Box<dyn Sparse<T>>
where
    Condensing: Sparse<T>,
{
    Box::new(Condensing::new(request, model))
}

/// Solves for the equilibrium under the scene's own friction: [`Request::equilibrium`].
///
/// # Errors
/// The errors of [`solve`].
pub fn equilibrium(request: &Request) -> Result<Solution, Error> {
    solve(&request.equilibrium(), &mut |_| ())
}

/// Checks that `unilateral` is requested in f64 by sparse Cholesky.
fn check_unilateral(request: &Request) -> Result<(), InputError> {
    let arithmetic = request.arithmetic;
    if arithmetic.scalar != ScalarName::F64 {
        let what =
            format!("unilateral does not run in {}: normals take square roots", arithmetic.scalar);
        return Err(InputError::new("--scalar", what, "use f64, or another variant"));
    }
    match arithmetic.solver {
        None | Some(Solver::SparseCholesky) => Ok(()),
        Some(other) => {
            let what = format!("unilateral does not solve by {other}");
            Err(InputError::new("--solver", what, "use sparse-cholesky, or another variant"))
        }
    }
}

/// Checks that every displacement, stress and strain can be represented.
fn check_finite(solution: &Solution) -> Result<(), InputError> {
    let of_element = |s: &State| (s.von_mises_stress + s.von_mises_strain).is_finite();
    let of_step = |step: &Step| {
        let sizes = [step.max_displacement, step.contact_residual(), step.target_force];
        (sizes.iter().sum::<f64>() + step.solve_residual).is_finite()
    };
    if solution.u.iter().all(|x| x.is_finite())
        && solution.elements.iter().all(of_element)
        && solution.steps.iter().all(of_step)
    {
        return Ok(());
    }
    let what = "the displacements or stresses are too large to represent";
    Err(InputError::new("loads, materials, mesh", what, "choose other units"))
}
