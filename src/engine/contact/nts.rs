//! Node to segment: the point of the target closest to each contact node, by the rules of
//! `outline.rs`.

use std::collections::HashSet;

use super::outline::{FacedPoint, Outline};
use super::pairing::{Pairing, Vector};
use super::surface::{Edge, Surfaces};
use base::error::InputError;
use problem::model::{Model, NodeId};

/// The initial penetration, over the longest contact edge beside the node, beyond which a scene is
/// refused. An interference that is modelled, as of a press fit, is a small part of an edge; a node
/// deeper than half an edge may well be nearer to another side of the target.
const DEEP_EDGE: f64 = 0.5;

/// The initial penetration over the size of the scene up to which a scene is never refused: ten
/// times the interference of a press fit of 0.1 %.
const DEEP_SCENE: f64 = 0.01;

/// Returns, for each entry of the contact surface, its closest point on the target.
pub(super) fn pairings(surfaces: &Surfaces, shape: &[Vector]) -> Vec<Option<Pairing>> {
    let outline = Outline::new(&surfaces.target, shape);
    let mut listed = HashSet::new();
    let normals = &surfaces.contact.node_normals;
    let pairing = |(&node, length): (&NodeId, f64)| {
        let faced = outline.closest_point(shape[node.index()], normals.get(&node).copied())?;
        let FacedPoint { edge, masters, normal, gap, corner, .. } = faced;
        let edge = surfaces.target.edges[edge].id.expect("a target edge is one of the model's");
        let pairing = Pairing { node, edge, masters, normal, gap, length, corner };
        listed.insert(node).then_some(pairing)
    };
    surfaces.nodes.iter().zip(surfaces.tributary(shape)).map(pairing).collect()
}

impl Surfaces {
    /// Checks that no contact node lies deep in the target before the loads act. What counts as
    /// deep is more than half the longest contact edge beside the node and more than 1 % of the
    /// scene's larger extent.
    ///
    /// # Errors
    /// A contact node lies deep in the target; the error names the deepest.
    pub fn check_initial_penetration(&self, model: &Model) -> Result<(), InputError> {
        let outline = Outline::new(&self.target, &model.nodes);
        let size = model.bounds().larger_side();
        let longest = |node: NodeId| {
            let beside =
                self.contact.edges.iter().filter(|edge: &&Edge| edge.nodes.contains(&node));
            beside.map(|edge| edge.in_shape(&model.nodes).length).fold(0.0, f64::max)
        };
        let depth = |&node: &NodeId| {
            let normal = self.contact.node_normals.get(&node).copied();
            let faced = outline.closest_point(model.coordinates(node), normal)?;
            let depth = -faced.gap;
            let deep = faced.over && depth > DEEP_SCENE * size;
            (deep && depth > DEEP_EDGE * longest(node)).then_some((node, depth))
        };
        let deep = self.nodes.iter().filter_map(depth);
        let deepest = deep.max_by(|a, b| a.1.total_cmp(&b.1).then(b.0.cmp(&a.0)));
        let Some((node, depth)) = deepest else { return Ok(()) };
        let (edge, part) = (longest(node), 100.0 * depth / size);
        let what = format!(
            "contact node {node} lies {depth:.4} inside the target before the loads act: {part:.1} % of \
             the scene's size, beside a contact edge of length {edge:.4}"
        );
        let fix = "move the bodies apart, or name the target's side that faces the contact surface; an \
                   interference may be half a contact edge deep";
        Err(InputError::new("contact", what, fix))
    }
}
