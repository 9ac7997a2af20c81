//! The reference solution: what it promises, on every scene, coupling, friction and geometry.

use std::sync::Arc;

use crate::common::tolerances::{BALANCE, Tolerance, assert_near};
use plane_contact::engine::contact::{ContactNode, Status};
use plane_contact::engine::error::Error;
use plane_contact::engine::{self, Detail, Request, Solution, Step, distance};
use plane_contact::problem::element::Plane;
use plane_contact::problem::model::NodeId;
use plane_contact::problem::modelling::{ContactModel, Coupling, Friction, Geometry, Variant};
use plane_contact::problem::scene::{
    Axis, Contact, MeshBuilder, SCENES, Scene, SceneBuilder, file, gmsh,
};
use plane_contact::studies::benchmark::{Blocks, Hertz, Punch};

/// A displacement in a scene a million of its sizes from the origin, relative to itself.
const FAR_FROM_THE_ORIGIN: Tolerance = Tolerance {
    limit: 1e-6,
    reason: "a coordinate of 3e6 resolves 5e-10; strains, and gaps over displacements of 1e-3, a \
         thousand times less",
};

/// The sum of normal forces beside the load along y, where the surface slopes a little:
/// relative to the load.
const FORCE_OF_A_SLOPE: Tolerance =
    Tolerance { limit: 1e-4, reason: "the slope of a surface strained by 1e-3, squared, is 1e-6" };

/// Contact in the current shape beside contact in the initial one at a load of a thousandth of
/// CGS-1's, relative to the peak.
const CURRENT_LENGTHS: Tolerance =
    Tolerance { limit: 2e-3, reason: "strains of 1e-3 at the contact: the two differ by as much" };

/// Gap times force of a contact node relative to size times the largest force; penetration
/// relative to the size.
const COMPLEMENTARITY: Tolerance = Tolerance { limit: 1e-12, reason: "the issue's own number" };

/// Both directions.
const BOTH: &[Axis] = &[Axis::X, Axis::Y];

/// The most iterations that an equilibrium under one load may take.
const ITERATIONS: usize = 20;

/// Every way to model contact under `unilateral`.
pub fn models() -> Vec<ContactModel> {
    let mut models = Vec::new();
    for &coupling in Coupling::ALL {
        for &geometry in Geometry::ALL {
            for mu in [0.0, 0.1, 0.3, f64::INFINITY] {
                let friction = Friction::new(mu).unwrap();
                models.push(ContactModel {
                    coupling,
                    friction,
                    geometry,
                    ..ContactModel::default()
                });
            }
        }
    }
    models
}

fn solve(scene: &Scene, model: ContactModel) -> Solution {
    let request = Request::new(scene).variant(Variant::Unilateral).contact(model);
    engine::solve(&request, &mut |_| ()).expect("there is an equilibrium")
}

fn force(node: &ContactNode) -> f64 {
    node.force.expect("no restraint leaves it open")
}

/// The force along the tangent.
fn shear(node: &ContactNode) -> f64 {
    node.friction_needed.map_or(0.0, |needed| needed * force(node))
}

/// The most iterations under one load.
fn iterations(solution: &Solution) -> usize {
    let load = |step: &Step| match &step.detail {
        Detail::Unilateral(own) => own.load.to_bits(),
        Detail::Published(_) => unreachable!("unilateral was asked for"),
    };
    let loads: Vec<u64> = solution.steps.iter().map(load).collect();
    loads.chunk_by(|a, b| a == b).map(<[u64]>::len).max().unwrap_or(0)
}

/// Larger extent of the scene.
fn size(solution: &Solution) -> f64 {
    let extent = |axis: usize| {
        let values = solution.model.nodes.iter().map(|place| place[axis]);
        let (l, h) = values.fold((f64::MAX, f64::MIN), |(l, h), x| (l.min(x), h.max(x)));
        h - l
    };
    extent(0).max(extent(1))
}

