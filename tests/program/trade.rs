//! Speed against accuracy: what is measured, and what it says. No test asserts a time.

use crate::claims::judged;
use crate::common::annulus::annulus;
use crate::common::golden_file::assert_rows_by;
use crate::common::rows::scene_of;
use crate::common::same_text::same_text;
use crate::common::tolerances::{CLAIM, CONSTANT_FIELD, assert_near};
use plane_contact::engine::linear::{Arithmetic, ScalarName};
use plane_contact::engine::{Request, Solution, max_displacement, solve};
use plane_contact::problem::element;
use plane_contact::problem::model::Model;
use plane_contact::problem::modelling::Variant;
use plane_contact::problem::scene::Scene;
use plane_contact::problem::scene::symmetry::half;
use plane_contact::studies::audit::claims::ClaimId;
use plane_contact::studies::audit::range::{self, ParameterValue};
use plane_contact::studies::benchmark::Strand;
use plane_contact::studies::trade::trial_tables as report;
use plane_contact::studies::trade::{self, AXES, Order, Point, Rounding, Trade, pareto, solve_to};

testing::tolerances! {
    /// Lamé: order of convergence in the energy norm, absolute.
    LAME_ENERGY_ORDER = 0.15,
        "1 where the solution is smooth; 0.89 was measured: the polygon's corners on the bore are re-entrant and take \
         some of it";
    /// Half a symmetric scene beside the whole, and a refined scene's area and load, relative to the largest.
    HALF = 1e-9,
        "the strand's mesh is symmetric within 2e-11 mm of triangles of 0.2 mm; the same equations in another order \
         add 1e-13";
}

const HALF_SCENES: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/program/half");

/// What is measured of the axes of these names, of all where there are none.
fn measured(scene: &Scene, only: &[&str]) -> Trade {
    let request = Request::new(scene);
    let only: Vec<String> = only.iter().map(ToString::to_string).collect();
    let plan = trade::plan(&request, &only).expect("a sound scene");
    trade::measure(&request, plan, 1, |_| ())
}

fn open(name: &str) -> Scene {
    Scene::open(name).expect("embedded scenes are sound")
}

fn solved(scene: &Scene, variant: Variant) -> Solution {
    solve(&Request::new(scene).variant(variant), &mut |_| ()).expect("the variant runs")
}

#[test]
fn the_front_is_what_nothing_beats() {
    let point = |[time, error]: [f64; 2]| Point { seconds: [0.9 * time, 1.1 * time], error };
    let points = [[1.0, 1.0], [2.0, 0.5], [2.0, 0.6], [3.0, 0.5], [0.5, 9.0], [1.0, 1.0]];
    assert_eq!(pareto(&points.map(point)), [true, true, false, false, true, true]);
    // Noise separates neither times nor errors by rounding.
    let noise = [[1.0, 7.8e-14], [1.05, 1.6e-13], [2.0, 1e-13], [2.0, 1e-15]];
    assert_eq!(pareto(&noise.map(point)), [true, true, false, true]);
    assert!(pareto(&[]).is_empty());
}

#[test]
fn a_made_up_order_is_found() {
    // The errors are 0.8 / 4^l.
    let order = Order::fit("x", vec![0.6, 0.15, 0.0375], 1);
    assert_eq!((order.order, order.scatter), (Some(2.0), Some(1.0)));
    for (found, expected) in order.errors.expect("an order").iter().zip([0.8, 0.2, 0.05, 0.0125]) {
        assert_near("error", *found, expected, expected, &CONSTANT_FIELD);
    }
    assert_eq!(Order::fit("x", vec![0.1, 0.2], 1).order, None);
    assert_eq!(Order::fit("x", vec![0.1], 1).order, None);
}

/// Squares of errors 1, 1/2, 1/4, ... are 1, 1/4, 1/16, ..., and differences the roots of 3/4 of
/// them.
#[test]
fn squares_of_differences_add_in_the_energy_norm() {
    let differences = [1.0, 0.5, 0.25].map(|e: f64| e * 0.75f64.sqrt());
    let errors = Order::fit("x", differences.to_vec(), 2).errors.expect("an order");
    for (found, expected) in errors.iter().zip([1.0, 0.5, 0.25, 0.125]) {
        assert_near("error", *found, expected, expected, &CONSTANT_FIELD);
    }
}

