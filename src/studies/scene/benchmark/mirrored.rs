//! Bodies that are their own mirror image about x = 0: the right half is triangulated, the left one
//! is its copy.

use super::delaunay::triangulate;
use problem::scene::MeshBuilder;

/// Nodes along the curves that bound the right half of a body, and their mirror images. Every curve
/// runs with the body on its left; the next begins where it ends, the first where the last ends.
pub struct Mirrored {
    /// The nodes along each curve.
    pub right: Vec<Vec<usize>>,
    /// The mirror images of the nodes along each curve, in the curve's order.
    pub left: Vec<Vec<usize>>,
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
        // A node on the axis is its own image.
        let image = |node: &usize| {
            let [x, y] = mesh.xy(*node);
            if x == 0.0 { *node } else { mesh.node([-x, y]) }
        };
        let left: Vec<usize> = right.iter().map(image).collect();
        mesh.triangles(body, half.triangles.iter().map(|t| t.map(|place| right[place])));
        // The mirror image of a triangle runs clockwise.
        mesh.triangles(body, half.triangles.iter().map(|&[a, b, c]| [left[a], left[c], left[b]]));
        // The polygon's nodes by its curves, each with both its ends.
        let along = |nodes: &[usize]| -> Vec<Vec<usize>> {
            let mut start = 0;
            let of_curve = |curve: &Vec<[f64; 2]>| {
                let places = start..start + curve.len();
                start += curve.len() - 1;
                places.map(|k| nodes[k % polygon.len()]).collect()
            };
            curves.iter().map(of_curve).collect()
        };
        Mirrored { right: along(&right), left: along(&left) }
    }
}
