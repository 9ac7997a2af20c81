//! A first scene for a mesh of Gmsh, to be edited: the groups that the mesh has, each in the place for which it
//! looks most likely.

use std::collections::{BTreeSet, HashMap};
use std::fmt::Write;

use serde_json::{Value, json};

use super::description::Description;
use super::file::text_of;
use super::groups::{GroupRef, Groups};
use super::mesh::Mesh;
use super::source;
use crate::element::Plane;
use crate::model::Bounds;
use base::error::{InputError, Result};
use base::plain::six_digits;
use numbers::joined::joined;

/// The most entities for which lines of Gmsh are written.
const MOST_LINES: usize = 20;

/// The part of the shortest target edge that the tolerance of the contact search becomes.
const TOLERANCE: f64 = 0.01;

/// A scene file, and what was guessed for it, in sentences.
pub struct FirstScene {
    /// The text of the file; what only its author knows is null.
    pub text: String,
    /// What was guessed, and which groups are left.
    pub notes: Vec<String>,
}

/// A physical group of edges.
struct Curve {
    group: GroupRef,
    nodes: BTreeSet<usize>,
    /// The body whose outline it is part of, by its lowest node; None where it is part of two.
    body: Option<usize>,
    /// The sum of its edges, the longest and the shortest of them, length.
    length: f64,
    longest: f64,
    shortest: f64,
    /// The middle of its nodes along y, length.
    height: f64,
}

/// Writes a first scene for the mesh in `file`, which the scene calls `name`.
///
/// # Errors
/// The file is no mesh, or has no group of triangles: the error has the lines that Gmsh needs.
pub fn first(name: &str, file: &[u8]) -> Result<FirstScene> {
    let mut description =
        Description { mesh: Some(name.into()), ..Description::new(Plane::Strain) };
    let mesh = source::mesh(&mut description, |_| Ok(file.to_vec()))?;
    mesh.check()?;
    let groups = Groups::new(&mesh);
    let bodies = groups.all(2);
    if bodies.is_empty() {
        let what = format!(
            "the mesh has no physical group of triangles, by which a scene names its bodies; such lines are missing in \
             the geometry, with names of your own:\n{}",
            lines(&mesh)
        );
        let fix = "add those that you need, and mesh again (gmsh part.geo -2); in Python: \
                   gmsh.model.addPhysicalGroup(2, [1], name=\"body\")";
        return Err(InputError::new(format!("mesh {name:?}"), what, fix));
    }
    let mut curves = curves(&mesh, &groups)?;
    let mut notes = Vec::new();
    let contact = pair(&mesh, &curves).map(|[cnt, trg]| {
        notes.push(format!(
            "contact: {} on {}, the nearest to each other of different bodies",
            curves[cnt].group, curves[trg].group
        ));
        let tolerance: Value =
            six_digits(TOLERANCE * curves[trg].shortest).parse().unwrap_or(Value::Null);
        let scene = json!({
            "cnt": curves[cnt].group, "trg": curves[trg].group, "c_tll": tolerance, "friction": null
        });
        curves.remove(cnt.max(trg));
        curves.remove(cnt.min(trg));
        scene
    });
    curves.sort_by(|a, b| a.height.total_cmp(&b.height));
    let mut rest = curves.iter().map(|curve| &curve.group);
    let restraints: Vec<Value> =
        rest.next().map(|on| json!({ "on": on, "fix": ["x", "y"] })).into_iter().collect();
    let loads: Vec<Value> =
        rest.next_back().map(|on| json!({ "on": on, "pressure": null })).into_iter().collect();
    let guess = |what: &str, values: &[Value], extreme: &str| match values {
        [] => format!("{what}: no group of edges is left for it"),
        [value, ..] => format!("{what}: on {}, the {extreme}", value["on"]),
    };
    if groups.all(1).is_empty() {
        notes.push(
            "the mesh has no group of edges, by which a scene names restraints, loads and contact: in Gmsh add those \
             that you need, as in Physical Curve(\"bottom\") = {1}; and mesh again"
                .into(),
        );
    } else {
        notes.push(guess("restraint", &restraints, "lowest"));
        notes.push(guess("load", &loads, "highest"));
    }
    let rest: Vec<String> = rest.map(GroupRef::to_string).collect();
    if !rest.is_empty() {
        notes.push(format!("left for more restraints and loads: {}", rest.join(", ")));
    }
    let unknown = |group: &GroupRef| (group.text(), json!({ "E": null, "nu": null }));
    let mut scene = json!({
        "title": name.rsplit('/').next().unwrap_or(name).trim_end_matches(".msh"),
        "mesh": name,
        "plane": Plane::Strain.name(),
        "units": { "length": "", "stress": "", "force": "" },
        "materials": bodies.iter().map(unknown).collect::<serde_json::Map<_, _>>(),
        "restraints": restraints,
        "loads": loads,
    });
    if let Some(contact) = contact {
        scene["contact"] = contact;
    }
    if !mesh.orphans().is_empty() {
        scene["drop_orphans"] = true.into();
        notes.push("drop_orphans: some nodes belong to no triangle".into());
    }
    Ok(FirstScene { text: text_of(&scene), notes })
}

