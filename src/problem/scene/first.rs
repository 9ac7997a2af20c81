//! A first scene for a mesh of Gmsh, to be edited: the groups that the mesh has, each in the place for which it
//! looks most likely.

use std::collections::{BTreeMap, BTreeSet, HashMap, HashSet};
use std::fmt::Write;

use serde_json::{Value, json};

use super::check;
use super::description::{Description, Material, Materials};
use super::file::{self, text_of};
use super::groups::{GroupRef, Groups};
use super::mesh::{Element, Mesh};
use super::surface::Surface;
use crate::element::Plane;
use crate::model::{Bounds, NodeId, Sides};
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
    /// The bodies that it bounds, each by its lowest node.
    bodies: BTreeSet<usize>,
    /// The ends of its outer edges, with the body on the left, length.
    edges: Vec<[[f64; 2]; 2]>,
    /// The middle of its nodes along y, length.
    height: f64,
}

/// Writes a first scene for the mesh in `file`, which the scene calls `name`.
///
/// # Errors
/// The file is no mesh, or not each of its triangles is in one group: the error has the lines that are missing.
pub fn first(name: &str, file: &[u8]) -> Result<FirstScene> {
    let mut description =
        Description { mesh: Some(name.into()), ..Description::new(Plane::Strain) };
    let mesh = file::mesh(&mut description, |_| Ok(file.to_vec()))?;
    mesh.check()?;
    let groups = Groups::new(&mesh);
    let mut notes = Vec::new();
    let materials = materials(name, &mesh, &groups, &mut notes)?;
    let body = bodies(&mesh);
    let mut curves = curves(&mesh, &groups, &body)?;
    let contact = match pair(&curves) {
        Some((gap, [cnt, trg])) => {
            let [of_cnt, of_trg] = [cnt, trg].map(|place| &curves[place].group);
            let reach = curves[cnt].longest().max(curves[trg].longest());
            let apart = match gap > reach {
                true => format!(", though they are {} apart, more than an edge", six_digits(gap)),
                false => String::new(),
            };
            notes.push(format!(
                "contact: {of_cnt} on {of_trg}, which face each other closest of those of different bodies{apart}"
            ));
            let tolerance: Value =
                six_digits(TOLERANCE * curves[trg].shortest()).parse().unwrap_or(Value::Null);
            let scene =
                json!({ "cnt": of_cnt, "trg": of_trg, "c_tll": tolerance, "friction": null });
            let pair = [cnt.max(trg), cnt.min(trg)].map(|place| curves.remove(place));
            Some((scene, pair))
        }
        None => {
            if body.iter().collect::<BTreeSet<_>>().len() > mesh.orphans().len() + 1 {
                notes.push(
                    "contact: no two groups of edges of different bodies face each other".into(),
                );
            }
            None
        }
    };
    curves.sort_by(|a, b| a.height.total_cmp(&b.height));
    let mut rest = curves.iter();
    let (lowest, highest) = (rest.next(), rest.next_back());
    let guess = |what: &str, curve: Option<&Curve>, extreme: &str| match curve {
        None => format!("{what}: no group of edges is left for it"),
        Some(curve) => format!("{what}: on {}, the {extreme}", curve.group),
    };
    if groups.all(1).is_empty() {
        let how = match is_of_gmsh(&mesh) {
            true => {
                "in Gmsh add those that you need, as in Physical Curve(\"bottom\") = {1}; and mesh again"
            }
            false => {
                "in meshio add cells of the kind \"line\", with a tag and its name, and save again"
            }
        };
        notes.push(format!(
            "the mesh has no group of edges, by which a scene names restraints, loads and contact: {how}"
        ));
    } else {
        notes.push(guess("restraint", lowest, "lowest"));
        notes.push(guess("load", highest, "highest"));
    }
    let rest: Vec<String> = rest.map(|curve| curve.group.to_string()).collect();
    if !rest.is_empty() {
        notes.push(format!("left for more restraints and loads: {}", rest.join(", ")));
    }
    let of = |curves: &[Curve]| curves.iter().flat_map(|curve| curve.bodies.clone()).collect();
    let touching = contact.as_ref().map_or(BTreeSet::new(), |(_, pair)| of(pair));
    let restrained = lowest.map_or(BTreeSet::new(), |curve| curve.bodies.clone());
    notes.extend(loose(&mesh, &groups, &materials, &body, [&restrained, &touching])?);
    notes.extend(groups.without_triangles());
    let unknown = |group: &GroupRef| (group.text(), json!({ "E": null, "nu": null }));
    let restraints = lowest.map(|curve| json!({ "on": curve.group, "fix": ["x", "y"] }));
    let loads = highest.map(|curve| json!({ "on": curve.group, "pressure": null }));
    let mut scene = json!({
        "title": name.rsplit('/').next().unwrap_or(name).trim_end_matches(".msh"),
        "mesh": name,
        "plane": Plane::Strain.name(),
        "units": { "length": "", "stress": "", "force": "" },
        "materials": materials.iter().map(unknown).collect::<serde_json::Map<_, _>>(),
        "restraints": restraints.as_slice(),
        "loads": loads.as_slice(),
    });
    if let Some((contact, _)) = contact {
        scene["contact"] = contact;
    }
    if !mesh.orphans().is_empty() {
        scene["drop_orphans"] = true.into();
        let named = mesh.named(&mesh.orphans());
        notes.push(format!("drop_orphans: nodes in no triangle are left out: {named}"));
    }
    Ok(FirstScene { text: text_of(&scene), notes })
}

