//! Generators of size and place: coordinates far from the origin, lengths and loads of any size,
//! slivers, many iterations.

use super::Generator;
use super::answer::{Quantity, solve};
use super::blocks::Blocks;
use super::precision::{
    BlocksOf, DOUBLE, SCALARS, SINGLE, carried, in_each_scalar, in_scalar, joined, mises,
};
use super::remedies::{length_scaled, load_scaled, shifted};
use super::sweep::{Method, Sweep};
use super::verdict::Verdict;
use crate::numbers::solve::ScalarName;
use crate::problem::modelling::Variant;

/// Coordinates moved off the origin.
pub fn offset() -> Generator {
    fn once(origin: f64) -> Blocks {
        Blocks { origin, ..Blocks::default() }
    }
    fn twice(origin: f64) -> Blocks {
        Blocks { iterations: 2, ..once(origin) }
    }
    let mut methods = joined(twice);
    methods.push(in_scalar(Variant::Printed, DOUBLE, once));
    methods.extend([SINGLE, DOUBLE].map(|scalar| shifted(scalar, twice)));
    methods.push(Method::new("exact, but for the input's rounding", 16.0, |origin| {
        beside_exact(&twice(origin), Variant::Tied, ScalarName::Exact, &twice(0.0))
    }));
    Generator {
        name: "offset",
        title: "Coordinates moved off the origin: against exact numbers on the moved scene, and \
                that against the scene unmoved",
        magnitude: "distance from the origin / edge length",
        sweep: Sweep::Decades { from: 0, to: 16, step: 1, start: 0 },
        methods,
    }
}

/// Compares `variant` in `scalar` on `blocks` with the exact `tied` run on others.
fn beside_exact(blocks: &Blocks, variant: Variant, scalar: ScalarName, others: &Blocks) -> Verdict {
    let answer = solve(&blocks.scene(variant), variant, scalar, None);
    let exact = solve(&others.scene(Variant::Tied), Variant::Tied, ScalarName::Exact, None);
    match (answer, exact) {
        (Ok(answer), Ok(exact)) => answer.against(&exact, Quantity::Displacement),
        (Err(error), _) | (_, Err(error)) => error.into(),
    }
}

/// Lengths, the tolerance among them.
pub fn lengths() -> Generator {
    fn blocks(length: f64) -> Blocks {
        Blocks { length, c_tll: 1e-3 * length, ..Blocks::default() }
    }
    let mut methods = of_any_size(blocks);
    methods.extend([SINGLE, DOUBLE].map(|scalar| length_scaled(scalar, blocks)));
    Generator {
        name: "lengths",
        title: "Lengths of any size",
        magnitude: "length unit",
        sweep: Sweep::Decades { from: -300, to: 300, step: 20, start: 0 },
        methods,
    }
}

/// Loads; one iteration, which is linear in them.
pub fn loads() -> Generator {
    fn blocks(pressure: f64) -> Blocks {
        Blocks { pressure, ..Blocks::default() }
    }
    let mut methods = of_any_size(blocks);
    methods.extend([SINGLE, DOUBLE].map(|scalar| load_scaled(scalar, blocks)));
    Generator {
        name: "loads",
        title: "Loads of any size, one iteration",
        magnitude: "pressure",
        sweep: Sweep::Decades { from: -300, to: 300, step: 20, start: 0 },
        methods,
    }
}

/// The variants that join the bodies, and `printed` in `f64`.
fn of_any_size(blocks: BlocksOf) -> Vec<Method> {
    let mut methods = joined(blocks);
    methods.push(in_scalar(Variant::Printed, DOUBLE, blocks));
    methods
}

/// Two triangles of ever smaller angle.
pub fn slivers() -> Generator {
    fn blocks(height: f64) -> Blocks {
        Blocks { sliver: Some(height), ..Blocks::default() }
    }
    let mut methods = in_each_scalar(Variant::Tied, blocks);
    methods.extend(SCALARS.map(|scalar| mises(Variant::Tied, scalar, blocks)));
    methods.push(in_scalar(Variant::Unilateral, DOUBLE, blocks));
    Generator {
        name: "slivers",
        title: "A triangle pressed flat",
        magnitude: "height / length of the triangle",
        sweep: Sweep::Decades { from: -18, to: 0, step: 1, start: 0 },
        methods,
    }
}

/// The load in many steps; contact does not change, so that one step has the exact answer.
pub fn iterations() -> Generator {
    fn blocks(steps: f64) -> Blocks {
        Blocks { iterations: steps.round() as usize, ..Blocks::default() }
    }
    let drift = |variant: Variant, scalar: ScalarName| {
        Method::new(format!("{variant} {scalar}"), carried(scalar), move |steps| {
            beside_exact(&blocks(steps), variant, scalar, &blocks(1.0))
        })
    };
    let mut methods: Vec<Method> = SCALARS.map(|scalar| drift(Variant::Stepped, scalar)).into();
    methods.push(drift(Variant::Tied, DOUBLE));
    Generator {
        name: "iterations",
        title: "Drift over many iterations",
        magnitude: "iterations",
        sweep: Sweep::Decades { from: 0, to: 4, step: 1, start: 0 },
        methods,
    }
}
