//! Random scenes whose statuses are known: a round stamp that jumped into a target by a given depth.
//!
//! ```text
//!      *----*----*----*          y = g(x) is the target surface: flat, sloping, broken or hollow. A contact node at x, y is
//!       \  / \  / \  /           in contact where y − g(x) ≤ c_tll / 2 and apart where it is beside the target or
//!     ---*-.-\/----*----*---     y − g(x) ≥ 3 c_tll: on the slopes drawn that is farther than c_tll from every edge.
//!     target  *                  None is drawn between.
//! ```

use fastrand::Rng;
use nalgebra::DVector;

use crate::problem::element::Plane;
use crate::problem::model::{
    ContactSurfaces, Edge, EdgeId, Element, Material, Model, NodeId, Row, Sides, Triangle,
    TriangleId,
};

/// The text's c_tol.
pub const C_TLL: f64 = 0.001;
/// Width of the target, length.
const WIDTH: f64 = 4.0;
/// Steepest slope of a broken surface.
const STEEPEST: f64 = 0.6;
/// Height of the target's lower side.
const BOTTOM: f64 = -6.0;

/// What is drawn.
#[derive(Clone, Copy, Debug)]
pub struct Kind {
    /// Number of target edges.
    pub edges: usize,
    /// How deep the deepest node is, in c_tll.
    pub depth: f64,
    /// Whether the target lies above the stamp: the scene upside down.
    pub above: bool,
}

/// A scene and the statuses of its contact nodes.
pub struct Drawn {
    /// The model in the shape after the jump.
    pub model: Model,
    /// Whether each contact node is in contact.
    pub touching: Vec<bool>,
}

/// Draws a scene.
pub fn draw(rng: &mut Rng, kind: Kind) -> Drawn {
    let surface = surface(rng, kind.edges);
    let (stamp, touching) = stamp(rng, &surface, kind);
    let turned = rng.bool();
    let model = model(&surface, &stamp, WIDTH / kind.edges as f64, turned, kind.above);
    Drawn { model, touching }
}

/// A number between `low` and `high`.
fn between(rng: &mut Rng, low: f64, high: f64) -> f64 {
    low + (high - low) * rng.f64()
}

/// The nodes of the target surface from left to right.
fn surface(rng: &mut Rng, edges: usize) -> Vec<[f64; 2]> {
    let shape = rng.usize(0..4);
    let (slope, radius) = (between(rng, -0.5, 0.5), between(rng, 4.0, 8.0));
    let step = WIDTH / edges as f64;
    let mut nodes: Vec<[f64; 2]> = Vec::new();
    for j in 0..=edges {
        let at_end = j == 0 || j == edges;
        let jitter = if at_end { 0.0 } else { between(rng, -0.2, 0.2) * step };
        let x = j as f64 * step + jitter;
        let y = match (shape, nodes.last()) {
            (0, _) => 0.0,
            (1, _) => slope * x,
            (2, Some(last)) => last[1] + between(rng, -STEEPEST, STEEPEST) * (x - last[0]),
            (2, None) => 0.0,
            _ => (x - WIDTH / 2.0).powi(2) / (2.0 * radius),
        };
        nodes.push([x, y]);
    }
    nodes
}

/// Height of the surface at `x`; nothing beside the target.
fn height(surface: &[[f64; 2]], x: f64) -> Option<f64> {
    let edge = surface.windows(2).find(|e| e[0][0] <= x && x <= e[1][0])?;
    let t = (x - edge[0][0]) / (edge[1][0] - edge[0][0]);
    Some(edge[0][1] + t * (edge[1][1] - edge[0][1]))
}

