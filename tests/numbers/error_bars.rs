//! The bars of rounding: true bounds, and not absurdly wide ones, on every rung; the numbers of `unilateral` beside exact ones.

use crate::common::shipped::shipped_scenes;
use crate::common::tolerances::{BAR_WIDTH_OF_ROUNDING, Tolerance};
use nalgebra::DVector;
use plane_contact::answer::contact::{Elimination, Outcome, Stiffness, Tie, run, run_in};
use plane_contact::answer::estimates::arithmetic::{displacement_bound, stress_bounds};
use plane_contact::numbers::scalar::{Exact, Scalar, scope};
use plane_contact::numbers::solve::{Arithmetic, Ldlt, ScalarName, Solver};
use plane_contact::paper::mirror::Reading;
use plane_contact::problem::element;
use plane_contact::problem::modelling::{Coupling, Friction, Variant};
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

/// That `bound` holds `error`, and is at most 1,000 times as wide as it or as half a unit in the last place of `scale`.
fn assert_bound(what: &str, bound: f64, error: f64, scale: f64) {
    assert!(error <= bound, "{what}: error {error:e} is beyond its bound {bound:e}");
    let Tolerance { limit, reason } = BAR_WIDTH_OF_ROUNDING;
    let least = error.max(scale * f64::EPSILON / 2.0);
    assert!(bound <= limit * least, "{what}: bound {bound:e} for an error of {error:e} ({reason})");
}

#[test]
fn the_bar_of_rounding_holds_on_every_rung() {
    let rungs = [
        in_scalar(ScalarName::F64, None),
        in_scalar(ScalarName::F64, Some(Solver::Cg)),
        in_scalar(ScalarName::F64, Some(Solver::SparseCholesky)),
        in_scalar(ScalarName::F32, None),
        in_scalar(ScalarName::F64x2, None),
    ];
    let mut held = 0;
    for scene in shipped_scenes().iter().filter(|scene| scene.load.len() <= EQUATIONS) {
        for variant in [Variant::Tied, Variant::Stepped] {
            let run = |arithmetic| run_in(scene, variant, &Reading::default(), arithmetic, |_| ());
            let Ok(exact) = run(in_scalar(ScalarName::Exact, None)) else { continue };
            for rung in rungs {
                let Ok(outcome) = run(rung) else { continue };
                let same = outcome.iterations.iter().zip(&exact.iterations);
                if same.into_iter().any(|(a, b)| a.pairs.dy != b.pairs.dy) {
                    continue;
                }
                // The exact numbers are rounded to f64 to be compared.
                let rounding = f64::EPSILON / 2.0 * exact.u.amax();
                let error = off(&outcome.u, &exact.u) - rounding;
                let bound = displacement_bound(scene, &outcome);
                let what =
                    format!("{}, {variant}, {} by {}", scene.name, rung.scalar, rung.solver());
                assert!(error <= bound, "{what}: error {error:e} is beyond its bound {bound:e}");
                held += 1;
            }
        }
    }
    assert!(held > 50, "only {held} runs could be compared");
}

/// Displacements of the last contact state of `unilateral`, its normals and weights taken as they stand, in rational numbers.
fn exact_state(scene: &Scene, outcome: &Outcome) -> DVector<f64> {
    scope(|| {
        let sheet = outcome.sheet.recomputed(Exact::from_f64, scene.thickness);
        let last = outcome.iterations.last().expect("an iteration");
        let ties: Vec<Tie<Exact>> = last.ties.iter().map(|tie| tie.map(Exact::from_f64)).collect();
        let t = Elimination::with_normals(&sheet, &ties).expect("it was solved before");
        let stiffness = Stiffness::new(&sheet);
        let load = |e: usize| if sheet.S[e + 1] == 1 { 0.0 } else { scene.load[e] };
        let load = DVector::from_fn(scene.load.len(), |e, _| Exact::from_f64(load(e)));
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

#[test]
fn the_bar_of_unilateral_holds() {
    let generated = Blocks { upper: 2, lower: 3 }.generate().unwrap().build().unwrap();
    let scenes = shipped_scenes().into_iter().filter(|scene| scene.load.len() <= EQUATIONS);
    let mut held = 0;
    for mut scene in scenes.chain([generated]).filter(|s| s.target().is_some()) {
        for (coupling, friction) in
            [(Coupling::Nts, Friction::Stick), (Coupling::Mortar, Friction::None)]
        {
            (scene.contact.coupling, scene.contact.friction) = (coupling, friction);
            let Ok(outcome) = run(&scene, Variant::Unilateral, &Reading::default(), |_| ()) else {
                continue;
            };
            let rounding = f64::EPSILON / 2.0 * outcome.u.amax();
            let error = off(&outcome.u, &exact_state(&scene, &outcome)) - rounding;
            let what = format!("{}, {coupling}, friction {friction}", scene.name);
            assert_bound(&what, displacement_bound(&scene, &outcome), error, outcome.u.amax());
            held += 1;
        }
    }
    assert!(held > 20, "only {held} runs could be compared");
}

/// Stresses of displacements that are off by as much as their bound says stay within theirs.
#[test]
fn the_bar_of_a_stress_holds_what_a_moved_node_does_to_it() {
    let scene = Scene::open("fig1").unwrap();
    let outcome = run(&scene, Variant::Tied, &Reading::default(), |_| ()).unwrap();
    let moved = 1e-6 * outcome.u.amax();
    let bounds = stress_bounds(&outcome, scene.thickness, moved);
    let sheet = &outcome.sheet;
    for n in 1..=sheet.M() {
        let of_element = |sign: f64| {
            nalgebra::SVector::<f64, 6>::from_fn(|k, _| {
                let turned = if k % 3 == 0 { -sign } else { sign };
                outcome.u[2 * sheet.EL[(n, sheet.ind_1 + k / 2)] - 2 + k % 2] + turned * moved
            })
        };
        for sign in [-1.0, 1.0] {
            let state = element::State::new(
                sheet.plane,
                sheet.E[n],
                sheet.nu[n],
                &sheet.B[n],
                &of_element(sign),
            );
            let change = (state.von_mises_stress - outcome.elements[n - 1].von_mises_stress).abs();
            assert!(change <= bounds[n - 1], "triangle {n}: {change:e}, bound {:e}", bounds[n - 1]);
        }
    }
}
