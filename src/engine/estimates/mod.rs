//! Error estimates: how far a printed number may be from the truth, for the effect of rounding and for
//! the effect of the mesh.
//!
//! ```text
//!  Model, States --recovery--> stresses --discretisation--> error of the mesh, in the energy norm
//!  Solution --------------------------------perturbed-----> what rounding does, measured
//!  Solution --------------------------------singular------> where stress has no limit
//! ```

pub mod discretisation;
mod perturbed;
mod recovery;
mod singular;

use serde::Serialize;

use super::solution::{Solution, max_displacement};
use discretisation::Discretisation;
use numbers::finite;
use numbers::largest::{is_as_large, largest};
pub use perturbed::{
    Certainty, ContactChange, Perturbed, RUNS, When, certain, equivalent, moves, perturbed,
    perturbed_requests,
};
use problem::model::{Body, NodeId};
pub use singular::{Cause, Singular, contact_ends, singular};

/// The estimates of a run: its errors, and the field of the mesh's error.
#[derive(Clone, Debug)]
pub struct Estimates {
    /// The estimates of its errors.
    pub errors: ErrorEstimates,
    /// The error that the mesh causes in the stresses.
    pub mesh: Discretisation,
}

/// How far the mesh leaves the numbers of a run from the truth; nothing where that is not known. What it does
/// to one displacement or stress is not estimated: `trade --only mesh` measures it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ErrorEstimates {
    /// The node at which the largest displacement has no limit as the mesh is refined, and why.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub displacement_no_limit: Option<(NodeId, Cause)>,
    /// The error of the mesh in the energy norm, relative to the norm of the solution.
    pub mesh_energy_relative: Option<f64>,
    /// The estimates for each body.
    pub bodies: Vec<BodyEstimates>,
}

/// How far a body's largest von Mises stress may be from the truth.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct BodyEstimates {
    /// The name of the body.
    pub name: String,
    /// Its largest von Mises stress.
    pub von_mises_stress: f64,
    /// A point of the body where the stress has no limit as the mesh is refined.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub no_limit: Option<NoLimit>,
}

/// A point of a body where the stress grows without limit as the mesh is refined.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct NoLimit {
    /// The node that stands there; of contact, that of the contact surface.
    pub node: NodeId,
    /// Why the stress has no limit.
    pub cause: Cause,
    /// Whether the body's largest stress was found in a triangle about it.
    pub is_largest: bool,
}

impl Estimates {
    /// Estimates the errors of a run.
    pub fn new(solution: &Solution) -> Self {
        let model = &*solution.model;
        let (mesh, points) = (Discretisation::new(model, &solution.elements), singular(solution));
        let of_body = |body: &Body| {
            let stresses =
                body.triangles.iter().map(|id| solution.elements[id.index()].von_mises_stress);
            let found = largest(stresses).expect("a body has a triangle");
            let near = |point: &&Singular, triangle: usize| {
                point.is_near(model.triangle(body.triangles[triangle]))
            };
            let is_largest = |point: &&Singular| near(point, found.first);
            let in_body = |point: &&Singular| (0..body.triangles.len()).any(|k| near(point, k));
            let point = points.iter().find(is_largest).or_else(|| points.iter().find(in_body));
            let value = solution.elements[body.triangles[found.first].index()].von_mises_stress;
            BodyEstimates {
                name: body.name.clone(),
                von_mises_stress: value,
                no_limit: point.filter(|_| value > 0.0).map(|point| NoLimit {
                    node: point.node,
                    cause: point.cause,
                    is_largest: is_largest(&point),
                }),
            }
        };
        let bodies = model.bodies.iter().map(of_body).collect();
        let errors = ErrorEstimates {
            displacement_no_limit: unlimited(solution, &points),
            mesh_energy_relative: finite(mesh.relative()),
            bodies,
        };
        Estimates { errors, mesh }
    }
}

/// Returns the point that leaves the largest displacement without a limit: a node that is held alone,
/// from which all are measured, or the node under a force where it moves most.
fn unlimited(solution: &Solution, points: &[Singular]) -> Option<(NodeId, Cause)> {
    let most = max_displacement(&solution.u);
    let counts = |point: &&Singular| {
        let [x, y] = point.node.components(&solution.u);
        let is_held = !solution.model.holds.of(point.node).is_empty();
        point.cause == Cause::Force && (is_held || is_as_large(x.hypot(y), most, most))
    };
    points.iter().find(counts).map(|point| (point.node, point.cause))
}
