//! The folder that a run leaves: pictures and data.

use std::path::Path;

use rayon::prelude::*;

use super::picture::{self, Drawing, Field};
use super::result_file::ResultFile;
use super::{pressure, vtu};
use base::error::Result;
use base::files;
use engine::{Assessment, Solution};
use problem::element::State;
use problem::scene::Scene;
use studies::plan::Plan;

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

/// Writes the files of a run to `folder`; returns the content of `result.json`. `plan` is the plan
/// that the run followed.
pub fn write(
    folder: &Path,
    solution: &Solution,
    assessment: &Assessment,
    plan: Option<&Plan>,
    wanted: Wanted,
) -> Result<String> {
    let mut files = contents(solution, assessment, plan, wanted);
    files::write_all(folder, "solve", &files)?;
    Ok(String::from_utf8(files.swap_remove(0).1).expect("JSON is UTF-8"))
}

/// The names of the files of a run with pictures: data first, and last the one that needs contact.
const NAMES: [&str; 6] = [
    "result.json",
    "fields.vtu",
    "mesh.svg",
    "von_mises_stress.svg",
    "von_mises_strain.svg",
    "pressure.svg",
];

/// Returns the names of the files that a run may leave.
pub fn names(wanted: Wanted) -> &'static [&'static str] {
    if wanted.pictures { &NAMES } else { &NAMES[..2] }
}

/// Returns the files of a run, each with its name.
pub fn contents(
    solution: &Solution,
    assessment: &Assessment,
    plan: Option<&Plan>,
    wanted: Wanted,
) -> Vec<(&'static str, Vec<u8>)> {
    let scene = &solution.request.scene;
    let drawing = Drawing::new(scene, &format!("{} ({})", scene.title, solution.request.variant));
    let displacement = &solution.displacements()[..];
    let field = |quantity, unit, of: fn(&State) -> f64| {
        let values: Vec<f64> = solution.elements.iter().map(of).collect();
        let field = Field { quantity, unit, values: &values, displacement, largest_at: None };
        picture::field(&drawing, &field).into_bytes()
    };
    let stress = || field("von Mises stress", &scene.units.stress, |state| state.von_mises_stress);
    let strain = || field("von Mises strain", "1", |state| state.von_mises_strain);
    let result = || result(solution, assessment, plan, wanted).into_bytes();
    let fields = || vtu::vtu(&drawing, solution, assessment);
    let mesh = || picture::mesh(&drawing).into_bytes();
    let pressure = || pressures(solution, assessment).into_bytes();
    let contents: [&(dyn Fn() -> Vec<u8> + Sync); 6] =
        [&result, &fields, &mesh, &stress, &strain, &pressure];
    let mut files: Vec<_> = names(wanted).iter().zip(contents).collect();
    if solution.contact.is_empty() {
        files.truncate(NAMES.len() - 1);
    }
    files.par_iter().with_max_len(1).map(|(name, content)| (**name, content())).collect()
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

/// Draws the contact pressure of a solution and of those beside which it is assessed.
fn pressures(solution: &Solution, assessment: &Assessment) -> String {
    let measured = assessment.own();
    let others = [assessment.measure(), measured].into_iter().flatten();
    let mut runs = vec![solution];
    for other in others.map(|measured| &*measured.reference) {
        if !runs.iter().any(|run| run.request.is_same_equilibrium(&other.request)) {
            runs.push(other);
        }
    }
    let hertz = measured.map_or(assessment.hertz.as_ref(), |measured| measured.hertz.as_ref());
    pressure::picture(&solution.request.scene, &runs, hertz)
}

/// Draws the mesh of a finding's scene, under the finding's id.
pub fn finding_picture(id: &str, scene: &Scene) -> String {
    picture::mesh(&Drawing::new(scene, &format!("{id}: {}", scene.title)))
}
