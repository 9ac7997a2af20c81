//! The bounds on rounding: true bounds, and not absurdly wide ones, on every setting.

use dashu_ratio::RBig;
use engine::estimates::Estimates;
use engine::estimates::arithmetic::{self, Rounding, bounded, stress_bounds};
use engine::linear::{Arithmetic, ScalarName, Solver};
use engine::{Detail, Request, Solution, Step, solve};
use problem::element::{B, D, State};
use problem::model::Triangle;
use problem::modelling::Variant;
use problem::scene::Scene;
use testing::embedded::scene_json;
use testing::json::build;
use testing::shipped::shipped_scenes;

/// Exact numbers are for scenes of this many equations at most, in a test.
const EQUATIONS: usize = 80;

fn rounding(solution: &Solution) -> Rounding {
    arithmetic::rounding(solution).expect("a variant of the paper")
}

fn in_scalar(scalar: ScalarName, solver: Option<Solver>) -> Arithmetic {
    Arithmetic { scalar, solver, ..Arithmetic::default() }
}

#[test]
fn the_bound_on_rounding_holds_on_every_setting() {
    let settings = [
        in_scalar(ScalarName::F64, None),
        in_scalar(ScalarName::F64, Some(Solver::DenseLu)),
        in_scalar(ScalarName::F64, Some(Solver::SparseCholesky)),
        in_scalar(ScalarName::F32, None),
        in_scalar(ScalarName::F64x2, None),
    ];
    let mut held = 0;
    for scene in shipped_scenes().iter().filter(|scene| scene.model.dofs() <= EQUATIONS) {
        for variant in [Variant::Tied, Variant::Stepped] {
            let request = Request::new(scene).variant(variant);
            let run = |arithmetic| solve(&request.clone().arithmetic(arithmetic), &mut |_| ());
            let Ok(exact) = run(in_scalar(ScalarName::Exact, None)) else { continue };
            for setting in settings {
                let Ok(solution) = run(setting) else { continue };
                let mut steps = solution.steps.iter().zip(&exact.steps);
                if steps.any(|(a, b)| a.statuses() != b.statuses()) {
                    continue;
                }
                // The exact numbers are rounded to f64 to be compared.
                let written = f64::EPSILON / 2.0 * exact.u.amax();
                let error = (&solution.u - &exact.u).amax() - written;
                let bound = rounding(&solution).displacement;
                let bound = bound.unwrap_or(f64::INFINITY);
                let what = format!(
                    "{}, {variant}, {} by {}",
                    scene.name,
                    setting.scalar,
                    request.solver()
                );
                assert!(error <= bound, "{what}: error {error:e} is beyond its bound {bound:e}");
                held += 1;
            }
        }
    }
    assert!(held > 50, "only {held} runs could be compared");
}

/// What a run in double-double loses is what its digits lose where they are written as an f64: at
/// most half a unit in the last place, beside which its own rounding is nothing.
#[test]
fn of_double_doubles_the_writing_is_what_rounds() {
    for name in ["fig1", "two-blocks"] {
        let double = in_scalar(ScalarName::F64x2, None);
        let request = Request::new(&Scene::open(name).unwrap()).variant(Variant::Tied);
        let solution = solve(&request.arithmetic(double), &mut |_| ()).unwrap();
        let bound = rounding(&solution).displacement;
        let bound = bound.unwrap_or(f64::INFINITY);
        let half = f64::EPSILON / 2.0 * solution.u.amax();
        let written = solution.u.iter().zip(solution.digits.as_ref().expect("it has more digits"));
        let lost = written.map(|(u, digits)| {
            let u = RBig::try_from(*u).expect("finite");
            (u - digits).to_f64().value().abs()
        });
        let lost = lost.fold(0.0, f64::max);
        assert!(lost <= bound && bound < 2.0 * half, "{name}: {lost:e}, {bound:e}, {half:e}");
    }
}

/// Stresses of displacements that are off by as much as their bound says stay within theirs.
#[test]
fn the_bar_of_a_stress_holds_what_a_moved_node_does_to_it() {
    let scene = Scene::open("fig1").unwrap();
    let solution = solve(&Request::new(&scene).variant(Variant::Tied), &mut |_| ()).unwrap();
    let moved = 1e-6 * solution.u.amax();
    let bounds = stress_bounds(&solution, &bounded(&solution.model), Some(moved));
    let model = &*solution.model;
    for n in model.triangle_ids() {
        let (Triangle { nodes, material }, b) = (model.triangle(n), B(&model.corners(n)));
        let of_element = |sign: f64| {
            nalgebra::SVector::<f64, 6>::from_fn(|k, _| {
                let turned = if k % 3 == 0 { -sign } else { sign };
                nodes[k / 2].components(&solution.u)[k % 2] + turned * moved
            })
        };
        for sign in [-1.0, 1.0] {
            let state = State::new(model.plane, material.e, material.nu, &b, &of_element(sign));
            let (bound, before) = (bounds[n.index()], &solution.elements[n.index()]);
            let change = (state.von_mises_stress - before.von_mises_stress).abs();
            assert!(change <= bound, "triangle {n}: {change:e}, bound {bound:e}");
        }
    }
}

