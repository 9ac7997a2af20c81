//! The bounds on rounding: true bounds, and not absurdly wide ones, on every setting; the numbers
//! of `unilateral` beside exact ones.

use crate::common::shipped::shipped_scenes;
use crate::common::tolerances::{ROUNDING_BOUND_WIDTH, Tolerance};
use dashu_ratio::RBig;
use nalgebra::DVector;
use plane_contact::answer::estimates::arithmetic::{self, bounded, stress_bounds};
use plane_contact::answer::{Constraint, Detail, Elimination, Request, Solution, Stiffness, solve};
use plane_contact::numbers::scalar::{Exact, Scalar, scope};
use plane_contact::numbers::solve::{Arithmetic, Ldlt, ScalarName, Solver};
use plane_contact::problem::element::{B, State};
use plane_contact::problem::model::Triangle;
use plane_contact::problem::modelling::{ContactModel, Coupling, Friction, Geometry, Variant};
use plane_contact::problem::scene::Scene;
use plane_contact::studies::benchmark::Blocks;

/// Exact numbers are for scenes of this many equations at most, in a test.
const EQUATIONS: usize = 80;

fn in_scalar(scalar: ScalarName, solver: Option<Solver>) -> Arithmetic {
    Arithmetic { scalar, solver, ..Arithmetic::default() }
}

/// Largest |u − v|.
fn off(u: &DVector<f64>, v: &DVector<f64>) -> f64 {
    (u - v).amax()
}

/// That `bound` holds `error`, and is at most 1,000 times as wide as it or as half a unit in the
/// last place of `scale`.
fn assert_bound(what: &str, bound: f64, error: f64, scale: f64) {
    assert!(error <= bound, "{what}: error {error:e} is beyond its bound {bound:e}");
    let Tolerance { limit, reason } = ROUNDING_BOUND_WIDTH;
    let least = error.max(scale * f64::EPSILON / 2.0);
    assert!(bound <= limit * least, "{what}: bound {bound:e} for an error of {error:e} ({reason})");
}

#[test]
fn the_bound_on_rounding_holds_on_every_setting() {
    let settings = [
        in_scalar(ScalarName::F64, None),
        in_scalar(ScalarName::F64, Some(Solver::Cg)),
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
                let rounding = f64::EPSILON / 2.0 * exact.u.amax();
                let error = off(&solution.u, &exact.u) - rounding;
                let bound = arithmetic::rounding(&solution).displacement;
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
        let bound = arithmetic::rounding(&solution).displacement;
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

/// Displacements of the last contact state of `unilateral`, its normals and weights taken as they
/// stand, in rational numbers.
fn exact_state(solution: &Solution) -> DVector<f64> {
    let model = &*solution.model;
    scope(|| {
        let constraints: Vec<Constraint<Exact>> =
            solution.last().constraints.iter().map(|c| c.map(Exact::from_f64)).collect();
        let t = Elimination::closing(&model.restrained, &constraints);
        let stiffness = Stiffness::new(model, Exact::from_f64);
        let Detail::Unilateral(last) = &solution.last().detail else { unreachable!() };
        let load = model.free_part(&(&model.load + &*last.friction)).map(Exact::from_f64);
        let b = t.load(&(load - stiffness.times(t.shift())));
        let value = |x: Exact| x.to_rational().expect("finite");
        let matrix = stiffness.reduced(&t).map(|x| value(*x));
        let q = Ldlt::new(&matrix)
            .expect("not singular")
            .solve(&b.iter().map(|x| value(*x)).collect::<Vec<_>>());
        let q = DVector::from_iterator(q.len(), q.into_iter().map(Exact::new));
        t.expand(&q).map(|x| x.to_f64())
    })
}

/// The factors of a run serve its estimates; once they were let go, estimates factor anew.
#[test]
fn estimates_do_without_the_factors_of_the_run() {
    let generated = Blocks { upper: 2, lower: 3 }.generate().unwrap().build().unwrap();
    for variant in [Variant::Tied, Variant::Unilateral] {
        let solution = solve(&Request::new(&generated).variant(variant), &mut |_| ()).unwrap();
        let before = arithmetic::rounding(&solution);
        solution.let_go_of_factors();
        let after = arithmetic::rounding(&solution);
        assert_eq!(before.decisions, after.decisions, "{variant}");
        let [a, b] = [before, after].map(|rounding| rounding.displacement);
        assert!(a > 0.0 && b > 0.0 && a < 10.0 * b && b < 10.0 * a, "{variant}: {a:e}, {b:e}");
    }
}

#[test]
fn the_bar_of_unilateral_holds() {
    let generated = Blocks { upper: 2, lower: 3 }.generate().unwrap().build().unwrap();
    let scenes = shipped_scenes().into_iter().filter(|scene| scene.model.dofs() <= EQUATIONS);
    let mut held = 0;
    for scene in scenes.chain([generated]).filter(|s| s.model.target().is_some()) {
        let mut request = Request::new(&scene).variant(Variant::Unilateral);
        for (coupling, friction) in
            [(Coupling::Nts, Friction::STICK), (Coupling::Mortar, Friction::NONE)]
        {
            let geometry = Geometry::Initial;
            request.contact = ContactModel { coupling, friction, geometry, ..request.contact };
            let Ok(solution) = solve(&request, &mut |_| ()) else { continue };
            let rounding = f64::EPSILON / 2.0 * solution.u.amax();
            let error = off(&solution.u, &exact_state(&solution)) - rounding;
            let what = format!("{}, {coupling}, friction {friction}", scene.name);
            assert_bound(
                &what,
                arithmetic::rounding(&solution).displacement,
                error,
                solution.u.amax(),
            );
            held += 1;
        }
    }
    assert!(held > 20, "only {held} runs could be compared");
}

/// Stresses of displacements that are off by as much as their bound says stay within theirs.
#[test]
fn the_bar_of_a_stress_holds_what_a_moved_node_does_to_it() {
    let scene = Scene::open("fig1").unwrap();
    let solution = solve(&Request::new(&scene).variant(Variant::Tied), &mut |_| ()).unwrap();
    let moved = 1e-6 * solution.u.amax();
    let bounds = stress_bounds(&solution, &bounded(&solution.model), moved);
    let model = &*solution.model;
    for n in model.triangle_ids() {
        let (Triangle { nodes, material }, b) = (model.triangle(n), B(&model.corners(n)));
        let of_element = |sign: f64| {
            nalgebra::SVector::<f64, 6>::from_fn(|k, _| {
                let turned = if k % 3 == 0 { -sign } else { sign };
                nodes[k / 2].of(&solution.u)[k % 2] + turned * moved
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
