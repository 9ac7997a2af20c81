//! What the restraints of a scene file hold on its mesh.
//!
//! ```text
//!   {"on": "slope", "fix": ["n"]}      the normal of an edge; at a node between two, their mean by length,
//!        ^ n                           or both where they turn by more than that of a circle of twelve edges
//!   -----+-----o____  edges
//! ```

use std::collections::{BTreeMap, HashMap, HashSet};

use super::description::{Axis, Restraint};
use super::groups::{GroupRef, Groups};
use super::mesh::Mesh;
use crate::model::{BEND, Bounds, Hold, Holds, Model, NodeId, Sides, crossing};
use base::error::{InputError, Result};
use base::plain::six_digits;

/// The sine of the angle up to which two directions are one, as coordinates are rounded, and the one from
/// which they are two: between these a node would be held twice along what was meant to be one direction.
const SAME: f64 = 1e-9;
const TWO: f64 = 0.05;

/// How far a node may be from the coordinates that name it, over the larger side of the mesh.
const NEAR: f64 = 1e-6;

/// Returns the names of what restraints hold, and what each holds and no restraint before it does; what
/// belongs to no triangle is held along both axes.
///
/// # Errors
/// A restraint names no place or several, or a node or a group that does not exist; a direction or a displacement
/// is missing or no number; two restraints displace a node along one direction by different amounts.
pub fn holds(
    mesh: &Mesh,
    groups: &Groups,
    sides: &Sides,
    dropped: &[NodeId],
    restraints: &[Restraint],
) -> Result<(Vec<String>, Holds)> {
    let mut held = Held { mesh, of_node: HashMap::new() };
    // Many restraints may name one group, which has many nodes.
    let mut done = HashSet::new();
    let mut names = Vec::with_capacity(restraints.len());
    for (k, restraint) in restraints.iter().enumerate() {
        let place = format!("restraints[{k}]");
        let displacements = displacements(restraint, &place)?;
        let (name, on, nodes) = site((mesh, dropped), groups, restraint, &place)?;
        for (axis, displacement) in restraint.fix.iter().zip(displacements) {
            if !done.insert(format!("{name} {axis:?} {displacement:e}")) {
                continue;
            }
            for (node, direction) in directions(mesh, groups, sides, (on, &nodes), *axis, &place)? {
                held.add(Hold { node, direction, displacement, restraint: Some(k) })?;
            }
        }
        names.push(name);
    }
    let all = held.of_node.into_values().flatten().collect();
    let mut holds = Holds::new(mesh.nodes.len(), all);
    holds.fix(dropped.iter().flat_map(|node| node.dofs()));
    Ok((names, holds))
}

/// Names the first node that two restraints hold along directions that are nearly one, as where a smooth
/// curve is in two groups; it then cannot move at all.
pub fn narrow(mesh: &Mesh, model: &Model) -> Option<String> {
    let nearly_one = model.node_ids().filter_map(|node| {
        let [one, other] = model.holds.of(node) else { return None };
        let (a, b) = (one.direction, other.direction);
        let cosine = (a[0] * b[0] + a[1] * b[1]).abs();
        let by = [one.restraint?, other.restraint?];
        (by[0] != by[1] && cosine > BEND).then_some((node, by, cosine))
    });
    let all: Vec<_> = nearly_one.collect();
    let (node, [j, k], cosine) = all.first()?;
    let others = match all.len() {
        1 => String::new(),
        count => format!(", one of {count} such nodes,"),
    };
    Some(format!(
        "Node {}{others} is held by restraints {} ({}) and {} ({}) along directions {} degrees apart, and so cannot move \
         at all: put both curves in one group, and it is held along their mean",
        mesh.named(&[node.number()]),
        j + 1,
        model.restraints[*j],
        k + 1,
        model.restraints[*k],
        six_digits(cosine.min(1.0).acos().to_degrees().round())
    ))
}

/// Returns the name of a restraint's place, the group that it is, and its nodes, ascending.
fn site<'a>(
    (mesh, dropped): (&Mesh, &[NodeId]),
    groups: &Groups,
    restraint: &'a Restraint,
    place: &str,
) -> Result<(String, Option<&'a GroupRef>, Vec<NodeId>)> {
    let one = |node: NodeId| (format!("node {}", mesh.named(&[node.number()])), None, vec![node]);
    match (&restraint.on, restraint.node, restraint.at) {
        (Some(on), None, None) => {
            let nodes = groups.nodes(on, &format!("{place}.on"))?;
            Ok((on.text(), Some(on), nodes.into_iter().collect()))
        }
        (None, Some(n), None) => mesh.node(n, &format!("{place}.node")).map(one),
        (None, None, Some(at)) => node_at(mesh, dropped, at, &format!("{place}.at")).map(one),
        _ => {
            let what = "a restraint is {on, fix}, {node, fix} or {at, fix}";
            Err(InputError::new(place, what, "give exactly one of on, node and at"))
        }
    }
}

