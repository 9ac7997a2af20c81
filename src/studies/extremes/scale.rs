//! Generators of size and place: coordinates far from the origin, lengths and loads of any size, slivers, many iterations.

use serde_json::Value;

use super::Generator;
use super::answer::{Answer, Quantity, solve};
use super::blocks::Blocks;
use super::ladder::{SCALARS, carried, ladder, mises, rung};
use super::remedies::{length_scaled, load_scaled, shifted};
use super::sweep::{Sweep, Way};
use super::verdict::Verdict;
use crate::answer::error::Error;
use crate::numbers::solve::ScalarName;
use crate::problem::modelling::Variant;

const SINGLE: ScalarName = ScalarName::F32;
const DOUBLE: ScalarName = ScalarName::F64;

/// Coordinates moved off the origin.
pub fn offset() -> Generator {
    fn scene(origin: f64) -> Value {
        Blocks { origin, iterations: 2, ..Blocks::default() }.json()
    }
    fn held(origin: f64) -> Value {
        Blocks { origin, held: true, ..Blocks::default() }.json()
    }
    let mut ways = ladder(Variant::Tied, scene);
    ways.push(rung(Variant::Unilateral, DOUBLE, scene));
    ways.push(rung(Variant::Printed, DOUBLE, held));
    ways.extend([SINGLE, DOUBLE].map(|scalar| shifted(scalar, scene)));
    ways.push(Way::new("exact, but for the input's rounding", 16.0, |origin| {
        moved(&scene(origin), &scene(0.0))
    }));
    Generator {
        name: "offset",
        title: "Coordinates moved off the origin: against exact numbers on the moved scene, and that against the scene unmoved",
        magnitude: "distance from the origin / edge length",
        sweep: Sweep::Decades { from: 0, to: 16, step: 1, start: 0 },
        ways,
    }
}

/// The exact answer of the moved scene against that of the scene at the origin.
fn moved(moved: &Value, home: &Value) -> Verdict {
    let exact = |json: &Value| solve(json, Variant::Tied, ScalarName::Exact, None);
    match (exact(moved), exact(home)) {
        (Ok(moved), Ok(home)) => moved.against(&home, Quantity::Displacement),
        (Err(error), _) | (_, Err(error)) => error.into(),
    }
}

/// Lengths, the tolerance among them.
pub fn lengths() -> Generator {
    fn scene(length: f64) -> Value {
        Blocks { length, c_tll: 1e-3 * length, ..Blocks::default() }.json()
    }
    fn held(length: f64) -> Value {
        Blocks { length, c_tll: 1e-3 * length, held: true, ..Blocks::default() }.json()
    }
    let mut ways = ladder(Variant::Tied, scene);
    ways.push(rung(Variant::Unilateral, DOUBLE, scene));
    ways.push(rung(Variant::Printed, DOUBLE, held));
    ways.extend([SINGLE, DOUBLE].map(|scalar| length_scaled(scalar, scene)));
    Generator {
        name: "lengths",
        title: "Lengths of any size",
        magnitude: "length unit",
        sweep: Sweep::Decades { from: -300, to: 300, step: 20, start: 0 },
        ways,
    }
}

/// Loads; one iteration, which is linear in them.
pub fn loads() -> Generator {
    fn scene(pressure: f64) -> Value {
        Blocks { pressure, ..Blocks::default() }.json()
    }
    fn held(pressure: f64) -> Value {
        Blocks { pressure, held: true, ..Blocks::default() }.json()
    }
    let mut ways = ladder(Variant::Tied, scene);
    ways.push(rung(Variant::Unilateral, DOUBLE, scene));
    ways.push(rung(Variant::Printed, DOUBLE, held));
    ways.extend([SINGLE, DOUBLE].map(|scalar| load_scaled(scalar, scene)));
    Generator {
        name: "loads",
        title: "Loads of any size, one iteration",
        magnitude: "pressure",
        sweep: Sweep::Decades { from: -300, to: 300, step: 20, start: 0 },
        ways,
    }
}

/// Two triangles of ever smaller angle.
pub fn slivers() -> Generator {
    fn scene(height: f64) -> Value {
        Blocks { sliver: Some(height), ..Blocks::default() }.json()
    }
    let mut ways = ladder(Variant::Tied, scene);
    ways.extend(SCALARS.map(|scalar| mises(Variant::Tied, scalar, scene)));
    ways.push(rung(Variant::Unilateral, DOUBLE, scene));
    Generator {
        name: "slivers",
        title: "A triangle pressed flat",
        magnitude: "height / length of the triangle",
        sweep: Sweep::Decades { from: -18, to: 0, step: 1, start: 0 },
        ways,
    }
}

/// The load in many steps; contact does not change, so that one step has the exact answer.
pub fn iterations() -> Generator {
    fn scene(steps: f64) -> Value {
        Blocks { iterations: steps.round() as usize, ..Blocks::default() }.json()
    }
    let drift = |variant: Variant, scalar: ScalarName| {
        Way::new(format!("{variant} {scalar}"), carried(scalar), move |steps| {
            match (solve(&scene(steps), variant, scalar, None), one_step(&scene(1.0))) {
                (Ok(answer), Ok(exact)) => answer.against(&exact, Quantity::Displacement),
                (Err(error), _) | (_, Err(error)) => error.into(),
            }
        })
    };
    let mut ways: Vec<Way> = SCALARS.map(|scalar| drift(Variant::Stepped, scalar)).into();
    ways.push(drift(Variant::Tied, DOUBLE));
    Generator {
        name: "iterations",
        title: "Drift over many iterations",
        magnitude: "iterations",
        sweep: Sweep::Decades { from: 0, to: 4, step: 1, start: 0 },
        ways,
    }
}

/// The exact answer of one iteration.
fn one_step(json: &Value) -> Result<Answer, Error> {
    solve(json, Variant::Tied, ScalarName::Exact, None)
}
