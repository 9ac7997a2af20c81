//! The corrected algorithm of `listings/corrected/`: along the normal beside the reference without
//! friction, which has one solution; with both components beside the conditions, written out here.

use std::sync::Arc;

use crate::common::annulus::annulus;
use crate::common::tolerances::{CORRECTED, assert_near};
use nalgebra::DVector;
use plane_contact::engine::contact::Surfaces;
use plane_contact::engine::{Request, Stiffness, solve};
use plane_contact::paper::corrected::{Bound, FAULTS, Fault, Worksheet};
use plane_contact::paper::door::Call;
use plane_contact::paper::mirror::Reading;
use plane_contact::problem::model::{Dof, Model, NodeId};
use plane_contact::problem::modelling::{Coupling, Friction, Geometry, Variant};
use plane_contact::problem::scene::Scene;
use plane_contact::studies::audit::Case;
use plane_contact::studies::audit::findings::{Finding, FindingId};
use plane_contact::studies::audit::prices::{self, Price, Weight};
use plane_contact::studies::benchmark::Hertz;
use testing::bodies::Writing;
use testing::drawn::{Drawn, Kind, Support, scenes};

testing::tolerances! {
    /// What is left of the conditions of contact under the corrected algorithm, relative to the largest displacement,
    /// respectively load.
    CORRECTED_CONDITIONS = 1e-9,
        "a factorisation of up to 2,300 equations in f64, whose residual is 1e-12 of the loads";
}

/// The iterations of the paper.
const STEPS: usize = 20;

/// The number of random scenes.
const SCENES: usize = 500;

/// Returns the request of the reference: no friction, node to segment, the initial geometry.
fn reference(scene: &Scene) -> Request {
    let mut request = Request::new(scene).variant(Variant::Unilateral);
    request.contact.friction = Friction::NONE;
    request.contact.coupling = Coupling::Nts;
    request.contact.geometry = Geometry::Initial;
    request
}

/// Random scenes on smooth targets, whose bodies are held against turning.
fn smooth() -> impl Iterator<Item = (String, Scene)> {
    let is_smooth = |drawn: &Drawn| match drawn.kind {
        Kind::Flat | Kind::Bent | Kind::Wavy => drawn.support != Support::Hinged,
        Kind::Groove | Kind::Roof | Kind::Narrow | Kind::Plate | Kind::Held => false,
    };
    let drawn = scenes(45, 5 * SCENES).enumerate().filter(move |(_, drawn)| is_smooth(drawn));
    drawn.take(SCENES).map(|(number, drawn)| {
        let scene = drawn.bodies.scene(&Writing::default(), Coupling::Nts, Geometry::Initial);
        (format!("scene {number}, {:?}, {:?}", drawn.kind, drawn.support), scene.build().unwrap())
    })
}

/// The prices on a case, and its repairs.
fn prices_of(case: &Case) -> (Vec<Price>, Vec<Price>) {
    let prices = prices::on(case, &|| ()).expect("a solution");
    let repairs = prices::repairs(case, &prices, &|| ()).expect("a solution");
    (prices, repairs)
}

fn assert_is_reference(what: &str, scene: &Scene) {
    let request = reference(scene);
    let ending =
        Worksheet::new(&request.model().unwrap(), Bound::Normal).iterate(&[], STEPS).expect(what);
    assert!(ending.is_settled, "{what}");
    let theirs = solve(&request, &mut |_| ()).expect(what);
    let difference = (DVector::from_vec(ending.u) - &theirs.u).amax();
    assert_near(what, difference, 0.0, theirs.u.amax(), &CORRECTED);
    assert_eq!(ending.in_contact.len(), theirs.last().in_contact, "{what}");
}

#[test]
fn along_the_normal_it_is_the_reference_without_friction() {
    for name in ["strand", "fig1", "two-blocks"] {
        assert_is_reference(name, &Scene::open(name).unwrap());
    }
    let random = smooth().map(|(what, scene)| assert_is_reference(&what, &scene));
    assert_eq!(random.count(), SCENES);
}

#[test]
fn it_is_the_reference_on_hertz_with_a_thousand_equations() {
    let hertz = Hertz { size: 9, ..Hertz::default() }.generate().unwrap().build().unwrap();
    assert!((900..1100).contains(&(2 * hertz.model.nodes.len())));
    assert_is_reference("hertz", &hertz);
}

