//! The folder that a run leaves: pictures and data.

use std::path::Path;

use rayon::prelude::*;

use super::picture::{self, Drawing, Field};
use super::quantities::triangle_array;
use super::result_file::ResultFile;
use super::{pressure, vtu};
use base::error::Result;
use base::files;
use engine::{Assessment, Quantity, Solution, TriangleValues};
use problem::scene::Scene;
use studies::plan::Plan;

/// What a folder holds beside `fields.vtu` and `result.json`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FolderOptions {
    /// Whether there are pictures.
    pub pictures: bool,
    /// Whether `result.json` has the values of all nodes and triangles however many there are.
    pub fields: bool,
}

impl Default for FolderOptions {
    fn default() -> Self {
        FolderOptions { pictures: true, fields: false }
    }
}

/// Writes the files of a run to `folder`; returns the content of `result.json`. `plan` is the plan
/// that the run followed.
pub fn write(
    folder: &Path,
    solution: &Solution,
    assessment: &Assessment,
    plan: Option<&Plan>,
    wanted: FolderOptions,
) -> Result<String> {
    let mut files = contents(solution, assessment, plan, wanted);
    files::write_all(folder, "solve", &files)?;
    Ok(String::from_utf8(files.swap_remove(0).1).expect("JSON is UTF-8"))
}

/// Returns the names of the files that a run may leave.
pub fn names(wanted: FolderOptions) -> Vec<String> {
    let data = ["result.json", "fields.vtu"].map(String::from);
    let pictures = ["mesh.svg", "pressure.svg"].map(String::from);
    let pictures = pictures.into_iter().chain(drawn().map(picture_name));
    data.into_iter().chain(pictures.filter(|_| wanted.pictures)).collect()
}

/// Returns the quantities of triangles of which there are pictures: all scalars.
fn drawn() -> impl Iterator<Item = &'static Quantity<TriangleValues>> {
    TriangleValues::QUANTITIES.iter().filter(|quantity| quantity.components().len() == 1)
}

fn picture_name(quantity: &Quantity<TriangleValues>) -> String {
    format!("{}.svg", quantity.array())
}

/// Computes the content of a file.
type Content<'a> = Box<dyn Fn() -> Vec<u8> + Send + Sync + 'a>;

/// Returns the files of a run, each with its name; the first is `result.json`.
pub fn contents(
    solution: &Solution,
    assessment: &Assessment,
    plan: Option<&Plan>,
    wanted: FolderOptions,
) -> Vec<(String, Vec<u8>)> {
    let scene = &solution.request.scene;
    let drawing = Drawing::new(scene, &format!("{} ({})", scene.title, solution.request.variant));
    let displacement = &solution.displacements()[..];
    let mut files: Vec<(String, Content)> = vec![
        (
            "result.json".into(),
            Box::new(|| result(solution, assessment, plan, wanted).into_bytes()),
        ),
        ("fields.vtu".into(), Box::new(|| vtu::vtu(&drawing, solution, assessment))),
    ];
    if wanted.pictures {
        files.push(("mesh.svg".into(), Box::new(|| picture::mesh(&drawing).into_bytes())));
        let triangles = TriangleValues::all(solution, assessment.mesh_error().as_deref());
        for quantity in drawn() {
            let Some(array) = triangle_array(quantity, &triangles, &scene.units) else { continue };
            let drawing = &drawing;
            let picture = move || {
                let (quantity, unit, values) = (quantity.title, &array.unit[..], &array.values[..]);
                let field = Field { quantity, unit, values, displacement, largest_at: None };
                picture::field(drawing, &field).into_bytes()
            };
            files.push((picture_name(quantity), Box::new(picture)));
        }
        if !solution.contact.is_empty() {
            let pressure = || pressures(solution, assessment).into_bytes();
            files.push(("pressure.svg".into(), Box::new(pressure)));
        }
    }
    files.par_iter().with_max_len(1).map(|(name, content)| (name.clone(), content())).collect()
}

/// Returns the content of `result.json`, and writes nothing.
pub fn result(
    solution: &Solution,
    assessment: &Assessment,
    plan: Option<&Plan>,
    wanted: FolderOptions,
) -> String {
    let result = ResultFile::new(solution, assessment, plan);
    if wanted.fields {
        result.with_fields(solution, assessment).to_json()
    } else {
        result.to_json()
    }
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
