//! Generators of materials: moduli far apart, Poisson's ratio at its ends, the unit diagonal.

use std::f64::consts::FRAC_1_SQRT_2;

use serde_json::Value;

use super::answer::{Quantity, compared, solve};
use super::blocks::Blocks;
use super::ladder::{carried, ladder, rung, solved_by};
use super::sweep::{Sweep, Way};
use super::verdict::Verdict;
use super::{Generator, remedies};
use crate::answer::contact::run;
use crate::answer::error::Error;
use crate::numbers::solve::{ScalarName, Solver};
use crate::paper::mirror::Reading;
use crate::problem::modelling::Variant;
use crate::studies::benchmark::Annulus;

const DOUBLE: ScalarName = ScalarName::F64;

/// E of the stamp over E of the block.
pub fn moduli() -> Generator {
    fn scene(ratio: f64) -> Value {
        Blocks { e: [30000.0, 30000.0 * ratio], ..Blocks::default() }.json()
    }
    fn held(ratio: f64) -> Value {
        Blocks { e: [30000.0, 30000.0 * ratio], held: true, ..Blocks::default() }.json()
    }
    let mut ways = ladder(Variant::Tied, scene);
    ways.push(rung(Variant::Unilateral, DOUBLE, scene));
    ways.extend(ladder(Variant::Printed, held));
    Generator {
        name: "moduli",
        title: "Moduli of the two bodies far apart",
        magnitude: "E of the stamp / E of the block",
        sweep: Sweep::Decades { from: -15, to: 15, step: 3, start: 0 },
        ways,
    }
}

/// 1 − 2 nu down to the last bit; the mesh locks long before the arithmetic gives.
pub fn incompressible() -> Generator {
    fn nu(rest: f64) -> f64 {
        0.5 - rest / 2.0
    }
    fn scene(rest: f64) -> Value {
        Blocks { nu: nu(rest), ..Blocks::default() }.json()
    }
    let mut ways = ladder(Variant::Tied, scene);
    ways.push(rung(Variant::Unilateral, DOUBLE, scene));
    ways.extend([4, 16].map(|radial| {
        let name = format!("f64, {radial} x {} mesh against Lame", 2 * radial);
        Way::new(name, 16.0, move |rest| lame(nu(rest), radial)).down_to(1.0)
    }));
    Generator {
        name: "incompressible",
        title: "Poisson's ratio to 0.5: arithmetic against exact numbers, and locking against Lame's closed form",
        magnitude: "1 - 2 nu",
        sweep: Sweep::Decades { from: -17, to: 0, step: 1, start: 0 },
        ways,
    }
}

/// 1 + nu down to the last bit.
pub fn auxetic() -> Generator {
    fn scene(rest: f64) -> Value {
        Blocks { nu: rest - 1.0, ..Blocks::default() }.json()
    }
    let mut ways = ladder(Variant::Tied, scene);
    ways.push(rung(Variant::Unilateral, DOUBLE, scene));
    Generator {
        name: "auxetic",
        title: "Poisson's ratio to -1",
        magnitude: "1 + nu",
        sweep: Sweep::Decades { from: -17, to: 0, step: 1, start: 0 },
        ways,
    }
}

/// The radial displacement of the bore on a mesh against Lamé's.
fn lame(nu: f64, radial: usize) -> Verdict {
    match bore(nu, radial) {
        Err(error) => error.into(),
        Ok(u) => {
            // (1 + nu) p a² / (E (b² − a²)) · ((1 − 2 nu) a + b²/a): a = 10, b = 20, p = 10, E = 30000.
            let exact = (1.0 + nu) * 1000.0 / (30000.0 * 300.0) * ((1.0 - 2.0 * nu) * 10.0 + 40.0);
            match Verdict::of_error((u - exact).abs() / exact) {
                Verdict::Wrong("no digit") => Verdict::Wrong("locked"),
                other => other,
            }
        }
    }
}

/// Where the quarter's diagonal meets the bore.
fn bore(nu: f64, radial: usize) -> Result<f64, Error> {
    let mut annulus = Annulus { radial, around: 2 * radial }.generate()?;
    annulus.description.materials.0[0].1.nu = nu;
    let scene = annulus.build()?;
    let outcome = run(&scene, Variant::Unilateral, &Reading::default(), |_| ())?;
    let far =
        |xyz: &[f64; 3]| (0..2).map(|d| (xyz[d] - 10.0 * FRAC_1_SQRT_2).abs()).fold(0.0, f64::max);
    let nodes = &annulus.mesh.nodes;
    let nearest = nodes.iter().min_by(|a, b| far(&a.xyz).total_cmp(&far(&b.xyz)));
    let first = 2 * nearest.expect("a mesh has nodes").number - 2;
    Ok(outcome.u[first].hypot(outcome.u[first + 1]))
}

/// K3: 1 on the diagonal of restrained equations among stiffnesses of any size.
pub fn unit_diagonal() -> Generator {
    fn scene(e: f64) -> Value {
        Blocks { e: [e, 7.0 * e], held: true, ..Blocks::default() }.json()
    }
    let mut ways = ladder(Variant::Printed, scene);
    ways.push(solved_by(Variant::Printed, Solver::Cg, scene));
    ways.extend([ScalarName::F32, DOUBLE].into_iter().map(|scalar| {
        Way::new(format!("printed {scalar}, E scaled to 1"), carried(scalar), move |e| {
            scaled(e, scalar, None)
        })
    }));
    ways.push(Way::new("printed f64 cg, E scaled to 1", 16.0, |e| {
        scaled(e, DOUBLE, Some(Solver::Cg))
    }));
    Generator {
        name: "unit-diagonal",
        title: "K3: the unit diagonal of restrained equations among stiffnesses of another size",
        magnitude: "E",
        sweep: Sweep::Decades { from: -12, to: 12, step: 3, start: 0 },
        ways,
    }
}

/// With E and the load divided by the power of two next to E: the unit diagonal is then one of them, and displacements stay.
fn scaled(e: f64, scalar: ScalarName, solver: Option<Solver>) -> Verdict {
    let json = |e: f64, pressure: f64| {
        Blocks { e: [e, 7.0 * e], pressure, held: true, ..Blocks::default() }.json()
    };
    let unit = remedies::power_of_two(e);
    let pressure = Blocks::default().pressure;
    match solve(&json(e / unit, pressure / unit), Variant::Printed, scalar, solver) {
        Err(error) => error.into(),
        Ok(answer) => {
            compared(&answer, &json(e, pressure), Variant::Printed, Quantity::Displacement)
        }
    }
}