#[test]
fn every_parameter_has_its_rows_and_every_row_its_columns() {
    let trade = measured(&open("fig1"), &[]);
    assert_eq!(trade.sections.len(), AXES.len());
    for section in &trade.sections {
        let none = section.parameter == "symmetry";
        assert_eq!(section.rows.is_empty(), none, "{}", section.parameter);
        for row in &section.rows {
            let (parameter, label) = (section.parameter, &row.label);
            assert!(row.failure.is_some() != row.seconds.is_some(), "{label}");
            assert!(row.seconds.is_none() || row.error.is_some(), "{parameter}: {label}");
            assert!(row.runs == 1 && row.equations > 0);
        }
        let ran = section.rows.iter().any(|row| row.error.is_some());
        assert_eq!(section.rows.iter().any(|row| row.pareto), ran, "{}", section.parameter);
    }
    let text = report::report(&trade).text(usize::MAX);
    assert!(text.contains("does not have this parameter"), "{text}");
    for words in ["c_tll", "von Mises", "exact", "equilibrium"] {
        assert!(text.contains(words), "{words:?}: {text}");
    }
}

/// A place of the range is the scene that the generator makes: run alone, in double-doubles. The place is one where
/// rounding does not decide who is in contact.
#[test]
fn a_place_of_the_range_is_a_run_of_its_scene() {
    let strand = Strand { strand: 5.0, duct: 5.1, ..Strand::default() };
    let scene = strand.generate().and_then(|builder| builder.build()).expect("in range");
    let arithmetic = Arithmetic { scalar: ScalarName::F64x2, ..Arithmetic::default() };
    let request = Request::new(&scene).variant(Variant::Stepped).arithmetic(arithmetic);
    let [own, least] = [1e-3, 1e-6].map(|tolerance| {
        let mut request = request.clone();
        request.tolerance = Some(tolerance);
        solve(&request, &mut |_| ()).expect("it runs")
    });
    let here =
        |place: ParameterValue| place.parameter == range::Parameter::Radius && place.value == 5.0;
    let judged = judged(ClaimId::P10);
    let at = judged.elsewhere.iter().find(|other| here(other.place)).expect("a place");
    let number = at.measured.number.expect("a number");
    let change = max_displacement(&(&least.u - &own.u)) / max_displacement(&own.u);
    assert_near("P10", number, change, change, &CLAIM);
}

#[test]
fn the_picture_is_xml() {
    let empty = measured(&open("fig1"), &["symmetry"]);
    assert_eq!(report::picture(&empty), None, "a chart without a point");
    let svg = report::picture(&measured(&open("fig1"), &["solver"])).expect("a chart");
    roxmltree::Document::parse(&svg).expect("XML");
}

#[test]
fn errors_fall_with_precision() {
    let trade = measured(&open("fig1"), &["arithmetic"]);
    let error = |label: &str| {
        let row = trade.sections[0].rows.iter().find(|row| row.label == label);
        row.and_then(|row| row.error).expect("the trial ran").displacement
    };
    assert!(error("f32") > error("f64"));
    assert!(error("f64") >= error("f64x2"));
    assert_eq!(error("exact"), 0.0);
}

/// The triangle's order in the energy norm is 1 where the solution is smooth.
#[test]
fn lame_converges_with_order_1_in_the_energy_norm() {
    let scene = annulus(4, 8).build().unwrap();
    let trade = measured(&scene, &["mesh"]);
    let section = &trade.sections[0];
    let errors: Vec<f64> = section.rows.iter().map(|row| row.error.unwrap().energy).collect();
    assert!(errors.len() >= 4 && errors.windows(2).all(|e| e[1] < e[0]), "{errors:?}");
    let order = section.orders[0].order.expect("an order");
    assert_near("order", order, 1.0, 1.0, &LAME_ENERGY_ORDER);
}