/// Twice as thick bodies under twice the forces move as before, by the same pressures and shears.
#[test]
fn tractions_are_forces_over_length_and_thickness() {
    let scene = Scene::open("two-blocks").unwrap();
    let mut thick = scene.clone();
    let model = Arc::make_mut(&mut thick.model);
    model.thickness *= 2.0;
    model.load *= 2.0;
    model.stages.iter_mut().for_each(|stage| *stage *= 2.0);
    let rubs = ContactModel { friction: Friction::new(0.3).unwrap(), ..ContactModel::default() };
    let (one, other) = (solve(&scene, rubs).contact, solve(&thick, rubs).contact);
    let tractions = |node: &ContactNode| [node.pressure, node.shear].map(Option::unwrap);
    let scale = one.iter().map(|node| tractions(node)[0]).fold(0.0, f64::max);
    assert!(scale > 0.0);
    for (one, other) in one.iter().zip(&other) {
        for d in [0, 1] {
            assert_near("traction", tractions(other)[d], tractions(one)[d], scale, &BALANCE);
        }
    }
}

/// Force balance, complementarity, no node that pulls, none that penetrates, few iterations.
fn assert_equilibrium(name: &str, scene: &Scene, model: ContactModel) {
    let solution = solve(scene, model);
    let what = |of: &str| format!("{name}, {model:?}: {of}");
    let [fx, fy] = scene.model.total_load();
    let load = fx.hypot(fy);
    assert_near(&what("force on the target"), solution.target_force(), load, load, &BALANCE);
    assert!(iterations(&solution) <= ITERATIONS, "{}", what(&iterations(&solution).to_string()));
    let size = size(&solution);
    let most = solution.contact.iter().map(force).fold(0.0, f64::max);
    assert!(most > 0.0, "{}", what("nothing presses"));
    for node in &solution.contact {
        let at = |of: &str| what(&format!("node {}: {of}", node.node));
        assert_near(&at("gap x force"), node.gap * force(node), 0.0, size * most, &COMPLEMENTARITY);
        assert_near(&at("penetration"), node.gap.min(0.0), 0.0, size, &COMPLEMENTARITY);
        assert_near(&at("pull"), force(node).min(0.0), 0.0, most, &BALANCE);
        assert_near(
            &at("force apart"),
            if node.in_contact { 0.0 } else { force(node) },
            0.0,
            most,
            &BALANCE,
        );
        if !node.in_contact {
            continue;
        }
        let (most_shear, shear) = (model.friction.coefficient() * force(node), shear(node));
        match node.status {
            Some(Status::Slip(_)) if most_shear > 0.0 => {
                assert_near(&at("friction"), shear.abs(), most_shear, most, &BALANCE);
            }
            _ => assert!(shear.abs() <= most_shear + 1e-10 * most, "{}", at("beyond friction")),
        }
    }
}

#[test]
fn every_model_ends_in_equilibrium_on_the_strand() {
    let scene = Scene::open("strand").unwrap();
    models().into_iter().for_each(|model| assert_equilibrium("strand", &scene, model));
}

#[test]
fn every_model_ends_in_equilibrium_on_the_benchmarks() {
    let hertz = |size| Hertz { size, ..Hertz::default() }.generate().unwrap();
    let benchmarks = [
        Blocks::default().generate().unwrap(),
        Punch::default().generate().unwrap(),
        hertz(8),
        hertz(20),
        hertz(40),
    ];
    for benchmark in benchmarks {
        let scene = benchmark.build().unwrap();
        for model in models().into_iter().filter(|model| model.friction == Friction::NONE) {
            // Force that a punch's own pressure puts beside the contact does not pass through it.
            if benchmark.name != "punch" {
                assert_equilibrium(&benchmark.name, &scene, model);
            } else {
                assert!(iterations(&solve(&scene, model)) <= ITERATIONS);
            }
        }
    }
}

