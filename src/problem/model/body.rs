//! Bodies, which are the parts of a mesh that share no node, and whether each is restrained.

use serde::Serialize;
use std::collections::{BTreeMap, HashMap, HashSet};

use nalgebra::{Matrix3, Vector3};

use super::ids::{NodeId, TriangleId};
use super::{Model, Triangle};
use base::plain::six_digits;
use numbers::joined::joined;

/// The most materials that the name of a body lists.
const MOST_NAMES: usize = 10;

/// The turn of a rigid motion, over its size, below which it is a translation to rounding.
const SLIDES: f64 = 1e-6;

/// A part of the mesh that shares no node with another part.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Body {
    /// The names of its materials, at most ten, joined by `+`; numbered where two bodies would share the name.
    pub name: String,
    /// The triangles of the body, ascending.
    pub triangles: Vec<TriangleId>,
    /// The nodes of the body, ascending.
    pub nodes: Vec<NodeId>,
}

impl Body {
    /// Returns whether `node` is one of its nodes.
    pub fn has(&self, node: NodeId) -> bool {
        self.nodes.binary_search(&node).is_ok()
    }
}

/// Returns the bodies that `triangles` on `nodes` nodes form, by their lowest node. `material`
/// names the material of each triangle.
pub fn bodies<'a>(
    nodes: usize,
    triangles: &[Triangle],
    material: impl Fn(TriangleId) -> &'a str,
) -> Vec<Body> {
    let sides = triangles.iter().flat_map(|triangle| {
        let [a, b, c] = triangle.nodes.map(NodeId::index);
        [(a, b), (b, c)]
    });
    let lowest = joined(nodes, sides);
    let mut bodies: BTreeMap<usize, Body> = BTreeMap::new();
    for (id, triangle) in TriangleId::all(triangles.len()).zip(triangles) {
        let body = bodies.entry(lowest[triangle.nodes[0].index()]).or_default();
        body.triangles.push(id);
    }
    for node in NodeId::all(nodes) {
        if let Some(body) = bodies.get_mut(&lowest[node.index()]) {
            body.nodes.push(node);
        }
    }
    let mut bodies: Vec<Body> = bodies.into_values().collect();
    for body in &mut bodies {
        let mut distinct = HashSet::new();
        let names = body.triangles.iter().map(|id| material(*id));
        let names: Vec<&str> = names.filter(|name| distinct.insert(*name)).collect();
        body.name = match names.len().saturating_sub(MOST_NAMES) {
            0 => names.join("+"),
            more => format!("{}+{more} more", names[..MOST_NAMES].join("+")),
        };
    }
    number_equal_names(&mut bodies);
    bodies
}

fn number_equal_names(bodies: &mut [Body]) {
    let mut counts: HashMap<String, [usize; 2]> = HashMap::new();
    bodies.iter().for_each(|body| counts.entry(body.name.clone()).or_default()[0] += 1);
    for body in bodies {
        let [count, before] = counts.get_mut(&body.name).expect("it was counted");
        if *count > 1 {
            *before += 1;
            body.name = format!("{} {before}", body.name);
        }
    }
}

/// Returns how the part with these nodes can still move as a rigid body under its restraints, and with some of its
/// nodes `pinned`, in words; None where it cannot move.
pub fn freedom(model: &Model, nodes: &[NodeId], pinned: &[NodeId]) -> Option<String> {
    let count = nodes.len() as f64;
    let points = || nodes.iter().map(|&n| model.coordinates(n));
    let sum = points().fold([0.0; 2], |s, p| [s[0] + p[0], s[1] + p[1]]);
    let centre = [sum[0] / count, sum[1] / count];
    let size = points().map(|[x, y]| (x - centre[0]).hypot(y - centre[1])).fold(0.0, f64::max);
    // The components of the three rigid motions along each direction that is held leave no motion free where
    // their Gram matrix has full rank.
    let mut gram = Matrix3::zeros();
    let mut hold = |n: NodeId, [dx, dy]: [f64; 2]| {
        let [x, y] = model.coordinates(n);
        let turn = (dy * (x - centre[0]) - dx * (y - centre[1])) / size;
        let motion = Vector3::new(dx, dy, turn);
        gram += motion * motion.transpose();
    };
    for &n in nodes {
        match pinned.contains(&n) {
            true => [[1.0, 0.0], [0.0, 1.0]].into_iter().for_each(|axis| hold(n, axis)),
            false => model.holds.of(n).iter().for_each(|own| hold(n, own.direction)),
        }
    }
    if gram[(0, 0)] == 0.0 {
        return Some("move in x".into());
    } else if gram[(1, 1)] == 0.0 {
        return Some("move in y".into());
    }
    let stiffness = gram.symmetric_eigen();
    let (least, most) = (stiffness.eigenvalues.argmin(), stiffness.eigenvalues.max());
    let motion = stiffness.eigenvectors.column(least.0);
    let [dx, dy, turn] = [motion[0], motion[1], motion[2]];
    (least.1 <= 1e-12 * most).then(|| {
        if turn.abs() < SLIDES {
            format!("slide along [{}, {}]", six_digits(dx), six_digits(dy))
        } else {
            let [x, y] = [centre[0] - size * dy / turn, centre[1] + size * dx / turn];
            // Six digits of the body's size: what is left of 0 is rounding.
            let at = |x: f64| six_digits(if x.abs() < 1e-9 * size { 0.0 } else { x });
            format!("rotate about {}, {}", at(x), at(y))
        }
    })
}