/// Checks an ending with both components bound: equilibrium of every free equation under the load
/// and the forces of contact, closed gaps, pressure, and no penetration. With the contact set these
/// determine the displacements.
fn assert_conditions(what: &str, model: &Model) {
    let ending = Worksheet::new(model, Bound::Both).iterate(&[], STEPS).expect(what);
    assert!(ending.is_settled, "{what}");
    let u = DVector::from_vec(ending.u);
    let of = |node: NodeId| [u[2 * node.index()], u[2 * node.index() + 1]];
    let mut free = model.clone();
    free.holds.release(model.all_dofs());
    let stiffness = Call::without_contact(&free).km(&Reading::default()).unwrap().dense();
    let mut force = &stiffness * &u - &model.load;
    let size = model.load.amax();
    let surfaces = Surfaces::new(model).unwrap();
    for pairing in surfaces.pairings(Coupling::Nts, &model.nodes).into_iter().flatten() {
        let closed = ending.in_contact.iter().find(|(node, _)| *node == pairing.node);
        let [nx, ny] = pairing.normal;
        let [x, y] = pairing.motion(of);
        let gap = pairing.opening(|node| model.nodes[node.index()]);
        let Some((_, pressing)) = closed else {
            assert!(nx * x + ny * y + gap >= 0.0, "{what}: {:?} penetrates", pairing.node);
            continue;
        };
        assert!(*pressing > 0.0, "{what}: {:?} pulls", pairing.node);
        assert_near(what, x + gap * nx, 0.0, u.amax(), &CORRECTED_CONDITIONS);
        assert_near(what, y + gap * ny, 0.0, u.amax(), &CORRECTED_CONDITIONS);
        // The force of contact on the node is taken from it and given to its master nodes. Where a
        // restraint holds the node, it is not known from the node's equation: nothing is asked there.
        for k in 0..2 {
            let dof = 2 * pairing.node.index() + k;
            let is_free = !model.is_restrained(Dof::new(dof));
            let contact = if is_free { force[dof] } else { f64::NAN };
            for (master, weight) in pairing.masters.iter().filter(|(_, weight)| *weight != 0.0) {
                force[2 * master.index() + k] += weight * contact;
            }
            force[dof] = 0.0;
        }
    }
    let asked = (0..force.len())
        .filter(|dof| !model.is_restrained(Dof::new(*dof)) && !force[*dof].is_nan());
    let left = asked.map(|dof| force[dof].abs()).fold(0.0, f64::max);
    assert_near(what, left, 0.0, size, &CORRECTED_CONDITIONS);
}

#[test]
fn with_both_components_it_fulfils_its_conditions() {
    for name in ["strand", "fig1", "two-blocks"] {
        assert_conditions(name, &Scene::open(name).unwrap().model);
    }
}

/// With all faults put back the programs are the print. On strand the boxes of the print follow the
/// motion (C6), and theirs do not: there too nothing reaches the target.
#[test]
fn with_all_faults_it_is_the_print() {
    let edits: Vec<&str> = FAULTS.iter().map(|fault| fault.edit).collect();
    for name in ["strand", "fig1", "two-blocks"] {
        let scene = Scene::open(name).unwrap();
        let ending =
            Worksheet::new(&scene.model, Bound::Normal).iterate(&edits, STEPS).expect(name);
        let printed = Request::new(&scene).variant(Variant::Printed);
        let printed = solve(&printed, &mut |_| ()).expect(name);
        assert!(printed.transmits_nothing() && ending.is_settled, "{name}");
        let u = DVector::from_vec(ending.u);
        let target = scene.model.target().expect("a target").nodes.iter();
        assert!(target.flat_map(|node| node.dofs()).all(|dof| u[dof.index()] == 0.0), "{name}");
        if name != "strand" {
            let difference = (u - &printed.u).amax();
            assert_near(name, difference, 0.0, printed.u.amax(), &CORRECTED);
        }
    }
}

/// Read from the end, each repair is the fault that, put back, leaves the least error of those that are
/// left, computed here anew.
#[test]
fn each_fault_put_back_is_the_one_that_costs_least() {
    let scene = Scene::open("fig1").unwrap();
    let exact = solve(&reference(&scene), &mut |_| ()).unwrap();
    let stiffness = Stiffness::new(&exact.model, |x| x);
    let size = exact.model.bounds().larger_side();
    let error = |put_back: &dyn Fn(&Fault) -> bool| {
        let faults = FAULTS.iter().filter(|fault| put_back(fault));
        let edits: Vec<&str> = faults.map(|fault| fault.edit).collect();
        let ending = Worksheet::new(&exact.model, Bound::Normal).iterate(&edits, STEPS).ok();
        let u = ending.map(|ending| DVector::from_vec(ending.u)).filter(|u| u.amax() <= size);
        let error = |u| stiffness.energy_norm(&(u - &exact.u)) / stiffness.energy_norm(&exact.u);
        u.map_or(f64::INFINITY, error)
    };
    let (_, repairs) = prices_of(&Case::new(scene.clone()));
    let mut put_back: Vec<String> = vec![];
    for pair in repairs.windows(2).rev() {
        let [before, repaired] = pair else { unreachable!("pairs") };
        let is_back = |fault: &Fault| put_back.contains(&fault.words());
        let with = |other: &Fault| error(&|fault| is_back(fault) || fault.words() == other.words());
        let left = FAULTS.iter().filter(|fault| !is_back(fault));
        let least = left.map(with).fold(f64::INFINITY, f64::min);
        put_back.push(repaired.fault.clone());
        let own = error(&|fault| put_back.contains(&fault.words()));
        assert!(own <= least + CORRECTED.limit, "{}: {own}, {least}", repaired.fault);
        assert!(own == before.error() || own < CORRECTED.limit, "{}", repaired.fault);
    }
    assert_eq!(put_back.len(), FAULTS.len());
    assert_eq!(repairs.len(), 1 + FAULTS.len());
}

