//! What went into two runs and differs is named, and where they first differ: of changes that a test makes,
//! of rounding, of another version, of a tampered number.

use fastrand::Rng;
use plane_contact::engine::linear::{Arithmetic, Solver};
use plane_contact::engine::{Detail, Request, Step, solve};
use plane_contact::problem::modelling::Variant;
use plane_contact::problem::scene::{GroupRef, Scene, SceneBuilder, Surface};
use plane_contact::studies::snapshot::{
    Entry, Quantity, Snapshot, Values, VerifiedRun, difference, verify,
};

/// A change of what goes into a run, and the place that is to be named.
struct Change {
    place: String,
    scene: Scene,
    request: Request,
}

const KINDS: usize = 7;

/// Draws a change of one kind; None where the changed scene is none.
fn change(kind: usize, scene: &Scene, rng: &mut Rng) -> Option<Change> {
    let (description, mesh) = scene.source();
    let mut builder = SceneBuilder {
        name: scene.name.clone(),
        mesh: mesh.clone(),
        description: description.clone(),
    };
    let variant = Variant::ALL[rng.usize(..3)];
    let mut changed = |request: &mut Request| {
        let contact = builder.description.contact.as_mut().expect("the scene has contact");
        match kind {
            0 => {
                let node = rng.usize(..builder.mesh.nodes.len());
                let axis = rng.usize(..2);
                let by = 10f64.powf(-1.0 - 6.0 * rng.f64());
                builder.mesh.nodes[node].xyz[axis] += by;
                format!("mesh node {}", node + 1)
            }
            1 => {
                let materials = &mut builder.description.materials.0;
                let (group, material) = &mut materials[rng.usize(..2)];
                material.e *= 1.0 + 10f64.powf(-1.0 - 6.0 * rng.f64());
                let name = match group {
                    GroupRef::Name(name) => name.clone(),
                    GroupRef::Tag(tag) => tag.to_string(),
                };
                format!("scene materials.{name}.E")
            }
            2 => {
                contact.tolerance *= 0.2 + 4.0 * rng.f64();
                "scene contact.c_tll".into()
            }
            3 => {
                let Surface::Numbers(nodes) = &mut contact.contact else { unreachable!("a list") };
                let before = nodes.clone();
                while *nodes == before {
                    rng.shuffle(nodes);
                }
                "scene contact.cnt".into()
            }
            4 => {
                let readings = ["R1=inside", "R2=printed", "R3=nested", "R5=node_n", "R8=m"];
                let reading = readings[rng.usize(..readings.len())];
                request.reading = reading.parse().expect("a reading");
                "option reading".into()
            }
            5 => {
                let solvers = [Solver::DenseLu, Solver::SparseLu];
                let solver = Some(solvers[rng.usize(..solvers.len())]);
                request.arithmetic = Arithmetic { solver, ..Arithmetic::default() };
                "option solver".into()
            }
            _ => {
                let edges = scene.model.target_edges().map(|edge| edge.number);
                let edges: Vec<usize> = edges.collect();
                let number = edges[rng.usize(..edges.len())];
                let elements = &mut builder.mesh.elements;
                let edge = elements.iter_mut().find(|e| e.number == number).expect("an edge");
                edge.nodes.reverse();
                format!("mesh elem {number}")
            }
        }
    };
    let mut own = Request::new(scene).variant(variant);
    let place = changed(&mut own);
    let scene = builder.build().ok()?;
    let mut request = Request::new(&scene).variant(variant).arithmetic(own.arithmetic);
    request.reading = own.reading;
    Some(Change { place, scene, request })
}

/// Compares two snapshots of one run each.
fn compared(old: &Snapshot, new: &Snapshot) -> VerifiedRun {
    difference(old, new).runs.remove(0)
}

/// The contact surface in an iteration, by the listing's own arrays.
fn found(step: &Step) -> (Vec<usize>, Vec<usize>) {
    let Detail::Published(step) = &step.detail else { panic!("a variant of the paper") };
    (step.ct.as_slice().to_vec(), step.dy.as_slice().to_vec())
}

/// The first iteration and node where two requests go different ways, found by looking at both runs.
fn first_flip(old: &Request, new: &Request) -> Option<(usize, u64)> {
    let [old, new] = [old, new].map(|request| solve(request, &mut |_| ()).expect("it runs"));
    let nodes = &new.model.contact.nodes;
    old.steps.iter().zip(&new.steps).find_map(|(was, is)| {
        let (was, is) = (found(was), found(is));
        let at = (0..nodes.len()).find(|&i| (was.0[i], was.1[i]) != (is.0[i], is.1[i]))?;
        Some((new.steps.iter().position(|step| found(step) == is)? + 1, nodes[at].number() as u64))
    })
}

