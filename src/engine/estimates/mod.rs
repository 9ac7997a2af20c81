//! Error estimates: how far a printed number may be from the truth. Each number has two, for the
//! effect of rounding and for the effect of the mesh.
//!
//! ```text
//!  Model, States --recovery--> stresses ---------------discretisation-------> errors of the mesh
//!  Solution ---------------------------------------- and these --dual--> errors of displacements
//!  Solution ---------------------------------------------- arithmetic -----> errors of rounding
//!  Solution ---------------------------------------------- singular -> where stress has no limit
//! ```

pub mod arithmetic;
pub mod discretisation;
mod dual;
mod factors;
mod recovery;
mod singular;
pub mod ties;

use nalgebra::DVector;
use serde::{Deserialize, Serialize};

use super::distance::finite;
use super::solution::{Solution, max_displacement};
use crate::Decision;
pub use arithmetic::{Certainty, certain};
use discretisation::Discretisation;
pub(super) use dual::Dual;
pub(super) use factors::StateFactors;
use numbers::largest::is_as_large;
use problem::model::{Body, NodeId, TriangleId};
pub use singular::{Cause, Singular, singular};

/// The estimates of a run: its errors, and the field of the mesh's error.
#[derive(Clone, Debug)]
pub struct Estimates {
    /// The estimates of its errors.
    pub errors: ErrorEstimates,
    /// The error that the mesh causes in the stresses.
    pub mesh: Discretisation,
}

/// How far the numbers of a run may be from the truth; nothing where that is not known.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ErrorEstimates {
    /// What rounding may do to a displacement, length.
    pub displacement_arithmetic: Option<f64>,
    /// The decisions on who is in contact that rounding may have taken.
    pub decided_by_rounding: Option<Vec<Decision>>,
    /// What the mesh may do to the largest displacement of a node, length.
    pub displacement_mesh: Option<f64>,
    /// The node at which the largest displacement has no limit as the mesh is refined, and why.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub displacement_no_limit: Option<(NodeId, Cause)>,
    /// The error of the mesh in the energy norm, relative to the norm of the solution.
    pub mesh_energy_relative: Option<f64>,
    /// The estimates for each body.
    pub bodies: Vec<BodyEstimates>,
}

/// How far a body's largest von Mises stress may be from the truth.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct BodyEstimates {
    /// The name of the body.
    pub name: String,
    /// Its largest von Mises stress.
    pub von_mises_stress: f64,
    /// The largest von Mises value of the recovered stresses, as a rule nearer to the truth.
    pub recovered: f64,
    /// What the mesh may do to it, stress; nothing where that is not known, and where it was found
    /// at a point where the stress has no limit.
    pub mesh: Option<f64>,
    /// A point of the body where the stress has no limit as the mesh is refined; what the mesh may
    /// do is said of the other ones.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub no_limit: Option<NoLimit>,
    /// What rounding may do to it, stress; nothing where that is not known.
    pub arithmetic: Option<f64>,
}

/// A point of a body where the stress grows without limit as the mesh is refined.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
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
        let of_rounding = || {
            // Another run takes much memory: nothing is held yet that it does not need.
            let of_run = arithmetic::published_rounding(solution);
            let (state, bounded) = (StateFactors::new(solution), arithmetic::bounded(model));
            let of_last = || arithmetic::equilibrium_rounding(solution, state.as_ref(), &bounded);
            let rounding = of_run.unwrap_or_else(of_last);
            let stress = arithmetic::stress_bounds(solution, &bounded, rounding.displacement);
            (state, rounding, stress)
        };
        let of_mesh = || (Discretisation::new(model, &solution.elements), singular(solution));
        let ((state, rounding, stress), (mesh, points)) = rayon::join(of_rounding, of_mesh);
        let bodies = model.bodies.iter().map(|body| {
            let states = &solution.elements;
            let largest = mesh.largest_von_mises(model, states, &body.triangles);
            let loaded = Some(&points).filter(|_| largest.value > 0.0);
            let no_limit = loaded.and_then(|points| no_limit(body, points, largest.at));
            let is_smooth = |id: &TriangleId| !points.iter().any(|p| p.triangles.contains(id));
            let smooth: Vec<TriangleId> =
                body.triangles.iter().copied().filter(is_smooth).collect();
            let rounding = body.triangles.iter().map(|id| stress[id.index()]);
            BodyEstimates {
                name: body.name.clone(),
                von_mises_stress: largest.value,
                recovered: largest.recovered,
                mesh: match no_limit {
                    Some(NoLimit { is_largest: true, .. }) => None,
                    Some(_) => finite(mesh.largest_von_mises(model, states, &smooth).error),
                    None => finite(largest.error),
                },
                no_limit,
                arithmetic: finite(rounding.fold(0.0, f64::max)),
            }
        });
        let bodies = bodies.collect();
        let displacement_no_limit = unlimited(solution, &points);
        let displacement_mesh =
            state.filter(|_| displacement_no_limit.is_none()).and_then(|state| {
                finite(Dual::new(solution, state, &mesh).error_of_largest(&solution.u))
            });
        let errors = ErrorEstimates {
            displacement_arithmetic: rounding.displacement,
            decided_by_rounding: rounding.decisions,
            displacement_mesh,
            displacement_no_limit,
            mesh_energy_relative: finite(mesh.relative()),
            bodies,
        };
        Estimates { errors, mesh }
    }
}

/// Returns the point that leaves the largest displacement without a limit: a node that is held alone,
/// from which all are measured, or the node under a force where it moves most.
fn unlimited(solution: &Solution, points: &[Singular]) -> Option<(NodeId, Cause)> {
    let size =
        |node: NodeId| max_displacement(&DVector::from_row_slice(&node.components(&solution.u)));
    let largest = max_displacement(&solution.u);
    let counts = |point: &&Singular| {
        let moves_most = is_as_large(size(point.node), largest, largest);
        point.cause.moves() && (point.cause == Cause::Support || moves_most)
    };
    points.iter().find(counts).map(|point| (point.node, point.cause))
}

/// Returns the point of a body where the stress has no limit, that where its largest stress was
/// found before the others.
fn no_limit(body: &Body, points: &[Singular], largest: TriangleId) -> Option<NoLimit> {
    let is_largest = |point: &Singular| point.triangles.contains(&largest);
    let mut of_body = points
        .iter()
        .filter(|point| point.triangles.iter().any(|id| body.triangles.binary_search(id).is_ok()));
    let first = of_body.clone().next()?;
    let point = of_body.find(|point| is_largest(point)).unwrap_or(first);
    Some(NoLimit { node: point.node, cause: point.cause, is_largest: is_largest(point) })
}