/// Under small displacements the two geometries are one.
#[test]
fn current_and_initial_shape_agree_as_displacements_vanish() {
    let scene =
        Hertz { size: 20, load: 35.0, ..Hertz::default() }.generate().unwrap().build().unwrap();
    let of = |geometry| solve(&scene, ContactModel { geometry, ..scene.contact });
    let (current, initial) = (of(Geometry::Current), of(Geometry::Initial));
    let peak = |solution: &Solution| solution.contact[0].pressure.unwrap();
    assert_near("peak", peak(&current), peak(&initial), peak(&initial), &CURRENT_LENGTHS);
}

#[test]
fn the_reference_is_at_no_distance_from_itself() {
    for embedded in SCENES {
        let scene = Scene::open(embedded.name).unwrap();
        let reached = engine::solve(&Request::new(&scene).equilibrium(), &mut |_| ()).unwrap();
        let same = distance(&reached, &reached);
        assert_eq!((same.displacement, same.energy_relative), (0.0, 0.0));
    }
}

/// Two unit squares, the upper one on the lower one; `load` on the top edge, `held` of the upper
/// square's left side.
///
/// ```text
///  8---7
///  |   |
///  5---6    contact surface
///  4---3    target
///  |   |
///  1---2
/// ```
pub fn stacked(load: [f64; 2], held: &[Axis], friction: Friction) -> SceneBuilder {
    let mut mesh = MeshBuilder::default();
    mesh.row([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]);
    mesh.row([[0.0, 1.0], [1.0, 1.0], [1.0, 2.0], [0.0, 2.0]]);
    mesh.edges("target", &[4, 3]);
    mesh.edges("contact", &[5, 6]);
    mesh.edges("top", &[8, 7]);
    mesh.triangles("lower", [[1, 2, 3], [1, 3, 4]]);
    mesh.triangles("upper", [[5, 6, 7], [5, 7, 8]]);
    let scene = SceneBuilder::new("stacked", mesh.finish(), Plane::Stress)
        .variant(Variant::Stepped)
        .material("lower", 1000.0, 0.0)
        .material("upper", 1000.0, 0.0)
        .restrain_node(1, BOTH)
        .restrain_node(2, BOTH)
        .traction("top", load)
        .contact(Contact { friction: Some(friction), ..Contact::new("contact", "target", 0.001) });
    if held.is_empty() { scene } else { scene.restrain_node(5, held).restrain_node(8, held) }
}

pub fn solved(scene: &SceneBuilder) -> Result<Solution, Error> {
    let scene = scene.build().expect("the scene is sound");
    engine::solve(&Request::new(&scene).variant(Variant::Unilateral), &mut |_| ())
}

/// Displacement along y of node 8, a corner of the stack's top edge.
fn top(solution: &Solution) -> f64 {
    NodeId::from_number(8).components(&solution.u)[1]
}

#[test]
fn a_stack_is_shortened_by_its_load() {
    let solution = solved(&stacked([0.0, -1.0], &[Axis::X], Friction::NONE)).unwrap();
    assert_near("top", top(&solution), -2e-3, 2e-3, &BALANCE);
}

#[test]
fn a_body_that_may_slide_is_the_inputs_fault() {
    let error = solved(&stacked([0.0, -1.0], &[], Friction::NONE)).unwrap_err();
    assert_eq!(error.exit_status().number(), 2);
    assert!(error.to_string().contains("can move in x"), "{error}");
    assert!(
        solved(&stacked([0.0, -1.0], &[], Friction::STICK)).is_ok(),
        "where it sticks it is held"
    );
}

#[test]
fn a_body_that_is_pulled_away_has_no_equilibrium() {
    let error = solved(&stacked([0.0, 1.0], &[Axis::X], Friction::NONE)).unwrap_err();
    assert_eq!(error.exit_status().number(), 4);
    let text = error.to_string();
    assert!(text.starts_with("no equilibrium was found: the load moves node"), "{text}");
    assert!(text.contains("in y"), "{text}");
}

