//! How the bodies lie before any load: apart, touching, or in each other.

use serde::Serialize;

use super::outline::{FacedPoint, Outline};
use super::overlap::PlacedTriangles;
use super::pairing::Vector;
use super::search::{distance_square, dot};
use super::surface::{SAME, Surfaces};
use crate::solution::Overlap;
use base::error::InputError;
use problem::model::{Body, Bounds, Model, NodeId};

/// The initial penetration over the size of the scene up to which a scene is never refused: ten
/// times the interference of a press fit of 0.1 %.
const DEEP_SCENE: f64 = 0.01;

/// The gap over the size of the smaller body beyond which bodies lie far apart.
const FAR: f64 = 0.1;

/// What is unusual about the gaps before any load.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(tag = "kind", rename_all = "lowercase")]
pub enum InitialGaps {
    /// Contact nodes lie inside the target: an interference fit, or a mistake of the drawing.
    Overlap(Overlap),
    /// All contact nodes are farther from the target than a tenth of the smaller body's size.
    Apart {
        /// The nearest.
        node: NodeId,
        /// Its gap, length.
        gap: f64,
    },
}

impl Surfaces {
    /// Returns what is unusual about the gaps before any load; None where surfaces touch or nearly do.
    pub fn initial_gaps(&self, model: &Model) -> Option<InitialGaps> {
        let faced = self.faced(model);
        let inside = self.inside_at_rest(model, &faced);
        if let Some((node, point)) = inside.first() {
            let nodes: Vec<NodeId> =
                point.masters.iter().map(|(master, _)| *master).chain([*node]).collect();
            let facet_height = self.facet_height(&nodes, 0.0);
            let (nodes, depth) = (inside.len(), -point.gap);
            return Some(InitialGaps::Overlap(Overlap { nodes, node: *node, depth, facet_height }));
        }
        let (node, nearest) = faced.iter().min_by(|a, b| a.1.gap.total_cmp(&b.1.gap))?;
        let size = |body: &Body| {
            Bounds::around(body.nodes.iter().map(|n| &model.nodes[n.index()])).larger_side()
        };
        let bodies = [*node, nearest.masters[0].0].map(|node| model.body_of(node).map(size));
        let smaller = bodies.into_iter().flatten().fold(f64::INFINITY, f64::min);
        (nearest.gap > FAR * smaller)
            .then_some(InitialGaps::Apart { node: *node, gap: nearest.gap })
    }

    /// Checks that no contact node lies deep in the target before the loads act: deeper than 1 % of the
    /// scene's larger extent, and nearer to a side of the target's body that looks the other way, so that it
    /// may have come from there. How long the edges are does not count: two rings of radii 5, 10 and 20 with
    /// an interference of 0.5, one to six edges deep, have Lamé's pressure within 3 % (7 % in the initial
    /// geometry).
    ///
    /// # Errors
    /// A contact node lies deep in the target; the error names the deepest.
    pub fn check_initial_penetration(&self, model: &Model) -> Result<(), InputError> {
        let size = model.bounds().larger_side();
        // The distance from a node to the nearest side of a body that looks against a normal.
        let behind = |node: NodeId, body: &Body, normal: Vector| {
            let sides = model.sides.outline().filter(|side| body.has(side.nodes[0]));
            let ends = sides.map(|side| side.nodes.map(|end| model.coordinates(end)));
            let against = ends.filter(|[[ax, ay], [bx, by]]| dot([by - ay, ax - bx], normal) < 0.0);
            let square = |ends| distance_square(ends, model.coordinates(node));
            against.map(square).fold(f64::INFINITY, f64::min).sqrt()
        };
        let faced = self.faced(model);
        let deep = self.inside_at_rest(model, &faced).into_iter().find_map(|(node, point)| {
            let depth = -point.gap;
            let body = model.body_of(point.masters[0].0).filter(|_| depth > DEEP_SCENE * size)?;
            let behind = behind(*node, body, point.normal);
            (behind < depth).then_some((node, depth, behind))
        });
        let Some((node, depth, behind)) = deep else { return Ok(()) };
        let part = 100.0 * depth / size;
        let what = format!(
            "contact node {node} lies {depth:.4} inside the target before the loads act: {part:.1} % of \
             the scene's size, and {behind:.4} from the other side of that body, which is nearer"
        );
        let fix = "move the bodies apart, or name the target's side that faces the contact surface; an \
                   interference may be half as deep as the target's body is thick";
        Err(InputError::new("contact", what, fix))
    }

    /// Returns what each contact node faces before any load.
    fn faced(&self, model: &Model) -> Vec<(NodeId, FacedPoint)> {
        let outline = Outline::new(&self.target, &model.nodes);
        let faced =
            |&node: &NodeId| Some((node, outline.faced((node, &self.contact), [&model.nodes; 2])?));
        self.nodes.iter().filter_map(faced).collect()
    }

    /// Returns those that lie inside the body that they face, the deepest first. The line of an edge does not
    /// tell: a node beside a body may lie behind the line of a side that it looks past.
    fn inside_at_rest<'a>(
        &self,
        model: &Model,
        faced: &'a [(NodeId, FacedPoint)],
    ) -> Vec<&'a (NodeId, FacedPoint)> {
        let least = SAME * model.bounds().larger_side();
        let behind = |(_, point): &&(NodeId, FacedPoint)| point.over && point.gap < -least;
        let mut found: Vec<_> = faced.iter().filter(behind).collect();
        if found.is_empty() {
            return found;
        }
        let nodes: Vec<NodeId> = found.iter().map(|(node, _)| *node).collect();
        let placed: Vec<_> = model
            .bodies
            .iter()
            .map(|body| PlacedTriangles::new(model, body, &nodes, &model.nodes))
            .collect();
        found.retain(|(node, point)| {
            let body = model.bodies.iter().position(|body| body.has(point.masters[0].0));
            body.is_some_and(|b| placed[b].contain(*node, &model.nodes))
        });
        found.sort_by(|a, b| a.1.gap.total_cmp(&b.1.gap).then(a.0.cmp(&b.0)));
        found.dedup_by_key(|found| found.0);
        found
    }
}
