//! The first cause of a difference is named: of changes that a test makes, of rounding, of another
//! version, of a defect.

use fastrand::Rng;
use plane_contact::engine::{Detail, Request, Step, solve};
use plane_contact::numbers::solve::{Arithmetic, Solver};
use plane_contact::problem::modelling::Variant;
use plane_contact::problem::scene::{GroupRef, Scene, SceneBuilder, Surface};
use plane_contact::studies::snapshot::{
    Bounds, Class, Explanation, Flip, Snapshot, Values, difference, verify,
};

/// A change of what goes into a run, and the cause that is to be named.
struct Change {
    class: Class,
    place: String,
    scene: Scene,
    request: Request,
}

const KINDS: usize = 7;

/// Draws a change of one kind; None where the changed scene is none.
fn change(kind: usize, scene: &Scene, rng: &mut Rng) -> Option<Change> {
    let (description, mesh) = scene.source().expect("an embedded scene has a source");
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
                (Class::Input, format!("mesh node {} {}", node + 1, ["x", "y"][axis]))
            }
            1 => {
                let materials = &mut builder.description.materials.0;
                let (group, material) = &mut materials[rng.usize(..2)];
                material.e *= 1.0 + 10f64.powf(-1.0 - 6.0 * rng.f64());
                let name = match group {
                    GroupRef::Name(name) => name.clone(),
                    GroupRef::Tag(tag) => tag.to_string(),
                };
                (Class::Input, format!("scene materials.{name}.E"))
            }
            2 => {
                contact.tolerance *= 0.2 + 4.0 * rng.f64();
                (Class::Input, "scene contact.c_tll".into())
            }
            3 => {
                let Surface::Numbers(nodes) = &mut contact.contact else { unreachable!("a list") };
                let before = nodes.clone();
                while *nodes == before {
                    rng.shuffle(nodes);
                }
                (Class::Input, "scene contact.cnt".into())
            }
            4 => {
                let readings = ["R1=inside", "R2=printed", "R3=nested", "R5=node_n", "R8=m"];
                let reading = readings[rng.usize(..readings.len())];
                request.reading = reading.parse().expect("a reading");
                (Class::Reading, format!("reading {}", &reading[..2]))
            }
            5 => {
                let solvers = [Solver::DenseLu, Solver::SparseLu];
                let solver = Some(solvers[rng.usize(..solvers.len())]);
                request.arithmetic = Arithmetic { solver, ..Arithmetic::default() };
                (Class::Solver, "option solver".into())
            }
            _ => {
                let edges = scene.model.target_edges().map(|edge| edge.number);
                let edges: Vec<usize> = edges.collect();
                let number = edges[rng.usize(..edges.len())];
                let elements = &mut builder.mesh.elements;
                let edge = elements.iter_mut().find(|e| e.number == number).expect("an edge");
                edge.nodes.reverse();
                (Class::Input, format!("mesh elem {number}"))
            }
        }
    };
    let mut own = Request::new(scene).variant(variant);
    let (class, place) = changed(&mut own);
    let scene = builder.build().ok()?;
    let mut request = Request::new(&scene).variant(variant).arithmetic(own.arithmetic);
    request.reading = own.reading;
    Some(Change { class, place, scene, request })
}

/// What two recorded runs differ by, in one explanation.
fn explained(old: &Snapshot, new: &Snapshot) -> Option<Explanation> {
    difference(old, new).runs[0].explanation.clone()
}

