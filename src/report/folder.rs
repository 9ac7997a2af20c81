//! The folder that a run leaves: pictures and data.

use std::path::Path;

use super::picture::{self, Contact, Drawing, Field};
use super::vtu::{Data, VtuMesh, vtu};
use super::{json, pressure};
use crate::answer::estimates::ErrorEstimates;
use crate::answer::{Assessment, Solution};
use crate::error::InputError;
use crate::files;
use crate::problem::element::State;
use crate::problem::model::{Model, NodeId};
use crate::problem::scene::Scene;
use crate::studies::plan::Plan;

/// Writes `mesh.svg`, `von_mises_stress.svg`, `von_mises_strain.svg`, `fields.vtu`, `result.json` and, with contact, `pressure.svg` to
/// `folder`; gives back the content of `result.json`. `plan` is the plan that the run followed.
///
/// # Errors
/// A file that cannot be written.
pub fn write(
    folder: &Path,
    solution: &Solution,
    assessment: &Assessment,
    plan: Option<&Plan>,
) -> Result<String, InputError> {
    let scene = &solution.request.scene;
    let shown = Shown::new(&solution.model);
    let displacement = solution.displacements();
    let title = format!("{} ({})", scene.title, solution.request.variant);
    let drawing = Drawing { title: &title, ..shown.drawing(scene) };
    let field = |quantity, unit, values: &[f64]| {
        picture::field(&drawing, &Field { quantity, unit, values, displacement: &displacement })
    };
    let stress = values(solution, |s| s.von_mises_stress);
    let strain = values(solution, |s| s.von_mises_strain);
    let files = [
        ("mesh.svg", picture::mesh(&drawing)),
        ("von_mises_stress.svg", field("von Mises stress", &scene.units.stress, &stress)),
        ("von_mises_strain.svg", field("von Mises strain", "1", &strain)),
        ("fields.vtu", shown.vtu(solution, &assessment.estimates)),
    ];
    files.iter().try_for_each(|(name, content)| files::write(&folder.join(name), content))?;
    if !solution.contact.is_empty() {
        let measured = assessment.measure();
        let reference = measured.map(|measured| &*measured.reference);
        let runs: Vec<&Solution> = std::iter::once(solution).chain(reference).collect();
        let hertz = measured.map_or(assessment.hertz.as_ref(), |measured| measured.hertz.as_ref());
        files::write(&folder.join("pressure.svg"), &pressure::picture(scene, &runs, hertz))?;
    }
    let result = json::result(solution, assessment, plan);
    files::write(&folder.join("result.json"), &result)?;
    Ok(result)
}

fn values(solution: &Solution, of: impl Fn(&State) -> f64) -> Vec<f64> {
    solution.elements.iter().map(of).collect()
}

/// The mesh of a scene as a picture.
pub fn mesh_picture(scene: &Scene) -> String {
    picture::mesh(&Shown::new(&scene.model).drawing(scene))
}

/// A field on the deformed mesh of a scene as a picture.
pub fn field_picture(scene: &Scene, title: &str, field: &Field<'_>) -> String {
    let shown = Shown::new(&scene.model);
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
    fn new(model: &Model) -> Self {
        let (region, region_names) = regions(model);
        Shown {
            points: model.nodes.clone(),
            triangles: model.triangles.iter().map(|t| t.nodes.map(NodeId::index)).collect(),
            region,
            region_names,
            contact_nodes: model.contact.nodes.iter().map(|n| n.index()).collect(),
            target_edges: model.target_edges().map(|e| e.nodes.map(NodeId::index)).collect(),
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
            contact: scene.model.target().map(|_| contact),
        }
    }

    fn vtu(&self, solution: &Solution, bars: &ErrorEstimates) -> String {
        let error = bars.mesh.error_map();
        let flat = |of: &dyn Fn(&State) -> [f64; 3]| -> Vec<f64> {
            solution.elements.iter().flat_map(of).collect()
        };
        let sigma = flat(&|s| s.sigma.into());
        let epsilon = flat(&|s| s.epsilon.into());
        let stress = values(solution, |s| s.von_mises_stress);
        let strain = values(solution, |s| s.von_mises_strain);
        let body: Vec<f64> = self.region.iter().map(|r| *r as f64).collect();
        vtu(&VtuMesh {
            points: &self.points,
            triangles: &self.triangles,
            point_data: &[Data {
                name: "displacement",
                components: 2,
                values: solution.u.as_slice(),
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
fn regions(model: &Model) -> (Vec<usize>, Vec<String>) {
    let target = model.target().unwrap_or(&model.bodies[0]);
    let others = model.bodies.iter().filter(|body| body.name != target.name);
    let mut region = vec![0; model.triangles.len()];
    let mut names = Vec::new();
    for (k, body) in std::iter::once(target).chain(others).enumerate() {
        names.push(body.name.clone());
        body.triangles.iter().for_each(|id| region[id.index()] = k);
    }
    (region, names)
}
