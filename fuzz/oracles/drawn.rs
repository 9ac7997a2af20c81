//! Small scenes, requests and edits drawn from bytes. The first choice is the plain one, which is
//! what no bytes are left for.

use arbitrary::{Result, Unstructured};
use plane_contact::Request;
use plane_contact::input::{
    Arithmetic, Axis, Contact, Coupling, Friction, Geometry, Inputs, Mesh, MeshBuilder, Plane,
    Reading, ScalarName, Solver, StatusRule, Variant,
};
use plane_contact::paper::mirror::{DefaultFrom, READINGS};
use plane_contact::problem::scene::{Scene, SceneBuilder, Surface};

fn seldom(u: &mut Unstructured) -> Result<bool> {
    u.choose(&[false, false, false, true]).copied()
}

/// A block under a stamp, each of a few triangles, whose nodes are moved a little.
pub fn scene(u: &mut Unstructured) -> Result<SceneBuilder> {
    let scale = *u.choose(&[1.0, 1.0, 1.0, 1.0, 1e3, 1e-9, 1e100, 1e-100, 1e153])?;
    let c_tll = *u.choose(&[1e-3, 1e-3, 0.1, 0.0, 1.0, 1e-300])?;
    let gap = *u.choose(&[0.0, 0.5, -0.5, 1.0, -1.0, 3.0, -3.0, 100.0])? * c_tll;
    let left = *u.choose(&[0.0, 0.25, -0.25, 0.5, 1.0, 3.0])?;
    let mut mesh = MeshBuilder::default();
    let block = body(u, &mut mesh, "block", [0.0, -1.0, 2.0, 0.0], scale)?;
    let top = *u.choose(&[1.0, 0.2, 3.0])?;
    let stamp = body(u, &mut mesh, "stamp", [left, gap, left + 1.0, gap + top], scale)?;
    mesh.edges("bottom", &block[0]);
    mesh.edges("top", &stamp[stamp.len() - 1]);
    let (mut face, mut arc) = (block[block.len() - 1].clone(), stamp[0].clone());
    if seldom(u)? {
        face.reverse();
    }
    mesh.edges("face", &face);
    mesh.edges("arc", &arc);
    let mut contact = Contact::new("arc", "face", c_tll * scale);
    if seldom(u)? {
        let places = u.choose_index(arc.len())?;
        arc.rotate_left(places);
        arc.extend(u.choose_iter([None, Some(arc[0])])?);
        contact.contact = Surface::Numbers(arc);
    }
    contact.coupling = Some(*u.choose(Coupling::ALL)?);
    let mu = *u.choose(&[0.3, f64::INFINITY, 0.0, 1e-9, 5.0, 1e300])?;
    contact.friction = Some(Friction::new(mu).expect("a coefficient"));
    contact.geometry = *u.choose(Geometry::ALL)?;
    contact.load_steps = *u.choose(&[4, 1, 2, 16])?;
    contact.status = *u.choose(StatusRule::ALL)?;
    described(u, mesh.finish(), contact, scale)
}

/// Materials, restraints and loads on the mesh of two bodies.
fn described(
    u: &mut Unstructured,
    mesh: Mesh,
    contact: Contact,
    scale: f64,
) -> Result<SceneBuilder> {
    let nodes = mesh.nodes.len();
    let mut scene = SceneBuilder::new("drawn", mesh, *u.choose(Plane::ALL)?)
        .thickness(*u.choose(&[1.0, 0.5, 1e6])?)
        .contact(contact)
        .variant(*u.choose(Variant::ALL)?)
        .iterations(u.int_in_range(1..=5)?);
    for group in ["block", "stamp"] {
        let e = *u.choose(&[3e4, 2.1e5, 1.0, 1e-3, 1e12, 1e-300, 1e300])?;
        let nu = *u.choose(&[0.2, 0.0, 0.3, 0.49, 0.499_999_9, 0.5, -0.5])?;
        scene = scene.material(group, e, nu);
    }
    let axes: [&[Axis]; 3] = [&[Axis::X, Axis::Y], &[Axis::Y], &[Axis::X]];
    scene = scene.restrain("bottom", u.choose(&axes)?);
    scene = scene.restrain("top", u.choose(&[axes[2], axes[1], axes[0]])?);
    for _ in 0..u.int_in_range(0..=2)? {
        scene = scene.restrain_node(u.int_in_range(1..=nodes)?, u.choose(&axes)?);
    }
    for _ in 0..u.int_in_range(1..=3)? {
        let sizes = [-1.0, 6.3, 0.0, 1e3, 1e-12, 1e-300, 1e150, 1e300];
        let mut size = || u.choose(&sizes).copied();
        let (x, y) = (size()?, size()?);
        scene = match u.int_in_range(0..=2)? {
            0 => scene.pressure("top", -x),
            1 => scene.traction("top", [y, x]),
            _ => scene.force(u.int_in_range(1..=nodes)?, [y * scale, x * scale]),
        };
        scene = scene.in_stage(*u.choose(&[1, 1, 2])?);
    }
    Ok(scene)
}