/// The contact nodes from left to right, and whether each is in contact. One stamp in four hangs over the target's end.
fn stamp(rng: &mut Rng, surface: &[[f64; 2]], kind: Kind) -> (Vec<[f64; 2]>, Vec<bool>) {
    let radius = between(rng, 1.5, 4.0);
    let (width, step) = (between(rng, 1.0, 2.5), WIDTH / kind.edges as f64);
    let middle = if rng.usize(0..4) == 0 {
        between(rng, 0.0, 0.3)
    } else {
        between(rng, 0.4 * WIDTH, 0.6 * WIDTH)
    };
    let mut nodes: Vec<[f64; 2]> = Vec::new();
    let mut x = middle - width / 2.0;
    while x < middle + width / 2.0 {
        // Beside the target, but not within c_tll of its flank.
        let x_node = if x < 0.0 { x.min(-3.0 * C_TLL) } else { x };
        nodes.push([x_node, (x_node - middle).powi(2) / (2.0 * radius)]);
        x += step * between(rng, 0.7, 1.3);
    }
    let above = |node: &[f64; 2]| height(surface, node[0]).map(|g| node[1] - g);
    let lowest = nodes.iter().filter_map(above).fold(f64::INFINITY, f64::min);
    let touching = nodes.iter_mut().map(|node| {
        node[1] -= lowest + kind.depth * C_TLL;
        let Some(g) = height(surface, node[0]) else { return false };
        let apart = node[1] - g > 0.5 * C_TLL;
        if apart {
            node[1] = node[1].max(g + 3.0 * C_TLL);
        }
        !apart
    });
    let touching = touching.collect();
    (nodes, touching)
}

/// Both bodies as strips of triangles under the surface and over the contact nodes; where the target is `above`, mirrored in y.
fn model(surface: &[[f64; 2]], stamp: &[[f64; 2]], size: f64, turned: bool, above: bool) -> Model {
    let (m, n) = (surface.len(), stamp.len());
    let bottom = surface.iter().map(|p| [p[0], BOTTOM]);
    let top = stamp.iter().map(|p| [p[0], p[1] + size]);
    let points = surface.iter().copied().chain(bottom).chain(stamp.iter().copied()).chain(top);
    let nodes: Vec<[f64; 2]> =
        points.map(|[x, y]| if above { [x, 0.0 - y] } else { [x, y] }).collect();
    let edge = |j: usize| Edge {
        number: j + 1,
        nodes: if turned { [j + 1, j] } else { [j, j + 1] }.map(NodeId::new),
    };
    // What no contact search reads.
    let material = Material { e: 0.0, nu: 0.0 };
    let triangles: Vec<Triangle> = strip(m, 0, m)
        .chain(strip(2 * m, 2 * m + n, n))
        .map(|[a, b, c]| if above { [a, c, b] } else { [a, b, c] })
        .map(|nodes| Triangle { nodes: nodes.map(NodeId::new), material })
        .collect();
    let elements = EdgeId::all(m - 1)
        .map(Element::Edge)
        .chain(TriangleId::all(triangles.len()).map(Element::Triangle));
    let row = |(k, element)| Row { number: k + 1, physical: 1, geometric: 1, element };
    Model {
        plane: Plane::Strain,
        thickness: 1.0,
        z: 0.0,
        sides: Sides::new(triangles.iter().map(|triangle| triangle.nodes)),
        edges: (0..m - 1).map(edge).collect(),
        restrained: vec![false; 2 * nodes.len()],
        load: DVector::zeros(2 * nodes.len()),
        bodies: Vec::new(),
        contact: ContactSurfaces {
            nodes: (2 * m..2 * m + n).map(NodeId::new).collect(),
            target: EdgeId::all(m - 1).collect(),
            tolerance: C_TLL,
        },
        rows: elements.enumerate().map(row).collect(),
        triangles,
        nodes,
    }
}

/// Counter-clockwise triangles between a lower and an upper row of `n` nodes that start at `lower` and `upper`.
fn strip(lower: usize, upper: usize, n: usize) -> impl Iterator<Item = [usize; 3]> {
    (1..n).flat_map(move |j| {
        let (a, b) = (lower + j - 1, upper + j - 1);
        [[a, a + 1, b], [a + 1, b + 1, b]]
    })
}
