//! Bodies: the parts of the mesh that share no node, and whether something holds each.

use nalgebra::{Matrix3, Vector3};

use super::mesh::Mesh;

/// A part of the mesh that shares no node with another.
#[derive(Clone, Debug, PartialEq)]
pub struct Body {
    /// The names of its materials, joined by `+`; numbered where two bodies would share it.
    pub name: String,
    /// Its triangles: rows of `EL`, from 1.
    pub triangles: Vec<usize>,
    /// Its nodes, ascending.
    pub nodes: Vec<usize>,
}

/// The bodies, by their lowest node. `material[n - 1]` names the material of triangle n.
pub fn find(mesh: &Mesh, material: &[String]) -> Vec<Body> {
    let root = roots(mesh);
    let mut bodies: Vec<(usize, Body)> = Vec::new();
    for (k, triangle) in mesh.of_dimension(2).enumerate() {
        let r = root[triangle.nodes[0] - 1];
        let at = bodies.iter().position(|(other, _)| *other == r).unwrap_or_else(|| {
            bodies
                .push((r, Body { name: String::new(), triangles: Vec::new(), nodes: Vec::new() }));
            bodies.len() - 1
        });
        bodies[at].1.triangles.push(k + 1);
    }
    bodies.sort_by_key(|(r, _)| *r);
    let mut found: Vec<Body> = bodies
        .into_iter()
        .map(|(r, body)| Body {
            name: joined(body.triangles.iter().map(|n| &material[n - 1])),
            nodes: (1..=root.len()).filter(|n| root[n - 1] == r).collect(),
            ..body
        })
        .collect();
    number_equal_names(&mut found);
    found
}

/// For each node the lowest node of its body, counted from 0.
fn roots(mesh: &Mesh) -> Vec<usize> {
    let mut root: Vec<usize> = (0..mesh.nodes.len()).collect();
    fn lowest(root: &mut [usize], mut n: usize) -> usize {
        while root[n] != n {
            root[n] = root[root[n]];
            n = root[n];
        }
        n
    }
    for triangle in mesh.of_dimension(2) {
        for pair in triangle.nodes.windows(2) {
            let (a, b) = (lowest(&mut root, pair[0] - 1), lowest(&mut root, pair[1] - 1));
            root[a.max(b)] = a.min(b);
        }
    }
    (0..root.len()).map(|n| lowest(&mut root, n)).collect()
}

fn joined<'a>(names: impl Iterator<Item = &'a String>) -> String {
    let mut distinct: Vec<&str> = Vec::new();
    for name in names {
        if !distinct.contains(&name.as_str()) {
            distinct.push(name);
        }
    }
    distinct.join("+")
}

fn number_equal_names(bodies: &mut [Body]) {
    let names: Vec<String> = bodies.iter().map(|b| b.name.clone()).collect();
    for (k, body) in bodies.iter_mut().enumerate() {
        if names.iter().filter(|n| **n == body.name).count() > 1 {
            let before = names[..k].iter().filter(|n| **n == body.name).count();
            body.name = format!("{} {}", body.name, before + 1);
        }
    }
}

/// How what has these nodes can still move, as a rigid body, under its restraints alone: `fixed(n)` tells which directions of node n are held. Nothing
/// where it cannot.
pub fn freedom(
    mesh: &Mesh,
    nodes: &[usize],
    fixed: impl Fn(usize) -> [bool; 2],
) -> Option<&'static str> {
    let count = nodes.len() as f64;
    let sum = nodes.iter().map(|&n| mesh.xy(n)).fold([0.0; 2], |s, p| [s[0] + p[0], s[1] + p[1]]);
    let centre = [sum[0] / count, sum[1] / count];
    let size = nodes
        .iter()
        .map(|&n| (mesh.xy(n)[0] - centre[0]).hypot(mesh.xy(n)[1] - centre[1]))
        .fold(0.0, f64::max);
    // The three rigid motions' components at each restraint; they leave none free when their Gram matrix has full rank.
    let mut gram = Matrix3::zeros();
    for &n in nodes {
        let [x, y] = mesh.xy(n);
        let motions = [
            Vector3::new(1.0, 0.0, -(y - centre[1]) / size),
            Vector3::new(0.0, 1.0, (x - centre[0]) / size),
        ];
        for (held, motion) in fixed(n).into_iter().zip(motions) {
            if held {
                gram += motion * motion.transpose();
            }
        }
    }
    let held = gram.symmetric_eigenvalues();
    match () {
        _ if gram[(0, 0)] == 0.0 => Some("move in x"),
        _ if gram[(1, 1)] == 0.0 => Some("move in y"),
        _ if held.min() <= 1e-12 * held.max() => Some("rotate"),
        _ => None,
    }
}
