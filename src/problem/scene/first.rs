//! A first scene for a mesh of Gmsh, to be edited: the groups that the mesh has, each in the place for which
//! it looks most likely.

use std::collections::{BTreeMap, BTreeSet, HashMap, HashSet};
use std::fmt::Write;

use serde_json::{Value, json};

use super::Scene;
use super::check;
use super::description::{Description, Materials};
use super::file::{self, of_null, text_of};
use super::groups::{GroupRef, Groups};
use super::mesh::{Element, Mesh};
use super::surface::Surface;
use crate::element::Plane;
use crate::model::{Bounds, Material, Model, NodeId, Sides, lowest};
use base::error::{InputError, Result};
use base::plain::six_digits;

/// The most entities for which lines of Gmsh are written.
const MOST_LINES: usize = 20;

/// What the contact surface and the target are called elsewhere.
const CONTACT: [&str; 2] = ["slave", "secondary"];
const TARGET: [&str; 2] = ["master", "primary"];

/// How many times as long as the target's contact edges are at least that let the pressure be smooth.
const MUCH_FINER: f64 = 0.5;

/// The part of their length by which edges of equal length may differ.
const EQUAL: f64 = 0.1;

/// The most edges, about, that are compared with those that they face.
const SAMPLE: usize = 200;

/// The part of the shortest target edge that the tolerance of the contact search becomes.
const TOLERANCE: f64 = 0.01;

/// A scene file, and what was guessed for it, in sentences.
pub struct FirstScene {
    /// The text of the file; what only its author knows is null.
    pub text: String,
    /// What was guessed, and which groups are left.
    pub notes: Vec<String>,
}

/// The two ends of an edge, with the body on the left, length.
type Ends = [[f64; 2]; 2];

/// A physical group of edges.
struct Curve {
    group: GroupRef,
    /// The bodies that it bounds, each by its lowest node.
    bodies: BTreeSet<usize>,
    /// The ends of its outer edges, with the body on the left, length.
    edges: Vec<Ends>,
    /// Whether each of its edges bounds one triangle.
    is_outline: bool,
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
    let (groups, body, orphans) = (Groups::new(&mesh), bodies(&mesh), mesh.orphans());
    let mut notes = Vec::new();
    let materials = materials(name, &mesh, &groups, &mut notes)?;
    let (mut curves, mut inner): (Vec<Curve>, Vec<Curve>) =
        curves(&mesh, &groups, &body)?.into_iter().partition(|curve| curve.is_outline);
    let contact = contact(&mut curves, &mut notes);
    let distinct: BTreeSet<usize> = body.iter().copied().collect();
    if contact.is_none() && distinct.len() > orphans.len() + 1 {
        notes.push("contact: no two groups of edges of different bodies face each other".into());
    }
    for group in [&mut curves, &mut inner] {
        group.sort_by(|a, b| a.height.total_cmp(&b.height));
    }
    let (mut rest, mut inner) = (curves.iter(), inner.iter());
    // Edges that bound no triangle or two can be restrained, too.
    let (lowest, highest) = (rest.next().or_else(|| inner.next()), rest.next_back());
    let guess = |what: &str, curve: Option<&Curve>, extreme: &str| match curve {
        None => format!("{what}: no group of edges is left for it"),
        Some(curve) => format!("{what}: on {}, the {extreme}", curve.group),
    };
    if groups.all(1).is_empty() {
        notes.push(without_curves(&mesh));
    } else {
        notes.push(guess("restraint", lowest, "lowest"));
        notes.push(guess("load", highest, "highest"));
    }
    let names = |rest: &mut dyn Iterator<Item = &Curve>| {
        rest.map(|curve| curve.group.to_string()).collect::<Vec<_>>().join(", ")
    };
    let (rest, inner) = (names(&mut rest), names(&mut inner));
    if !rest.is_empty() {
        notes.push(format!("left for more restraints and loads: {rest}"));
    }
    if !inner.is_empty() {
        notes.push(format!(
            "left over: {inner}, with edges that bound no triangle or two: for restraints alone"
        ));
    }
    let of = |curves: &[Curve]| curves.iter().flat_map(|curve| curve.bodies.clone()).collect();
    let touching = contact.as_ref().map_or(BTreeSet::new(), |(_, pair)| of(pair));
    let restrained = lowest.map_or(BTreeSet::new(), |curve| curve.bodies.clone());
    notes.extend(loose(&mesh, &groups, &materials, &body, [&restrained, &touching])?);
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
    if !orphans.is_empty() {
        scene["drop_orphans"] = true.into();
        let named = mesh.named(&orphans);
        notes.push(format!("drop_orphans: nodes in no triangle are left out: {named}"));
    }
    notes.extend(in_solve(&scene, file));
    Ok(FirstScene { text: text_of(&scene), notes })
}