#[test]
fn a_finer_scene_keeps_its_nodes_area_load_and_surfaces() {
    for name in ["fig1", "two-blocks", "strand"] {
        let scene = open(name);
        let finer = scene.refined().unwrap().scene;
        let [before, after] = [&scene.model, &finer.model];
        assert_eq!(after.triangles.len(), 4 * before.triangles.len());
        assert_eq!(after.contact.target.len(), 2 * before.contact.target.len(), "{name}");
        assert_eq!(after.contact.nodes.len(), 2 * before.contact.nodes.len() - 1, "{name}");
        let area = |model: &Model| {
            model.triangle_ids().map(|id| element::area(&model.corners(id))).sum::<f64>()
        };
        assert_near("area", area(after), area(before), area(before), &HALF);
        assert_eq!(after.thickness, before.thickness);
        let (load, total) = (before.total_load(), after.total_load());
        assert_near("load", total[1], load[1], load[1], &HALF);
        assert_eq!(after.bodies.len(), before.bodies.len());
    }
}

#[track_caller]
fn half_is_whole(scene: &Scene, variant: Variant) {
    let half = half(scene).expect("the scene is symmetric");
    let (whole, of_half) = (solved(scene, variant), solved(&half.scene, variant));
    let scale = whole.u.amax();
    let expected = half.displacements(&whole.u);
    for n in half.scene.model.node_ids() {
        let (u, expected) = (n.components(&of_half.u), n.components(&expected));
        for d in [0, 1] {
            assert_near(&format!("node {n}"), u[d], expected[d], scale, &HALF);
        }
    }
    for (state, n) in of_half.elements.iter().zip(&half.triangles) {
        let (stress, expected) =
            (state.von_mises_stress, whole.elements[n.index()].von_mises_stress);
        assert_near(&format!("triangle {n}"), stress, expected, expected.max(1.0), &HALF);
    }
}

#[test]
fn half_of_a_symmetric_scene_is_the_whole() {
    for row in ["square", "square shift=3.7,0", "square shift=-20.1,0"] {
        half_is_whole(&scene_of(HALF_SCENES, row).unwrap(), Variant::Tied);
    }
    half_is_whole(&open("strand"), Variant::Unilateral);
}

/// The rows of `half/rows.txt`: what is left of each scene.
#[test]
fn what_is_symmetric_has_a_half() {
    assert_rows_by(format!("{HALF_SCENES}/rows.txt"), same_text, |row| {
        let Some(half) = half(&scene_of(HALF_SCENES, row).unwrap()) else { return "none".into() };
        assert!(half.scene.model.dropped.is_empty() && half.nodes.iter().all(|[a, b]| a == b));
        let nodes = half.nodes.iter().map(|[node, _]| format!(" {node}"));
        format!("nodes{}", nodes.collect::<String>())
    });
    assert!(half(&open("fig1")).is_none());
}

#[test]
fn half_a_scene_is_refined_as_the_whole() {
    let whole = scene_of(HALF_SCENES, "square").unwrap();
    let of_half = half(&whole).unwrap().scene.refined().unwrap().scene;
    let half_of = half(&whole.refined().unwrap().scene).unwrap().scene;
    assert_eq!(of_half.model.free_dofs(), half_of.model.free_dofs());
    assert_eq!(of_half.model.triangles.len(), half_of.model.triangles.len());
}

#[test]
fn everything_but_times_is_reproducible() {
    let scene = open("fig1");
    let measured = || {
        let mut trade = measured(&scene, &[]);
        for row in trade.sections.iter_mut().flat_map(|section| &mut section.rows) {
            (row.seconds, row.pareto) = (None, false);
        }
        serde_json::to_string(&trade).unwrap()
    };
    assert!(measured() == measured());
}

/// The true error, against f64x2, is within the bar of every precision that is taken.
#[test]
fn the_bar_of_an_accuracy_holds() {
    for name in ["fig1", "two-blocks", "strand"] {
        let request = Request::new(&open(name)).variant(Variant::Tied);
        let reach = |accuracy| solve_to(&request, accuracy).expect("a precision meets it");
        let best = reach(1e-18).solution.u;
        for accuracy in [0.5, 1e-6, 1e-8] {
            let reached = reach(accuracy);
            let error = (&reached.solution.u - &best).amax() / max_displacement(&best);
            let Rounding::Measured(bar) = reached.attempts.last().expect("an attempt").rounding
            else {
                panic!("it ran");
            };
            // The best displacements are rounded to be written.
            let written = f64::EPSILON;
            assert!(
                error <= bar + written && bar <= accuracy,
                "{name}: {error:e}, {bar:e}, {accuracy:e}"
            );
        }
    }
}
