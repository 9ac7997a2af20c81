//! The solution of a request by the requested variant in the requested numbers.

use super::error::{Error, too_large};
use super::published::{check_published, published};
use super::request::Request;
use super::solution::{Solution, Step};
use super::unilateral::unilateral;
use crate::linear::{ScalarName, Solver};
use base::error::InputError;
use base::limits;
use numbers::scalar::{self, Exact, F64x2};
use paper::door;
use paper::listings::Which;
use problem::element::State;
use problem::modelling::{Friction, Variant, check_iterations, check_tolerance};

/// Calls a function in the type of a scalar.
macro_rules! in_scalar {
    ($scalar:expr, $work:ident($($argument:expr),*)) => {
        match $scalar {
            ScalarName::F64 => $work::<f64>($($argument),*),
            ScalarName::F32 => $work::<f32>($($argument),*),
            ScalarName::F64x2 => $work::<F64x2>($($argument),*),
            ScalarName::Exact => scalar::scope(|| $work::<Exact>($($argument),*)),
        }
    };
}

/// Solves `request`; `watch` is called after each step.
///
/// # Errors
/// A number that is asked for is out of its range; the published algorithm fails as printed; a
/// matrix cannot be solved; a dense matrix does not fit in memory; the scalar does not have the
/// solver; the scene is too large for exact numbers; or under `unilateral` contact and restraints
/// do not restrain the bodies.
pub fn solve(request: &Request, watch: &mut dyn FnMut(&Step)) -> Result<Solution, Error> {
    check(request)?;
    let solution = match request.variant {
        Variant::Unilateral => unilateral(request, watch),
        Variant::Printed | Variant::Tied | Variant::Stepped => {
            let solved = in_scalar!(request.arithmetic.scalar, published(request, watch));
            solved.map_err(|why| blamed(request, why))
        }
    };
    let solution = solution.map_err(|why| why.hinting(request.scene.slits()))?;
    check_finite(&solution)?;
    Ok(solution)
}

/// Returns the error of a run by what is at fault. Of a scalar with fewer digits than the paper's worksheets
/// have, no failure is one of the print; nor is a singular matrix of an edited listing where that of the
/// print is none.
fn blamed(request: &Request, why: Error) -> Error {
    let scalar = request.arithmetic.scalar;
    let is_coarser = scalar.properties().digits < ScalarName::F64.properties().digits;
    let as_printed = Request { edited: Vec::new(), ..request.clone() };
    match why {
        Error::Singular(_) | Error::Listing(_) if is_coarser && !scalar.is_exact() => {
            let what = format!("in {scalar} {why}; {scalar} cannot represent what f64 does");
            InputError::new("scalar", what, "use f64, as the paper's worksheets do").into()
        }
        Error::Singular(matrix)
            if !request.edited.is_empty()
                && !matches!(solve(&as_printed, &mut |_| ()), Err(Error::Singular(_))) =>
        {
            let places: Vec<&str> = request.edited.iter().map(|own| own.place.as_str()).collect();
            let fix = "correct the edited listing";
            InputError::new(places.join(" and "), matrix.to_string(), fix).into()
        }
        other => other,
    }
}

/// Checks what is known of a request before it runs.
///
/// # Errors
/// A number that is asked for is out of its range, the variant or the coupling does not run in the
/// scalar or by the solver, what is edited is not executed, the load vanishes in the scalar, or the run
/// does not fit in memory or in a bearable time.
pub fn check(request: &Request) -> Result<(), InputError> {
    request.arithmetic.check()?;
    check_iterations(request.iterations)?;
    request.contact.check()?;
    request.tolerance.map_or(Ok(()), check_tolerance)?;
    check_edited(request)?;
    let model = request.model()?;
    match request.variant {
        Variant::Unilateral => check_unilateral(request)?,
        Variant::Printed | Variant::Tied | Variant::Stepped => {
            door::check_restraints(&model)?;
            in_scalar!(request.arithmetic.scalar, check_published(request, &model))?;
        }
    }
    check_size(request)
}

/// Checks that the mesh, and the path of the load of the run or of the equilibrium beside it, have a size
/// that fits in memory.
///
/// # Errors
/// Says what there is more of than there may be.
fn check_size(request: &Request) -> Result<(), InputError> {
    let model = &request.scene.model;
    limits::EQUATIONS.check(model.free_dofs(), "the mesh")?;
    if !model.has_contact() || request.contact.friction == Friction::NONE {
        return Ok(());
    }
    let steps = request.contact.load_steps * model.stages.len();
    limits::check_steps(steps, model.nodes.len(), "contact.load_steps")
}

/// Checks that a run with edited listings executes them: in f64, as the interpreter does, and an
/// edited `Km`, whose matrix need not be symmetric, by LU.
fn check_edited(request: &Request) -> Result<(), InputError> {
    let Request { variant, contact, arithmetic, .. } = request;
    let [c_cnt, km] = [Which::CCnt, Which::Km].map(|which| request.is_edited(which));
    if !c_cnt && !km {
        return Ok(());
    }
    let (place, what, fix) = if *variant == Variant::Unilateral {
        let what = "unilateral executes no listing".into();
        ("edited listing", what, "ask for printed, tied or stepped")
    } else if arithmetic.scalar != ScalarName::F64 {
        let what = format!("an edited listing is not executed in {}", arithmetic.scalar);
        ("scalar", what, "leave it out")
    } else if c_cnt && !request.decides_by_listing() {
        ("status", format!("under the rule {} c_cnt is not called", contact.status), "leave it out")
    } else if km && !matches!(request.solver(), Solver::DenseLu | Solver::SparseLu) {
        let what = format!("{} does not solve what an edited Km builds", request.solver());
        ("solver", what, "use sparse-lu or dense-lu")
    } else {
        return Ok(());
    };
    Err(InputError::new(place, what, fix))
}

/// Checks that `unilateral` is requested in f64 by sparse Cholesky.
fn check_unilateral(request: &Request) -> Result<(), InputError> {
    let arithmetic = request.arithmetic;
    if arithmetic.scalar != ScalarName::F64 {
        let what =
            format!("unilateral does not run in {}: normals take square roots", arithmetic.scalar);
        return Err(InputError::new("scalar", what, "use f64, or another variant"));
    }
    match arithmetic.solver {
        None | Some(Solver::SparseCholesky) => Ok(()),
        Some(other) => {
            let what = format!("unilateral does not solve by {other}");
            Err(InputError::new("solver", what, "use sparse-cholesky, or another variant"))
        }
    }
}

/// Checks that every displacement, stress and strain can be represented.
fn check_finite(solution: &Solution) -> Result<(), InputError> {
    let of_element = |s: &State| (s.von_mises_stress + s.von_mises_strain).is_finite();
    let of_step = |step: &Step| {
        let known = step.max_displacement + step.target_force;
        (known + step.contact_residual + step.solve_residual).is_finite()
    };
    if solution.u.iter().all(|x| x.is_finite())
        && solution.elements.iter().all(of_element)
        && solution.steps.iter().all(of_step)
    {
        return Ok(());
    }
    Err(too_large())
}
