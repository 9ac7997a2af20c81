//! Snapshots recorded here verify on other processors, whose vector instructions have factorisations
//! sum in another order: every golden snapshot, and random scenes with friction. QEMU emulates the
//! processors; where it is not installed nothing is checked, unless `REQUIRE_QEMU` is set.
//! `PLANE_CONTACT_PROCESSORS` asks for a number of random scenes.

use std::path::{Path, PathBuf};
use std::process::Command;

use fastrand::Rng;
use plane_contact::engine::Request;
use plane_contact::problem::element::Plane;
use plane_contact::problem::modelling::{Coupling, Friction, Geometry, Variant};
use plane_contact::problem::scene::{Axis, Contact, MeshBuilder, Scene, SceneBuilder};
use plane_contact::report::snapshot::file;
use plane_contact::studies::snapshot::{Bounds, Snapshot};
use tempfile::TempDir;

use crate::common::draws::one_of;
use crate::common::tools::is_there;

/// SSE 4.2 alone; AVX; AVX 2 with fused multiplication and addition.
const PROCESSORS: [&str; 3] = ["Nehalem", "SandyBridge", "Haswell"];

/// Verifies snapshots on each processor.
fn verify(files: &[PathBuf]) {
    let emulated = |processor: &str| {
        let mut command = Command::new("qemu-x86_64");
        command.args(["-cpu", processor, env!("CARGO_BIN_EXE_plane-contact")]);
        command
    };
    let mut version = emulated(PROCESSORS[0]);
    version.arg("--version");
    if !is_there(version, "REQUIRE_QEMU") {
        return;
    }
    for processor in PROCESSORS {
        let output = emulated(processor)
            .args(["snapshot", "verify"])
            .args(files)
            .output()
            .expect("it starts");
        let text = String::from_utf8_lossy(&output.stdout);
        let errors = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.success(), "{processor}: {text}{errors}");
    }
}

#[test]
fn golden_snapshots_verify_on_other_processors() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("golden");
    let folders = std::fs::read_dir(folder).expect("golden files").flatten();
    let files = folders.map(|entry| entry.path().join("snapshot.json"));
    verify(&files.filter(|file| file.exists()).collect::<Vec<_>>());
}

/// Draws a block of `height` on `bottom` from `left` on: the rows of its nodes, from below.
fn block(
    rng: &mut Rng,
    mesh: &mut MeshBuilder,
    name: &str,
    [left, bottom, width, height]: [f64; 4],
) -> Vec<Vec<usize>> {
    let (columns, lines) = (rng.usize(2..6), rng.usize(1..4));
    let mut point = |i: usize, j: usize| {
        let is_inside = i > 0 && i < columns && j > 0 && j < lines;
        let mut moved = || if is_inside { 0.4 * (rng.f64() - 0.5) } else { 0.0 };
        let [x, y] = [i as f64 + moved(), j as f64 + moved()];
        [left + width * x / columns as f64, bottom + height * y / lines as f64]
    };
    let rows: Vec<Vec<usize>> = (0..=lines)
        .map(|j| mesh.row((0..=columns).map(|i| point(i, j)).collect::<Vec<_>>()))
        .collect();
    for (below, above) in rows.iter().zip(&rows[1..]) {
        for i in 0..columns {
            let [a, b, c, d] = [below[i], below[i + 1], above[i + 1], above[i]];
            mesh.triangles(name, [[a, b, c], [a, c, d]]);
        }
    }
    rows
}

/// Draws two blocks with friction between them, the upper one pressed down and pushed aside.
fn frictional(rng: &mut Rng) -> Option<Scene> {
    let mut mesh = MeshBuilder::default();
    let size = one_of(rng, &[0.01, 1.0, 20.0]);
    let [a, b, c, d] = [(); 4].map(|()| size * (0.5 + rng.f64()));
    let lower = block(rng, &mut mesh, "lower", [0.0, 0.0, 2.0 * a, b]);
    let upper = block(rng, &mut mesh, "upper", [0.3 * a, b, 0.7 * d, c]);
    mesh.edges("bottom", &lower[0]);
    mesh.edges("target", lower.last()?);
    mesh.edges("contact", &upper[0]);
    mesh.edges("top", upper.last()?);
    let friction = Friction::new(0.05 + 0.8 * rng.f64())?;
    let contact = Contact {
        friction,
        coupling: one_of(rng, &[Coupling::Nts, Coupling::Mortar]),
        geometry: one_of(rng, &[Geometry::Current, Geometry::Initial]),
        load_steps: rng.usize(1..5),
        ..Contact::new("contact", "target", 1e-3 * size)
    };
    let pressure = one_of(rng, &[1.0, 30.0]);
    let shear = pressure * (rng.f64() - 0.5) * friction.coefficient();
    let scene = SceneBuilder::new(
        "frictional",
        mesh.finish(),
        one_of(rng, &[Plane::Stress, Plane::Strain]),
    )
    .units("mm", "MPa", "N")
    .material("lower", one_of(rng, &[3e4, 2.1e5]), 0.2)
    .material("upper", one_of(rng, &[3e4, 2.1e5]), 0.3)
    .restrain("bottom", &[Axis::X, Axis::Y])
    .traction("top", [shear, -pressure])
    .contact(contact);
    let scene = if rng.bool() { scene.restrain("top", &[Axis::X]) } else { scene };
    scene.variant(Variant::Unilateral).build().ok()
}

#[test]
fn random_frictional_snapshots_verify_on_other_processors() {
    let asked = std::env::var("PLANE_CONTACT_PROCESSORS").ok();
    let count = asked.map_or(5, |count| count.parse().expect("a number of scenes"));
    let folder = TempDir::new().expect("a folder");
    let mut rng = Rng::with_seed(41);
    let scenes = std::iter::repeat_with(|| frictional(&mut rng)).flatten().take(count);
    let record = |(k, scene): (usize, Scene)| {
        let request = Request::new(&scene);
        let snapshot = Snapshot::record(&scene, &[request], Bounds::Computed).expect("it runs");
        let path = folder.path().join(format!("{k}.json"));
        std::fs::write(&path, file(&snapshot)).expect("a snapshot");
        path
    };
    verify(&scenes.enumerate().map(record).collect::<Vec<_>>());
}
