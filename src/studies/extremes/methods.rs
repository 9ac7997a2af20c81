//! What a generator tries on its blocks: a variant in scalars of every precision, and well-known
//! remedies, applied to a scene from outside: the mirror keeps the printed formulas.

use std::sync::Arc;

use super::answer::{Answer, Quantity, solve};
use super::blocks::BlocksOf;
use super::sweep::Method;
use numbers::solve::{ScalarName, Solver};
use problem::modelling::Variant;
use problem::scene::SceneBuilder;

/// Single precision, 7 digits.
pub const SINGLE: ScalarName = ScalarName::F32;
/// Double precision, 16 digits.
pub const DOUBLE: ScalarName = ScalarName::F64;
pub const SCALARS: [ScalarName; 3] = [SINGLE, DOUBLE, ScalarName::F64x2];

/// Displacements of the variants that join the bodies: `tied` in each scalar, `unilateral` in f64.
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
    run(format!("{variant} {scalar}"), variant, (scalar, None), Answer::displacement, blocks)
}

/// A run of `variant` in a scalar, by its own solver unless another is given, against the exact run
/// of the same inputs.
pub fn run(
    name: String,
    variant: Variant,
    (scalar, solver): (ScalarName, Option<Solver>),
    quantity: Quantity,
    blocks: BlocksOf,
) -> Method {
    Method::new(name, scalar, move |x, exacts| {
        let scene = blocks(x).scene(variant);
        let answer = solve(&scene, variant, scalar, solver)?;
        Ok(exacts.judge(&answer, &scene, variant, quantity))
    })
}

/// The power of two at or below |x|, which divides without rounding; 1 of what has none.
pub fn power_of_two(x: f64) -> f64 {
    if x == 0.0 || !x.is_finite() {
        1.0
    } else {
        2f64.powi(x.abs().log2().floor().clamp(-1000.0, 1000.0) as i32)
    }
}

/// `tied` with the first node moved to the origin, in f64, before rounding to the scalar.
pub fn shifted(scalar: ScalarName, blocks: BlocksOf) -> Method {
    remedied("origin shifted", scalar, blocks, |scene| {
        let first = scene.mesh.xy(1);
        change_coordinates(scene, |axis, x| x - first[axis]);
        1.0
    })
}

/// `tied` with lengths in a unit of their own size.
pub fn length_scaled(scalar: ScalarName, blocks: BlocksOf) -> Method {
    remedied("lengths scaled", scalar, blocks, |scene| {
        let unit = power_of_two(scene.mesh.xy(2)[0]);
        change_coordinates(scene, |_, x| x / unit);
        if let Some(contact) = &mut scene.description.contact {
            contact.tolerance /= unit;
        }
        unit
    })
}

/// `tied` with the load in a unit of its own size: what one iteration computes is linear.
pub fn load_scaled(scalar: ScalarName, blocks: BlocksOf) -> Method {
    remedied("loads scaled", scalar, blocks, |scene| {
        let [pressure] = scene.description.loads[0].kind.numbers() else {
            panic!("the load is a pressure")
        };
        let unit = power_of_two(*pressure);
        *pressure /= unit;
        unit
    })
}

/// Displacements of `tied` on a scene that `change` changes, times the unit that it returns,
/// against the exact ones of the scene as it was.
fn remedied(
    name: &str,
    scalar: ScalarName,
    blocks: BlocksOf,
    change: fn(&mut SceneBuilder) -> f64,
) -> Method {
    Method::new(format!("tied {scalar}, {name}"), scalar, move |x, exacts| {
        let scene = blocks(x).scene(Variant::Tied);
        let mut changed = scene.clone();
        let unit = change(&mut changed);
        let tied = |scalar| solve(&changed, Variant::Tied, scalar, None);
        let answer = tied(scalar)?.times(unit);
        let exact = match exacts.answer(&scene, Variant::Tied) {
            Ok(exact) => exact,
            // The scene itself is refused where its areas leave the range of f64; the changed one
            // has the same exact answer.
            Err(_) => Arc::new(tied(ScalarName::Exact)?.times(unit)),
        };
        Ok(answer.against(&exact, Answer::displacement))
    })
}

/// Replaces each coordinate in the plane by what `of` makes of its axis and it, length.
fn change_coordinates(scene: &mut SceneBuilder, of: impl Fn(usize, f64) -> f64) {
    for node in &mut scene.mesh.nodes {
        for axis in [0, 1] {
            node.xyz[axis] = of(axis, node.xyz[axis]);
        }
    }
}