/// Node 5 carries half of the load; its restraint takes it, as far as the target leaves it.
#[test]
fn the_force_on_a_contact_node_restrained_along_the_normal_comes_from_its_target() {
    let scene = with(stacked([0.0, -1.0], BOTH, Friction::NONE), flat);
    let solution = solved(&scene).unwrap();
    let passed = solution.target_force();
    let forces: f64 = solution.contact.iter().map(force).sum();
    assert_near("force on the target", forces, passed, 1.0, &BALANCE);
    assert!(solution.contact.iter().all(|node| force(node) >= 0.0));
}

/// Where both surfaces are restrained along the normal nothing says what passes between them.
#[test]
fn a_force_between_two_restraints_is_not_determined() {
    let scene = stacked([0.0, -1.0], BOTH, Friction::NONE).restrain_node(4, BOTH);
    let solution = solved(&scene).unwrap();
    let of = |number: usize| {
        let mut nodes = solution.contact.iter();
        nodes.find(|node| node.node.number() == number).unwrap()
    };
    assert_eq!((of(5).force, of(5).pressure), (None, None));
    assert!(of(6).force.is_some());
}

#[test]
fn friction_is_a_coefficient_or_stick() {
    let scene = stacked([0.0, -1.0], &[Axis::X], Friction::NONE);
    let read = |friction: &str| {
        let text = file::write(&scene.description, "m.msh");
        let text = text.replace("\"friction\":0", &format!("\"friction\":{friction}"));
        let beside = |_: &str| Ok(gmsh::write(&scene.mesh).into_bytes());
        SceneBuilder::read("stacked", text.as_bytes(), beside)
    };
    for wrong in ["-0.1", "\"slippery\"", "\"NaN\""] {
        let error = read(wrong).unwrap_err().to_string();
        assert!(error.contains("neither a number of 0 or more nor"), "{wrong}: {error}");
    }
    let open = read("null").unwrap_err().to_string();
    assert!(open.contains("leaves values to be chosen"), "{open}");
    assert!(read("0.3").is_ok() && read("\"stick\"").is_ok());
}

/// Moduli so far apart that the soft block holds the stiff one by less than rounding: the error
/// says so, and does not ask for a restraint.
#[test]
fn moduli_that_are_too_far_apart_are_no_missing_restraint() {
    let mut scene = stacked([0.0, -1.0], &[Axis::X], Friction::NONE);
    scene.description.materials.0[1].1.e = 1e20;
    let error = solved(&scene).unwrap_err();
    assert_eq!(error.exit_status().number(), 2);
    let text = error.to_string();
    assert!(text.contains("the moduli are 1e17 apart"), "{text}");
    assert!(text.contains("choose moduli that are closer"), "{text}");
}

/// Where a block is so thin that its stiffness is far from the other's, moduli are to blame beyond a
/// million apart, and the mesh up to that.
#[test]
fn moduli_are_too_far_apart_beyond_a_million() {
    for (e, fix) in [(1e9, "choose other units"), (1.001e9, "choose moduli that are closer")] {
        let mut scene = stacked([0.0, -1.0], &[Axis::X], Friction::NONE);
        scene.description.materials.0[1].1.e = e;
        for node in &mut scene.mesh.nodes {
            let y = node.xyz[1] - 1.0;
            node.xyz[1] = if y > 0.0 { 1e-11 } else { y };
        }
        let text = solved(&scene).expect_err("it is singular").to_string();
        assert!(text.contains("the moduli are 1e6 apart") && text.contains(fix), "{text}");
    }
}

