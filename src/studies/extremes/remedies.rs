//! Well-known remedies, applied to a scene from outside: the mirror keeps the printed formulas.

use super::answer::{Quantity, solve};
use super::precision::{BlocksOf, carried};
use super::sweep::Method;
use super::verdict::Verdict;
use crate::numbers::solve::ScalarName;
use crate::problem::modelling::Variant;
use crate::problem::scene::SceneBuilder;

/// The power of two at or below |x|, which divides without rounding; 1 of what has none.
pub fn power_of_two(x: f64) -> f64 {
    if x == 0.0 || !x.is_finite() {
        1.0
    } else {
        2f64.powi(x.abs().log2().floor().clamp(-1000.0, 1000.0) as i32)
    }
}

/// `tied` with the first node moved to the origin, in f64, before anything is rounded to the
/// scalar.
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
        let pressure =
            scene.description.loads[0].pressure.as_mut().expect("the load is a pressure");
        let unit = power_of_two(*pressure);
        *pressure /= unit;
        unit
    })
}

/// `tied` on a scene that `change` changes; it returns the unit in which displacements come out.
fn remedied(
    name: &str,
    scalar: ScalarName,
    blocks: BlocksOf,
    change: fn(&mut SceneBuilder) -> f64,
) -> Method {
    Method::new(format!("tied {scalar}, {name}"), carried(scalar), move |x| {
        let scene = blocks(x).scene(Variant::Tied);
        let mut changed = scene.clone();
        let unit = change(&mut changed);
        run(&changed, unit, &scene, scalar)
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

/// Displacements of `changed`, times `unit`, against the exact ones of `scene`.
fn run(changed: &SceneBuilder, unit: f64, scene: &SceneBuilder, scalar: ScalarName) -> Verdict {
    match solve(changed, Variant::Tied, scalar, None) {
        Err(error) => error.into(),
        Ok(answer) => {
            let exact = |scene| solve(scene, Variant::Tied, ScalarName::Exact, None);
            // The scene itself is refused where its areas leave the range of f64; the changed one
            // has the same exact answer.
            match exact(scene).or_else(|_| exact(changed).map(|exact| exact.times(unit))) {
                Ok(exact) => answer.times(unit).against(&exact, Quantity::Displacement),
                Err(error) => error.into(),
            }
        }
    }
}
