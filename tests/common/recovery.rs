//! Benchmarks run, and stresses at their nodes: a three-node triangle has one stress for the whole
//! of it.

use std::collections::BTreeSet;

use nalgebra::{Matrix3, Vector3};
use plane_contact::engine::{Request, Solution, solve};
use plane_contact::problem::element;
use plane_contact::problem::model::{Model, NodeId, TriangleId};
use plane_contact::problem::modelling::{ContactModel, Variant};
use plane_contact::problem::scene::SceneBuilder;

/// Runs a benchmark under `unilateral`.
pub fn solved(benchmark: SceneBuilder) -> Solution {
    solved_by(benchmark, |_| ())
}

/// The same with contact modelled otherwise.
pub fn solved_by(benchmark: SceneBuilder, change: impl Fn(&mut ContactModel)) -> Solution {
    let scene = benchmark.build().expect("generated scenes are sound");
    let mut request = Request::new(&scene).variant(Variant::Unilateral);
    change(&mut request.contact);
    solve(&request, &mut |_| ()).expect("the benchmark has a solution")
}

/// The node at a place; there must be one.
pub fn node_at(model: &Model, [x, y]: [f64; 2]) -> NodeId {
    let here = |node: &NodeId| {
        let p = model.coordinates(*node);
        (p[0] - x).hypot(p[1] - y) < 1e-9
    };
    model.node_ids().find(here).expect("a node stands there")
}

/// sigma_x, sigma_y, tau_xy at a node: the mean over its triangles, weighted by area. At a boundary
/// first order only.
pub fn averaged(solution: &Solution, node: NodeId) -> [f64; 3] {
    let around = patch(&solution.model, &BTreeSet::from([node]));
    let area = |t: &TriangleId| element::area(&solution.model.corners(*t));
    let total: f64 = around.iter().map(area).sum();
    let sum = around.iter().map(|t| solution.elements[t.index()].sigma * area(t));
    sum.fold(Vector3::zeros(), |a, b| a + b).scale(1.0 / total).into()
}

/// sigma_x, sigma_y, tau_xy at a node of the boundary: the plane through the stresses at the
/// centroids around an inner node, by least squares, taken at the node; the mean over the inner
/// nodes next to it, or next to those where it has none. Second order, for the errors of the
/// triangles around an inner node cancel on a mapped grid.
///
/// Source: O. C. Zienkiewicz, J. Z. Zhu, Int. J. Numer. Methods Eng. 33 (1992) 1331-1364.
pub fn extrapolated(solution: &Solution, node: NodeId) -> [f64; 3] {
    let model = &*solution.model;
    let outer = boundary(model);
    let mut near = BTreeSet::from([node]);
    while near.is_subset(&outer) {
        near = patch(model, &near).iter().flat_map(|t| model.triangle(*t).nodes).collect();
    }
    let inner: Vec<NodeId> = near.difference(&outer).copied().collect();
    let planes = inner.iter().map(|&n| from_patch(solution, n, model.coordinates(node)));
    (planes.fold(Vector3::zeros(), |a, b| a + b) / inner.len() as f64).into()
}

/// The plane through the stresses around node `centre`, at a place.
fn from_patch(solution: &Solution, centre: NodeId, [x0, y0]: [f64; 2]) -> Vector3<f64> {
    let (mut normal, mut right) = (Matrix3::zeros(), Matrix3::zeros());
    for triangle in patch(&solution.model, &BTreeSet::from([centre])) {
        let [a, b, c] = solution.model.corners(triangle);
        let [x, y] = [0, 1].map(|k| (a[k] + b[k] + c[k]) / 3.0);
        let basis = Vector3::new(1.0, x - x0, y - y0);
        normal += basis * basis.transpose();
        right += basis * solution.elements[triangle.index()].sigma.transpose();
    }
    let planes = normal.lu().solve(&right).expect("more than three centroids, not in line");
    planes.row(0).transpose()
}

/// The nodes of the edges that bound one triangle only.
fn boundary(model: &Model) -> BTreeSet<NodeId> {
    let sides = |nodes: [NodeId; 3]| [0, 1, 2].map(|k| [nodes[k], nodes[(k + 1) % 3]]);
    let all = model.triangles.iter().flat_map(|triangle| sides(triangle.nodes));
    all.filter(|side| model.sides.boundary(*side).is_some()).flatten().collect()
}

/// The triangles that have one of `nodes`.
fn patch(model: &Model, nodes: &BTreeSet<NodeId>) -> Vec<TriangleId> {
    let touches = |t: &TriangleId| model.triangle(*t).nodes.iter().any(|n| nodes.contains(n));
    model.triangle_ids().filter(touches).collect()
}

/// Order of convergence between two meshes, the second with half the element size.
pub fn order(coarse_error: f64, fine_error: f64) -> f64 {
    (coarse_error / fine_error).abs().log2()
}