/// Returns the node at a place, of those that belong to a triangle.
fn node_at(mesh: &Mesh, dropped: &[NodeId], [x, y]: [f64; 2], place: &str) -> Result<NodeId> {
    let points: Vec<[f64; 2]> = mesh.nodes.iter().map(|node| [node.xyz[0], node.xyz[1]]).collect();
    let is_kept = |n: &usize| dropped.binary_search(&NodeId::from_number(*n)).is_err();
    let kept: Vec<usize> = (1..=points.len()).filter(is_kept).collect();
    let near = NEAR * Bounds::around(kept.iter().map(|n| &points[n - 1])).larger_side();
    let distance = |n: &usize| (points[n - 1][0] - x).hypot(points[n - 1][1] - y);
    let nearest = kept.iter().copied().min_by(|a, b| distance(a).total_cmp(&distance(b)));
    let all: Vec<usize> = kept.iter().copied().filter(|n| distance(n) <= near).collect();
    match (&all[..], nearest) {
        ([n], _) => Ok(NodeId::from_number(*n)),
        ([], Some(nearest)) => {
            let [nx, ny] = points[nearest - 1].map(six_digits);
            let what = format!(
                "no node is at {}, {} to within {}: the nearest, node {}, is at {nx}, {ny}",
                six_digits(x),
                six_digits(y),
                six_digits(near),
                mesh.named(&[nearest])
            );
            Err(InputError::new(place, what, "give the coordinates of a node of the mesh"))
        }
        _ => {
            let what = format!("nodes {} are all at this place", mesh.named(&all));
            Err(InputError::new(place, what, "name one of them by its number"))
        }
    }
}

/// Returns the displacement along each direction of a restraint, length.
fn displacements(restraint: &Restraint, place: &str) -> Result<Vec<f64>> {
    let Restraint { fix, displacement, .. } = restraint;
    if fix.is_empty() {
        let what = "a restraint that fixes no direction";
        let fix = "name \"x\", \"y\", \"n\", \"t\" or {\"direction\": [1, 1]}";
        return Err(InputError::new(format!("{place}.fix"), what, fix));
    }
    if displacement.is_empty() {
        return Ok(vec![0.0; fix.len()]);
    }
    let place = format!("{place}.displacement");
    if displacement.len() != fix.len() {
        let what = format!("a list of {}, where fix has {}", displacement.len(), fix.len());
        return Err(InputError::new(place, what, "give one for each of fix"));
    }
    match displacement.iter().find(|x| !x.is_finite()) {
        // 0 − 0 is no displacement either.
        None => Ok(displacement.iter().map(|x| x + 0.0).collect()),
        Some(x) => Err(InputError::new(place, format!("{x} is not finite"), "give a length")),
    }
}

/// Returns the nodes that a restraint holds along an axis, ascending, each with its direction, of length 1.
fn directions(
    mesh: &Mesh,
    groups: &Groups,
    sides: &Sides,
    (on, nodes): (Option<&GroupRef>, &[NodeId]),
    axis: Axis,
    place: &str,
) -> Result<Vec<(NodeId, [f64; 2])>> {
    let vector = match axis {
        Axis::X => [1.0, 0.0],
        Axis::Y => [0.0, 1.0],
        Axis::Direction(vector) => unit(vector).ok_or_else(|| {
            let what = format!("the direction [{}, {}] has no length", vector[0], vector[1]);
            InputError::new(format!("{place}.fix"), what, "give one such as [1, 1]")
        })?,
        Axis::Normal | Axis::Tangent => {
            let Some(on) = on else {
                let what = "a node has neither normal nor tangent";
                let fix = "name a group of edges, or give {\"direction\": [1, 1]}";
                return Err(InputError::new(format!("{place}.fix"), what, fix));
            };
            let along = |[nx, ny]: [f64; 2]| match axis {
                Axis::Tangent => [-ny, nx],
                Axis::X | Axis::Y | Axis::Direction(_) | Axis::Normal => [nx, ny],
            };
            let normals = normals(mesh, groups, sides, on, place)?;
            let each = |(node, own): (NodeId, Vec<[f64; 2]>)| {
                own.into_iter().map(move |normal| (node, along(normal)))
            };
            return Ok(normals.into_iter().flat_map(each).collect());
        }
    };
    Ok(nodes.iter().map(|node| (*node, vector)).collect())
}

