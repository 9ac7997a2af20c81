//! The finite element model: nodes, triangles, materials, restraints, load, contact surfaces.
//!
//! Everything counts from 0, each thing by a type of its own. The paper's tables, which count from
//! 1, are made from a model in one place (`paper::door`).

mod body;
mod bounds;
mod force;
mod holds;
mod ids;
mod rigid;
mod sides;

use std::collections::{BTreeSet, HashSet};

use serde::{Deserialize, Serialize};

use nalgebra::DVector;

pub use body::{Body, bodies, lowest};
pub use bounds::Bounds;
pub use force::Force;
#[cfg(feature = "scenes")]
pub(crate) use holds::crossing;
pub use holds::{Hold, Holds};
pub use ids::{Dof, EdgeId, NodeId, TriangleId};
pub use rigid::{FREE, RigidBody, freedom};
pub use sides::{BEND, Sides, TriangleSide, unordered};

use super::element::{Corners, Plane};
use numbers::scalar::Scalar;

/// The sum of forces, over the sum of their sizes, up to which it is the rounding of forces that cancel each
/// other.
pub(crate) const CANCELLED: f64 = 1e-13;

/// An isotropic elastic material.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Serialize)]
#[cfg_attr(feature = "scenes", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Material {
    /// The elastic modulus, stress.
    #[serde(rename = "E")]
    pub e: f64,
    /// Poisson's ratio, which has no unit.
    pub nu: f64,
}

/// A triangle of the mesh.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Triangle {
    /// The nodes of the corners, counter-clockwise.
    pub nodes: [NodeId; 3],
    /// Its material.
    pub material: Material,
}

impl Triangle {
    /// Returns its sides, which leave it on their left.
    pub fn sides(&self) -> [[NodeId; 2]; 3] {
        let [a, b, c] = self.nodes;
        [[a, b], [b, c], [c, a]]
    }
}

/// An edge that the mesh names.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct Edge {
    /// The number of the edge in the mesh file.
    pub number: usize,
    /// The nodes of the edge, in the order of the mesh file.
    pub nodes: [NodeId; 2],
}

/// The two contact surfaces, both empty without contact.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct ContactSurfaces {
    /// The nodes of the contact (stamp) surface, in order along it.
    pub nodes: Vec<NodeId>,
    /// The edges of the target surface, in the order in which they are searched.
    pub target: Vec<EdgeId>,
    /// The tolerance of the contact search, length.
    pub tolerance: f64,
}

/// An element of the mesh file: a row of a table that only the paper's computations need.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct Row {
    /// The number of the element in the mesh file.
    pub number: usize,
    /// The tag of the first physical group to which it belongs; 0 where it belongs to none.
    pub physical: usize,
    /// The tag of the geometric entity to which it belongs.
    pub geometric: usize,
    /// The point, edge or triangle that the row describes.
    pub element: Element,
}

/// The kind of an element of the mesh file, and its place in the model.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub enum Element {
    /// A point, by its node.
    Point(NodeId),
    /// An edge of a group.
    Edge(EdgeId),
    /// A triangle.
    Triangle(TriangleId),
}

