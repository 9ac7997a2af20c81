//! Triangles that lie over each other, as in a mesh that folds over itself: their stiffness would count
//! twice. Two bodies may lie inside each other where contact pushes them apart.

use super::mesh::Mesh;
use crate::element::Corners;
use crate::model::{Bounds, Model, NodeId, TriangleId};
use base::error::{InputError, Result};

/// How deep one triangle may lie in another, over their longest side: what rounding does where the nodes
/// along a crack are doubled.
pub const DEPTH: f64 = 1e-9;

/// Which bodies the contact surfaces lie on.
pub struct Faces {
    /// The place of each node's body.
    of_node: Vec<usize>,
    /// Whether each body has contact nodes, and whether it has target edges.
    sides: Vec<[bool; 2]>,
}

impl Faces {
    /// Finds the bodies on which the contact surfaces of a model lie.
    pub fn new(model: &Model) -> Self {
        let mut of_node = vec![0; model.nodes.len()];
        for (k, body) in model.bodies.iter().enumerate() {
            body.nodes.iter().for_each(|n| of_node[n.index()] = k);
        }
        let mut sides = vec![[false; 2]; model.bodies.len()];
        model.contact.nodes.iter().for_each(|n| sides[of_node[n.index()]][0] = true);
        let target = model.target_edges().flat_map(|edge| edge.nodes);
        target.for_each(|n| sides[of_node[n.index()]][1] = true);
        Faces { of_node, sides }
    }

    /// Returns whether two nodes are of two bodies on which contact surfaces lie: either may be inside the
    /// other.
    pub fn may_overlap(&self, a: NodeId, b: NodeId) -> bool {
        let [a, b] = [a, b].map(|n| self.of_node[n.index()]);
        a != b && [a, b].iter().all(|body| self.sides[*body].contains(&true))
    }

    /// Returns whether two nodes are of two bodies that have contact between them.
    pub fn may_meet(&self, a: NodeId, b: NodeId) -> bool {
        let [a, b] = [a, b].map(|n| self.of_node[n.index()]);
        let [[a_contact, a_target], [b_contact, b_target]] = [self.sides[a], self.sides[b]];
        a != b && (a_contact && b_target || a_target && b_contact)
    }
}

/// Checks that no triangles lie over each other but those of two bodies on which contact surfaces lie.
///
/// # Errors
/// Names two that do.
pub fn check(mesh: &Mesh, model: &Model) -> Result<()> {
    let Some(ids) = overlap(model) else { return Ok(()) };
    let numbers: Vec<usize> = mesh.of_dimension(2).map(|triangle| triangle.number).collect();
    let [a, b] = ids.map(|id| numbers[id.index()]);
    let what = format!("triangles {} and {} lie over each other", a.min(b), a.max(b));
    let fix =
        "remove one, or move its nodes; only bodies on which contact surfaces lie may overlap";
    Err(InputError::new("the mesh's triangles", what, fix))
}

/// A triangle with the rectangle around it.
struct Boxed {
    id: TriangleId,
    /// One of its nodes.
    node: NodeId,
    corners: Corners<f64>,
    longest_side: f64,
    bounds: Bounds,
}

/// Returns two triangles that lie over each other and may not; None where there are none.
fn overlap(model: &Model) -> Option<[TriangleId; 2]> {
    let faces = Faces::new(model);
    let boxed = |id: TriangleId| {
        let corners @ [a, b, c] = model.corners(id);
        let (node, bounds) = (model.triangle(id).nodes[0], Bounds::around(&corners));
        let length = |p: [f64; 2], q: [f64; 2]| (q[0] - p[0]).hypot(q[1] - p[1]);
        let longest_side = length(a, b).max(length(b, c)).max(length(c, a));
        Boxed { id, node, corners, longest_side, bounds }
    };
    let mut triangles: Vec<Boxed> = TriangleId::all(model.triangles.len()).map(boxed).collect();
    // A line sweeps the bodies along the axis on which it crosses fewer triangles at a time.
    let whole = model.bounds().size();
    let crossed =
        [0, 1].map(|k| triangles.iter().map(|one| one.bounds.size()[k]).sum::<f64>() / whole[k]);
    let axis = usize::from(crossed[1] < crossed[0]);
    triangles.sort_by(|a, b| a.bounds.low[axis].total_cmp(&b.bounds.low[axis]));
    let mut crossed: Vec<&Boxed> = Vec::new();
    for one in &triangles {
        crossed.retain(|other| other.bounds.high[axis] > one.bounds.low[axis]);
        let is_over =
            |other: &&&Boxed| other.overlaps(one) && !faces.may_overlap(other.node, one.node);
        if let Some(other) = crossed.iter().find(is_over) {
            return Some([other.id, one.id]);
        }
        crossed.push(one);
    }
    None
}

impl Boxed {
    fn overlaps(&self, other: &Boxed) -> bool {
        let [a, b] = [self.bounds, other.bounds];
        let meets = |k: usize| a.low[k] < b.high[k] && b.low[k] < a.high[k];
        let depth = DEPTH * self.longest_side.max(other.longest_side);
        meets(0) && meets(1) && !self.is_apart(other, depth) && !other.is_apart(self, depth)
    }

    /// Returns whether the other triangle lies beyond one of this one's sides, but for `depth`.
    fn is_apart(&self, other: &Boxed, depth: f64) -> bool {
        let [a, b, c] = self.corners;
        [[a, b], [b, c], [c, a]].into_iter().any(|[from, to]| {
            let (dx, dy) = (to[0] - from[0], to[1] - from[1]);
            let length = dx.hypot(dy);
            let inside = |p: &[f64; 2]| (dx * (p[1] - from[1]) - dy * (p[0] - from[0])) / length;
            other.corners.iter().all(|p| inside(p) <= depth)
        })
    }
}