/// A target node between two contact nodes stands 0.03 above the others: node to segment lets it
/// into the contact body and says so, mortar sees it.
#[test]
fn a_target_node_that_node_to_segment_does_not_see_is_reported() {
    let mut mesh = MeshBuilder::default();
    let bottom = mesh.row([[0.0, 0.0], [1.0, 0.0], [2.0, 0.0]]);
    let target = mesh.row([[0.0, 1.0], [1.0, 1.03], [2.0, 1.0]]);
    let contact = mesh.row([[0.0, 1.0], [2.0, 1.0]]);
    let top = mesh.row([[0.0, 2.0], [2.0, 2.0]]);
    mesh.join("lower", &bottom, &target);
    mesh.join("upper", &contact, &top);
    let names = [("bottom", &bottom), ("target", &target), ("contact", &contact), ("top", &top)];
    names.iter().for_each(|(name, row)| mesh.edges(*name, row));
    let scene = SceneBuilder::new("apex", mesh.finish(), Plane::Stress)
        .variant(Variant::Stepped)
        .material("lower", 1e3, 0.0)
        .material("upper", 1e3, 0.0)
        .restrain("bottom", BOTH)
        .restrain("top", &[Axis::X])
        .pressure("top", 1.0)
        .contact(Contact {
            friction: Some(Friction::NONE),
            ..Contact::new("contact", "target", 0.001)
        });
    let unseen = |coupling| {
        let scene = with(scene.clone(), |contact| contact.coupling = Some(coupling));
        solved(&scene).unwrap().equilibrium.unwrap().unseen
    };
    let (node, depth) = unseen(Coupling::Nts).expect("the apex is inside");
    assert_eq!(node.number(), target[1]);
    assert!(depth > 0.02, "{depth}");
    assert_eq!(unseen(Coupling::Mortar), None);
}

/// Small displacements.
pub fn flat(contact: &mut Contact) {
    contact.geometry = Geometry::Initial;
}

/// `scene` with its contact changed.
pub fn with(mut scene: SceneBuilder, change: impl FnOnce(&mut Contact)) -> SceneBuilder {
    change(scene.description.contact.as_mut().expect("the scene has contact"));
    scene
}

/// `scene` with its contact modelled so.
fn modelled(scene: SceneBuilder, (coupling, geometry): (Coupling, Geometry)) -> SceneBuilder {
    with(scene, |contact| (contact.coupling, contact.geometry) = (Some(coupling), geometry))
}

fn every_coupling_and_geometry() -> impl Iterator<Item = (Coupling, Geometry)> {
    let of = |geometry: &'static Geometry| Coupling::ALL.iter().map(|c| (*c, *geometry));
    Geometry::ALL.iter().flat_map(of)
}

/// The stack with a Poisson's ratio: its surfaces slide on each other, past the target's end.
fn bulging() -> SceneBuilder {
    let mut scene = stacked([0.0, -1.0], &[Axis::X], Friction::NONE);
    scene.description.materials.0.iter_mut().for_each(|(_, material)| material.nu = 0.3);
    scene
}

#[test]
fn a_node_that_slides_a_little_past_the_end_of_the_target_rests_on_it() {
    for model in every_coupling_and_geometry() {
        let solution = solved(&modelled(bulging(), model)).unwrap();
        assert_eq!(solution.in_contact().count(), 2, "{model:?}");
        let force: f64 = solution.contact.iter().map(force).sum();
        assert_near("force", force, 1.0, 1.0, &FORCE_OF_A_SLOPE);
    }
}

#[test]
fn a_scene_far_from_the_origin_has_the_same_answer() {
    for model in every_coupling_and_geometry() {
        let scene = modelled(bulging(), model);
        let mut far = scene.clone();
        for node in &mut far.mesh.nodes {
            node.xyz[0] += 1e6;
            node.xyz[1] -= 3e6;
        }
        let (near, far) = (solved(&scene).unwrap(), solved(&far).unwrap());
        let (near, far) = (top(&near), top(&far));
        assert_near("top", far, near, near.abs(), &FAR_FROM_THE_ORIGIN);
    }
}

#[test]
fn bodies_that_touch_without_a_load_rest() {
    for model in every_coupling_and_geometry() {
        let scene = modelled(stacked([0.0, 0.0], &[Axis::X], Friction::NONE), model);
        let solution = solved(&scene).unwrap();
        assert_eq!(solution.u.amax(), 0.0);
    }
}

