//! The folder that a run leaves: pictures and data.

use std::path::Path;

use rayon::prelude::*;

use super::picture::{self, Drawing, Field};
use super::quantities::{Array, triangle_array};
use super::result_file::ResultFile;
use super::{pressure, vtu};
use base::error::Result;
use base::files;
use engine::plan::Plan;
use engine::{Assessment, Quantity, Solution, TriangleValues};
use problem::scene::Scene;

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
///
/// # Errors
/// A file cannot be written.
pub fn write(
    folder: &Path,
    solution: &Solution,
    assessment: &Assessment,
    plan: Option<&Plan>,
    wanted: FolderOptions,
) -> Result<String> {
    let mut files = contents(solution, assessment, plan, wanted);
    files::write_all(folder, &files)?;
    let (_, result) = files.pop().expect("every run has a result");
    Ok(String::from_utf8(result).expect("JSON is UTF-8"))
}

/// A file of a run.
#[derive(Clone, Copy)]
enum File {
    Result,
    Fields,
    Mesh,
    /// A picture of a quantity of triangles.
    Picture(&'static Quantity<TriangleValues>),
    Pressure,
}

impl File {
    /// Returns the files that a run may leave; pictures of the quantities that are scalars.
    fn all(wanted: FolderOptions) -> impl Iterator<Item = File> {
        let quantities = TriangleValues::QUANTITIES.iter();
        let scalars = quantities.filter(|quantity| quantity.components().len() == 1);
        let pictures = std::iter::once(File::Mesh).chain(scalars.map(File::Picture));
        let pictures = pictures.chain([File::Pressure]).filter(move |_| wanted.pictures);
        std::iter::once(File::Fields).chain(pictures).chain([File::Result])
    }

    fn name(self) -> String {
        match self {
            File::Result => "result.json".into(),
            File::Fields => "fields.vtu".into(),
            File::Mesh => "mesh.svg".into(),
            File::Picture(quantity) => format!("{}.svg", quantity.array()),
            File::Pressure => "pressure.svg".into(),
        }
    }
}

/// Returns the names of the files that a run may leave; the last is `result.json`.
pub fn names(wanted: FolderOptions) -> Vec<String> {
    File::all(wanted).map(File::name).collect()
}

/// Returns the files that a run may leave, for help: four a line, with what not every name says.
pub fn help() -> String {
    let described = |file: File| match file {
        File::Fields => format!("{} (for ParaView)", file.name()),
        File::Mesh => format!("{} (the paper's fig. 4)", file.name()),
        File::Result | File::Picture(_) | File::Pressure => file.name(),
    };
    let files: Vec<String> = File::all(FolderOptions::default()).map(described).collect();
    let lines: Vec<String> = files.chunks(4).map(|line| line.join(", ")).collect();
    lines.join(",\n")
}

/// Computes the content of a file.
type Content<'a> = Box<dyn Fn() -> Vec<u8> + Send + Sync + 'a>;

/// Returns the files of a run, each with its name; the last is `result.json`.
pub fn contents(
    solution: &Solution,
    assessment: &Assessment,
    plan: Option<&Plan>,
    wanted: FolderOptions,
) -> Vec<(String, Vec<u8>)> {
    let scene = &solution.request.scene;
    let drawing = &Drawing::new(scene, &format!("{} ({})", scene.title, solution.request.variant));
    let triangles = TriangleValues::all(solution, assessment.mesh_error().as_deref());
    let content = |file| -> Option<Content> {
        Some(match file {
            File::Result => {
                Box::new(move || result(solution, assessment, plan, wanted).into_bytes())
            }
            File::Fields => Box::new(move || vtu::vtu(drawing, solution, assessment)),
            File::Mesh => Box::new(move || picture::mesh(drawing).into_bytes()),
            File::Picture(quantity) => {
                let array = triangle_array(quantity, &triangles, &scene.units)?;
                let quantity = quantity.title;
                Box::new(move || field_picture(drawing, solution, quantity, &array).into_bytes())
            }
            File::Pressure if solution.contact.is_empty() => return None,
            File::Pressure => Box::new(move || pressures(solution, assessment).into_bytes()),
        })
    };
    let files = File::all(wanted).filter_map(|file| Some((file.name(), content(file)?)));
    let files: Vec<(String, Content)> = files.collect();
    files.par_iter().with_max_len(1).map(|(name, content)| (name.clone(), content())).collect()
}

/// Draws a quantity of the triangles on the deformed mesh, each with one value.
pub fn field_picture(
    drawing: &Drawing,
    solution: &Solution,
    quantity: &str,
    array: &Array,
) -> String {
    let (unit, values) = (&array.unit[..], &array.values[..]);
    let displacement = &solution.displacements()[..];
    picture::field(drawing, &Field { quantity, unit, values, displacement, largest_at: None })
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
