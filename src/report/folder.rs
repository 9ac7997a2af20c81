//! The folder that a run leaves: pictures and data.

use std::path::Path;

use super::picture::{self, Contact, Drawing, Field};
use super::vtu::{Data, VtuMesh, vtu};
use super::{json, pressure};
use crate::answer::contact::Outcome;
use crate::answer::estimates::ErrorBars;
use crate::error::InputError;
use crate::files;
use crate::paper::mirror::Worksheet;
use crate::problem::element::State;
use crate::problem::scene::Scene;
use crate::studies::plan::Plan;

/// Writes `mesh.svg`, `von_mises_stress.svg`, `von_mises_strain.svg`, `fields.vtu`, `result.json` and, with contact, `pressure.svg` to
/// `folder`; gives back the content of `result.json`. `converged` is the answer that the run is measured against,
/// `plan` the plan that it followed.
///
/// # Errors
/// A file that cannot be written.
pub fn write(
    folder: &Path,
    scene: &Scene,
    outcome: &Outcome,
    bars: &ErrorBars,
    converged: Option<&Outcome>,
    plan: Option<&Plan>,
) -> Result<String, InputError> {
    let shown = Shown::new(scene, &outcome.sheet);
    let displacement: Vec<[f64; 2]> =
        outcome.u.as_slice().chunks(2).map(|u| [u[0], u[1]]).collect();
    let title = format!("{} ({})", scene.title, outcome.variant);
    let drawing = Drawing { title: &title, ..shown.drawing(scene) };
    let field = |quantity, unit, values: &[f64]| {
        picture::field(&drawing, &Field { quantity, unit, values, displacement: &displacement })
    };
    let stress = values(outcome, |s| s.von_mises_stress);
    let strain = values(outcome, |s| s.von_mises_strain);
    let files = [
        ("mesh.svg", picture::mesh(&drawing)),
        ("von_mises_stress.svg", field("von Mises stress", &scene.units.stress, &stress)),
        ("von_mises_strain.svg", field("von Mises strain", "1", &strain)),
        ("fields.vtu", shown.vtu(outcome, bars)),
    ];
    files.iter().try_for_each(|(name, content)| files::write(&folder.join(name), content))?;
    if !outcome.contact.is_empty() {
        let runs: Vec<&Outcome> = std::iter::once(outcome).chain(converged).collect();
        files::write(&folder.join("pressure.svg"), &pressure::picture(scene, &runs))?;
    }
    let result = json::result(scene, outcome, bars, converged, plan);
    files::write(&folder.join("result.json"), &result)?;
    Ok(result)
}

fn values(outcome: &Outcome, of: impl Fn(&State) -> f64) -> Vec<f64> {
    outcome.elements.iter().map(of).collect()
}

/// The mesh of a scene as a picture.
pub fn mesh_picture(scene: &Scene, sheet: &Worksheet<f64>) -> String {
    picture::mesh(&Shown::new(scene, sheet).drawing(scene))
}

/// A field on the deformed mesh of a scene as a picture.
pub fn field_picture(
    scene: &Scene,
    sheet: &Worksheet<f64>,
    title: &str,
    field: &Field<'_>,
) -> String {
    let shown = Shown::new(scene, sheet);
    picture::field(&Drawing { title, ..shown.drawing(scene) }, field)
}

/// The mesh, counted from 0.
struct Shown {
    points: Vec<[f64; 2]>,
    triangles: Vec<[usize; 3]>,
    region: Vec<usize>,
    region_names: Vec<String>,
    contact_nodes: Vec<usize>,
    target_edges: Vec<[usize; 2]>,
}

impl Shown {
    fn new(scene: &Scene, sheet: &Worksheet<f64>) -> Self {
        let (region, region_names) = regions(scene, sheet.M());
        let ends = |e: &usize| [sheet.elem[(*e, 6)] - 1, sheet.elem[(*e, 7)] - 1];
        Shown {
            points: (1..=sheet.R()).map(|n| [sheet.node[(n, 2)], sheet.node[(n, 3)]]).collect(),
            triangles: (1..=sheet.M())
                .map(|n| [0, 1, 2].map(|k| sheet.EL[(n, sheet.ind_1 + k)] - 1))
                .collect(),
            region,
            region_names,
            contact_nodes: sheet.cnt.iter().map(|n| n - 1).collect(),
            target_edges: sheet.trg.iter().map(ends).collect(),
        }
    }

    fn drawing<'a>(&'a self, scene: &'a Scene) -> Drawing<'a> {
        let contact = Contact { nodes: &self.contact_nodes, edges: &self.target_edges };
        Drawing {
            title: &scene.title,
            points: &self.points,
            triangles: &self.triangles,
            region: &self.region,
            region_names: &self.region_names,
            length_unit: &scene.units.length,
            contact: scene.target().map(|_| contact),
        }
    }

    fn vtu(&self, outcome: &Outcome, bars: &ErrorBars) -> String {
        let error = bars.mesh.error_map();
        let flat = |of: &dyn Fn(&State) -> [f64; 3]| -> Vec<f64> {
            outcome.elements.iter().flat_map(of).collect()
        };
        let sigma = flat(&|s| s.sigma.into());
        let epsilon = flat(&|s| s.epsilon.into());
        let stress = values(outcome, |s| s.von_mises_stress);
        let strain = values(outcome, |s| s.von_mises_strain);
        let body: Vec<f64> = self.region.iter().map(|r| *r as f64).collect();
        vtu(&VtuMesh {
            points: &self.points,
            triangles: &self.triangles,
            point_data: &[Data {
                name: "displacement",
                components: 2,
                values: outcome.u.as_slice(),
            }],
            cell_data: &[
                Data { name: "sigma_x sigma_y tau_xy", components: 3, values: &sigma },
                Data { name: "epsilon_x epsilon_y gamma_xy", components: 3, values: &epsilon },
                Data { name: "von_mises_stress", components: 1, values: &stress },
                Data { name: "von_mises_strain", components: 1, values: &strain },
                Data { name: "body", components: 1, values: &body },
                Data { name: "mesh_error", components: 1, values: &error },
            ],
        })
    }
}

/// The region of each triangle, 0 the target, then the other bodies; and the regions' names.
fn regions(scene: &Scene, triangles: usize) -> (Vec<usize>, Vec<String>) {
    let target = scene.target().unwrap_or(&scene.bodies[0]);
    let others = scene.bodies.iter().filter(|body| body.name != target.name);
    let mut region = vec![0; triangles];
    let mut names = Vec::new();
    for (k, body) in std::iter::once(target).chain(others).enumerate() {
        names.push(body.name.clone());
        body.triangles.iter().for_each(|n| region[n - 1] = k);
    }
    (region, names)
}