/// Takes the two curves that look like a contact out of the others; returns them behind the scene's contact.
fn contact(curves: &mut Vec<Curve>, notes: &mut Vec<String>) -> Option<(Value, [Curve; 2])> {
    let (gap, [cnt, trg], why) = pair(curves)?;
    let [of_cnt, of_trg] = [cnt, trg].map(|place| &curves[place].group);
    let reach = curves[cnt].longest().max(curves[trg].longest());
    let apart = match gap > reach {
        true => format!(", though they are {} apart, more than an edge", six_digits(gap)),
        false => String::new(),
    };
    notes.push(format!(
        "contact: {of_cnt} on {of_trg}, which face each other closest of those of different bodies{apart}; {of_cnt} is \
         cnt, as {why}"
    ));
    let tolerance = six_digits(TOLERANCE * curves[trg].shortest()).parse().unwrap_or(Value::Null);
    let scene = json!({ "cnt": of_cnt, "trg": of_trg, "c_tll": tolerance, "friction": null });
    Some((scene, [cnt.max(trg), cnt.min(trg)].map(|place| curves.remove(place))))
}

/// Says that a mesh has no group of edges.
fn without_curves(mesh: &Mesh) -> String {
    let how = match is_of_gmsh(mesh) {
        true => {
            "in Gmsh add those that you need, as in Physical Curve(\"bottom\") = {1}; and mesh again"
        }
        false => {
            "in meshio add cells of the kind \"line\", with a tag and its name, and save again"
        }
    };
    format!(
        "the mesh has no group of edges, by which a scene names restraints, loads and contact: {how}"
    )
}

/// Returns what `solve` would say of a first scene, whatever is chosen for what is null.
fn in_solve(scene: &Value, file: &[u8]) -> Vec<String> {
    let mut chosen = scene.clone();
    of_null(&mut chosen, "", "", &mut |_, field, value| {
        *value = if field == "nu" { 0.0 } else { 1.0 }.into();
    });
    match Scene::build("first", text_of(&chosen).as_bytes(), |_| Ok(file.to_vec())) {
        Ok(scene) => scene.adapted().to_vec(),
        Err(why) => vec![format!("solve refuses it so far: {}; {}", why.what, why.fix)],
    }
}

/// Returns the groups of triangles that get a material: the smaller first, without those of which others have
/// a triangle too.
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
                "contact alone holds the body {name}: it may slide or lift off: restrain it, or give friction"
            ),
            false => format!("nothing holds the body {name}: restrain it, or give it a contact surface"),
        }
    });
    Ok(merged.chain(said).collect())
}

/// Returns the body of each node, by its lowest one.
fn bodies(mesh: &Mesh) -> Vec<usize> {
    lowest(mesh.nodes.len(), mesh.of_dimension(2).map(Element::ids))
}

/// Returns the groups of edges.
fn curves(mesh: &Mesh, groups: &Groups, body: &[usize]) -> Result<Vec<Curve>> {
    let triangles: Vec<[NodeId; 3]> = mesh.of_dimension(2).map(Element::ids).collect();
    let sides = Sides::new(triangles.into_iter());
    let curve = |group: GroupRef| {
        let nodes = groups.nodes(&group, "")?;
        let outer = groups.members(1, &group, "")?.filter_map(|edge| {
            let side = sides.boundary(edge.ids())?;
            Some(side.nodes.map(|node| mesh.xy(node.number())))
        });
        let edges: Vec<Ends> = outer.collect();
        let is_outline = edges.len() == groups.members(1, &group, "")?.count();
        let heights = nodes.iter().map(|n| mesh.xy(n.number())[1]);
        let height = heights.sum::<f64>() / nodes.len() as f64;
        let bodies = nodes.iter().map(|n| body[n.index()]).collect();
        Ok(Curve { group, bodies, edges, is_outline, height })
    };
    groups.all(1).into_iter().map(curve).collect()
}

impl Curve {
    fn lengths(&self) -> impl Iterator<Item = f64> {
        self.edges.iter().map(length)
    }

    fn longest(&self) -> f64 {
        self.lengths().fold(0.0, f64::max)
    }

    fn shortest(&self) -> f64 {
        self.lengths().fold(f64::INFINITY, f64::min)
    }

    /// Returns whether the group is called as the contact surface is elsewhere, or as the target is.
    fn is_called(&self, names: &[&str]) -> bool {
        let name = self.group.text().to_lowercase();
        names.iter().any(|word| name.contains(word))
    }
}

fn length([[ax, ay], [bx, by]]: &Ends) -> f64 {
    (bx - ax).hypot(by - ay)
}