/// The rows of nodes of a body between two corners, from bottom to top.
fn body(
    u: &mut Unstructured,
    mesh: &mut MeshBuilder,
    name: &str,
    [x0, y0, x1, y1]: [f64; 4],
    scale: f64,
) -> Result<Vec<Vec<usize>>> {
    let (nx, ny) = (u.int_in_range(1..=4)?, u.int_in_range(1..=2)?);
    let mut rows: Vec<Vec<usize>> = Vec::new();
    for j in 0..=ny {
        let mut points = Vec::new();
        for i in 0..=nx {
            let nudges = [0.0, 0.0, 0.0, 0.05, -0.05, 1e-3, -1e-3, 1e-12, 0.2];
            let [s, t] = [f64::from(i) / f64::from(nx), f64::from(j) / f64::from(ny)];
            let x = x0 + s * (x1 - x0) + u.choose(&nudges)?;
            let y = y0 + t * (y1 - y0) + u.choose(&nudges)?;
            points.push([x * scale, y * scale]);
        }
        rows.push(mesh.row(points));
    }
    mesh.join_all(name, &rows);
    Ok(rows)
}

/// What is asked of a scene. Exact numbers are left to scenes that are known to be cheap.
pub fn request(u: &mut Unstructured, scene: &Scene) -> Result<Request> {
    use ScalarName::{F32, F64, F64x2};
    let scalar = *u.choose(&[F64, F64, F64, F64x2, F32])?;
    let solver = match seldom(u)? {
        true => Some(*u.choose(Solver::ALL)?),
        false => None,
    };
    let inputs = *u.choose(Inputs::ALL)?;
    let request = Request::new(scene).reading(reading(u)?);
    Ok(request.arithmetic(Arithmetic { scalar, solver, inputs }))
}

pub fn reading(u: &mut Unstructured) -> Result<Reading> {
    let mut reading = Reading::default();
    for row in READINGS.iter().filter(|row| row.is_option()) {
        let mut choices: Vec<_> = row.values.iter().map(Some).collect();
        match row.default {
            DefaultFrom::First => (),
            DefaultFrom::Scene | DefaultFrom::Variant => choices.insert(0, None),
        }
        if let Some(value) = u.choose(&choices)? {
            row.set(&mut reading, value);
        }
    }
    Ok(reading)
}

/// Returns a listing's text with so many edits: lines that go, come twice, change places or level,
/// and words of the listing in the place of others.
pub fn edited(u: &mut Unstructured, text: &str, edits: usize) -> Result<String> {
    let mut lines: Vec<String> = text.lines().map(String::from).collect();
    let all: Vec<&str> = words(text).into_iter().filter(|word| !word.contains('\n')).collect();
    for _ in 0..edits {
        // The header stays.
        let mut line = || u.int_in_range(1..=lines.len() - 1);
        let (i, j) = (line()?, line()?);
        match u.int_in_range(0..=5)? {
            0 if lines.len() > 2 => drop(lines.remove(i)),
            1 => lines.insert(i, lines[j].clone()),
            2 => lines.swap(i, j),
            3 => lines[i].insert_str(0, "  "),
            4 => lines[i] = lines[i].strip_prefix("  ").unwrap_or(&lines[i]).into(),
            _ => {
                let line = lines[i].clone();
                let mut words = words(&line);
                let k = u.choose_index(words.len())?;
                words[k] = *u.choose(&all)?;
                lines[i] = words.concat();
            }
        }
    }
    Ok(lines.join("\n") + "\n")
}

/// Cuts a text between words and signs.
fn words(text: &str) -> Vec<&str> {
    let mut words = Vec::new();
    let mut start = 0;
    let is_word = |c: char| c.is_alphanumeric() || c == '_';
    for ((_, a), (at, b)) in text.char_indices().zip(text.char_indices().skip(1)) {
        if !(is_word(a) && is_word(b) || a == ' ' && b == ' ') {
            words.push(&text[start..at]);
            start = at;
        }
    }
    words.push(&text[start..]);
    words
}
