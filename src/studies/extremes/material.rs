//! Generators of materials: moduli far apart, Poisson's ratio at its ends, the unit diagonal.

use std::f64::consts::FRAC_1_SQRT_2;

use super::answer::{Answer, solve};
use super::blocks::{Blocks, BlocksOf};
use super::methods::{DOUBLE, SINGLE, in_each_scalar, joined, power_of_two};
use super::sweep::{Generator, Method, Sweep};
use super::verdict::Verdict;
use crate::benchmark::Annulus;
use engine::error::Error;
use engine::{self, Request};
use numbers::solve::ScalarName;
use problem::model::NodeId;
use problem::modelling::Variant;

/// E of the stamp over E of the block.
pub fn moduli() -> Generator {
    let blocks: BlocksOf = |ratio| Blocks { e: [30000.0, 30000.0 * ratio], ..Blocks::default() };
    Generator::new(
        "moduli",
        "Moduli of the two bodies far apart",
        "E of the stamp / E of the block",
        Sweep::Decades { from: -15, to: 15, step: 3 },
        [joined(blocks), in_each_scalar(Variant::Printed, blocks)],
    )
}

/// 1 − 2 nu down to the last bit; the mesh locks long before the arithmetic breaks down.
pub fn incompressible() -> Generator {
    fn nu(rest: f64) -> f64 {
        0.5 - rest / 2.0
    }
    let against_lame = [4, 16].map(|radial| {
        let name = format!("f64, {radial} x {} mesh against Lame", 2 * radial);
        Method::new(name, DOUBLE, move |rest, _| lame(nu(rest), radial)).down_to(1.0)
    });
    Generator::new(
        "incompressible",
        "Poisson's ratio to 0.5: arithmetic against exact numbers, and locking against Lame's \
         closed form",
        "1 - 2 nu",
        Sweep::Decades { from: -17, to: 0, step: 1 },
        [joined(|rest| Blocks { nu: nu(rest), ..Blocks::default() }), against_lame.into()],
    )
}

/// 1 + nu down to the last bit.
pub fn auxetic() -> Generator {
    Generator::new(
        "auxetic",
        "Poisson's ratio to -1",
        "1 + nu",
        Sweep::Decades { from: -17, to: 0, step: 1 },
        [joined(|rest| Blocks { nu: rest - 1.0, ..Blocks::default() })],
    )
}

/// The radial displacement where the quarter's diagonal meets the bore, on a mesh of `radial`
/// divisions of the wall, against Lamé's.
fn lame(nu: f64, radial: usize) -> Result<Verdict, Error> {
    let mut annulus = Annulus { radial, around: 2 * radial }.generate()?;
    annulus.description.materials.0[0].1.nu = nu;
    let request = Request::new(&annulus.build()?).variant(Variant::Unilateral);
    let solution = engine::solve(&request, &mut |_| ())?;
    let model = &solution.model;
    let far = |node: &NodeId| {
        let at = model.coordinates(*node);
        at.iter().map(|x| (x - 10.0 * FRAC_1_SQRT_2).abs()).fold(0.0, f64::max)
    };
    let nearest = model.node_ids().min_by(|a, b| far(a).total_cmp(&far(b)));
    let [x, y] = nearest.expect("a mesh has nodes").components(&solution.u);
    let u = x.hypot(y);
    // (1 + nu) p a² / (E (b² − a²)) · ((1 − 2 nu) a + b²/a): a = 10, b = 20, p = 10, E = 30000.
    let exact = (1.0 + nu) * 1000.0 / (30000.0 * 300.0) * ((1.0 - 2.0 * nu) * 10.0 + 40.0);
    Ok(match Verdict::of_error((u - exact).abs() / exact) {
        Verdict::Wrong("no digit") => Verdict::Wrong("locked"),
        other => other,
    })
}

/// K3: 1 on the diagonal of restrained equations among stiffnesses of any size.
pub fn unit_diagonal() -> Generator {
    let blocks: BlocksOf = |e| Blocks { e: [e, 7.0 * e], ..Blocks::default() };
    let others = vec![
        scaled("printed f32, E scaled to 1", SINGLE),
        scaled("printed f64, E scaled to 1", DOUBLE),
    ];
    Generator::new(
        "unit-diagonal",
        "K3: the unit diagonal of restrained equations among stiffnesses of another size",
        "E",
        Sweep::Decades { from: -12, to: 12, step: 3 },
        [in_each_scalar(Variant::Printed, blocks), others],
    )
}

/// `printed` with E and the load divided by the power of two next to E: the unit diagonal is then
/// one of the stiffnesses, and displacements stay.
fn scaled(name: &str, scalar: ScalarName) -> Method {
    let scene = |e: f64, unit: f64| {
        let Blocks { pressure, .. } = Blocks::default();
        let (e, pressure) = (e / unit, pressure / unit);
        Blocks { e: [e, 7.0 * e], pressure, ..Blocks::default() }.scene(Variant::Printed)
    };
    Method::new(name, scalar, move |e, exacts| {
        let answer = solve(&scene(e, power_of_two(e)), Variant::Printed, scalar, None)?;
        Ok(exacts.judge(&answer, &scene(e, 1.0), Variant::Printed, Answer::displacement))
    })
}
