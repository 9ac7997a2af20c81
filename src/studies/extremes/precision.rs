//! One variant in scalars of every precision, against the exact run of the same inputs.

use super::answer::{Quantity, against_exact};
use super::blocks::Blocks;
use super::sweep::Method;
use crate::numbers::solve::{ScalarName, Solver};
use crate::problem::modelling::Variant;

/// The blocks of a magnitude.
pub type BlocksOf = fn(f64) -> Blocks;

/// Single and double precision.
pub const SINGLE: ScalarName = ScalarName::F32;
pub const DOUBLE: ScalarName = ScalarName::F64;

/// The scalars that are compared.
pub const SCALARS: [ScalarName; 3] = [SINGLE, DOUBLE, ScalarName::F64x2];

/// Decimal digits that a scalar carries.
pub fn carried(scalar: ScalarName) -> f64 {
    match scalar {
        ScalarName::F32 => 7.0,
        ScalarName::F64x2 => 31.0,
        _ => 16.0,
    }
}

/// Displacements of the variants that join the bodies: `tied` in each scalar, `unilateral` in
/// `f64`.
pub fn joined(blocks: BlocksOf) -> Vec<Method> {
    let mut methods = in_each_scalar(Variant::Tied, blocks);
    methods.push(in_scalar(Variant::Unilateral, DOUBLE, blocks));
    methods
}

/// Displacements of `variant` in each scalar.
pub fn in_each_scalar(variant: Variant, blocks: BlocksOf) -> Vec<Method> {
    SCALARS.into_iter().map(|scalar| in_scalar(variant, scalar, blocks)).collect()
}

/// Displacements of `variant` in one scalar.
pub fn in_scalar(variant: Variant, scalar: ScalarName, blocks: BlocksOf) -> Method {
    Method::new(format!("{variant} {scalar}"), carried(scalar), move |x| {
        let scene = blocks(x).scene(variant);
        against_exact(&scene, variant, scalar, None, Quantity::Displacement)
    })
}

/// Displacements of `variant` in `f64`, by a solver that is not the scalar's own.
pub fn solved_by(variant: Variant, solver: Solver, blocks: BlocksOf) -> Method {
    Method::new(format!("{variant} f64 {solver}"), 16.0, move |x| {
        let (scene, displacement) = (blocks(x).scene(variant), Quantity::Displacement);
        against_exact(&scene, variant, DOUBLE, Some(solver), displacement)
    })
}

/// Von Mises stresses of `variant` in one scalar; they leave a run as `f64`.
pub fn mises(variant: Variant, scalar: ScalarName, blocks: BlocksOf) -> Method {
    Method::new(format!("{variant} {scalar}, von Mises"), carried(scalar).min(16.0), move |x| {
        against_exact(&blocks(x).scene(variant), variant, scalar, None, Quantity::Mises)
    })
}
