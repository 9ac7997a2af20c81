//! Compares the variants that the paper describes with the reference solution, on its figure 1.

use plane_contact::input::Variant;
use plane_contact::{Error, Request, Scene, compare, solve};

/// Solves each variant and prints how far it is from the reference solution.
pub fn main() -> Result<(), Error> {
    let scene = Scene::open("fig1")?;
    let reference = solve(&Request::new(&scene).reference(), &mut |_| ())?;
    for variant in [Variant::Printed, Variant::Tied, Variant::Stepped] {
        let solution = solve(&Request::new(&scene).variant(variant), &mut |_| ())?;
        let distance = compare(&solution, &reference);
        println!(
            "{variant}: {} nodes in contact; error against the reference solution: {:.1} % in |u|, \
             {:.1} % in the energy norm",
            solution.last().in_contact,
            100.0 * distance.displacement_relative,
            100.0 * distance.energy_relative
        );
    }
    Ok(())
}
