//! One variant on every scalar, against the exact run of the same inputs.

use serde_json::Value;

use super::answer::{Quantity, against_exact};
use super::sweep::Way;
use crate::numbers::solve::{ScalarName, Solver};
use crate::problem::modelling::Variant;

/// A scene by its magnitude.
pub type SceneOf = fn(f64) -> Value;

/// The scalars side by side.
pub const SCALARS: [ScalarName; 3] = [ScalarName::F32, ScalarName::F64, ScalarName::F64x2];

/// Decimal digits that a scalar carries.
pub fn carried(scalar: ScalarName) -> f64 {
    match scalar {
        ScalarName::F32 => 7.0,
        ScalarName::F64x2 => 31.0,
        _ => 16.0,
    }
}

/// Displacements of `variant` in each scalar.
pub fn ladder(variant: Variant, scene: SceneOf) -> Vec<Way> {
    SCALARS.into_iter().map(|scalar| rung(variant, scalar, scene)).collect()
}

/// Displacements of `variant` in one scalar.
pub fn rung(variant: Variant, scalar: ScalarName, scene: SceneOf) -> Way {
    Way::new(format!("{variant} {scalar}"), carried(scalar), move |x| {
        against_exact(&scene(x), variant, scalar, None, Quantity::Displacement)
    })
}

/// The same by a solver that is not the scalar's own.
pub fn solved_by(variant: Variant, solver: Solver, scene: SceneOf) -> Way {
    Way::new(format!("{variant} f64 {solver}"), 16.0, move |x| {
        against_exact(&scene(x), variant, ScalarName::F64, Some(solver), Quantity::Displacement)
    })
}

/// Von Mises stresses of `variant` in one scalar; they leave a run as `f64`.
pub fn mises(variant: Variant, scalar: ScalarName, scene: SceneOf) -> Way {
    Way::new(format!("{variant} {scalar}, von Mises"), carried(scalar).min(16.0), move |x| {
        against_exact(&scene(x), variant, scalar, None, Quantity::Mises)
    })
}
