//! Benchmarks run, and stresses at their nodes: a three-node triangle has one stress for the whole of it.

use std::collections::{BTreeMap, BTreeSet};

use nalgebra::{Matrix3, Vector3};
use plane_contact::answer::contact::{Outcome, run};
use plane_contact::error::InputError;
use plane_contact::paper::mirror::Reading;
use plane_contact::problem::element;
use plane_contact::problem::modelling::{ContactModel, Variant};
use plane_contact::problem::scene::{Element, Mesh, SceneBuilder};

/// Generates a benchmark and runs the variant `unilateral`.
pub fn solved(benchmark: Result<SceneBuilder, InputError>) -> (Mesh, Outcome) {
    solved_by(benchmark, |_| ())
}

/// The same with contact modelled otherwise.
pub fn solved_by(
    benchmark: Result<SceneBuilder, InputError>,
    change: impl Fn(&mut ContactModel),
) -> (Mesh, Outcome) {
    let benchmark = benchmark.expect("the parameters are in range");
    let mut scene = benchmark.build().expect("generated scenes are sound");
    change(&mut scene.contact);
    let outcome = run(&scene, Variant::Unilateral, &Reading::default(), |_| ());
    (benchmark.mesh, outcome.expect("the benchmark has a solution"))
}

/// The node at a place; there must be one.
pub fn node_at(mesh: &Mesh, [x, y]: [f64; 2]) -> usize {
    let here = |p: &[f64; 3]| (p[0] - x).hypot(p[1] - y) < 1e-9;
    mesh.nodes.iter().find(|node| here(&node.xyz)).expect("a node stands there").number
}

/// sigma_x, sigma_y, tau_xy at a node: the mean over its triangles, weighted by area. At a boundary first order only.
pub fn averaged(mesh: &Mesh, outcome: &Outcome, node: usize) -> [f64; 3] {
    let around = patch(mesh, &BTreeSet::from([node]));
    let area = |t: &Element| element::area(&mesh.corners(t));
    let total: f64 = around.iter().map(|(_, t)| area(t)).sum();
    let sum = around.iter().map(|(row, t)| outcome.elements[*row].sigma * area(t));
    sum.fold(Vector3::zeros(), |a, b| a + b).scale(1.0 / total).into()
}

/// sigma_x, sigma_y, tau_xy at a node of the boundary: the plane through the stresses at the centroids around an inner node, by least
/// squares, taken at the node; the mean over the inner nodes next to it, or next to those where it has none. Second order, for the
/// errors of the triangles around an inner node cancel on a mapped grid.
///
/// Source: O. C. Zienkiewicz, J. Z. Zhu, Int. J. Numer. Methods Eng. 33 (1992) 1331-1364.
pub fn extrapolated(mesh: &Mesh, outcome: &Outcome, node: usize) -> [f64; 3] {
    let outer = boundary(mesh);
    let mut near = BTreeSet::from([node]);
    while near.is_subset(&outer) {
        near = patch(mesh, &near).iter().flat_map(|(_, t)| t.nodes.iter().copied()).collect();
    }
    let inner: Vec<usize> = near.difference(&outer).copied().collect();
    let planes = inner.iter().map(|&n| from_patch(mesh, outcome, n, mesh.xy(node)));
    (planes.fold(Vector3::zeros(), |a, b| a + b) / inner.len() as f64).into()
}

/// The plane through the stresses around node `centre`, at a place.
fn from_patch(mesh: &Mesh, outcome: &Outcome, centre: usize, [x0, y0]: [f64; 2]) -> Vector3<f64> {
    let (mut normal, mut right) = (Matrix3::zeros(), Matrix3::zeros());
    for (row, triangle) in patch(mesh, &BTreeSet::from([centre])) {
        let [a, b, c] = mesh.corners(triangle);
        let [x, y] = [0, 1].map(|k| (a[k] + b[k] + c[k]) / 3.0);
        let basis = Vector3::new(1.0, x - x0, y - y0);
        normal += basis * basis.transpose();
        right += basis * outcome.elements[row].sigma.transpose();
    }
    let planes = normal.lu().solve(&right).expect("more than three centroids, not in line");
    planes.row(0).transpose()
}

/// The nodes of the edges that bound one triangle only.
fn boundary(mesh: &Mesh) -> BTreeSet<usize> {
    let mut bounds: BTreeMap<[usize; 2], usize> = BTreeMap::new();
    for t in mesh.of_dimension(2) {
        for k in 0..3 {
            let (a, b) = (t.nodes[k], t.nodes[(k + 1) % 3]);
            *bounds.entry([a.min(b), a.max(b)]).or_default() += 1;
        }
    }
    bounds.into_iter().filter(|(_, count)| *count == 1).flat_map(|(edge, _)| edge).collect()
}

/// The triangles that have one of `nodes`, each with its row of `Outcome::elements`.
fn patch<'m>(mesh: &'m Mesh, nodes: &BTreeSet<usize>) -> Vec<(usize, &'m Element)> {
    let touches = |t: &Element| t.nodes.iter().any(|n| nodes.contains(n));
    mesh.of_dimension(2).enumerate().filter(|(_, t)| touches(t)).collect()
}

/// Order of convergence between two meshes, the second with half the element size.
pub fn order(coarse_error: f64, fine_error: f64) -> f64 {
    (coarse_error / fine_error).abs().log2()
}
