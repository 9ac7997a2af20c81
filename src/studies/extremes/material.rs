//! Generators of materials: moduli far apart, Poisson's ratio at its ends, the unit diagonal.

use std::f64::consts::FRAC_1_SQRT_2;

use super::answer::{Quantity, compared, solve};
use super::blocks::Blocks;
use super::precision::{DOUBLE, SINGLE, carried, in_each_scalar, joined, solved_by};
use super::sweep::{Method, Sweep};
use super::verdict::Verdict;
use super::{Generator, remedies};
use crate::answer::error::Error;
use crate::answer::{self, Request};
use crate::numbers::solve::{ScalarName, Solver};
use crate::problem::model::NodeId;
use crate::problem::modelling::Variant;
use crate::studies::benchmark::Annulus;

/// E of the stamp over E of the block.
pub fn moduli() -> Generator {
    fn blocks(ratio: f64) -> Blocks {
        Blocks { e: [30000.0, 30000.0 * ratio], ..Blocks::default() }
    }
    let mut methods = joined(blocks);
    methods.extend(in_each_scalar(Variant::Printed, blocks));
    Generator {
        name: "moduli",
        title: "Moduli of the two bodies far apart",
        magnitude: "E of the stamp / E of the block",
        sweep: Sweep::Decades { from: -15, to: 15, step: 3, start: 0 },
        methods,
    }
}

/// 1 − 2 nu down to the last bit; the mesh locks long before the arithmetic breaks down.
pub fn incompressible() -> Generator {
    fn nu(rest: f64) -> f64 {
        0.5 - rest / 2.0
    }
    fn blocks(rest: f64) -> Blocks {
        Blocks { nu: nu(rest), ..Blocks::default() }
    }
    let mut methods = joined(blocks);
    methods.extend([4, 16].map(|radial| {
        let name = format!("f64, {radial} x {} mesh against Lame", 2 * radial);
        Method::new(name, 16.0, move |rest| lame(nu(rest), radial)).down_to(1.0)
    }));
    Generator {
        name: "incompressible",
        title: "Poisson's ratio to 0.5: arithmetic against exact numbers, and locking against \
                Lame's closed form",
        magnitude: "1 - 2 nu",
        sweep: Sweep::Decades { from: -17, to: 0, step: 1, start: 0 },
        methods,
    }
}

/// 1 + nu down to the last bit.
pub fn auxetic() -> Generator {
    fn blocks(rest: f64) -> Blocks {
        Blocks { nu: rest - 1.0, ..Blocks::default() }
    }
    Generator {
        name: "auxetic",
        title: "Poisson's ratio to -1",
        magnitude: "1 + nu",
        sweep: Sweep::Decades { from: -17, to: 0, step: 1, start: 0 },
        methods: joined(blocks),
    }
}

/// The radial displacement of the bore on a mesh against Lamé's.
fn lame(nu: f64, radial: usize) -> Verdict {
    match bore(nu, radial) {
        Err(error) => error.into(),
        Ok(u) => {
            // (1 + nu) p a² / (E (b² − a²)) · ((1 − 2 nu) a + b²/a): a = 10, b = 20, p = 10, E =
            // 30000.
            let exact = (1.0 + nu) * 1000.0 / (30000.0 * 300.0) * ((1.0 - 2.0 * nu) * 10.0 + 40.0);
            match Verdict::of_error((u - exact).abs() / exact) {
                Verdict::Wrong("no digit") => Verdict::Wrong("locked"),
                other => other,
            }
        }
    }
}

/// The radial displacement where the quarter's diagonal meets the bore, mm.
fn bore(nu: f64, radial: usize) -> Result<f64, Error> {
    let mut annulus = Annulus { radial, around: 2 * radial }.generate()?;
    annulus.description.materials.0[0].1.nu = nu;
    let scene = annulus.build()?;
    let request = Request::new(&scene).variant(Variant::Unilateral);
    let solution = answer::solve(&request, &mut |_| ())?;
    let model = &solution.model;
    let far = |node: &NodeId| {
        let at = model.at(*node);
        at.iter().map(|x| (x - 10.0 * FRAC_1_SQRT_2).abs()).fold(0.0, f64::max)
    };
    let nearest = model.node_ids().min_by(|a, b| far(a).total_cmp(&far(b)));
    let [x, y] = nearest.expect("a mesh has nodes").of(&solution.u);
    Ok(x.hypot(y))
}

/// K3: 1 on the diagonal of restrained equations among stiffnesses of any size.
pub fn unit_diagonal() -> Generator {
    fn blocks(e: f64) -> Blocks {
        Blocks { e: [e, 7.0 * e], ..Blocks::default() }
    }
    let mut methods = in_each_scalar(Variant::Printed, blocks);
    methods.push(solved_by(Variant::Printed, Solver::Cg, blocks));
    methods.extend([SINGLE, DOUBLE].into_iter().map(|scalar| {
        Method::new(format!("printed {scalar}, E scaled to 1"), carried(scalar), move |e| {
            scaled(e, scalar, None)
        })
    }));
    methods.push(Method::new("printed f64 cg, E scaled to 1", 16.0, |e| {
        scaled(e, DOUBLE, Some(Solver::Cg))
    }));
    Generator {
        name: "unit-diagonal",
        title: "K3: the unit diagonal of restrained equations among stiffnesses of another size",
        magnitude: "E",
        sweep: Sweep::Decades { from: -12, to: 12, step: 3, start: 0 },
        methods,
    }
}

/// `printed` with E and the load divided by the power of two next to E: the unit diagonal is then
/// one of the stiffnesses, and displacements stay.
fn scaled(e: f64, scalar: ScalarName, solver: Option<Solver>) -> Verdict {
    let scene = |e: f64, pressure: f64| {
        Blocks { e: [e, 7.0 * e], pressure, ..Blocks::default() }.scene(Variant::Printed)
    };
    let unit = remedies::power_of_two(e);
    let pressure = Blocks::default().pressure;
    match solve(&scene(e / unit, pressure / unit), Variant::Printed, scalar, solver) {
        Err(error) => error.into(),
        Ok(answer) => {
            compared(&answer, &scene(e, pressure), Variant::Printed, Quantity::Displacement)
        }
    }
}
