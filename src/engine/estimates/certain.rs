//! A run in numbers in which rounding does not decide who is in contact.

use schemars::JsonSchema;
use serde::Serialize;

use super::arithmetic::decides_nothing;
use crate::{Request, Session, Solution, Step};
use numbers::solve::{Arithmetic, ScalarName};
use problem::modelling::Variant;

/// Whether rounding decides who is in contact.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Certainty {
    /// It decides nothing.
    Certain,
    /// It may decide in the numbers asked for, and decides nothing in the double-doubles in which
    /// the run was repeated.
    InDoubleDouble,
    /// It may decide, or whether it does is not known.
    Unknown,
}

/// Returns the solution itself where rounding decides nothing in it, else that of the same request in
/// double-doubles where it decides nothing there, and which of the two it is. Under `unilateral`,
/// which has no other numbers, the solution stays as it is.
pub fn certain(solution: Solution, session: &Session) -> (Solution, Certainty) {
    if decides_nothing(&solution, session) {
        return (solution, Certainty::Certain);
    }
    if solution.request.variant == Variant::Unilateral {
        return (solution, Certainty::Unknown);
    }
    let arithmetic = Arithmetic {
        scalar: ScalarName::BoundedDouble,
        solver: None,
        tol: None,
        ..solution.request.arithmetic
    };
    let request = Request { arithmetic, ..solution.request.clone() };
    match session.solve_while(&request, &mut Step::is_certain) {
        Ok(again) if again.error_bound.is_some_and(f64::is_finite) => {
            (again, Certainty::InDoubleDouble)
        }
        _ => (solution, Certainty::Unknown),
    }
}
