//! The folder that a run leaves: pictures and data.

use std::path::Path;

use super::output::write_all;
use super::picture::{self, Drawing, Field};
use super::result_file::ResultFile;
use super::{pressure, vtu};
use crate::answer::{Assessment, Solution};
use crate::error::Result;
use crate::files;
use crate::problem::element::State;
use crate::problem::scene::Scene;
use crate::studies::plan::Plan;

/// Writes `mesh.svg`, `von_mises_stress.svg`, `von_mises_strain.svg`, `fields.vtu`, `result.json`
/// and, with contact, `pressure.svg` to `folder`; returns the content of `result.json`. `plan` is
/// the plan that the run followed.
pub fn write(
    folder: &Path,
    solution: &Solution,
    assessment: &Assessment,
    plan: Option<&Plan>,
) -> Result<String> {
    let scene = &solution.request.scene;
    let drawing = Drawing::new(scene, &format!("{} ({})", scene.title, solution.request.variant));
    let displacement = &solution.displacements()[..];
    let field = |quantity, unit, of: fn(&State) -> f64| {
        let values: Vec<f64> = solution.elements.iter().map(of).collect();
        picture::field(
            &drawing,
            &Field { quantity, unit, values: &values, displacement, largest_at: None },
        )
    };
    let stress = field("von Mises stress", &scene.units.stress, |state| state.von_mises_stress);
    let strain = field("von Mises strain", "1", |state| state.von_mises_strain);
    let result = ResultFile::new(solution, assessment, plan).to_json();
    write_all(
        folder,
        &[
            ("mesh.svg", &picture::mesh(&drawing)),
            ("von_mises_stress.svg", &stress),
            ("von_mises_strain.svg", &strain),
            ("fields.vtu", &vtu::vtu(&drawing, solution, assessment)),
            ("result.json", &result),
        ],
    )?;
    if !solution.contact.is_empty() {
        let measured = assessment.own();
        let others = [assessment.measure(), measured].into_iter().flatten();
        let mut runs = vec![solution];
        for other in others.map(|measured| &*measured.reference) {
            if !runs.iter().any(|run| run.request.is_same_equilibrium(&other.request)) {
                runs.push(other);
            }
        }
        let hertz = measured.map_or(assessment.hertz.as_ref(), |measured| measured.hertz.as_ref());
        files::write(&folder.join("pressure.svg"), &pressure::picture(scene, &runs, hertz))?;
    }
    Ok(result)
}

pub fn mesh_picture(scene: &Scene) -> String {
    picture::mesh(&Drawing::new(scene, &scene.title))
}
