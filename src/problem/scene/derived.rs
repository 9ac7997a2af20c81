//! A scene on a mesh that was made of another one's: a finer one, or half of it.

use nalgebra::DVector;

use super::Scene;
use crate::model::{NodeId, TriangleId};

/// A scene on a mesh that was made of another one's.
#[derive(Clone, Debug)]
pub struct Derived {
    /// The scene.
    pub scene: Scene,
    /// For each of its nodes, the two nodes of the other mesh halfway between which it stands: the same one
    /// twice where it is that node.
    pub nodes: Vec<[NodeId; 2]>,
    /// For each of its triangles, the triangle of the other mesh in which it lies.
    pub triangles: Vec<TriangleId>,
}

impl Derived {
    /// Returns displacements of the other mesh at the nodes of this one, both by degree of freedom, length:
    /// they are linear along each edge.
    pub fn displacements(&self, u: &DVector<f64>) -> DVector<f64> {
        let of_node = |ends: &[NodeId; 2]| {
            let [a, b] = ends.map(|node| node.components(u));
            [0, 1].map(|d| (a[d] + b[d]) / 2.0)
        };
        DVector::from_iterator(2 * self.nodes.len(), self.nodes.iter().flat_map(of_node))
    }
}