/// Returns the groups of triangles that get a material: the smaller first, without those of which others have a
/// triangle too.
///
/// # Errors
/// There is none, or not each triangle is in one of them.
fn materials(
    name: &str,
    mesh: &Mesh,
    groups: &Groups,
    notes: &mut Vec<String>,
) -> Result<Vec<GroupRef>> {
    let all = groups.all(2);
    if all.is_empty() {
        return Err(ungrouped(name, mesh));
    }
    let members = |group: &GroupRef| groups.places(2, group, "").unwrap_or_default();
    let mut by_size: Vec<&GroupRef> = all.iter().collect();
    by_size.sort_by_key(|group| members(group).len());
    let (mut taken, mut apart) = (BTreeSet::<u32>::new(), HashSet::new());
    for group in by_size {
        if members(group).iter().all(|place| !taken.contains(place)) {
            taken.extend(members(group));
            apart.insert(group);
        }
    }
    let (own, rest): (Vec<GroupRef>, Vec<GroupRef>) =
        all.iter().cloned().partition(|group| apart.contains(group));
    let are_enough = |list: &[GroupRef]| {
        // Any numbers do: which triangles have a material is asked for.
        let some = list.iter().map(|group| (group.clone(), Material { e: 1.0, nu: 0.0 })).collect();
        let description =
            Description { materials: Materials(some), ..Description::new(Plane::Strain) };
        check::materials(mesh, groups, &description)
    };
    if are_enough(&own).is_err() {
        are_enough(&all).map_err(|why| why.within(&format!("mesh {name:?}")))?;
    }
    if !rest.is_empty() {
        let rest: Vec<String> = rest.iter().map(GroupRef::to_string).collect();
        notes.push(format!(
            "materials: none for {}, whose triangles are in the other groups too",
            rest.join(", ")
        ));
    }
    Ok(own)
}

/// Says of each body that is in no group of edges that is restrained what holds it: contact, or nothing.
fn loose(
    mesh: &Mesh,
    groups: &Groups,
    materials: &[GroupRef],
    body: &[usize],
    [restrained, touching]: [&BTreeSet<usize>; 2],
) -> Result<Vec<String>> {
    let mut names: BTreeMap<usize, Vec<String>> = BTreeMap::new();
    for group in materials {
        let of = groups.members(2, group, "")?.map(|triangle| body[triangle.nodes[0] - 1]);
        let of: BTreeSet<usize> = of.collect();
        for first in &of {
            let part = match of.len() {
                1 => group.to_string(),
                _ => format!("{group} at node {}", mesh.named(&[first + 1])),
            };
            names.entry(*first).or_default().push(part);
        }
    }
    let merged = names.values().filter(|names| names.len() > 1).map(|names| {
        format!(
            "{} share nodes and are one body: nothing comes in contact between them; where they only touch, mesh them \
             apart, in Gmsh without Coherence and BooleanFragments",
            names.join(" and ")
        )
    });
    let free = names.iter().filter(|(first, _)| !restrained.contains(first));
    let said = free.map(|(first, names)| {
        let name = names.join(", ");
        match touching.contains(first) {
            true => format!(
                "contact alone holds the body {name}, which slides where no friction holds it, and may lift off: \
                 restrain it too if it can"
            ),
            false => format!("nothing holds the body {name}: restrain it, or give it a contact surface"),
        }
    });
    Ok(merged.chain(said).collect())
}

