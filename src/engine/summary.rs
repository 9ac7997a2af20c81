//! The largest values of each body, for tables and result files.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::solution::Solution;
use numbers::largest::{Largest, largest};
use problem::model::{Body, TriangleId};

/// The largest displacement, stress and strain of a body.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct BodySummary {
    /// The name of the body.
    pub name: String,
    /// The number of its nodes.
    pub nodes: usize,
    /// The number of its triangles.
    pub triangles: usize,
    /// The largest displacement |u| of a node, length.
    pub max_displacement: f64,
    /// The largest von Mises stress of its triangles.
    pub max_von_mises_stress: f64,
    /// The triangle with that stress, the first of those that have it.
    pub at: TriangleId,
    /// The number of other triangles with the same stress to 1e-9 of it, as mirror images have: only
    /// rounding tells which is the largest.
    pub as_large: usize,
    /// The centre of that triangle, length.
    pub centre: [f64; 2],
    /// The largest von Mises strain of its triangles.
    pub max_von_mises_strain: f64,
}

/// Returns a summary of each body, in the model's order.
pub fn summaries(solution: &Solution) -> Vec<BodySummary> {
    solution.model.bodies.iter().map(|body| summary(body, solution)).collect()
}

fn summary(body: &Body, solution: &Solution) -> BodySummary {
    let state = |id: TriangleId| &solution.elements[id.index()];
    let stress = |id: TriangleId| state(id).von_mises_stress;
    let stresses = body.triangles.iter().map(|id| stress(*id));
    let Largest { first, others } = largest(stresses).expect("a body has a triangle");
    let at = body.triangles[first];
    let length = |[x, y]: [f64; 2]| x.hypot(y);
    let moved = body.nodes.iter().map(|n| length(n.of(&solution.u)));
    let strains = body.triangles.iter().map(|&id| state(id).von_mises_strain);
    let corners = solution.model.corners(at);
    BodySummary {
        name: body.name.clone(),
        nodes: body.nodes.len(),
        triangles: body.triangles.len(),
        max_displacement: moved.fold(0.0, f64::max),
        max_von_mises_stress: stress(at),
        at,
        as_large: others,
        centre: [0, 1].map(|axis| corners.iter().map(|p| p[axis]).sum::<f64>() / 3.0),
        max_von_mises_strain: strains.fold(0.0, f64::max),
    }
}