/// The bounds of each step hold beside the same run in exact numbers, in which their own tell how
/// far the writing as `f64` may be off.
#[test]
fn the_bounds_of_each_step_hold() {
    let mut held = 0;
    for name in ["fig1", "two-blocks"] {
        for variant in [Variant::Tied, Variant::Stepped, Variant::Printed] {
            let mut request = Request::new(&Scene::open(name).unwrap()).variant(variant);
            request.iterations = 3;
            let run = |scalar| {
                let request = request.clone().arithmetic(in_scalar(scalar, None));
                solve(&request, &mut |_| ()).ok()
            };
            let Some(exact) = run(ScalarName::Exact) else { continue };
            let written = rounding(&exact);
            assert_eq!(written.displacement, Some(exact.u.amax() * (f64::EPSILON / 2.0)), "{name}");
            assert_eq!(written.decisions, Some(Vec::new()), "{name}");
            let half = |x: f64| x * (f64::EPSILON / 2.0);
            let largest = |step: &Step| step.max_displacement;
            let sizes = |step: &Step| {
                let Detail::Published(own) = &step.detail else {
                    unreachable!("a paper's variant")
                };
                let yt = own.pairs.yt.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
                [yt, own.pairs.k_cnt().as_matrix().amax(), largest(step)]
            };
            for (step, bounds) in exact.steps.iter().zip(&written.steps) {
                let bounds = bounds.as_ref().expect("exact numbers have them");
                assert_eq!([bounds.yt, bounds.weights, bounds.u], sizes(step).map(half), "{name}");
            }
            for scalar in [ScalarName::F32, ScalarName::F64, ScalarName::F64x2] {
                let Some(solution) = run(scalar) else { continue };
                let found = rounding(&solution);
                let what = format!("{name}, {variant}, {scalar}");
                if let (ScalarName::F64x2, Some(bound)) = (scalar, found.displacement) {
                    let unit = f64::EPSILON / 2.0 * solution.u.amax();
                    assert!(bound >= unit && bound < 2.0 * unit, "{what}: {bound:e}, {unit:e}");
                }
                let pairs = solution.steps.iter().zip(&exact.steps).zip(&found.steps);
                for ((own, exact), bounds) in pairs {
                    let Some(bounds) = bounds else { continue };
                    let (Detail::Published(a), Detail::Published(b)) = (&own.detail, &exact.detail)
                    else {
                        unreachable!("a paper's variant")
                    };
                    let [yt, weights, u] = sizes(exact).map(half);
                    let far = (a.pairs.yt.iter().zip(b.pairs.yt.iter()))
                        .fold(0.0_f64, |m, (a, b)| m.max((a - b).abs()));
                    assert!(far <= bounds.yt + yt, "{what}: yt {far:e} {bounds:?}");
                    let far = (a.pairs.k_cnt().as_matrix() - b.pairs.k_cnt().as_matrix()).amax();
                    assert!(far <= bounds.weights + weights, "{what}: weights {far:e} {bounds:?}");
                    let far = (largest(own) - largest(exact)).abs();
                    assert!(far <= bounds.u + u, "{what}: |u| {far:e} {bounds:?}");
                    let sums = [bounds.yt, bounds.weights, bounds.u];
                    assert!(sums.iter().all(|bound| *bound >= 0.0), "{what}: {bounds:?}");
                    let is_written = bounds.weights >= weights && bounds.u >= u;
                    assert!(scalar != ScalarName::F64x2 || is_written, "{what}: {bounds:?}");
                    let is_narrow = scalar == ScalarName::F32 || bounds.weights < 1e-9;
                    assert!(is_narrow, "{what}: {bounds:?}");
                    held += 1;
                }
            }
        }
    }
    assert!(held > 20, "only {held} steps could be compared");
}