/// All of the upper square's outline listed: only its lower side faces the target, and its corners
/// stand for half of each side.
#[test]
fn a_closed_contact_surface_has_an_edge_from_its_last_node_to_its_first() {
    for model in every_coupling_and_geometry() {
        let closed = with(modelled(bulging(), model), |c| c.contact = vec![5, 6, 7, 8].into());
        let open = solved(&modelled(bulging(), model)).unwrap();
        let closed = solved(&closed).unwrap();
        let numbers: Vec<usize> = closed.contact.iter().map(|c| c.node.number()).collect();
        assert_eq!(numbers, [5, 6]);
        for (one, other) in closed.contact.iter().zip(&open.contact) {
            assert_near("force", force(one), force(other), 1.0, &BALANCE);
        }
        if model.0 == Coupling::Nts {
            let of =
                |o: &Solution| o.contact.iter().map(|c| c.pressure.unwrap()).collect::<Vec<_>>();
            for (one, other) in of(&closed).into_iter().zip(of(&open)) {
                assert_near("pressure over both sides", one, other / 2.0, 1.0, &CURRENT_LENGTHS);
            }
        }
    }
}

#[test]
fn a_node_named_twice_counts_once() {
    for model in every_coupling_and_geometry() {
        let twice = with(modelled(bulging(), model), |c| c.contact = vec![5, 6, 5, 6].into());
        let of = |scene| solved(&scene).unwrap().contact;
        assert_eq!(of(twice), of(modelled(bulging(), model)));
    }
}

#[test]
fn a_surface_that_does_not_face_the_target_is_the_inputs_fault() {
    for model in every_coupling_and_geometry() {
        let scene = with(modelled(bulging(), model), |c| c.contact = vec![8, 7].into());
        let error = solved(&scene).unwrap_err();
        assert_eq!(error.exit_status().number(), 2);
        assert!(error.to_string().contains("no contact node faces the target"), "{error}");
    }
}

/// A wedge over a roof of two faces, 0.4 above its ridge: the normal is the mean of the faces', and
/// the gap is measured along it.
#[test]
fn a_gap_over_a_ridge_closes() {
    let mut mesh = MeshBuilder::default();
    mesh.row([[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 1.1], [0.0, 1.0]]);
    mesh.row([[1.0, 1.5], [1.5, 2.0], [0.5, 2.0]]);
    mesh.edges("roof", &[3, 4, 5]);
    mesh.triangles("lower", [[1, 2, 4], [2, 3, 4], [1, 4, 5]]);
    mesh.triangles("upper", [[6, 7, 8]]);
    let contact = Contact::new(vec![6], "roof", 0.001);
    let scene = SceneBuilder::new("ridge", mesh.finish(), Plane::Stress)
        .variant(Variant::Stepped)
        .material("lower", 1000.0, 0.0)
        .material("upper", 1000.0, 0.0)
        .restrain_node(1, BOTH)
        .restrain_node(2, BOTH)
        .restrain_node(6, &[Axis::X])
        .restrain_node(7, &[Axis::X])
        .force(7, [0.0, -0.5])
        .force(8, [0.0, -0.5])
        .contact(Contact { friction: Some(Friction::NONE), ..contact });
    for geometry in Geometry::ALL {
        let solution = solved(&modelled(scene.clone(), (Coupling::Nts, *geometry))).unwrap();
        let node = &solution.contact[0];
        assert_near("gap", node.gap, 0.0, 1.0, &COMPLEMENTARITY);
        assert_near("force", force(node), 1.0, 1.0, &FORCE_OF_A_SLOPE);
    }
}

