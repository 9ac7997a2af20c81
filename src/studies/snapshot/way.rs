//! The way to an equilibrium. Where iterations of `unilateral` end in the same equilibrium, the ways
//! there may differ from a decision on that rounding takes, such as which of two nodes closes first.

use super::Run;
use super::compare::{Difference, compare};
use super::input::Input;
use super::place::iteration;
use super::record::{Bounds, record};
use engine::error::Result;
use problem::modelling::Variant;
use problem::scene::SceneBuilder;

/// The changes of the moduli by which rounding is tried, in units of 2^-52: as small as rounding itself.
const TRIALS: [f64; 6] = [-1.0, 1.0, -2.0, 2.0, -3.0, 3.0];

/// Returns the first iteration of the `differences` of a run from an earlier one where these are of the
/// way alone, and rounding decides it: with moduli that differ in their last digit the run goes another
/// way there too, or before.
///
/// # Errors
/// The scene with such moduli is at fault.
pub fn decided_by_rounding(
    input: &Input,
    run: &Run,
    differences: &[Difference],
) -> Result<Option<usize>> {
    let Some(first) = first_iteration(differences) else { return Ok(None) };
    if run.options.variant != Some(Variant::Unilateral)
        || !differences.iter().all(|d| is_of_way(&d.entry, first))
    {
        return Ok(None);
    }
    for units in TRIALS {
        let mut description = input.scene.clone();
        for (_, material) in &mut description.materials.0 {
            material.e *= 1.0 + units * f64::EPSILON;
        }
        let (name, mesh) = (input.name.clone(), input.mesh.clone());
        let scene = SceneBuilder { name, mesh, description }.build()?;
        let again = record(&run.options.request(&scene), Bounds::LeftOut)?;
        if first_iteration(&compare(run, &again).0).is_some_and(|other| other <= first) {
            return Ok(Some(first));
        }
    }
    Ok(None)
}

/// Returns a run without its way from iteration `first` on.
pub fn without_way(run: &Run, first: usize) -> Run {
    let mut run = run.clone();
    run.facts.retain(|name, _| !is_of_way(name, first));
    run.numbers.retain(|name, _| !is_of_way(name, first));
    run
}

fn is_of_way(entry: &str, first: usize) -> bool {
    entry == "iterations" || iteration(entry).is_some_and(|(k, _)| k >= first)
}

/// Returns the first iteration of which something differs; None where nothing does.
fn first_iteration(differences: &[Difference]) -> Option<usize> {
    differences.iter().filter_map(|d| Some(iteration(&d.entry)?.0)).min()
}
