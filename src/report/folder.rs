//! The folder that a run leaves: pictures and data.

use std::path::Path;

use rayon::prelude::*;

use super::picture::{self, Drawing, Field};
use super::result_file::ResultFile;
use super::{pressure, vtu};
use crate::answer::{Assessment, Solution};
use crate::error::Result;
use crate::files;
use crate::problem::element::State;
use crate::problem::scene::Scene;
use crate::studies::plan::Plan;

/// What a folder holds beside `fields.vtu` and `result.json`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Wanted {
    /// Whether there are pictures.
    pub pictures: bool,
    /// Whether `result.json` has the values of all nodes and triangles however many there are.
    pub fields: bool,
}

impl Default for Wanted {
    fn default() -> Self {
        Wanted { pictures: true, fields: false }
    }
}

/// Writes `fields.vtu`, `result.json` and, where pictures are wanted, `mesh.svg`,
/// `von_mises_stress.svg`, `von_mises_strain.svg` and, with contact, `pressure.svg` to `folder`;
/// returns the content of `result.json`. `plan` is the plan that the run followed.
pub fn write(
    folder: &Path,
    solution: &Solution,
    assessment: &Assessment,
    plan: Option<&Plan>,
    wanted: Wanted,
) -> Result<String> {
    let scene = &solution.request.scene;
    let drawing = Drawing::new(scene, &format!("{} ({})", scene.title, solution.request.variant));
    if wanted.pictures {
        pictures(folder, &drawing, solution, assessment)?;
    }
    files::write(&folder.join("fields.vtu"), &vtu::vtu(&drawing, solution, assessment))?;
    let result = result(solution, assessment, plan, wanted);
    files::write(&folder.join("result.json"), &result)?;
    Ok(result)
}

/// Returns the content of `result.json`, and writes nothing.
pub fn result(
    solution: &Solution,
    assessment: &Assessment,
    plan: Option<&Plan>,
    wanted: Wanted,
) -> String {
    let result = ResultFile::new(solution, assessment, plan);
    if wanted.fields { result.with_fields(solution).to_json() } else { result.to_json() }
}

fn pictures(
    folder: &Path,
    drawing: &Drawing,
    solution: &Solution,
    assessment: &Assessment,
) -> Result<()> {
    let scene = &solution.request.scene;
    let displacement = &solution.displacements()[..];
    let field = |quantity, unit, of: fn(&State) -> f64| {
        let values: Vec<f64> = solution.elements.iter().map(of).collect();
        picture::field(
            drawing,
            &Field { quantity, unit, values: &values, displacement, largest_at: None },
        )
    };
    let stress = || field("von Mises stress", &scene.units.stress, |state| state.von_mises_stress);
    let strain = || field("von Mises strain", "1", |state| state.von_mises_strain);
    let mesh = || picture::mesh(drawing);
    let pictures: [(&str, &(dyn Fn() -> String + Sync)); 3] =
        [("mesh.svg", &mesh), ("von_mises_stress.svg", &stress), ("von_mises_strain.svg", &strain)];
    let drawn: Vec<String> = pictures.par_iter().map(|(_, draw)| draw()).collect();
    for ((name, _), picture) in pictures.iter().zip(drawn) {
        files::write(&folder.join(name), &picture)?;
    }
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
    Ok(())
}

/// Draws the mesh of a finding's scene, under the finding's id.
pub fn finding_picture(id: &str, scene: &Scene) -> String {
    picture::mesh(&Drawing::new(scene, &format!("{id}: {}", scene.title)))
}