/// Returns the body of each node, by its lowest one.
fn bodies(mesh: &Mesh) -> Vec<usize> {
    let sides = mesh.of_dimension(2).flat_map(|triangle| {
        let [a, b, c] = [0, 1, 2].map(|k| triangle.nodes[k] - 1);
        [(a, b), (b, c)]
    });
    joined(mesh.nodes.len(), sides)
}

/// Returns the groups of edges.
fn curves(mesh: &Mesh, groups: &Groups, body: &[usize]) -> Result<Vec<Curve>> {
    let corners = |triangle: &Element| [0, 1, 2].map(|k| NodeId::from_number(triangle.nodes[k]));
    let triangles: Vec<[NodeId; 3]> = mesh.of_dimension(2).map(corners).collect();
    let sides = Sides::new(triangles.into_iter());
    let curve = |group: GroupRef| {
        let nodes = groups.nodes(&group, "")?;
        let outer = groups.members(1, &group, "")?.filter_map(|edge| {
            let side = sides.boundary([0, 1].map(|k| NodeId::from_number(edge.nodes[k])))?;
            Some(side.nodes.map(|node| mesh.xy(node.number())))
        });
        let edges = outer.collect();
        let heights = nodes.iter().map(|n| mesh.xy(*n)[1]);
        let height = heights.sum::<f64>() / nodes.len() as f64;
        let bodies = nodes.iter().map(|n| body[n - 1]).collect();
        Ok(Curve { group, bodies, edges, height })
    };
    groups.all(1).into_iter().map(curve).collect()
}

impl Curve {
    fn lengths(&self) -> impl Iterator<Item = f64> {
        self.edges.iter().map(|[[ax, ay], [bx, by]]| (bx - ax).hypot(by - ay))
    }

    fn longest(&self) -> f64 {
        self.lengths().fold(0.0, f64::max)
    }

    fn shortest(&self) -> f64 {
        self.lengths().fold(f64::INFINITY, f64::min)
    }

    /// Returns for each edge that faces one of `other` the distance from its middle to the nearest of those along its
    /// normal, length: < 0 where they overlap.
    fn gaps(&self, other: &Curve) -> Vec<f64> {
        let reach = self.longest().max(other.longest());
        let nearest = |edge: &[[f64; 2]; 2]| {
            let gaps = other.edges.iter().filter_map(|target| gap(edge, target));
            gaps.filter(|gap| *gap >= -reach).min_by(|a, b| a.abs().total_cmp(&b.abs()))
        };
        self.edges.iter().filter_map(nearest).collect()
    }
}

/// Returns the distance from the middle of an edge to another along the outward normal, length; None where the
/// normal does not meet it, or its outer side looks away.
fn gap([a, b]: &[[f64; 2]; 2], [c, d]: &[[f64; 2]; 2]) -> Option<f64> {
    let [u, v] = [[b[0] - a[0], b[1] - a[1]], [d[0] - c[0], d[1] - c[1]]];
    let across = u[0] * v[0] + u[1] * v[1];
    let middle = [(a[0] + b[0]) / 2.0, (a[1] + b[1]) / 2.0];
    let to = [c[0] - middle[0], c[1] - middle[1]];
    // The normals are u and v turned by a right angle: both products are those of u and v too.
    let part = (to[0] * v[1] - to[1] * v[0]) / across;
    let at = [part * u[1] - to[0], -part * u[0] - to[1]];
    let along = (at[0] * v[0] + at[1] * v[1]) / (v[0] * v[0] + v[1] * v[1]);
    let meets = across < 0.0 && (0.0..=1.0).contains(&along);
    meets.then(|| part * u[0].hypot(u[1]))
}

