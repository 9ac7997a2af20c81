//! The scenes of exercises: a target of four edges and a stamp of four or five contact nodes, all
//! coordinates with two decimals, so that `c_cnt` can be executed by hand.

use fastrand::Rng;

use paper::door::{Call, ContactStatus};
use paper::mirror::Reading;
use problem::element::Plane;
use problem::model::Model;
use problem::scene::{Axis, Contact, MeshBuilder, Scene, SceneBuilder};

/// The tolerance of the contact search, length: with three decimals, so that no node lies on a box.
const C_TLL: f64 = 0.045;
/// How far each gap is from 0 and from c_tll at least, length: no rounding decides a status.
const CLEAR: f64 = 0.002;

/// Heights over the target's line, in c_tll, between which a contact node is drawn.
type Height = [f64; 2];
const TOUCHING: Height = [-0.7, 0.7];
const NEAR: Height = [1.2, 2.5];
const DEEP: Height = [-2.5, -1.2];
const FAR: Height = [2.5, 6.0];

/// Draws scenes until one is fair.
pub fn draw(rng: &mut Rng) -> Scene {
    loop {
        let scene = drawn(rng);
        if is_fair(&scene.model) {
            return scene;
        }
    }
}

/// Returns whether at least one node is in contact by its own gap, one by the sign rule (lines 17 and
/// 18) alone, one is not, and as many are in contact as are not.
fn is_fair(model: &Model) -> bool {
    let call = Call::c_cnt(model, &Reading::default(), &model.nodes);
    let statuses = call.expect("no target edge is vertical").statuses;
    let count = |is: fn(&ContactStatus) -> bool| statuses.iter().filter(|s| is(s)).count();
    let by_signs = count(|s| s.in_contact && s.distance.abs() >= C_TLL);
    let by_gap = count(|s| s.in_contact && s.distance.abs() < C_TLL);
    let apart = count(|s| !s.in_contact);
    let unclear = |gap: f64| gap.abs() < CLEAR || (gap.abs() - C_TLL).abs() < CLEAR;
    let is_clear = !statuses.iter().any(|s| s.edge.is_some() && unclear(s.distance));
    is_clear && by_signs > 0 && by_gap > 0 && (1..=by_signs + by_gap).contains(&apart)
}

fn between(rng: &mut Rng, [low, high]: [f64; 2]) -> f64 {
    low + (high - low) * rng.f64()
}

/// A scene that may be fair: a deep node beside a separated one, the others as they come.
fn drawn(rng: &mut Rng) -> Scene {
    let corner = |j| rounded([f64::from(j) + between(rng, [-0.2, 0.2]), between(rng, [0.0, 0.6])]);
    let surface: Vec<_> = (0..5).map(corner).collect();
    let count = rng.usize(4..=5);
    let deep = rng.usize(0..count - 1);
    let pair = if rng.bool() { [DEEP, NEAR] } else { [NEAR, DEEP] };
    let step = 3.0 / (count - 1) as f64;
    let stamp = (0..count).map(|k| {
        let height = match k {
            k if k == deep => pair[0],
            k if k == deep + 1 => pair[1],
            _ if rng.bool() => TOUCHING,
            _ => FAR,
        };
        let x = 0.5 + step * k as f64 + between(rng, [-0.2, 0.2]);
        rounded([x, line(&surface, x) + C_TLL * between(rng, height)])
    });
    let stamp: Vec<_> = stamp.collect();
    scene(&surface, &stamp, rng.bool())
}

/// A point with two decimals.
fn rounded(point: [f64; 2]) -> [f64; 2] {
    point.map(|x| (100.0 * x).round() / 100.0)
}

/// Height of the surface at `x`, which lies over it.
fn line(surface: &[[f64; 2]], x: f64) -> f64 {
    let edge = surface.windows(2).find(|edge| x <= edge[1][0]).expect("the stamp is narrower");
    let [a, b] = [edge[0], edge[1]];
    a[1] + (b[1] - a[1]) * (x - a[0]) / (b[0] - a[0])
}

/// Both bodies as strips of triangles, restrained whole: nothing is solved. Target edges run from right
/// to left where they are `turned`.
fn scene(surface: &[[f64; 2]], stamp: &[[f64; 2]], turned: bool) -> Scene {
    let mut mesh = MeshBuilder::default();
    let target = mesh.row(surface.iter().copied());
    let bottom = mesh.row(surface.iter().map(|p| [p[0], -1.0]));
    let contact = mesh.row(stamp.iter().copied());
    let top = mesh.row(stamp.iter().map(|p| [p[0], 2.0]));
    for edge in target.windows(2) {
        let [a, b] = [edge[0], edge[1]];
        mesh.edges("surface", &if turned { [b, a] } else { [a, b] });
    }
    mesh.join("target", &target, &bottom);
    mesh.join("stamp", &top, &contact);
    SceneBuilder::new("exercise", mesh.finish(), Plane::Strain)
        .material("target", 1.0, 0.0)
        .material("stamp", 1.0, 0.0)
        .restrain("target", &[Axis::X, Axis::Y])
        .restrain("stamp", &[Axis::X, Axis::Y])
        .contact(Contact::new(contact, "surface", C_TLL))
        .build()
        .expect("a scene that is drawn is sound")
}