/// The finite element model. Lengths, forces and stresses are in any consistent unit.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Model {
    /// The plane problem: plane strain or plane stress.
    pub plane: Plane,
    /// The thickness across the plane, length.
    pub thickness: f64,
    /// The coordinates of each node, length.
    pub nodes: Vec<[f64; 2]>,
    /// The z coordinate of the plane, length, as in the mesh file; it has no effect.
    pub z: f64,
    /// The triangles, in the order of the mesh file.
    pub triangles: Vec<Triangle>,
    /// The sides of all triangles.
    pub sides: Sides,
    /// The edges that the mesh names, by ascending number.
    pub edges: Vec<Edge>,
    /// What holds the nodes.
    pub holds: Holds,
    /// What each restraint of the scene holds, as the scene says: the name of a group, or a node.
    pub restraints: Vec<String>,
    /// The nodes that belong to no triangle, ascending: no equation has them, and both of their degrees
    /// of freedom count as fixed.
    pub dropped: Vec<NodeId>,
    /// The parts of the load, as the scene states them.
    pub forces: Vec<Force>,
    /// The load by degree of freedom, restrained ones included, force, as `f64` adds it up.
    pub load: DVector<f64>,
    /// The part of the load that each stage adds, in order, restrained degrees of freedom included,
    /// force; they sum to the load.
    pub stages: Vec<DVector<f64>>,
    /// The bodies, by their lowest node.
    pub bodies: Vec<Body>,
    /// The contact surfaces; both are empty where there is no contact.
    pub contact: ContactSurfaces,
    /// The elements of the mesh file, by ascending number.
    pub rows: Vec<Row>,
}

impl Model {
    /// Returns the number of degrees of freedom, restrained ones included.
    pub fn dofs(&self) -> usize {
        2 * self.nodes.len()
    }

    /// Returns every node, in order.
    pub fn node_ids(&self) -> impl DoubleEndedIterator<Item = NodeId> + Clone + use<> {
        NodeId::all(self.nodes.len())
    }

    /// Returns whether a node belongs to no triangle.
    pub fn is_dropped(&self, node: NodeId) -> bool {
        self.dropped.binary_search(&node).is_ok()
    }

    /// Returns the smallest box around the nodes of the triangles.
    pub fn bounds(&self) -> Bounds {
        Bounds::around(
            self.bodies.iter().flat_map(|body| &body.nodes).map(|n| &self.nodes[n.index()]),
        )
    }

    /// Returns every triangle, in order.
    pub fn triangle_ids(&self) -> impl DoubleEndedIterator<Item = TriangleId> + Clone + use<> {
        TriangleId::all(self.triangles.len())
    }

    /// Returns every degree of freedom, in order.
    pub fn all_dofs(&self) -> impl DoubleEndedIterator<Item = Dof> + Clone + use<> {
        Dof::all(self.dofs())
    }

    /// Returns the coordinates of a node, length.
    pub fn coordinates(&self, node: NodeId) -> [f64; 2] {
        self.nodes[node.index()]
    }

    /// Returns a triangle.
    pub fn triangle(&self, id: TriangleId) -> &Triangle {
        &self.triangles[id.index()]
    }

    /// Returns the materials, each once, in the order of the triangles.
    pub fn materials(&self) -> Vec<Material> {
        let mut found = Vec::new();
        for Triangle { material, .. } in &self.triangles {
            if !found.contains(material) {
                found.push(*material);
            }
        }
        found
    }

    /// Returns an edge.
    pub fn edge(&self, id: EdgeId) -> &Edge {
        &self.edges[id.index()]
    }

    /// Returns the coordinates of the corners of a triangle, length.
    pub fn corners(&self, id: TriangleId) -> Corners<f64> {
        self.triangle(id).nodes.map(|node| self.coordinates(node))
    }

    /// Adds a node that belongs to no triangle, and that nothing holds.
    pub fn add_node(&mut self, at: [f64; 2]) {
        self.nodes.push(at);
        self.holds.add_node();
    }

    /// Returns whether a degree of freedom is restrained: its displacement is given, and it has no equation.
    pub fn is_restrained(&self, dof: Dof) -> bool {
        self.holds.given(dof).is_some()
    }

    /// Returns which of a node's two displacements are restrained.
    pub fn restraints_of(&self, node: NodeId) -> [bool; 2] {
        node.dofs().map(|dof| self.is_restrained(dof))
    }

    /// Returns the name of the restraint of a hold; empty for what no restraint of the scene gives.
    pub fn restraint_of(&self, hold: &Hold) -> &str {
        hold.restraint.map_or("", |k| &self.restraints[k])
    }