/// Returns the groups of edges.
fn curves(mesh: &Mesh, groups: &Groups) -> Result<Vec<Curve>> {
    let sides = mesh.of_dimension(2).flat_map(|triangle| {
        let [a, b, c] = [0, 1, 2].map(|k| triangle.nodes[k] - 1);
        [(a, b), (b, c)]
    });
    let body = joined(mesh.nodes.len(), sides);
    let curve = |group: GroupRef| {
        let nodes = groups.nodes(&group, "")?;
        let lengths = groups.members(1, &group, "")?.map(|edge| {
            let [[ax, ay], [bx, by]] = [0, 1].map(|k| mesh.xy(edge.nodes[k]));
            (bx - ax).hypot(by - ay)
        });
        let lengths: Vec<f64> = lengths.collect();
        let bodies: BTreeSet<usize> = nodes.iter().map(|n| body[n - 1]).collect();
        let heights = nodes.iter().map(|n| mesh.xy(*n)[1]);
        Ok(Curve {
            body: bodies.first().copied().filter(|_| bodies.len() == 1),
            length: lengths.iter().sum(),
            longest: lengths.iter().copied().fold(0.0, f64::max),
            shortest: lengths.iter().copied().fold(f64::INFINITY, f64::min),
            height: heights.sum::<f64>() / nodes.len() as f64,
            nodes,
            group,
        })
    };
    groups.all(1).into_iter().map(curve).collect()
}

/// Returns the places of the two curves of different bodies that look like a contact: most of their nodes lie within
/// an edge of the other one; the shorter comes first.
fn pair(mesh: &Mesh, curves: &[Curve]) -> Option<[usize; 2]> {
    let near = |from: &Curve, to: &Curve| {
        let least = from.nodes.iter().map(|n| {
            let [x, y] = mesh.xy(*n);
            let distances = to.nodes.iter().map(|m| {
                let [mx, my] = mesh.xy(*m);
                (x - mx).hypot(y - my)
            });
            distances.fold(f64::INFINITY, f64::min)
        });
        let least: Vec<f64> = least.collect();
        let within =
            least.iter().filter(|distance| **distance <= from.longest.max(to.longest)).count();
        (within, -least.into_iter().fold(f64::INFINITY, f64::min))
    };
    let pairs = (0..curves.len()).flat_map(|a| (0..a).map(move |b| [b, a]));
    let facing = pairs.filter_map(|[a, b]| {
        let [of_a, of_b] = [&curves[a], &curves[b]];
        (of_a.body? != of_b.body?).then(|| {
            let [(m, distance), (n, _)] = [near(of_a, of_b), near(of_b, of_a)];
            let places = if of_b.length < of_a.length { [b, a] } else { [a, b] };
            ((m + n, distance), places)
        })
    });
    let best = facing.reduce(|best, other| if other.0 > best.0 { other } else { best });
    best.map(|(_, places)| places)
}

/// Returns the lines by which Gmsh has a group of each surface and curve of the mesh, each with its extent.
fn lines(mesh: &Mesh) -> String {
    let mut lines = String::new();
    for (dim, kind) in [(2, "Surface"), (1, "Curve")] {
        let mut points: HashMap<usize, Vec<[f64; 2]>> = HashMap::new();
        for element in mesh.of_dimension(dim) {
            let nodes = element.nodes.iter().map(|n| mesh.xy(*n));
            points.entry(element.geometric).or_default().extend(nodes);
        }
        let mut tags: Vec<_> = points.keys().copied().collect();
        tags.sort_unstable();
        let word = kind.to_lowercase();
        for tag in tags.iter().take(MOST_LINES) {
            let Bounds { low, high } = Bounds::around(&points[tag]);
            let [[ax, ay], [bx, by]] = [low, high].map(|point| point.map(six_digits));
            let group = format!("Physical {kind}(\"{word}{tag}\") = {{{tag}}};");
            let _ = writeln!(lines, "  {group:<42} // x {ax} to {bx}, y {ay} to {by}");
        }
        match tags.len() {
            0 => lines.push_str(
                "  Physical Curve(\"bottom\") = {n};  // for curves, whose numbers Gmsh shows\n",
            ),
            count if count > MOST_LINES => {
                let _ = writeln!(lines, "  ... and {} more {word}s", count - MOST_LINES);
            }
            _ => {}
        }
    }
    lines.trim_end().into()
}