#[test]
fn a_hundred_seeded_changes_are_named() {
    let mut rng = Rng::with_seed(2026);
    let scenes = ["fig1", "two-blocks"].map(|name| Scene::open(name).expect("embedded"));
    let lists = scenes.map(|scene| with_lists(&scene));
    let (mut flips, mut drawn, mut differ) = (0, 0, 0);
    while drawn < 100 {
        let scene = &lists[drawn / KINDS % 2];
        let Some(change) = change(drawn % KINDS, scene, &mut rng) else { continue };
        let own = Request::new(scene).variant(change.request.variant);
        let record = |scene: &Scene, request: &Request| {
            Snapshot::record(scene, std::slice::from_ref(request))
        };
        let old = record(scene, &own).expect("it runs");
        // A changed scene whose matrix is singular to rounding is refused, and records nothing.
        let Ok(new) = record(&change.scene, &change.request) else { continue };
        drawn += 1;
        let found = compared(&old, &new);
        // Without a change there is no difference.
        let again = record(&change.scene, &change.request).expect("it ran");
        assert!(compared(&new, &again).differences.is_empty());
        if found.differences.is_empty() {
            continue;
        }
        differ += 1;
        let places: Vec<_> = found.changes.iter().map(|change| &change.place).collect();
        assert_eq!(places, [&change.place]);
        // The runs themselves go different ways where it is said.
        let run = &new.runs.iter().next().expect("a run").1;
        if run.exit_status() == Some(0) && change.place != "scene contact.cnt" {
            let status = found.first.expect("they differ").status;
            let named = status.map(|status| (status.iteration, status.node));
            let seen = first_flip(&own, &change.request);
            assert_eq!(named, seen, "{}", change.place);
            flips += usize::from(seen.is_some());
        }
    }
    assert!(differ > 70 && flips > 10, "{differ} {flips}");
}

/// The same scene with its contact surface as a list of nodes.
fn with_lists(scene: &Scene) -> Scene {
    let (description, mesh) = scene.source();
    let mut description = description.clone();
    let nodes = scene.model.contact.nodes.iter().map(|node| node.number()).collect();
    description.contact.as_mut().expect("contact").contact = Surface::Numbers(nodes);
    SceneBuilder { name: scene.name.clone(), mesh: mesh.clone(), description }
        .build()
        .expect("sound")
}

/// On `strand` at a small tolerance rounding decides who is in contact (C11): two solvers give
/// histories of their own, and what looks like another machine is said to be decided by rounding.
#[test]
fn what_rounding_may_have_decided_is_said() {
    let scene = Scene::open("strand").expect("embedded");
    let mut request = Request::new(&scene).variant(Variant::Tied);
    request.tolerance = Some(1e-6);
    let solver = Some(Solver::SparseLu);
    let other = request.clone().arithmetic(Arithmetic { solver, ..Arithmetic::default() });
    let mut snapshot = Snapshot::record(&scene, &[other]).expect("it runs");
    let (_, run) = snapshot.runs.iter().next().expect("a run");
    let mut run = run.clone();
    run.options.solver = None;
    snapshot.runs = [(run.options.name(), run)].into_iter().collect();
    let mut verified = verify(&snapshot, None, &|| ()).expect("it runs");
    let VerifiedRun { first, changes, .. } = verified.runs.remove(0);
    assert!(changes.is_empty(), "{changes:?}");
    let status = first.expect("it differs").status.expect("a status");
    assert!(status.rounding.expect("a decision").contains("c_cnt"));
}

#[test]
fn another_version_is_named_and_a_tampered_number_is_found() {
    let scene = Scene::open("two-blocks").expect("embedded");
    let request = Request::new(&scene).variant(Variant::Tied);
    let mut snapshot = Snapshot::record(&scene, &[request]).expect("it runs");
    let run = snapshot.runs.get_mut("tied").expect("it was recorded");
    let u = run.numbers.get_mut(&Entry::from(Quantity::U)).expect("it was recorded");
    let Values::Rows(rows) = &mut u.values else { panic!("rows") };
    rows[2].values[1].0 += 1e-3;
    let found =
        |snapshot: &Snapshot| verify(snapshot, None, &|| ()).expect("it runs").runs.remove(0);
    let VerifiedRun { changes, first, .. } = found(&snapshot);
    let first = first.expect("it differs");
    assert_eq!((first.entry, first.node, changes.len()), (Entry::from(Quantity::U), Some(3), 0));
    assert_eq!(first.status, None);
    snapshot.version = "0.0.1".into();
    let changes = found(&snapshot).changes;
    assert_eq!(
        (changes[0].place.as_str(), &changes[0].was[..]),
        ("version of the program", "0.0.1")
    );
}