/// A square on a longer target whose surface falls away from the middle, loaded right of where it
/// first touches.
fn tipping(load: f64) -> SceneBuilder {
    let surface = |x: f64| 1.0 - 0.05 * (x - 0.4) * (x - 0.4);
    let mut mesh = MeshBuilder::default();
    for k in 0..=10 {
        let x = 0.2 * f64::from(k) - 0.6;
        mesh.row([[x, 0.0], [x, surface(x)]]);
    }
    for k in 0..10 {
        let [a, b, c, d] = [2 * k + 1, 2 * k + 3, 2 * k + 4, 2 * k + 2];
        mesh.edges("target", &[c, d]);
        mesh.triangles("lower", [[a, b, c], [a, c, d]]);
    }
    for k in 0..=4 {
        let x = 0.25 * f64::from(k);
        mesh.row([[x, 1.01], [x, 2.01]]);
    }
    for k in 0..4 {
        let [a, b, c, d] = [23 + 2 * k, 25 + 2 * k, 26 + 2 * k, 24 + 2 * k];
        mesh.triangles("upper", [[a, b, c], [a, c, d]]);
    }
    let contact = Contact::new(vec![23, 25, 27, 29, 31], "target", 0.001);
    let scene = SceneBuilder::new("tipping", mesh.finish(), Plane::Strain)
        .variant(Variant::Stepped)
        .material("lower", 1e5, 0.3)
        .material("upper", 1e5, 0.3)
        .restrain_node(24, &[Axis::X])
        .force(28, [0.0, -load])
        .force(32, [0.0, -load])
        .contact(Contact { friction: Some(Friction::NONE), ..contact });
    (0..=10).fold(scene, |scene, k| scene.restrain_node(2 * k + 1, BOTH))
}

/// It tips over that node until another one touches. The nodes left of it, with gaps as small,
/// would pull.
#[test]
fn a_body_that_tips_comes_to_rest_on_the_side_that_it_tips_to() {
    let scene = tipping(0.5);
    for coupling in Coupling::ALL {
        let solution = solved(&modelled(scene.clone(), (*coupling, Geometry::Initial))).unwrap();
        assert!(solution.in_contact().all(|c| c.gap >= -1e-11 && force(c) >= 0.0));
        let right = solution.in_contact().filter(|c| c.arc > 0.5).count();
        assert!(right > 0, "it rests on its right side too");
    }
}

/// The node that closes next is the one that the load brings to the target first, however small the
/// load, also where rounding decides where the body comes to rest: not the nearest.
#[test]
fn a_body_that_is_not_held_closes_the_node_that_it_tips_to() {
    for (load, is_rounding) in [(0.5, false), (2e-8, false), (2e-16, true)] {
        let scene = modelled(tipping(load), (Coupling::Nts, Geometry::Initial)).build().unwrap();
        let mut first = None;
        let found =
            engine::solve(&Request::new(&scene).variant(Variant::Unilateral), &mut |step| {
                let Detail::Unilateral(own) = &step.detail else {
                    unreachable!("it was asked for")
                };
                first.get_or_insert_with(|| own.statuses.clone());
            });
        assert!(is_rounding || found.is_ok(), "it comes to rest");
        let first = first.expect("there is an iteration");
        let found = (0..5).filter(|i| first[*i].is_closed());
        assert_eq!(found.collect::<Vec<_>>(), [2, 4], "{load}");
    }
}

/// The stack pushed to +x by a fifth of what presses it: the target pushes back, to the left, which
/// is the tangent's direction.
#[test]
fn shear_and_the_friction_needed_balance_a_push_along_the_surface() {
    let solution = solved(&with(stacked([0.2, -1.0], &[], Friction::STICK), flat)).unwrap();
    let shear: f64 = solution.contact.iter().map(|c| 0.5 * c.shear.unwrap()).sum();
    assert_near("shear force", shear, 0.2, 1.0, &BALANCE);
    for node in &solution.contact {
        let needed = node.friction_needed.expect("every node presses");
        assert_near(
            "friction",
            needed * node.pressure.unwrap(),
            node.shear.unwrap().abs(),
            1.0,
            &BALANCE,
        );
    }
}
