//! Node to segment: the point of the target closest to each contact node, by the rules of
//! `outline.rs`.

use std::collections::HashSet;

use super::outline::{FacedPoint, Outline};
use super::pairing::{Pairing, Vector};
use super::search::{Segment, dot};
use super::surface::Surfaces;
use base::error::InputError;
use problem::model::{Body, Model, NodeId};

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
    /// Checks that no contact node lies deep in the target before the loads act: deeper than 1 % of the
    /// scene's larger extent, and nearer to a side of the target's body that looks the other way, so that it may
    /// have come from there. How long the edges are does not count: two
    /// rings of radii 5, 10 and 20 with an interference of 0.5, one to six edges deep, have Lamé's pressure within 3 %
    /// (7 % in the initial geometry).
    ///
    /// # Errors
    /// A contact node lies deep in the target; the error names the deepest.
    pub fn check_initial_penetration(&self, model: &Model) -> Result<(), InputError> {
        let outline = Outline::new(&self.target, &model.nodes);
        let size = model.bounds().larger_side();
        // The distance from a node to the nearest side of a body that looks against a normal.
        let behind = |node: NodeId, body: &Body, normal: Vector| {
            let sides = model.sides.outline().filter(|side| body.has(side.nodes[0]));
            let ends = sides.map(|side| side.nodes.map(|end| model.coordinates(end)));
            let against = ends.filter(|[[ax, ay], [bx, by]]| dot([by - ay, ax - bx], normal) < 0.0);
            let square = |ends| Segment::new(ends).closest(model.coordinates(node)).distance_square;
            against.map(square).fold(f64::INFINITY, f64::min).sqrt()
        };
        let deep = |&node: &NodeId| {
            let normal = self.contact.node_normals.get(&node).copied();
            let faced = outline.closest_point(model.coordinates(node), normal)?;
            let depth = -faced.gap;
            let is_deep = faced.over && depth > DEEP_SCENE * size;
            let body = model.body_of(faced.masters[0].0).filter(|_| is_deep)?;
            let behind = behind(node, body, faced.normal);
            (behind < depth).then_some((node, depth, behind))
        };
        let deep = self.nodes.iter().filter_map(deep);
        let deepest = deep.max_by(|a, b| a.1.total_cmp(&b.1).then(b.0.cmp(&a.0)));
        let Some((node, depth, behind)) = deepest else { return Ok(()) };
        let part = 100.0 * depth / size;
        let what = format!(
            "contact node {node} lies {depth:.4} inside the target before the loads act: {part:.1} % of \
             the scene's size, and {behind:.4} from the other side of that body, which is nearer"
        );
        let fix = "move the bodies apart, or name the target's side that faces the contact surface; an \
                   interference may be half as deep as the target's body is thick";
        Err(InputError::new("contact", what, fix))
    }
}
