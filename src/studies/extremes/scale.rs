//! Generators of size and place: coordinates far from the origin, lengths and loads of any size,
//! slivers, many iterations.

use std::sync::Arc;

use super::answer::{Answer, solve};
use super::blocks::{Blocks, BlocksOf};
use super::methods::{
    DOUBLE, SCALARS, SINGLE, in_each_scalar, in_scalar, joined, length_scaled, load_scaled, run,
    shifted,
};
use super::sweep::{Generator, Method, Sweep};
use numbers::solve::ScalarName;
use problem::modelling::Variant;

pub fn offset() -> Generator {
    fn twice(origin: f64) -> Blocks {
        Blocks { origin, iterations: 2, ..Blocks::default() }
    }
    let once: BlocksOf = |origin| Blocks { origin, ..Blocks::default() };
    let others = vec![
        in_scalar(Variant::Printed, DOUBLE, once),
        shifted(SINGLE, twice),
        shifted(DOUBLE, twice),
        Method::new("exact, but for the input's rounding", DOUBLE, |origin, exacts| {
            let scene = |origin| twice(origin).scene(Variant::Tied);
            let judge = |moved: Arc<Answer>| {
                exacts.judge(&moved, &scene(0.0), Variant::Tied, Answer::displacement)
            };
            Ok(exacts.answer(&scene(origin), Variant::Tied).map_or_else(|refused| refused, judge))
        }),
    ];
    Generator::new(
        "offset",
        "Coordinates moved off the origin: against exact numbers on the moved scene, and that \
         against the scene unmoved",
        "distance from the origin / edge length",
        Sweep::Decades { from: 0, to: 16, step: 1 },
        [joined(twice), others],
    )
}

pub fn lengths() -> Generator {
    let blocks = |length| Blocks { length, c_tll: 1e-3 * length, ..Blocks::default() };
    of_any_size("lengths", "Lengths of any size", "length unit", blocks, length_scaled)
}

/// Loads; one iteration, which is linear in them.
pub fn loads() -> Generator {
    let blocks = |pressure| Blocks { pressure, ..Blocks::default() };
    of_any_size("loads", "Loads of any size, one iteration", "pressure", blocks, load_scaled)
}

/// The variants that join the bodies, `printed` in `f64`, and a remedy.
fn of_any_size(
    name: &'static str,
    title: &'static str,
    magnitude: &'static str,
    blocks: BlocksOf,
    remedy: fn(ScalarName, BlocksOf) -> Method,
) -> Generator {
    let printed = in_scalar(Variant::Printed, DOUBLE, blocks);
    let others = vec![printed, remedy(SINGLE, blocks), remedy(DOUBLE, blocks)];
    let sweep = Sweep::Decades { from: -300, to: 300, step: 20 };
    Generator::new(name, title, magnitude, sweep, [joined(blocks), others])
}

/// Two triangles of ever smaller angle.
pub fn slivers() -> Generator {
    let blocks: BlocksOf = |height| Blocks { sliver: Some(height), ..Blocks::default() };
    // Stresses leave a run as `f64`.
    let mises = |scalar: ScalarName| {
        let name = format!("tied {scalar}, von Mises");
        run(name, Variant::Tied, (scalar, None), Answer::mises, blocks).carrying(16.0)
    };
    Generator::new(
        "slivers",
        "A triangle pressed flat",
        "height / length of the triangle",
        Sweep::Decades { from: -18, to: 0, step: 1 },
        [
            in_each_scalar(Variant::Tied, blocks),
            SCALARS.map(mises).into(),
            vec![in_scalar(Variant::Unilateral, DOUBLE, blocks)],
        ],
    )
}

/// The load in many steps; contact does not change, so that one step has the exact answer.
pub fn iterations() -> Generator {
    fn blocks(steps: f64) -> Blocks {
        Blocks { iterations: steps.round() as usize, ..Blocks::default() }
    }
    let drift = |variant: Variant, scalar: ScalarName| {
        Method::new(format!("{variant} {scalar}"), scalar, move |steps, exacts| {
            let answer = solve(&blocks(steps).scene(variant), variant, scalar, None)?;
            let once = blocks(1.0).scene(Variant::Tied);
            Ok(exacts.judge(&answer, &once, Variant::Tied, Answer::displacement))
        })
    };
    let stepped = SCALARS.map(|scalar| drift(Variant::Stepped, scalar));
    Generator::new(
        "iterations",
        "Drift over many iterations",
        "iterations",
        Sweep::Decades { from: 0, to: 4, step: 1 },
        [stepped.into(), vec![drift(Variant::Tied, DOUBLE)]],
    )
}