/// Returns the outward normals of the nodes of a group of edges, of length 1: their mean by the lengths of
/// the edges, or those of all edges where these meet in a corner.
fn normals(
    mesh: &Mesh,
    groups: &Groups,
    sides: &Sides,
    on: &GroupRef,
    place: &str,
) -> Result<BTreeMap<NodeId, Vec<[f64; 2]>>> {
    let place = format!("{place}.on");
    let mut across: BTreeMap<NodeId, Vec<[f64; 2]>> = BTreeMap::new();
    for edge in groups.members(1, on, &place)? {
        let Some(side) = sides.boundary(edge.ids()) else {
            let (number, nodes) = (edge.number, mesh.named(&edge.nodes));
            let what = format!("edge {number} (nodes {nodes}) has no outer side");
            return Err(InputError::new(place, what, "name outer edges of a body"));
        };
        let [[ax, ay, _], [bx, by, _]] = side.nodes.map(|node| mesh.nodes[node.index()].xyz);
        side.nodes.iter().for_each(|n| across.entry(*n).or_default().push([by - ay, ax - bx]));
    }
    let own = |edges: Vec<[f64; 2]>| {
        let each: Vec<[f64; 2]> = edges.iter().filter_map(|edge| unit(*edge)).collect();
        let turns = |n: &[f64; 2]| n[0] * each[0][0] + n[1] * each[0][1] < BEND;
        if each.iter().any(turns) {
            return each;
        }
        let sum = edges.iter().fold([0.0; 2], |s, e| [s[0] + e[0], s[1] + e[1]]);
        unit(sum).into_iter().collect()
    };
    Ok(across.into_iter().map(|(node, edges)| (node, own(edges))).collect())
}

/// Returns a vector at length 1, along an axis where it is so to rounding; None where it has no length.
fn unit([x, y]: [f64; 2]) -> Option<[f64; 2]> {
    let length = x.hypot(y);
    let part = |x: f64| if (x / length).abs() < SAME { 0.0 } else { x / length };
    (length > 0.0 && length.is_finite()).then(|| match [part(x), part(y)] {
        [x, 0.0] => [x.signum(), 0.0],
        [0.0, y] => [0.0, y.signum()],
        both => both,
    })
}

/// The directions along which nodes are held so far.
struct Held<'a> {
    mesh: &'a Mesh,
    /// Those of each node, at most two.
    of_node: HashMap<NodeId, Vec<Hold>>,
}

impl Held<'_> {
    /// Keeps what a restraint holds where those before it do not.
    ///
    /// # Errors
    /// They displace the node by another amount along that direction, or hold it along nearly the same one.
    fn add(&mut self, hold: Hold) -> Result<()> {
        let by = |hold: &Hold| hold.restraint.expect("a restraint gives it");
        let k = by(&hold);
        let before = self.of_node.entry(hold.node).or_default();
        let [x, y] = hold.direction;
        let sine = |other: &Hold| (x * other.direction[1] - y * other.direction[0]).abs();
        let near = before.iter().find(|other| sine(other) < TWO);
        let already = match (near, &before[..]) {
            (Some(other), _) if sine(other) <= SAME => {
                let along = x * other.direction[0] + y * other.direction[1];
                along.signum() * other.displacement
            }
            (_, [a, b]) => {
                let [u, v] = crossing([a, b]);
                x * u + y * v
            }
            (Some(other), _) => {
                let (first, degrees) = (by(other), sine(other).asin().to_degrees());
                let what = format!(
                    "restraints[{first}] and restraints[{k}] hold node {} along directions {} degrees apart",
                    self.mesh.named(&[hold.node.number()]),
                    six_digits(degrees)
                );
                let fix = "hold it along one of them, or put both curves in one group";
                return Err(InputError::new(format!("restraints[{k}]"), what, fix));
            }
            (None, _) => {
                before.push(hold);
                return Ok(());
            }
        };
        let sizes = before.iter().map(|other| other.displacement.abs());
        let size = sizes.fold(hold.displacement.abs(), f64::max);
        if (already - hold.displacement).abs() <= SAME * size {
            return Ok(());
        }
        let first = by(&before[0]);
        let what = format!(
            "node {} is displaced by {} along [{}, {}], and by {} as restraints[{first}] has it",
            self.mesh.named(&[hold.node.number()]),
            six_digits(hold.displacement),
            six_digits(x),
            six_digits(y),
            six_digits(already)
        );
        let fix = "give one displacement of the node along each direction";
        Err(InputError::new(format!("restraints[{k}]"), what, fix))
    }
}