/// The contact surface in an iteration, by the listing's own arrays.
fn found(step: &Step) -> (Vec<usize>, Vec<usize>) {
    let Detail::Published(step) = &step.detail else { panic!("a variant of the paper") };
    (step.pairs.ct.as_slice().to_vec(), step.pairs.dy.as_slice().to_vec())
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
fn the_first_cause_of_a_hundred_seeded_changes_is_named() {
    let mut rng = Rng::with_seed(2026);
    let scenes = ["fig1", "two-blocks"].map(|name| Scene::open(name).expect("embedded"));
    let lists = scenes.map(|scene| with_lists(&scene));
    let (mut right, mut false_causes, mut flips, mut drawn) = (0, 0, 0, 0);
    while drawn < 100 {
        let scene = &lists[drawn / KINDS % 2];
        let Some(change) = change(drawn % KINDS, scene, &mut rng) else { continue };
        let own = Request::new(scene).variant(change.request.variant);
        let record = |scene: &Scene, request: &Request| {
            Snapshot::record(scene, std::slice::from_ref(request), Bounds::Computed)
        };
        let old = record(scene, &own).expect("it runs");
        // A changed scene whose matrix is singular to rounding is refused, and records nothing.
        let Ok(new) = record(&change.scene, &change.request) else { continue };
        drawn += 1;
        let Some(explanation) = explained(&old, &new) else { panic!("{}: not seen", change.place) };
        let named = &explanation.causes[0];
        right += usize::from((named.class, &named.place) == (change.class, &change.place));
        false_causes += explanation.causes.len() - 1;
        assert!(explanation.cause.starts_with(&change.place), "{}", explanation.cause);
        let again = "from the old input this program gives the old run";
        assert!(explanation.known_by.starts_with(again), "{}", explanation.known_by);
        // The runs themselves go different ways where the explanation says so.
        let run = &new.runs.iter().next().expect("a run").1;
        if run.exit_status() == Some(0) && change.place != "scene contact.cnt" {
            let named = explanation.flip.map(|Flip { iteration, node, .. }| (iteration, node));
            let seen = first_flip(&own, &change.request).map(|(k, node)| (k, Some(node)));
            assert_eq!(named, seen, "{}", change.place);
            flips += usize::from(seen.is_some());
        }
        // Without a change there is no cause.
        let again = record(&change.scene, &change.request).expect("it ran");
        false_causes += usize::from(explained(&new, &again).is_some());
    }
    eprintln!("{right} of {drawn} right, {false_causes} false causes, {flips} divergences");
    assert_eq!((right, false_causes), (100, 0));
    assert!(flips > 10, "{flips}");
}

/// The same scene with its contact surface as a list of nodes.
fn with_lists(scene: &Scene) -> Scene {
    let (description, mesh) = scene.source().expect("an embedded scene has a source");
    let mut description = description.clone();
    let nodes = scene.model.contact.nodes.iter().map(|node| node.number()).collect();
    description.contact.as_mut().expect("contact").contact = Surface::Numbers(nodes);
    SceneBuilder { name: scene.name.clone(), mesh: mesh.clone(), description }
        .build()
        .expect("sound")
}

/// On `strand` at a small tolerance rounding decides who is in contact (C11): two solvers give
/// histories of their own, and what looks like another machine is explained as such.
#[test]
fn what_rounding_decided_is_said_to_be_decided_by_rounding() {
    let scene = Scene::open("strand").expect("embedded");
    let mut request = Request::new(&scene).variant(Variant::Tied);
    request.tolerance = Some(1e-6);
    let solver = Some(Solver::SparseLu);
    let other = request.clone().arithmetic(Arithmetic { solver, ..Arithmetic::default() });
    let mut snapshot = Snapshot::record(&scene, &[other], Bounds::Computed).expect("it runs");
    let (_, run) = snapshot.runs.iter().next().expect("a run");
    let mut run = run.clone();
    run.options.solver = None;
    snapshot.runs = [(run.options.name(), run)].into_iter().collect();
    let verified = verify(&snapshot, None, &|| ()).expect("it runs");
    let explanation = verified.runs[0].explanation.as_ref().expect("it differs");
    assert_eq!(explanation.class, Class::Rounding, "{explanation:?}");
    assert!(explanation.cause.contains("c_cnt"), "{}", explanation.cause);
}

#[test]
fn another_version_and_a_defect_are_told_apart_and_exact_numbers_arbitrate() {
    let scene = Scene::open("two-blocks").expect("embedded");
    let request = Request::new(&scene).variant(Variant::Tied);
    let mut snapshot = Snapshot::record(&scene, &[request], Bounds::Computed).expect("it runs");
    let run = snapshot.runs.get_mut("tied").expect("it was recorded");
    let stress = run.numbers.get_mut("stress").expect("it was recorded");
    let Values::Rows(rows) = &mut stress.values else { panic!("rows") };
    rows[2].values[1].0 *= 1.0 + 1e-6;
    let explained = |snapshot: &Snapshot| {
        verify(snapshot, None, &|| ()).expect("it runs").runs[0]
            .explanation
            .clone()
            .expect("it differs")
    };
    let defect = explained(&snapshot);
    assert_eq!((defect.class, defect.first.as_deref()), (Class::Defect, Some("stress")));
    assert!(defect.known_by.contains("in exact numbers, stress: the new one is right"));
    snapshot.version = "0.0.1".into();
    let version = explained(&snapshot);
    assert_eq!(version.class, Class::Version);
    assert!(version.cause.ends_with("was 0.0.1"), "{}", version.cause);
}
