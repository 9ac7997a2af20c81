//! The point of a surface that a node faces, and the normal there, also at the surface's corners.
//!
//! ```text
//!     edge          o p         corner          o p        corner, p inside
//!                   :                          / n = (p − v)/|p − v|
//!      *------------+---*          *----------v                 *-----------v
//!        . . body . . .              . body . |                   . . . o   | both equally near:
//!                                    . . . .  |                   . . . . . | n = bisector at v
//! ```
//!
//! 1. A node that projects on an edge is paired with that point of the edge.
//! 2. A node in the cone of a corner, where it projects past the ends of both edges, is paired with
//!    the corner's vertex alone. The normal is the direction between vertex and node. It is the
//!    edge's normal on the cone's two sides, so that nothing jumps where a node passes round.
//! 3. Where the node lies within [`SAME`] of the vertex, or two edges that meet there are equally
//!    near within [`SAME`], it is paired with the vertex, and the normal is the bisector of the
//!    edges' normals. So a node inside a convex corner or over a concave one, on the bisector.
//!    There, and inside a concave corner past the ends of both edges, contact may press along any normal
//!    between those of the edges.
//! 4. Where edges meet in a bend of a smooth surface, within [`BEND`], the normal turns along each
//!    edge from the mean normal at its first node to that at its second. Otherwise a node that comes
//!    to rest at a bend of a curved target would alternate between the two edges without end.
//! 5. Past the end of the edges that face it, a node rests on the last edge's line as far as
//!    [`HANGING`], even with a closed gap. Otherwise a node there would be released because it is
//!    closed, and closed again because it then penetrates, without end.
//!
//! 6. An edge that the node sees from behind, through the body, before any load does not count.
//!
//! No rule depends on the order or direction of the edges or on the axes; a choice jumps only where
//! a node leaves the neighbourhood [`SAME`] of rule 3, and at the limits of rules 4 and 5.
//!
//! Source: G. Zavarise, L. De Lorenzis, Comput. Methods Appl. Mech. Engrg. 198 (2009) 3428-3451 (a
//! node in the cone between two segments is paired with the vertex); J. A. Bærentzen, H. Aanæs, IEEE
//! TVCG 11 (2005) 243-253 (the sum of the edges' normals has the right sign at a vertex).

use std::cell::{Cell, RefCell};

use super::pairing::{Vector, unit};
use super::search::{dot, minus};
use super::surface::{FACING, PlacedEdge, SAME, Surface};
use problem::model::{BEND, NodeId};
use problem::tree::{Bounds, Tree};

/// How far past the end of the surface a node still rests on it, over the last edge's length: the
/// same tolerance as mortar's. Edges that lie flush slide by their strain.
const HANGING: f64 = 0.05;

/// The edges of a body's surface in a shape, for the search of what a node faces.
pub(super) struct Outline<'a> {
    surface: &'a Surface,
    placed: Vec<PlacedEdge>,
    /// The mean normal at each edge's two nodes, over the edges that meet there in a bend.
    normals: Vec<[Vector; 2]>,
    tree: Tree,
    /// The distance below which two are equal, length.
    tie: f64,
}

/// What a node faces.
pub(super) struct FacedPoint {
    /// The index of the edge.
    pub(super) edge: usize,
    /// The nodes of the surface and their weights, which sum to 1.
    pub(super) masters: Vec<(NodeId, f64)>,
    /// The unit normal out of the body.
    pub(super) normal: Vector,
    /// The distance along the normal, length; < 0 inside the body.
    pub(super) gap: f64,
    /// Whether the node lies over the surface, not past its end.
    pub(super) over: bool,
    /// The tangent of the angle from the normal to those of the edges of a concave corner; 0 elsewhere.
    pub(super) corner: f64,
}

/// The part of a surface that is nearest to a node.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Part {
    Edge(usize),
    Vertex(NodeId),
    /// A vertex, from a node inside a tip of which no edge faces the node.
    Tip(NodeId),
}