/// With the weights of K2 the contact pairs that the seventh iteration on strand asks for are those of
/// the sixth: the two alternate for ever, and the run ends there.
#[test]
fn pairs_that_come_back_end_the_iterations() {
    let k2 = FAULTS.iter().find(|fault| fault.finding == FindingId::K2).expect("a fault").edit;
    let model = &Scene::open("strand").unwrap().model;
    let ending = Worksheet::new(model, Bound::Normal).iterate(&[k2], STEPS).expect("a result");
    assert_eq!((ending.iterations, ending.period, ending.is_settled), (7, Some(2), false));
    let one_less = Worksheet::new(model, Bound::Normal).iterate(&[k2], 6).expect("a result");
    assert_eq!((one_less.iterations, one_less.period), (6, None));
    assert_ne!(one_less.u, ending.u);
}

/// A stamp that may turn is refused, or its iterations do not settle: it is never answered wrongly.
#[test]
fn a_hinge_is_not_answered_silently() {
    let hinged = scenes(10, 1000).filter(|drawn| drawn.support == Support::Hinged);
    let mut unanswered = 0;
    for drawn in hinged {
        let builder = drawn.bodies.scene(&Writing::default(), Coupling::Nts, Geometry::Initial);
        let scene = builder.build().unwrap();
        let ending = Worksheet::new(&scene.model, Bound::Normal).iterate(&[], STEPS);
        let size = scene.model.bounds().larger_side();
        match ending {
            Ok(ending) if ending.is_settled => {
                assert!(ending.u.iter().all(|x| x.abs() < size), "{:?}", drawn.kind);
            }
            Ok(_) | Err(_) => unanswered += 1,
        }
    }
    assert!(unanswered > 0);
}

/// On a target with a corner the reference has rules of its own: the report of prices says so. A scene
/// without contact is refused.
#[test]
fn where_it_does_not_hold_the_prices_say_so() {
    let roof = scenes(10, 340).nth(339).expect("a scene");
    assert_eq!(roof.kind, Kind::Roof);
    let roof = roof.bodies.scene(&Writing::default(), Coupling::Nts, Geometry::Initial);
    let roof = roof.build().unwrap();
    let (prices, repairs) = prices_of(&Case::new(roof.clone()));
    let document = prices::price_tables::PricesOnScene {
        reading: Reading::default(),
        prices: &prices,
        repairs: &repairs,
    };
    let report = prices::price_tables::report(&document, &roof).text(usize::MAX);
    assert!(report.contains("The corrected algorithm itself is 265 %"), "{report}");
    let plate = annulus(2, 4).build().unwrap();
    let refused = prices::on(&Case::new(plate), &|| ()).expect_err("no contact").to_string();
    assert!(refused.contains("the scene has no contact surfaces"), "{refused}");
}

/// Where no load passes, none can be lost: no fault is called fatal, and no repair leads to the
/// solution.
#[test]
fn without_a_load_no_fault_is_weighed() {
    let scene = Finding::of(FindingId::C10).scene();
    assert!(scene.model.load.iter().all(|f| *f == 0.0));
    let (prices, repairs) = prices_of(&Case::new(scene));
    assert_eq!(prices::needed(&repairs), None);
    let why = prices::price_tables::unsound(&prices).expect("a reason");
    assert!(why.contains("no load passes"), "{why}");
}

/// That nodes stick is a fault only where one slides under the scene's own friction.
#[test]
fn sticking_is_no_fault_where_no_node_slides() {
    let weight = |friction| {
        let mut scene = Scene::open("fig1").unwrap();
        scene.contact.friction = friction;
        let prices = prices::on(&Case::new(scene), &|| ()).expect("prices");
        let named = |price: &&prices::Price| price.name.as_deref() == Some("K9 (sliding)");
        prices.iter().find(named).expect("a fault").weight
    };
    let slippery = Friction::new(0.05).unwrap();
    assert_eq!([Friction::STICK, slippery].map(weight), [Weight::NoFault, Weight::Shifts]);
}

/// On a target whose nodes are held the load passes all the same, and K1 alone is fatal.
#[test]
fn on_a_target_that_is_held_the_load_passes() {
    let mut scene = Scene::open("two-blocks").unwrap();
    let model = Arc::make_mut(&mut scene.model);
    let target: Vec<_> = model.target_edges().flat_map(|edge| edge.nodes).collect();
    model.holds.fix(target.iter().flat_map(|node| node.dofs()));
    let prices = prices::on(&Case::new(scene), &|| ()).expect("prices");
    let run = prices[0].outcome.as_ref().expect("a result");
    assert!(!run.passes_nothing);
    assert_near("transmitted", run.transmitted, 1.0, 1.0, &CORRECTED);
    assert_eq!(prices::price_tables::of_weight(&prices, Weight::Fatal), ["K1"]);
}