/// Returns for each edge that faces one of `others` the distance from its middle to the nearest of those
/// along its normal, length, < 0 where they overlap, and how many times as long as that one it is.
fn facing(edges: &[Ends], others: &[Ends]) -> Vec<[f64; 2]> {
    let reach = edges.iter().chain(others).map(length).fold(0.0, f64::max);
    let nearest = |edge: &Ends| {
        let gaps = others
            .iter()
            .filter_map(|other| Some([gap(edge, other)?, length(edge) / length(other)]));
        gaps.filter(|[gap, _]| *gap >= -reach).min_by(|a, b| a[0].abs().total_cmp(&b[0].abs()))
    };
    edges.iter().filter_map(nearest).collect()
}

/// Returns how many times as long as the edges that they face edges are, by the middle one of a sample; None
/// where none faces another.
fn relative_length(edges: &[Ends], others: &[Ends]) -> Option<f64> {
    let sample: Vec<Ends> = edges.iter().step_by(1 + edges.len() / SAMPLE).copied().collect();
    let mut ratios: Vec<f64> = facing(&sample, others).iter().map(|[_, ratio]| *ratio).collect();
    ratios.sort_unstable_by(f64::total_cmp);
    ratios.get(ratios.len() / 2).copied()
}

/// Writes a ratio with two decimals at most.
fn times(ratio: f64) -> String {
    six_digits((100.0 * ratio).round() / 100.0)
}

/// Says that the edges of the contact surface are under half as long as the target's.
pub fn fine_contact(model: &Model) -> Option<String> {
    let outer = |nodes: [NodeId; 2]| {
        let side = model.sides.boundary(nodes)?;
        Some(side.nodes.map(|node| model.nodes[node.index()]))
    };
    let nodes = &model.contact.nodes;
    let next = nodes.iter().cycle().skip(1);
    let contact: Vec<Ends> = nodes.iter().zip(next).filter_map(|(a, b)| outer([*a, *b])).collect();
    let target: Vec<Ends> = model.target_edges().filter_map(|edge| outer(edge.nodes)).collect();
    let ratio = relative_length(&contact, &target).filter(|ratio| *ratio < MUCH_FINER)?;
    Some(format!(
        "The target's edges are {} times as long as those of the contact surface that face them, so that the contact \
         pressure alternates from node to node: the surface with the longer edges is the better cnt",
        times(ratio.recip())
    ))
}

/// Returns the distance from the middle of an edge to another along the outward normal, length; None where
/// the normal does not meet it, or its outer side looks away.
fn gap([a, b]: &Ends, [c, d]: &Ends) -> Option<f64> {
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
        pair(&curves).map(|(_, places, _)| places.map(|place| curves[place].group.to_string()));
    right.map(|[a, b]| {
        format!("The contact surfaces {cnt} and {trg} face each other nowhere; {a} and {b} do")
    })
}

/// Returns the smallest distance of the two curves of different bodies that look like a contact, their
/// places, and why the first is the contact surface: most of their edges face the other one within an edge.
fn pair(curves: &[Curve]) -> Option<(f64, [usize; 2], String)> {
    let pairs = (0..curves.len()).flat_map(|a| (0..a).map(move |b| [b, a]));
    let facing = pairs.filter_map(|[a, b]| {
        let [of_a, of_b] = [&curves[a], &curves[b]];
        if !of_a.bodies.is_disjoint(&of_b.bodies) {
            return None;
        }
        let gaps = [facing(&of_a.edges, &of_b.edges), facing(&of_b.edges, &of_a.edges)].concat();
        let least = gaps.iter().map(|[gap, _]| gap.abs()).reduce(f64::min)?;
        let reach = of_a.longest().max(of_b.longest());
        let within = gaps.iter().filter(|[gap, _]| gap.abs() <= reach).count();
        Some(((within, -least), [a, b]))
    });
    let best = facing.reduce(|best, other| if other.0 > best.0 { other } else { best });
    best.map(|((_, least), [a, b])| {
        let (is_first, why) = contact_surface(&curves[a], &curves[b]);
        (-least, if is_first { [a, b] } else { [b, a] }, why)
    })
}

/// Returns whether `a` rather than `b` is the contact surface, and why: the one that its name says, unless
/// its edges are much the shorter ones; else the one with the longer edges, of equal ones the shorter.
fn contact_surface(a: &Curve, b: &Curve) -> (bool, String) {
    let ratio = relative_length(&a.edges, &b.edges).unwrap_or(1.0);
    let is_named = |own: &Curve, other: &Curve| own.is_called(&CONTACT) || other.is_called(&TARGET);
    let [first, second] = [is_named(a, b), is_named(b, a)];
    if first != second && (if first { ratio } else { ratio.recip() }) >= MUCH_FINER {
        return (first, "the names say".into());
    }
    if (ratio.ln()).abs() > EQUAL {
        let more = times(ratio.max(ratio.recip()));
        return (
            ratio > 1.0,
            format!("its edges are longer, {more} times, so that its pressure is smoother"),
        );
    }
    let is_shorter = a.lengths().sum::<f64>() <= b.lengths().sum();
    (is_shorter, "it is the shorter surface, and their edges are about as long".into())
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