impl<'a> Outline<'a> {
    /// Places the edges of a surface in `shape`.
    pub(super) fn new(surface: &'a Surface, shape: &[Vector]) -> Self {
        let placed = surface.in_shape(shape);
        let ends = surface.edges.iter().map(|edge| edge.map(|n| shape[n.index()]));
        let tree = Tree::new(ends.enumerate());
        let tie = SAME * tree.bounds().map_or(0.0, |all| all.larger_side());
        let normals = normals(surface, &placed);
        Outline { surface, placed, normals, tree, tie }
    }

    /// Returns what a node of another surface faces in the shape; `at_rest` is the undeformed one.
    pub(super) fn faced(
        &self,
        (node, surface): (NodeId, &Surface),
        [shape, at_rest]: [&[Vector]; 2],
    ) -> Option<FacedPoint> {
        let [p, at_rest] = [shape, at_rest].map(|shape| shape[node.index()]);
        let own = surface.node_normals.get(&node).copied();
        let node = FacingNode { outline: self, p, own };
        let best = Cell::new(f64::INFINITY);
        let near: RefCell<Vec<(f64, Part)>> = RefCell::default();
        let key = |b: Bounds| Some(b.distance(p)).filter(|d| *d <= best.get() + self.tie);
        self.tree.visit(&key, &mut |k| {
            if let Some((distance, part)) = node.part(k)
                && distance <= best.get() + self.tie
                && !matches!(part, Part::Edge(k) if self.surface.is_seen_through(k, at_rest))
            {
                best.set(best.get().min(distance));
                near.borrow_mut().push((distance, part));
            }
        });
        let mut near = near.into_inner();
        near.retain(|(distance, _)| *distance <= best.get() + self.tie);
        let parts: Vec<Part> = near.into_iter().map(|(_, part)| part).collect();
        (!parts.is_empty()).then(|| node.choose(&parts))
    }

    /// Returns the place of a vertex in the shape, length.
    fn vertex(&self, v: NodeId) -> Vector {
        let k = self.surface.at[&v][0];
        let PlacedEdge { start, tangent, length, .. } = &self.placed[k];
        let end = self.surface.edges[k][1] == v;
        let far = if end { *length } else { 0.0 };
        [0, 1].map(|d| start[d] + far * tangent[d])
    }

    /// Returns how far `p` projects past end `v` of edge `k`, over its length; < 0 on its side.
    fn past(&self, k: usize, v: NodeId, p: Vector) -> f64 {
        let xi = self.placed[k].along(p);
        if self.surface.edges[k][1] == v { xi - 1.0 } else { -xi }
    }

    /// Returns the sum of the normals of the edges at a vertex, which points out of the body.
    fn pseudo_normal(&self, v: NodeId) -> Vector {
        let normals = self.surface.at[&v].iter().map(|&k| self.placed[k].normal);
        normals.fold([0.0; 2], |sum, n| [sum[0] + n[0], sum[1] + n[1]])
    }

    /// Returns whether the edges at a vertex meet in a bend of a smooth surface.
    fn bends(&self, v: NodeId) -> bool {
        let at = &self.surface.at[&v];
        let normal = |k: usize| self.placed[k].normal;
        at.iter().all(|&k| at.iter().all(|&l| dot(normal(k), normal(l)) > BEND))
    }
}

/// A node in search of what it faces.
struct FacingNode<'a> {
    outline: &'a Outline<'a>,
    p: Vector,
    /// The normal out of its own body in the undeformed shape; None where it bounds no edge and so faces every
    /// edge.
    own: Option<Vector>,
}

