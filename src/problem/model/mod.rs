//! The finite element model: nodes, triangles, materials, restraints, load and contact surfaces,
//! whoever made them.
//!
//! Everything counts from 0, each thing by a type of its own; the paper's tables, which count from
//! 1, are made from a model behind one door (`paper::door`).

mod body;
mod ids;
mod sides;

use nalgebra::DVector;

pub use body::{Body, bodies, freedom};
pub use ids::{Dof, EdgeId, NodeId, TriangleId};
pub use sides::{Beside, Sides, unordered};

use super::element::{Corners, Plane};

/// An elastic material.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Material {
    /// Elastic modulus, stress.
    pub e: f64,
    /// Poisson's ratio.
    pub nu: f64,
}

/// A three-node triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Triangle {
    /// Its nodes, counter-clockwise.
    pub nodes: [NodeId; 3],
    /// What it is made of.
    pub material: Material,
}

/// An edge that the mesh names.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Edge {
    /// Its number in the mesh file.
    pub number: usize,
    /// Its nodes, in the order of the mesh file.
    pub nodes: [NodeId; 2],
}

/// The two contact surfaces. Without contact both are empty.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ContactSurfaces {
    /// The contact (stamp) surface: its nodes in order along it.
    pub nodes: Vec<NodeId>,
    /// The target surface: its edges in the order in which they are searched.
    pub target: Vec<EdgeId>,
    /// The tolerance of the contact search, length.
    pub tolerance: f64,
}

/// An element as the mesh file has it: the row of a table that no computation needs but the
/// paper's.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Row {
    /// Its number.
    pub number: usize,
    /// Tag of the first physical group that it belongs to; 0 where it belongs to none.
    pub physical: usize,
    /// Tag of its geometric entity.
    pub geometric: usize,
    /// What it is.
    pub element: Element,
}

/// What an element of the mesh file is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Element {
    /// A point.
    Point(NodeId),
    /// An edge of the model.
    Edge(EdgeId),
    /// A triangle of the model.
    Triangle(TriangleId),
}

/// The finite element model. Lengths, forces and stresses in any consistent unit.
#[derive(Clone, Debug, PartialEq)]
pub struct Model {
    /// Plane strain or plane stress.
    pub plane: Plane,
    /// Thickness across the plane, length.
    pub thickness: f64,
    /// Coordinates of each node, length.
    pub nodes: Vec<[f64; 2]>,
    /// The plane's z, length: of the mesh file, and of no effect.
    pub z: f64,
    /// The triangles.
    pub triangles: Vec<Triangle>,
    /// Which triangles have which side.
    pub sides: Sides,
    /// The edges that the mesh names, by ascending number.
    pub edges: Vec<Edge>,
    /// By degree of freedom, whether it is restrained to 0.
    pub restrained: Vec<bool>,
    /// Load by degree of freedom, restrained ones included, force.
    pub load: DVector<f64>,
    /// The bodies, by their lowest node.
    pub bodies: Vec<Body>,
    /// The two contact surfaces.
    pub contact: ContactSurfaces,
    /// The mesh file's elements, by ascending number.
    pub rows: Vec<Row>,
}

impl Model {
    /// Number of degrees of freedom, restrained ones included.
    pub fn dofs(&self) -> usize {
        2 * self.nodes.len()
    }

    /// Every node, in order.
    pub fn node_ids(&self) -> impl DoubleEndedIterator<Item = NodeId> + Clone + use<> {
        NodeId::all(self.nodes.len())
    }

    /// Every triangle, in order.
    pub fn triangle_ids(&self) -> impl DoubleEndedIterator<Item = TriangleId> + Clone + use<> {
        TriangleId::all(self.triangles.len())
    }

    /// Every degree of freedom, in order.
    pub fn all_dofs(&self) -> impl DoubleEndedIterator<Item = Dof> + Clone + use<> {
        Dof::all(self.dofs())
    }

    /// Coordinates of a node, length.
    pub fn at(&self, node: NodeId) -> [f64; 2] {
        self.nodes[node.index()]
    }

    /// A triangle.
    pub fn triangle(&self, id: TriangleId) -> &Triangle {
        &self.triangles[id.index()]
    }

    /// An edge.
    pub fn edge(&self, id: EdgeId) -> &Edge {
        &self.edges[id.index()]
    }

    /// Coordinates of the corners of a triangle, length.
    pub fn corners(&self, id: TriangleId) -> Corners<f64> {
        self.triangle(id).nodes.map(|node| self.at(node))
    }

    /// Whether a degree of freedom is restrained.
    pub fn is_restrained(&self, dof: Dof) -> bool {
        self.restrained[dof.index()]
    }

    /// Which of a node's two displacements are restrained.
    pub fn restraints_of(&self, node: NodeId) -> [bool; 2] {
        node.dofs().map(|dof| self.is_restrained(dof))
    }

    /// Number of degrees of freedom that are not restrained.
    pub fn free_dofs(&self) -> usize {
        self.restrained.iter().filter(|restrained| !**restrained).count()
    }

    /// The load, 0 at restrained degrees of freedom, force.
    pub fn free_load(&self) -> DVector<f64> {
        self.load.zip_map(&DVector::from_column_slice(&self.restrained), |load, restrained| {
            if restrained { 0.0 } else { load }
        })
    }

    /// Sum of the loads, force.
    pub fn total_load(&self) -> [f64; 2] {
        [0, 1].map(|direction| self.load.iter().skip(direction).step_by(2).sum())
    }

    /// Whether there is a contact surface.
    pub fn has_contact(&self) -> bool {
        !self.contact.nodes.is_empty()
    }

    /// The target edges, in the order in which they are searched.
    pub fn target_edges(&self) -> impl Iterator<Item = &Edge> + Clone {
        self.contact.target.iter().map(|id| self.edge(*id))
    }

    /// The body that carries the target surface; none without contact.
    pub fn target(&self) -> Option<&Body> {
        self.body_of(self.target_edges().next()?.nodes[0])
    }

    /// The body that has `node`.
    pub fn body_of(&self, node: NodeId) -> Option<&Body> {
        self.bodies.iter().find(|body| body.has(node))
    }

    /// Where displacements `u` bring each node, length.
    pub fn shape(&self, u: &DVector<f64>) -> Vec<[f64; 2]> {
        let moved = |(node, [x, y]): (NodeId, &[f64; 2])| {
            let [ux, uy] = node.of(u);
            [x + ux, y + uy]
        };
        self.node_ids().zip(&self.nodes).map(moved).collect()
    }
}
