//! Error estimates: how far a printed number may be from the truth. Each number has two, for the
//! effect of rounding and for the effect of the mesh.
//!
//! ```text
//!  Model, States --patches--> sites --recovery--> stresses --discretisation--> errors of the mesh
//!  Solution ---------------------------------------- and these --dual--> errors of displacements
//!  Solution ---------------------------------------------- arithmetic -----> errors of rounding
//!  Solution ---------------------------------------------- singular -> where stress has no limit
//! ```

pub mod arithmetic;
mod certain;
pub mod discretisation;
mod dual;
mod patches;
mod recovery;
mod singular;
pub mod ties;

use nalgebra::DVector;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::held::Held;
use super::side_by_side::side_by_side;
use super::solution::{Solution, max_displacement};
use crate::numbers::largest::is_as_large;
use crate::paper::decisions::Decision;
use crate::problem::model::{Body, NodeId, TriangleId};
pub use certain::{Certainty, certain};
use discretisation::Discretisation;
pub(super) use dual::Dual;
pub use singular::{Cause, Singular, singular};

/// The error estimates of a run.
#[derive(Clone, Debug)]
pub struct ErrorEstimates {
    /// A bound on the rounding error of any displacement, length; infinite where unknown, as where
    /// rounding may have decided who is in contact.
    pub displacement: f64,
    /// The decisions on who is in contact that rounding may have taken; None where that is not known.
    pub decisions: Option<Vec<Decision>>,
    /// The estimated error of the largest displacement |u| of a node that the mesh causes, length;
    /// infinite where unknown.
    pub displacement_mesh: f64,
    /// The node at which the largest displacement has no limit as the mesh is refined, and why; None
    /// where it has one.
    pub unlimited: Option<(NodeId, Cause)>,
    /// The error that the mesh causes in the stresses.
    pub mesh: Discretisation,
    /// The error estimates of each body's largest stress, in the model's order.
    pub bodies: Vec<BodyEstimates>,
}

/// A body's largest von Mises stress and its error estimates, stress; infinite where unknown.
#[derive(Clone, Debug, PartialEq)]
pub struct BodyEstimates {
    /// The name of the body.
    pub name: String,
    /// The largest von Mises stress of its triangles, stress.
    pub value: f64,
    /// The largest of the recovered stresses, typically nearer to the truth, stress.
    pub recovered: f64,
    /// The estimated error of `value` that the mesh causes, stress; infinite too where `no_limit`
    /// is where `value` was found.
    pub mesh: f64,
    /// A point of the body where the stress has no limit as the mesh is refined; None where there
    /// is none.
    pub no_limit: Option<NoLimit>,
    /// A bound on the error of `value` that rounding causes, stress.
    pub arithmetic: f64,
}

/// A point of a body where the stress grows without limit as the mesh is refined.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct NoLimit {
    /// The node that stands there; of contact, that of the contact surface.
    pub node: NodeId,
    /// Why the stress has no limit.
    pub cause: Cause,
    /// Whether the body's largest stress was found in a triangle about it.
    pub is_largest: bool,
}

impl ErrorEstimates {
    /// Estimates the errors of a run.
    pub fn new(solution: &Solution) -> Self {
        let model = &*solution.model;
        let of_rounding = || {
            // Another run takes much memory: nothing is held yet that it does not need.
            let of_run = arithmetic::of_published(solution, &mut |_| true);
            let (held, bounded) = (Held::new(solution), arithmetic::bounded(model));
            let of_last = || arithmetic::of_equilibrium(solution, held.as_ref(), &bounded);
            let rounding = of_run.unwrap_or_else(of_last);
            let stress = arithmetic::stress_bounds(solution, &bounded, rounding.displacement);
            (held, rounding, stress)
        };
        let of_mesh = || (Discretisation::new(model, &solution.elements), singular(solution));
        let ((held, rounding, stress), (mesh, points)) = side_by_side(model, of_rounding, of_mesh);
        let arithmetic::Rounding { displacement, decisions, .. } = rounding;
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
                value: largest.value,
                recovered: largest.recovered,
                mesh: match no_limit {
                    Some(NoLimit { is_largest: true, .. }) => f64::INFINITY,
                    Some(_) => mesh.largest_von_mises(model, states, &smooth).error,
                    None => largest.error,
                },
                no_limit,
                arithmetic: rounding.fold(0.0, f64::max),
            }
        });
        let bodies = bodies.collect();
        let of_largest = |dual: Dual| dual.error_of_largest(&solution.u);
        let unlimited = unlimited(solution, &points);
        let displacement_mesh = match held {
            Some(held) if unlimited.is_none() => of_largest(Dual::new(solution, held, &mesh)),
            _ => f64::INFINITY,
        };
        ErrorEstimates { displacement, decisions, displacement_mesh, unlimited, bodies, mesh }
    }
}

/// Returns the point that leaves the largest displacement without a limit: a node that is held alone,
/// from which all are measured, or the node under a force where it moves most.
fn unlimited(solution: &Solution, points: &[Singular]) -> Option<(NodeId, Cause)> {
    let size = |node: NodeId| max_displacement(&DVector::from_row_slice(&node.of(&solution.u)));
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
