//! The folder that a run leaves: pictures and data.

use std::path::Path;

use rayon::prelude::*;
use serde_json::json;

use super::json::document;
use super::model::Report;
use super::page::{Page, TABLE};
use super::picture::{self, Drawing};
use super::quantities::triangle_array;
use super::result_file::ResultFile;
use super::{pressure, tables, vtu};
use base::error::Result;
use base::files;
use engine::plan::Plan;
use engine::{Assessment, Quantity, Solution, TriangleValues};

/// What a folder holds beside `fields.vtu` and `result.json`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FolderOptions {
    /// Whether there are pictures.
    pub pictures: bool,
    /// Whether `result.json` has the values of all nodes and triangles however many there are.
    pub fields: bool,
}

/// Writes the files of a run to `folder`; returns the content of `result.json`. `plan` is the plan
/// that the run followed, `command` what was typed.
///
/// # Errors
/// A file cannot be written.
pub fn write(
    folder: &Path,
    solution: &Solution,
    assessment: &Assessment,
    plan: Option<&Plan>,
    wanted: FolderOptions,
    command: &str,
) -> Result<String> {
    let mut files = contents(solution, assessment, plan, wanted);
    if wanted.pictures {
        files.insert(0, (PAGE.into(), page(solution, assessment, &files, command).into_bytes()));
    }
    files::write_all(folder, &files)?;
    let (_, result) = files.pop().expect("every run has a result");
    Ok(String::from_utf8(result).expect("JSON is UTF-8"))
}

/// The page that shows a run.
const PAGE: &str = "index.html";

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

/// Returns the files that a run may leave with their names; the last is `result.json`. There are pictures of
/// the quantities that are scalars.
fn files(wanted: FolderOptions) -> Vec<(String, File)> {
    let mut files = vec![("fields.vtu".into(), File::Fields)];
    if wanted.pictures {
        files.push(("mesh.svg".into(), File::Mesh));
        let quantities = TriangleValues::QUANTITIES.iter();
        for quantity in quantities.filter(|quantity| quantity.components().len() == 1) {
            files.push((format!("{}.svg", quantity.array()), File::Picture(quantity)));
        }
        files.push(("pressure.svg".into(), File::Pressure));
    }
    files.push(("result.json".into(), File::Result));
    files
}

/// Returns the names of the files that a run may leave; the last is `result.json`.
pub fn names(wanted: FolderOptions) -> Vec<String> {
    let page = wanted.pictures.then(|| PAGE.to_string());
    page.into_iter().chain(files(wanted).into_iter().map(|(name, _)| name)).collect()
}

/// Returns the files that a run may leave, for help: four a line, with what not every name says.
pub fn help() -> String {
    let files =
        files(FolderOptions { pictures: true, fields: false }).into_iter().map(|(name, file)| {
            match file {
                File::Fields => name + " (for ParaView)",
                File::Mesh => name + " (the paper's fig. 4)",
                File::Result | File::Picture(_) | File::Pressure => name,
            }
        });
    let files: Vec<String> = std::iter::once(PAGE.to_string()).chain(files).collect();
    files.chunks(4).map(|line| line.join(", ")).collect::<Vec<_>>().join(",\n")
}

/// Returns the files of a run, each with its name; the last is `result.json`.
fn contents(
    solution: &Solution,
    assessment: &Assessment,
    plan: Option<&Plan>,
    wanted: FolderOptions,
) -> Vec<(String, Vec<u8>)> {
    let scene = &solution.request.scene;
    let drawing = &Drawing::new(scene, &format!("{} ({})", scene.title, solution.request.variant));
    let triangles = TriangleValues::all(solution, assessment.mesh_error().as_deref());
    let content = |file| {
        Some(match file {
            File::Result => {
                ResultFile::new(solution, assessment, plan, wanted.fields).to_json().into_bytes()
            }
            File::Fields => vtu::vtu(drawing, solution, assessment),
            File::Mesh => picture::mesh(drawing).into_bytes(),
            File::Picture(quantity) => {
                let array = triangle_array(quantity, &triangles, &scene.units)?;
                let (title, moved) = (quantity.title, solution.displacements());
                picture::field(drawing, title, &array.unit, &array.values, &moved).into_bytes()
            }
            File::Pressure if solution.contact.is_empty() => return None,
            File::Pressure => pressures(solution, assessment).into_bytes(),
        })
    };
    let files = files(wanted).into_par_iter().with_max_len(1);
    files.filter_map(|(name, file)| Some((name, content(file)?))).collect()
}

/// Returns a page of one file: the result, the pictures, the tables, and the command that makes it again.
fn page(
    solution: &Solution,
    assessment: &Assessment,
    files: &[(String, Vec<u8>)],
    command: &str,
) -> String {
    let pictures = files.iter().filter(|(name, _)| name.ends_with(".svg"));
    let pictures = pictures.fold(Report::default().heading("Pictures"), |report, (name, svg)| {
        report.figure(name, String::from_utf8_lossy(svg))
    });
    let report = tables::summary(solution, assessment)
        .then(pictures)
        .then(tables::details(solution, assessment))
        .then(tables::error_estimates(solution, assessment))
        .then(tables::distance(solution, assessment))
        .then(tables::steps(solution, assessment, false))
        .line(format!("Make it again: `{command}`"));
    let body = report.html().replace("<details id", "<details open id");
    let scene = &solution.request.scene;
    Page {
        title: &format!("{}: {}", scene.name, solution.request.variant),
        body: &format!("<main>{body}</main>\n"),
        style: include_str!("page/result.css"),
        script: &[TABLE],
        data: document(Some(scene), &json!({})),
    }
    .html()
}

/// Draws the contact pressure of a solution and of the equilibrium.
fn pressures(solution: &Solution, assessment: &Assessment) -> String {
    let measured = assessment.own();
    let equilibrium = measured.map(|measured| &*measured.reference);
    let is_other = |other: &&Solution| !solution.request.is_same_equilibrium(&other.request);
    let runs: Vec<&Solution> =
        std::iter::once(solution).chain(equilibrium.filter(is_other)).collect();
    let hertz = measured.map_or(assessment.hertz.as_ref(), |measured| measured.hertz.as_ref());
    pressure::picture(&solution.request.scene, &runs, hertz)
}
