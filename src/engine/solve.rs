//! The solution of a request by the requested variant in the requested numbers.

use super::error::{Error, SingularMatrix};
use super::memory::{Bytes, FEWER_STEPS, bytes_of_paths};
use super::published::{check_published, published};
use super::request::Request;
use super::session::Session;
use super::solution::{Solution, Step};
use super::sparse::dense_matrices;
use super::unilateral::unilateral;
use base::error::InputError;
use base::memory;
use numbers::scalar::{self, Bounded, BoundedDouble, Exact, F64x2};
use numbers::solve::{Arithmetic, ScalarName, Solver, cost};
use paper::listings::Which;
use problem::element::State;
use problem::modelling::{Variant, check_iterations, check_tolerance};

/// Calls a function in the type of a scalar.
macro_rules! in_scalar {
    ($scalar:expr, $work:ident($($argument:expr),*)) => {
        match $scalar {
            ScalarName::F64 => $work::<f64>($($argument),*),
            ScalarName::F32 => $work::<f32>($($argument),*),
            ScalarName::F64x2 => $work::<F64x2>($($argument),*),
            ScalarName::Bounded => $work::<Bounded>($($argument),*),
            ScalarName::BoundedDouble => $work::<BoundedDouble>($($argument),*),
            ScalarName::Exact => scalar::scope(|| $work::<Exact>($($argument),*)),
        }
    };
}

/// Solves `request` in a session of its own ([`Session::solve`]).
///
/// # Errors
/// The errors of [`Session::solve`].
pub fn solve(request: &Request, watch: &mut dyn FnMut(&Step)) -> Result<Solution, Error> {
    Session::default().solve(request, watch)
}

impl Session {
    /// Solves `request`; `watch` is called after each step.
    ///
    /// # Errors
    /// A number that is asked for is out of its range; the published algorithm fails as printed; a
    /// matrix cannot be solved; a dense matrix does not fit in memory; the scalar does not have the
    /// solver; the scene is too large for exact numbers; or under `unilateral` contact and restraints
    /// do not restrain the bodies.
    pub fn solve(
        &self,
        request: &Request,
        watch: &mut dyn FnMut(&Step),
    ) -> Result<Solution, Error> {
        self.solve_while(request, &mut |step| {
            watch(step);
            true
        })
    }

    /// Solves `request`; under a variant that the paper describes it ends with the step after which
    /// `continues` is false.
    ///
    /// # Errors
    /// The errors of [`Session::solve`].
    pub(super) fn solve_while(
        &self,
        request: &Request,
        continues: &mut dyn FnMut(&Step) -> bool,
    ) -> Result<Solution, Error> {
        check_in(request, self)?;
        run(request, self, continues).map_err(|why| blamed(request, why))
    }
}

/// Checks what is known of a request before it runs.
///
/// # Errors
/// A number that is asked for is out of its range, the variant or the coupling does not run in the
/// scalar or by the solver, what is edited is not executed, the load vanishes in the scalar, or the run
/// does not fit in memory or in a bearable time.
pub fn check(request: &Request) -> Result<(), InputError> {
    check_in(request, &Session::default())
}

fn check_in(request: &Request, session: &Session) -> Result<(), InputError> {
    request.arithmetic.check()?;
    check_iterations(request.iterations)?;
    request.contact.check()?;
    request.tolerance.map_or(Ok(()), check_tolerance)?;
    check_edited(request)?;
    let model = request.model()?;
    match request.variant {
        Variant::Unilateral => check_unilateral(request)?,
        Variant::Printed | Variant::Tied | Variant::Stepped => {
            in_scalar!(request.arithmetic.scalar, check_published(request, &model))?;
        }
    }
    check_memory(request, session)
}

/// Checks that a run has the memory that it takes, with the runs beside it. Of runs that share
/// what was factored, one that takes no more than another is not checked again: what is no longer free
/// may be that one's.
///
/// # Errors
/// Says how much it needs where that is not free.
fn check_memory(request: &Request, session: &Session) -> Result<(), InputError> {
    let model = &request.scene.model;
    let path = bytes_of_paths(request, model);
    let whose =
        format!("{} steps of the load on {} nodes", request.contact.load_steps, model.nodes.len());
    memory::check_bytes(path, "contact.load_steps", &whose, FEWER_STEPS)?;
    let whose = format!("{} free equations", model.free_dofs());
    session.check_room(Bytes::estimate(request, model).total(), &whose)
}

/// Returns the error of a run, and where rounding alone is its cause says so: a matrix that is
/// singular to the digits of a scalar only is no fault of the print, nor is what `f32` cannot
/// represent, as the paper's worksheet computes in `f64`.
fn blamed(request: &Request, why: Error) -> Error {
    let Arithmetic { scalar, inputs, .. } = request.arithmetic;
    let rounded = match why {
        Error::Singular(_) => scalar != ScalarName::Exact,
        Error::Listing(_) => scalar == ScalarName::F32,
        Error::Input(_) | Error::Execution(_) | Error::Equilibrium(_) => false,
    };
    let more = more_precise(request).filter(|more| rounded && *more != scalar);
    let Some(more) = more else { return why };
    let arithmetic = Arithmetic { scalar: more, inputs, ..Arithmetic::default() };
    if let Error::Singular(singular) = &why
        && let Some(bytes) = dense_bytes(request, arithmetic)
    {
        return SingularMatrix { untried: Some(bytes), ..singular.clone() }.into();
    }
    let request = request.clone().arithmetic(arithmetic);
    match check(&request)
        .map_err(Error::from)
        .and_then(|()| run(&request, &Session::default(), &mut |_| true))
    {
        Ok(_) => {
            let what = format!("in {scalar} {why}; in {more} the run does not fail");
            InputError::new("scalar", what, format!("use {more}")).into()
        }
        Err(_) => why,
    }
}

/// Returns the bytes of the dense matrices in which a large run would be repeated: that takes too long.
/// None where it is repeated.
fn dense_bytes(request: &Request, arithmetic: Arithmetic) -> Option<f64> {
    /// The number of equations of a large one.
    const LARGE: usize = 3000;
    let model = &request.scene.model;
    // Each double-double is two numbers.
    let matrices = 2 * dense_matrices(request.variant, arithmetic);
    let is_repeated = model.free_dofs() <= LARGE || matrices == 0;
    (!is_repeated).then(|| memory::needed(model.nodes.len(), matrices) as f64)
}

/// Returns the scalar that tells whether rounding is at fault: exact numbers where they end in a
/// moment.
fn more_precise(request: &Request) -> Option<ScalarName> {
    /// The free equations whose exact solutions end in a moment.
    const FEW: usize = 50;
    let growing = request.reading.r5.follows_the_shape();
    let most = cost::most_equations(growing, request.iterations).min(FEW);
    let exact = request.scene.model.free_dofs() <= most;
    let more = if exact { ScalarName::Exact } else { ScalarName::F64x2 };
    (request.variant != Variant::Unilateral).then_some(more)
}

fn run(
    request: &Request,
    session: &Session,
    continues: &mut dyn FnMut(&Step) -> bool,
) -> Result<Solution, Error> {
    let solution = match request.variant {
        Variant::Unilateral => unilateral(request, session, &mut |step| _ = continues(step))?,
        Variant::Printed | Variant::Tied | Variant::Stepped => {
            in_scalar!(request.arithmetic.scalar, published(request, session, continues))?
        }
    };
    check_finite(&solution)?;
    Ok(solution)
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
        let known = step.max_displacement.into_iter().chain(step.target_force);
        (known.sum::<f64>() + step.contact_residual() + step.solve_residual).is_finite()
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