/// Says that the two groups of a scene's contact do not face each other, and which ones do.
pub fn not_facing(mesh: &Mesh, groups: &Groups, file: &Description) -> Option<String> {
    let named = file.contact.as_ref().map(|contact| [&contact.contact, &contact.target]);
    let Some([Surface::Group(cnt), Surface::Group(trg)]) = named else { return None };
    let curves = curves(mesh, groups, &bodies(mesh)).ok()?;
    let is = |curve: &&Curve, group: &GroupRef| {
        groups.places(1, &curve.group, "").ok() == groups.places(1, group, "").ok()
    };
    let [own, other] = [cnt, trg].map(|group| curves.iter().find(|curve| is(curve, group)));
    let [own, other] = [own?, other?];
    if own.edges.iter().any(|edge| other.edges.iter().any(|target| gap(edge, target).is_some())) {
        return None;
    }
    let right =
        pair(&curves).map(|(_, places)| places.map(|place| curves[place].group.to_string()));
    right.map(|[a, b]| {
        format!("The contact surfaces {cnt} and {trg} face each other nowhere; {a} and {b} do")
    })
}

/// Returns the smallest distance of the two curves of different bodies that look like a contact, and their places:
/// most of their edges face the other one within an edge; the shorter comes first.
fn pair(curves: &[Curve]) -> Option<(f64, [usize; 2])> {
    let pairs = (0..curves.len()).flat_map(|a| (0..a).map(move |b| [b, a]));
    let facing = pairs.filter_map(|[a, b]| {
        let [of_a, of_b] = [&curves[a], &curves[b]];
        let is_one = |curve: &Curve| curve.bodies.len() == 1;
        if !is_one(of_a) || !is_one(of_b) || of_a.bodies == of_b.bodies {
            return None;
        }
        let gaps = [of_a.gaps(of_b), of_b.gaps(of_a)].concat();
        let least = gaps.iter().map(|gap| gap.abs()).reduce(f64::min)?;
        let reach = of_a.longest().max(of_b.longest());
        let within = gaps.iter().filter(|gap| gap.abs() <= reach).count();
        let length = |curve: &Curve| curve.lengths().sum::<f64>();
        let places = if length(of_b) < length(of_a) { [b, a] } else { [a, b] };
        Some(((within, -least), places))
    });
    let best = facing.reduce(|best, other| if other.0 > best.0 { other } else { best });
    best.map(|((_, least), places)| (-least, places))
}

/// Returns whether the mesh has numbers of Gmsh's surfaces, which other programs leave out.
fn is_of_gmsh(mesh: &Mesh) -> bool {
    mesh.of_dimension(2).any(|triangle| triangle.geometric != 0)
}

/// Says how a mesh without a group of triangles gets some.
fn ungrouped(name: &str, mesh: &Mesh) -> InputError {
    let what = "the mesh has no physical group of triangles, by which a scene names its bodies";
    let place = format!("mesh {name:?}");
    if !is_of_gmsh(mesh) {
        let what =
            format!("{what}; nor has it surfaces of Gmsh, as where meshio saved it without tags");
        let fix = format!(
            "in Python give each triangle and line the tag of its group, and each tag its name and dimension:\n\
             \x20 mesh.cell_data[\"gmsh:physical\"] = [np.full(len(b), 1) for b in mesh.cells]\n\
             \x20 mesh.field_data = {{\"body\": np.array([1, 2]), \"bottom\": np.array([1, 1])}}\n\
             \x20 mesh.write({name:?}, file_format=\"gmsh22\")\n\
             (a .msh file has no cell_sets; the Python package plane_contact takes a mesh with them)"
        );
        return InputError::new(place, what, fix);
    }
    let lines = lines(mesh);
    let what =
        format!("{what}; such lines are missing in the geometry, with names of your own:\n{lines}");
    let fix = "add those that you need, and mesh again (gmsh part.geo -2); in Python: \
               gmsh.model.addPhysicalGroup(2, [1], name=\"body\")";
    InputError::new(place, what, fix)
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
