//! Bodies that are their own mirror image about x = 0: the right half is triangulated, the left one
//! is its copy.

use super::delaunay::triangulate;
use problem::scene::MeshBuilder;

/// Nodes along the curves that bound the right half of a body, and their mirror images. Every curve
/// runs with the body on its left; the next begins where it ends, the first where the last ends.
pub struct Mirrored {
    right: Vec<Vec<usize>>,
    left: Vec<Vec<usize>>,
}

impl Mirrored {
    /// Adds a body whose right half is bounded by `curves`, points along each, length. The
    /// triangles go to the group `body`; `size` is their target edge length at a place, length.
    pub fn add(
        mesh: &mut MeshBuilder,
        body: &str,
        curves: &[Vec<[f64; 2]>],
        size: impl Fn([f64; 2]) -> f64,
    ) -> Self {
        let polygon: Vec<[f64; 2]> =
            curves.iter().flat_map(|curve| &curve[..curve.len() - 1]).copied().collect();
        let half = triangulate(&polygon, size);
        let right = mesh.row(half.nodes);
        let left: Vec<usize> = right.iter().map(|&node| image(mesh, node)).collect();
        mesh.triangles(body, half.triangles.iter().map(|t| t.map(|place| right[place])));
        // The mirror image of a triangle runs clockwise.
        mesh.triangles(body, half.triangles.iter().map(|&[a, b, c]| [left[a], left[c], left[b]]));
        let along = |nodes: &[usize]| split(&nodes[..polygon.len()], curves);
        Mirrored { right: along(&right), left: along(&left) }
    }

    /// The nodes along curve `k`, from 0.
    pub fn right(&self, k: usize) -> &[usize] {
        &self.right[k]
    }

    /// The mirror images of the nodes along curve `k`, from 0, in the curve's order.
    pub fn left(&self, k: usize) -> &[usize] {
        &self.left[k]
    }
}

/// Returns the node itself where it stands on the axis, else a new node at its image's place.
fn image(mesh: &mut MeshBuilder, node: usize) -> usize {
    let [x, y] = mesh.xy(node);
    if x == 0.0 { node } else { mesh.node([-x, y]) }
}

/// Splits a polygon's nodes by its curves, each with both its ends.
fn split(nodes: &[usize], curves: &[Vec<[f64; 2]>]) -> Vec<Vec<usize>> {
    let mut start = 0;
    let nodes_of = |curve: &Vec<[f64; 2]>| {
        let all = (start..start + curve.len()).map(|k| nodes[k % nodes.len()]).collect();
        start += curve.len() - 1;
        all
    };
    curves.iter().map(nodes_of).collect()
}
