//! Random scenes whose statuses are known: a round stamp that jumped into a target by a given
//! depth.
//!
//! ```text
//!      *----*----*----*          y = g(x) is the target surface: flat, sloping, broken or hollow.
//!       \  / \  / \  /           A contact node at x, y is in contact where y − g(x) ≤ c_tll / 2,
//!     ---*-.-\/----*----*---     and apart where it is beside the target or y − g(x) ≥ 3 c_tll: on
//!     target  *                  the slopes drawn that is farther than c_tll from every edge. None
//!                                is drawn between.
//! ```

use fastrand::Rng;
use plane_contact::problem::element::Plane;
use plane_contact::problem::modelling::Variant;
use plane_contact::problem::scene::{Axis, Contact, MeshBuilder, Scene, SceneBuilder};
use testing::draws::between;

/// The tolerance of the contact search, length: the text's c_tol.
const C_TLL: f64 = 0.001;
/// Width of the target, length.
const WIDTH: f64 = 4.0;
const STEEPEST: f64 = 0.6;
/// Height of the target's lower side.
const BOTTOM: f64 = -6.0;

/// The kind of a random scene.
#[derive(Clone, Copy, Debug)]
pub struct Kind {
    /// How many edges the target has.
    pub edges: usize,
    /// How deep the deepest node is, in c_tll.
    pub depth: f64,
    /// Whether the target lies above the stamp: the scene upside down.
    pub above: bool,
}

impl Kind {
    /// Mean length of a target edge along x.
    fn edge(&self) -> f64 {
        WIDTH / self.edges as f64
    }
}

/// A scene that was drawn, and the statuses of its contact nodes.
pub struct DrawnScene {
    pub scene: Scene,
    pub touching: Vec<bool>,
}

/// Draws a scene of a kind; its contact nodes lie well inside or outside the target.
pub fn draw(rng: &mut Rng, kind: Kind) -> DrawnScene {
    let surface = surface(rng, kind);
    let (stamp, touching) = stamp(rng, &surface, kind);
    let turned = rng.bool();
    let scene = scene(&surface, &stamp, kind, turned).build();
    let scene = scene.expect("a scene that is drawn is sound");
    DrawnScene { scene, touching }
}

/// The nodes of the target surface from left to right.
fn surface(rng: &mut Rng, kind: Kind) -> Vec<[f64; 2]> {
    let shape = rng.usize(0..4);
    let (slope, radius) = (between(rng, -0.5, 0.5), between(rng, 4.0, 8.0));
    let step = kind.edge();
    let mut nodes: Vec<[f64; 2]> = Vec::new();
    for j in 0..=kind.edges {
        let at_end = j == 0 || j == kind.edges;
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

/// The contact nodes from left to right, and whether each is in contact. One stamp in four hangs
/// over the target's end.
fn stamp(rng: &mut Rng, surface: &[[f64; 2]], kind: Kind) -> (Vec<[f64; 2]>, Vec<bool>) {
    let radius = between(rng, 1.5, 4.0);
    let (width, step) = (between(rng, 1.0, 2.5), kind.edge());
    let middle = if rng.usize(0..4) == 0 {
        between(rng, 0.0, 0.3)
    } else {
        between(rng, 0.4 * WIDTH, 0.6 * WIDTH)
    };
    let mut nodes: Vec<[f64; 2]> = Vec::new();
    let mut x = middle - width / 2.0;
    // One node alone would have no triangle, and a depth is measured over the target.
    let is_over = |nodes: &[[f64; 2]]| nodes.last().is_some_and(|node| node[0] >= 0.0);
    while x < middle + width / 2.0 || nodes.len() < 2 || !is_over(&nodes) {
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

/// Both bodies as strips of triangles under the surface and over the contact nodes, restrained
/// whole: nothing is solved. Where the target lies above, they are mirrored in y. Target edges run
/// from right to left where they are `turned`.
fn scene(surface: &[[f64; 2]], stamp: &[[f64; 2]], kind: Kind, turned: bool) -> SceneBuilder {
    let size = kind.edge();
    let mut mesh = MeshBuilder::default();
    let mut row = |points: &mut dyn Iterator<Item = [f64; 2]>| {
        mesh.row(points.map(|[x, y]| [x, if kind.above { 0.0 - y } else { y }]))
    };
    let target = row(&mut surface.iter().copied());
    let bottom = row(&mut surface.iter().map(|p| [p[0], BOTTOM]));
    let contact = row(&mut stamp.iter().copied());
    let top = row(&mut stamp.iter().map(|p| [p[0], p[1] + size]));
    for edge in target.windows(2) {
        let [a, b] = [edge[0], edge[1]];
        mesh.edges("surface", &if turned { [b, a] } else { [a, b] });
    }
    // Which diagonal cuts a cell counts: under `intersection` a node's sides decide.
    mesh.join("target", &target, &bottom);
    mesh.join("stamp", &top, &contact);
    SceneBuilder::new("statuses", mesh.finish(), Plane::Strain)
        .variant(Variant::Stepped)
        .material("target", 1.0, 0.0)
        .material("stamp", 1.0, 0.0)
        .restrain("target", &[Axis::X, Axis::Y])
        .restrain("stamp", &[Axis::X, Axis::Y])
        .contact(Contact::new(contact, "surface", C_TLL))
}