impl FacingNode<'_> {
    /// Returns whether the node faces a normal of the surface.
    fn faces(&self, normal: Vector) -> bool {
        self.own.is_none_or(|own| dot(own, normal) <= SAME - FACING)
    }

    fn faces_edge(&self, k: usize) -> bool {
        self.faces(self.outline.surface.undeformed[k].normal)
    }

    /// Returns the part of edge `k` or of its ends that is nearest to the node, and its distance.
    fn part(&self, k: usize) -> Option<(f64, Part)> {
        let (outline, p) = (self.outline, self.p);
        let edge = outline.surface.edges[k];
        let xi = outline.placed[k].along(p);
        let v = edge[usize::from(xi > 0.5)];
        if outline.past(k, v, p) > 0.0 {
            return self.at_vertex(v).map(|part| (self.distance(v), part));
        }
        if self.faces_edge(k) {
            return Some((outline.placed[k].outside(p).abs(), Part::Edge(k)));
        }
        // From the middle of an edge both of its ends are as near.
        let ends = edge.into_iter().filter(|end| *end == v || xi == 0.5);
        let tip = ends.filter(|end| self.in_tip(*end)).min()?;
        Some((self.distance(tip), Part::Tip(tip)))
    }

    fn distance(&self, v: NodeId) -> f64 {
        let [x, y] = minus(self.p, self.outline.vertex(v));
        x.hypot(y)
    }

    /// Returns the part of the surface at vertex `v` that the node rests on, past an edge's end.
    fn at_vertex(&self, v: NodeId) -> Option<Part> {
        let outline = self.outline;
        let at = &outline.surface.at[&v];
        let facing: Vec<usize> = at.iter().copied().filter(|k| self.faces_edge(*k)).collect();
        let past = |k: usize| outline.past(k, v, self.p);
        let last = if let [k] = facing[..] { Some(k) } else { None };
        let last = last.filter(|k| past(*k) > 0.0);
        if let Some(k) = last
            && past(k) <= HANGING + SAME
        {
            return Some(Part::Edge(k));
        }
        let in_cone = at.len() > 1 && at.iter().all(|&k| past(k) > 0.0);
        // The normal by rules 2 and 3.
        let out = || match self.distance(v) <= outline.tie {
            true => unit(outline.pseudo_normal(v)),
            false => self.direction(v),
        };
        if in_cone && (facing.len() == at.len() || self.faces(out())) {
            return Some(Part::Vertex(v));
        }
        let steep = |k: &usize| {
            let edge = &outline.placed[*k];
            past(*k) <= edge.outside(self.p).abs() / edge.length + SAME
        };
        last.filter(steep).map(Part::Edge)
    }

    /// Returns whether the node lies inside a tip at `v` of which no edge faces the node, but a
    /// direction between their normals does.
    fn in_tip(&self, v: NodeId) -> bool {
        let outline = self.outline;
        let at = &outline.surface.at[&v];
        let inside = |k: &usize| outline.placed[*k].outside(self.p) <= outline.tie;
        at.len() > 1
            && at.iter().all(|k| !self.faces_edge(*k) && inside(k))
            && self.faces(unit(outline.pseudo_normal(v)))
    }

    /// Returns the unit vector between vertex and node, out of the body.
    fn direction(&self, v: NodeId) -> Vector {
        let away = minus(self.p, self.outline.vertex(v));
        let out = dot(away, self.outline.pseudo_normal(v)) >= 0.0;
        unit(if out { away } else { away.map(|x| -x) })
    }

    /// Chooses among the nearest parts, which are equally near.
    fn choose(&self, parts: &[Part]) -> FacedPoint {
        if let Some(v) = self.corner(parts) {
            return self.on_vertex(v, unit(self.outline.pseudo_normal(v)));
        }
        // A vertex before an edge, then the one with the least node numbers.
        let first = parts.iter().min_by_key(|part| match part {
            Part::Vertex(v) | Part::Tip(v) => (false, [*v; 2]),
            Part::Edge(k) => (true, self.outline.surface.edges[*k]),
        });
        match *first.expect("there is one") {
            Part::Tip(v) => self.on_vertex(v, unit(self.outline.pseudo_normal(v))),
            Part::Vertex(v) if self.outline.bends(v) => self.on_edge(self.farther(v)),
            Part::Vertex(v) => self.on_vertex(v, self.direction(v)),
            Part::Edge(k) => self.on_edge(k),
        }
    }

    /// Returns the vertex of rule 3: of two edges among `parts`, or a vertex so near that the
    /// direction from it is rounding.
    fn corner(&self, parts: &[Part]) -> Option<NodeId> {
        let outline = self.outline;
        let mut vertices: Vec<NodeId> = Vec::new();
        for part in parts {
            match part {
                Part::Edge(k) => vertices.extend(outline.surface.edges[*k]),
                Part::Vertex(v) | Part::Tip(v) => vertices.push(*v),
            }
        }
        let met = |v: &NodeId| {
            let at = &outline.surface.at[v];
            let near = |k: &&usize| parts.contains(&Part::Edge(**k));
            let facing = || at.iter().filter(|k| self.faces_edge(**k)).count();
            at.iter().filter(near).count() > 1
                || self.distance(*v) <= outline.tie
                    && (facing() > 1 || parts.contains(&Part::Vertex(*v)))
        };
        vertices.into_iter().filter(met).min()
    }

    /// Returns the edge at a vertex whose line is the farther from the node.
    fn farther(&self, v: NodeId) -> usize {
        let outline = self.outline;
        let away = |k: usize| outline.placed[k].outside(self.p).abs();
        let edges = outline.surface.at[&v].iter().copied();
        let best = edges.reduce(|a, b| {
            let further = away(b) - away(a);
            let first = outline.surface.edges[b] < outline.surface.edges[a];
            if further > outline.tie || further >= -outline.tie && first { b } else { a }
        });
        best.expect("a vertex has an edge")
    }

    fn on_vertex(&self, v: NodeId, normal: Vector) -> FacedPoint {
        let corner = self.corner_at(v);
        let normal = if corner > 0.0 { unit(self.outline.pseudo_normal(v)) } else { normal };
        let gap = dot(normal, minus(self.p, self.outline.vertex(v)));
        let (edge, masters) = (self.farther(v), vec![(v, 1.0)]);
        FacedPoint { edge, masters, normal, gap, over: true, corner }
    }

    /// Returns the tangent of half the angle between the normals of two edges that face the node and meet in
    /// a concave corner at a vertex; 0 at any other vertex.
    fn corner_at(&self, v: NodeId) -> f64 {
        let outline = self.outline;
        let [k, l] = outline.surface.at[&v][..] else { return 0.0 };
        let [n, m] = [k, l].map(|edge| outline.placed[edge].normal);
        let ends = outline.surface.edges[l];
        let far = outline.vertex(if ends[0] == v { ends[1] } else { ends[0] });
        let is_concave = outline.placed[k].outside(far) > outline.tie && !outline.bends(v);
        let faced = [k, l].into_iter().all(|edge| self.faces_edge(edge));
        // tan (a / 2) = sin a / (1 + cos a).
        let tangent = (n[0] * m[1] - n[1] * m[0]).abs() / (1.0 + dot(n, m));
        if is_concave && faced { tangent } else { 0.0 }
    }

    fn on_edge(&self, k: usize) -> FacedPoint {
        let ([first, second], placed) = (self.outline.surface.edges[k], &self.outline.placed[k]);
        let along = placed.along(self.p);
        let xi = along.clamp(0.0, 1.0);
        let over = (along - xi).abs() <= SAME;
        let [a, b] = self.outline.normals[k];
        let normal = unit([0, 1].map(|d| (1.0 - xi) * a[d] + xi * b[d]));
        let masters = vec![(first, 1.0 - xi), (second, xi)];
        let gap = placed.outside(self.p) * dot(normal, placed.normal);
        FacedPoint { edge: k, masters, normal, gap, over, corner: 0.0 }
    }
}

/// Returns the normals at the nodes of each edge: the mean over edges that meet in a bend.
fn normals(surface: &Surface, placed: &[PlacedEdge]) -> Vec<[Vector; 2]> {
    let mean = |k: usize, node: NodeId| {
        let own = placed[k].normal;
        let normals = surface.at[&node].iter().map(|&other| placed[other].normal);
        let bend = normals.filter(|normal| dot(*normal, own) > BEND);
        let mean =
            unit(bend.fold([0.0; 2], |sum, normal| [sum[0] + normal[0], sum[1] + normal[1]]));
        surface.mirrored(node, mean)
    };
    surface.edges.iter().enumerate().map(|(k, edge)| edge.map(|node| mean(k, node))).collect()
}