    /// Returns the nodes that each restraint of the scene holds.
    pub fn held_nodes(&self) -> Vec<BTreeSet<NodeId>> {
        let mut nodes = vec![BTreeSet::new(); self.restraints.len()];
        let by_restraint = self.holds.iter().filter_map(|hold| Some((hold.restraint?, hold.node)));
        by_restraint.for_each(|(k, node)| _ = nodes[k].insert(node));
        nodes
    }

    /// Returns the number of equations: motions of nodes that nothing holds.
    pub fn free_dofs(&self) -> usize {
        self.dofs() - self.holds.iter().len()
    }

    /// Returns the load by degree of freedom, restrained ones included, force, computed in T from
    /// numbers that pass through `number`.
    pub fn load_in<T: Scalar>(&self, number: impl Fn(f64) -> T) -> DVector<T> {
        let mut f = DVector::from_element(self.dofs(), T::zero());
        self.forces.iter().for_each(|force| force.add_to(&mut f, self, &number));
        f
    }

    /// Returns the load by degree of freedom after a part of the stages: 1.5 is the first stage and half
    /// of the second; restrained degrees of freedom included, force.
    pub fn load_after(&self, part: f64) -> DVector<f64> {
        let zero = DVector::zeros(self.dofs());
        self.stages.iter().enumerate().fold(zero, |mut sum, (stage, load)| {
            sum.axpy((part - stage as f64).clamp(0.0, 1.0), load, 1.0);
            sum
        })
    }

    /// Returns a load by degree of freedom with 0 at restrained ones, force.
    pub fn free_part<T: Scalar>(&self, load: &DVector<T>) -> DVector<T> {
        let free = |(dof, load): (Dof, &T)| if self.is_restrained(dof) { T::zero() } else { *load };
        DVector::from_iterator(self.dofs(), self.all_dofs().zip(load.iter()).map(free))
    }

    /// Returns the sum of the loads along x and y, force; 0 where they cancel each other to rounding.
    pub fn total_load(&self) -> [f64; 2] {
        let nodes = self.load.as_slice().chunks_exact(2);
        [0, 1].map(|direction| {
            let loads = nodes.clone().map(|load| load[direction]);
            let (sum, sizes): (f64, f64) = (loads.clone().sum(), loads.map(f64::abs).sum());
            if sum.abs() > CANCELLED * sizes { sum } else { 0.0 }
        })
    }

    /// Returns whether there are contact nodes and a target.
    pub fn has_contact(&self) -> bool {
        !self.contact.nodes.is_empty()
    }

    /// Returns the target edges, in the order in which they are searched.
    pub fn target_edges(&self) -> impl Iterator<Item = &Edge> + Clone {
        self.contact.target.iter().map(|id| self.edge(*id))
    }

    /// Returns the distance of two nodes, length.
    pub fn length(&self, nodes: [NodeId; 2]) -> f64 {
        let [[ax, ay], [bx, by]] = nodes.map(|node| self.coordinates(node));
        (bx - ax).hypot(by - ay)
    }

    /// Returns the nodes of both contact surfaces.
    pub fn surface_nodes(&self) -> HashSet<NodeId> {
        let ends = self.target_edges().flat_map(|edge| edge.nodes);
        self.contact.nodes.iter().copied().chain(ends).collect()
    }

    /// Returns the body that has the target surface; None without contact.
    pub fn target(&self) -> Option<&Body> {
        self.body_of(self.target_edges().next()?.nodes[0])
    }

    /// Returns the body that has `node`.
    pub fn body_of(&self, node: NodeId) -> Option<&Body> {
        self.bodies.iter().find(|body| body.has(node))
    }

    /// Returns the coordinates of each node after displacements `u`, length.
    pub fn shape(&self, u: &DVector<f64>) -> Vec<[f64; 2]> {
        let moved = |(node, [x, y]): (NodeId, &[f64; 2])| {
            let [ux, uy] = node.components(u);
            [x + ux, y + uy]
        };
        self.node_ids().zip(&self.nodes).map(moved).collect()
    }
}
