//! The largest values of each body.

use serde::Serialize;

use super::outcome::Outcome;
use crate::problem::scene::{Body, Scene};

/// The largest values of a body.
#[derive(Clone, Debug, Serialize)]
pub struct BodySummary {
    /// The body.
    pub name: String,
    /// Number of its nodes.
    pub nodes: usize,
    /// Number of its triangles.
    pub triangles: usize,
    /// Largest |u| of a node, length.
    pub max_displacement: f64,
    /// Largest von Mises stress.
    pub max_von_mises_stress: f64,
    /// The triangle that has it: row of `EL`.
    pub at: usize,
    /// Centre of that triangle, length.
    pub centre: [f64; 2],
    /// Largest von Mises strain.
    pub max_von_mises_strain: f64,
}

/// One summary a body.
pub fn summaries(scene: &Scene, outcome: &Outcome) -> Vec<BodySummary> {
    scene.bodies.iter().map(|body| summary(body, outcome)).collect()
}

fn summary(body: &Body, outcome: &Outcome) -> BodySummary {
    let stress = |n: usize| outcome.elements[n - 1].von_mises_stress;
    let strain = |n: usize| outcome.elements[n - 1].von_mises_strain;
    let at =
        body.triangles.iter().copied().reduce(|a, b| if stress(b) > stress(a) { b } else { a });
    let at = at.expect("a body has a triangle");
    BodySummary {
        name: body.name.clone(),
        nodes: body.nodes.len(),
        triangles: body.triangles.len(),
        max_displacement: body
            .nodes
            .iter()
            .map(|n| outcome.u[2 * n - 2].hypot(outcome.u[2 * n - 1]))
            .fold(0.0, f64::max),
        max_von_mises_stress: stress(at),
        at,
        centre: centre(outcome, at),
        max_von_mises_strain: body.triangles.iter().map(|&n| strain(n)).fold(0.0, f64::max),
    }
}

/// Centre of triangle `n`.
fn centre(outcome: &Outcome, n: usize) -> [f64; 2] {
    let sheet = &outcome.sheet;
    [2, 3].map(|column| {
        (0..3).map(|k| sheet.node[(sheet.EL[(n, sheet.ind_1 + k)], column)]).sum::<f64>() / 3.0
    })
}