/// Where each displacement is known to d, each strain is known to the sum of |B| d, each stress to
/// that times D, and the von Mises stress to the von Mises value of these, all of one sign.
#[test]
fn the_bar_of_a_stress_has_its_closed_form() {
    for plane in ["strain", "stress"] {
        let mut json = scene_json("fig1");
        json["plane"] = plane.into();
        let scene = build(&json).expect("a sound scene");
        let solution = solve(&Request::new(&scene).variant(Variant::Tied), &mut |_| ()).unwrap();
        let model = &*solution.model;
        let d = solution.u.amax();
        let [wide, none] =
            [d, 0.0].map(|d| stress_bounds(&solution, &bounded(&solution.model), Some(d)));
        for id in model.triangle_ids() {
            let (material, b) = (model.triangle(id).material, B(&model.corners(id)));
            let strains = b.abs() * nalgebra::SVector::<f64, 6>::repeat(d);
            let [x, y, xy]: [f64; 3] = (D(model.plane, material.e, material.nu) * strains).into();
            let z = if plane == "strain" { material.nu * (x + y) } else { 0.0 };
            let squares = (x + y).powi(2) + (y + z).powi(2) + (z + x).powi(2);
            let expected = (squares / 2.0 + 3.0 * xy * xy).sqrt();
            let found = wide[id.index()];
            assert!(found >= expected && found < 1.001 * expected, "{id}: {found} {expected}");
            let rounding = 16.0 * f64::EPSILON * solution.elements[id.index()].von_mises_stress;
            assert!(none[id.index()] >= rounding, "{id}: {:e} {rounding:e}", none[id.index()]);
            assert!(none[id.index()] < 1e-6 * expected, "{id}: {:e}", none[id.index()]);
        }
        // The rounding of a von Mises stress that is far beyond all others.
        let mut far = solution.clone();
        far.elements[0].von_mises_stress = 1e20;
        let bound = stress_bounds(&far, &bounded(model), Some(0.0))[0];
        assert!((bound / (16.0 * f64::EPSILON * 1e20) - 1.0).abs() < 1e-9, "{bound:e}");
    }
}

/// Lengths, stresses and thickness in other units: what is estimated comes out in these units, and
/// what has no unit stays.
#[test]
fn estimates_have_their_units() {
    for variant in [Variant::Tied, Variant::Unilateral] {
        let estimates = |length: f64, stress: f64, thickness: f64| {
            let mut json = scene_json("two-blocks");
            for node in json["node"].as_array_mut().unwrap() {
                for k in [1, 2] {
                    node[k] = (length * node[k].as_f64().unwrap()).into();
                }
            }
            for material in json["materials"].as_object_mut().unwrap().values_mut() {
                material["E"] = (stress * material["E"].as_f64().unwrap()).into();
            }
            let pressure = &mut json["loads"][0]["pressure"];
            *pressure = (stress * pressure.as_f64().unwrap()).into();
            json["thickness"] = thickness.into();
            let tolerance = &mut json["contact"]["c_tll"];
            *tolerance = (length * tolerance.as_f64().unwrap()).into();
            let scene = build(&json).expect("a sound scene");
            let solution = solve(&Request::new(&scene).variant(variant), &mut |_| ()).unwrap();
            Estimates::new(&solution)
        };
        let plain = estimates(1.0, 1.0, 1.0);
        assert!(plain.mesh.total() > 0.0, "{variant}");
        for [length, stress, thickness] in [[2.0, 1.0, 1.0], [1.0, 4.0, 1.0], [1.0, 1.0, 4.0]] {
            let other = estimates(length, stress, thickness);
            let what = format!("{variant}, {length} {stress} {thickness}");
            let same = |a: f64, b: f64| {
                assert!(a == b || (a - b).abs() <= 1e-9 * b.abs(), "{what}: {a:e} {b:e}");
            };
            same(other.mesh.relative(), plain.mesh.relative());
            // The root of an energy: stress · length² · thickness.
            let root = (stress * length * length * thickness).sqrt();
            same(other.mesh.total(), root * plain.mesh.total());
            same(other.mesh.energy_norm, root * plain.mesh.energy_norm);
            for (a, b) in other.errors.bodies.iter().zip(&plain.errors.bodies) {
                same(a.von_mises_stress, stress * b.von_mises_stress);
            }
            let maps = [&other, &plain].map(|estimates| estimates.mesh.error_map());
            maps[0].iter().zip(&maps[1]).for_each(|(a, b)| same(*a, *b));
            let mean = maps[1].iter().map(|x| x * x).sum::<f64>() / maps[1].len() as f64;
            same(mean.sqrt(), plain.mesh.relative());
        }
    }
}

/// Nothing loads the blocks: there is no error, and no division by nothing.
#[test]
fn what_is_not_loaded_has_no_error() {
    let mut json = scene_json("two-blocks");
    json["loads"] = serde_json::json!([]);
    let scene = build(&json).expect("a sound scene");
    let solution = solve(&Request::new(&scene).variant(Variant::Tied), &mut |_| ()).unwrap();
    let found = Estimates::new(&solution);
    assert_eq!(
        (found.mesh.total(), found.mesh.relative(), found.mesh.energy_norm),
        (0.0, 0.0, 0.0)
    );
    assert!(found.mesh.error_map().iter().all(|part| *part == 0.0));
    let errors = found.errors;
    assert_eq!(errors.displacement_no_limit, None);
    for body in &errors.bodies {
        assert_eq!((body.von_mises_stress, &body.no_limit), (0.0, &None));
    }
}
