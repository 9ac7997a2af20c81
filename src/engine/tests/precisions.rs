//! One solve on several settings: each against exact numbers, and what rounding is measured to do against the
//! error.

use super::systems::lower;
use dashu_ratio::RBig;
use engine::error::Error;
use engine::estimates::perturbed;
use engine::linear::{
    Arithmetic, DenseLu, Inputs, Ldlt, ScalarName, Solver, inverse_norm, solve_dense,
};
use engine::{self, Request, Solution};
use nalgebra::{DMatrix, DVector};
use numbers::scalar::Scalar;
use paper::door;
use problem::model::NodeId;
use problem::modelling::Variant;
use problem::scene::Scene;
use proptest::prelude::*;
use testing::embedded::scene_json;
use testing::json::build;
use testing::random::fixed;
use testing::shipped::shipped_scenes;
use testing::tolerances::Tolerance;

testing::tolerances! {
    /// f32 against exact numbers, displacements relative to the largest.
    LADDER_SINGLE = 1e-4, "eps = 6e-8 times a condition number of 1e2 to 1e3 of fig1 and two-blocks";
    /// f64 against exact numbers, displacements relative to the largest.
    LADDER_DOUBLE = 1e-13, "eps = 1e-16 times a condition number of 1e2 to 1e3 of fig1 and two-blocks";
    /// f64x2 against exact numbers, displacements relative to the largest.
    LADDER_DOUBLE_DOUBLE = 1e-28,
        "eps = 5e-32, iterations stop at 16 of it, times a condition number of 1e2 to 1e3 of fig1 and two-blocks";
    /// What rounding is measured to do over what it does.
    MEASURED_ROUNDING = 1e3, "an error may be small by chance, where the changed last digits all add up";
    /// An estimate of a norm that no exact arithmetic would let it pass, relative to the norm.
    NORM_ESTIMATE = 1e-10, "estimate and norm are both rounded: 1e-16 times a condition number of 1e4";
}

const PUBLISHED: [Variant; 3] = [Variant::Printed, Variant::Tied, Variant::Stepped];

fn arithmetic(scalar: ScalarName, solver: Option<Solver>) -> Arithmetic {
    Arithmetic { scalar, solver, ..Arithmetic::default() }
}

fn solve(scene: &Scene, variant: Variant, arithmetic: Arithmetic) -> Result<Solution, Error> {
    engine::solve(&Request::new(scene).variant(variant).arithmetic(arithmetic), &mut |_| ())
}

/// Largest difference of two runs' displacements.
fn distance(a: &Solution, b: &Solution) -> f64 {
    let pairs = a.exact_displacements().into_iter().zip(b.exact_displacements());
    pairs.map(|(a, b)| (a - b).to_f64().value().abs()).fold(0.0, f64::max)
}

/// The shipped scenes that exact numbers solve in a moment.
fn small_scenes() -> Vec<Scene> {
    let small = |scene: &Scene| scene.model.dofs() <= 80;
    shipped_scenes().into_iter().filter(small).collect()
}

#[test]
fn every_setting_leads_to_the_exact_answer() {
    use ScalarName::{F32, F64, F64x2 as Double};
    use Solver::{DenseLu, SparseCholesky};
    let settings: [(ScalarName, &[Solver], &Tolerance); 3] = [
        (F32, &[DenseLu, SparseCholesky], &LADDER_SINGLE),
        (F64, Solver::ALL, &LADDER_DOUBLE),
        (Double, &[DenseLu, SparseCholesky], &LADDER_DOUBLE_DOUBLE),
    ];
    for name in ["fig1", "two-blocks"] {
        let scene = Scene::open(name).unwrap();
        for variant in PUBLISHED {
            let exact = solve(&scene, variant, arithmetic(ScalarName::Exact, None)).unwrap();
            let size = exact.u.amax();
            for (scalar, solvers, Tolerance { limit, reason }) in settings {
                for &solver in solvers {
                    let solution =
                        solve(&scene, variant, arithmetic(scalar, Some(solver))).unwrap();
                    let error = distance(&solution, &exact) / size;
                    assert!(
                        error <= *limit,
                        "{name} {variant} {scalar} {solver}: {error:e} > {limit:e} ({reason})"
                    );
                    assert_eq!(solution.factored, exact.factored, "{name} {variant} {scalar}");
                }
            }
        }
    }
}

#[test]
fn both_exact_solvers_give_the_same_digits() {
    for scene in small_scenes() {
        for variant in PUBLISHED {
            let by = |solver| solve(&scene, variant, arithmetic(ScalarName::Exact, Some(solver)));
            match (by(Solver::DenseLu), by(Solver::SparseCholesky)) {
                (Ok(a), Ok(b)) => {
                    assert_eq!(a.digits, b.digits, "{} {variant}", scene.name);
                    assert_eq!(a.elements, b.elements);
                    assert!(a.steps.iter().all(|step| step.solve_residual == 0.0));
                }
                (Err(a), Err(b)) => assert_eq!(a.exit_status(), b.exit_status(), "{}", scene.name),
                (a, b) => panic!("{} {variant}: {:?} and {:?}", scene.name, a.err(), b.err()),
            }
        }
    }
}

/// GOAL: uniaxial strain of two blocks under pressure p, as written in decimals: v = −p h (1 + nu)
/// (1 − 2 nu) / (E (1 − nu)) of each.
#[test]
fn two_blocks_in_decimals_is_its_closed_form_exactly() {
    let scene = Scene::open("two-blocks").unwrap();
    let decimals = Arithmetic { inputs: Inputs::Decimal, ..arithmetic(ScalarName::Exact, None) };
    let solution = solve(&scene, Variant::Stepped, decimals).unwrap();
    let number = |text: &str| RBig::from_str_decimal(text).unwrap();
    let shortening = |e: &str, nu: &str| {
        let (one, two, nu) = (RBig::ONE, RBig::from(2), number(nu));
        let modulus = number(e) * (&one - &nu) / ((&one + &nu) * (&one - &two * &nu));
        number("6.3") * two / modulus
    };
    let expected = -(shortening("30000", "0.2") + shortening("210000", "0.3"));
    let top = &solution.digits.unwrap()[NodeId::from_number(18).y().index()];
    assert_eq!(*top, expected);
    // The stress is p nu / (1 − nu) across and p along: von Mises 6.3 (1 − 2 nu) / (1 − nu), plane
    // strain.
    let mises =
        number("6.3") * (RBig::ONE - RBig::from(2) * number("0.2")) / (RBig::ONE - number("0.2"));
    assert_eq!(solution.elements[0].von_mises_stress, mises.to_f64().value());
}

/// The size of what inputs changed in the last digit are seen to change is that of the error: this is at most ten
/// times as large, and at least a part of it where it is no chance.
#[test]
fn what_rounding_is_measured_to_do_is_of_the_size_of_the_error() {
    let mut compared = 0;
    for scene in small_scenes() {
        for variant in PUBLISHED {
            let Some((error, measured, least)) = error_and_measure(&scene, variant) else {
                continue;
            };
            compared += 1;
            let what = format!("{} {variant}: error {error:e}, measured {measured:e}", scene.name);
            assert!(error <= 10.0 * measured.max(least), "{what}");
            let Tolerance { limit, reason } = MEASURED_ROUNDING;
            assert!(measured <= limit * error.max(least), "{what} ({reason})");
        }
    }
    assert!(compared > 20, "only {compared} runs were compared");
}

/// Returns the error of a run in f64, what it is measured to be, and half a unit in the last place of the largest
/// displacement, below which both may be 0 by chance, length; none where the scene cannot be run, or runs otherwise
/// in exact numbers.
fn error_and_measure(scene: &Scene, variant: Variant) -> Option<(f64, f64, f64)> {
    let plain = solve(scene, variant, Arithmetic::default()).ok()?;
    let exact = solve(scene, variant, arithmetic(ScalarName::Exact, None)).ok()?;
    let statuses =
        |of: &Solution| -> Vec<_> { of.steps.iter().map(|step| step.statuses.clone()).collect() };
    if statuses(&plain) != statuses(&exact) {
        return None;
    }
    let size = plain.u.amax();
    let measured = perturbed(&plain)?.displacement.unwrap_or(0.0) * size;
    Some((distance(&plain, &exact), measured, size * f64::EPSILON / 2.0))
}

/// `two-blocks` with its nodes moved by up to a fifth of its edges; those of the interface together
/// and along it, so that they stay in contact.
fn disturbed(moves: &[[f64; 2]], moduli: [f64; 2], nu: [f64; 2]) -> Scene {
    let mut json = scene_json("two-blocks");
    for (k, [dx, dy]) in moves.iter().enumerate() {
        let mates: &[usize] = match k {
            6..=8 => &[k, k + 3],
            9..=11 => &[],
            _ => &[k],
        };
        for n in mates {
            let node = &mut json["node"][*n];
            node[1] = (node[1].as_f64().unwrap() + dx).into();
            let dy = if mates.len() == 2 { 0.0 } else { *dy };
            node[2] = (node[2].as_f64().unwrap() + dy).into();
        }
    }
    for (material, (e, nu)) in ["1", "2"].iter().zip(moduli.into_iter().zip(nu)) {
        json["materials"][*material] = serde_json::json!({ "E": e, "nu": nu });
    }
    json["iterations"] = 3.into();
    build(&json).unwrap()
}

fn small_moves() -> impl Strategy<Value = Vec<[f64; 2]>> {
    prop::collection::vec([-0.2..0.2_f64, -0.2..0.2_f64], 18)
}

proptest! {
    #![proptest_config(fixed(30))]

    /// How wide it is depends on the moduli: with 1e2 beside 1e6 a bound may be more than 1e3
    /// errors.
    #[test]
    fn the_measure_holds_on_random_scenes(
        moves in small_moves(),
        moduli in [1e2..1e6_f64, 1e2..1e6_f64],
        nu in [0.0..0.45_f64, 0.0..0.45_f64],
    ) {
        let scene = disturbed(&moves, moduli, nu);
        // A wholly total load may leave no node in contact, and then the stamp is free.
        for variant in [Variant::Tied, Variant::Stepped] {
            if let Some((error, measured, least)) = error_and_measure(&scene, variant) {
                prop_assert!(error <= 10.0 * measured.max(least), "{error:e} {measured:e}");
            }
        }
    }
}

/// A symmetric positive definite matrix of a random network of springs, some of them to the ground.
fn springs() -> impl Strategy<Value = (DMatrix<f64>, DVector<f64>)> {
    (2..14_usize).prop_flat_map(|n| {
        let spring = (0..n, 0..n, 0.1..10.0_f64);
        let (springs, load) =
            (prop::collection::vec(spring, 3 * n), prop::collection::vec(-1.0..1.0_f64, n));
        (springs, load).prop_map(move |(springs, load)| {
            let mut a = DMatrix::from_diagonal_element(n, n, 0.01);
            for (i, j, k) in springs {
                a[(i, i)] += k;
                if i != j {
                    a[(j, j)] += k;
                    a[(i, j)] -= k;
                    a[(j, i)] -= k;
                }
            }
            (a, DVector::from_vec(load))
        })
    })
}

proptest! {
    #![proptest_config(fixed(256))]

    #[test]
    fn exact_solvers_solve_exactly((a, b) in springs()) {
        let value = |x: f64| RBig::try_from(x).unwrap();
        let load: Vec<RBig> = b.iter().map(|x| value(*x)).collect();
        let x = Ldlt::new(&lower(&a).map(|x| value(*x))).unwrap().solve(&load);
        for i in 0..b.len() {
            let products = (0..b.len()).map(|j| value(a[(i, j)]) * &x[j]);
            let product = products.fold(RBig::ZERO, |s, p| s + p);
            prop_assert_eq!(&product, &load[i]);
        }
        prop_assert_eq!(solve_dense(|i, j| value(a[(i, j)]), load).unwrap(), x);
    }

    #[test]
    fn the_norm_of_the_inverse_is_estimated((a, b) in springs()) {
        let lu = DenseLu::new(a.clone()).unwrap();
        let w = b.abs();
        let inverse = a.try_inverse().unwrap().abs();
        let (norm, estimate) = ((inverse * &w).amax(), inverse_norm(&lu, &w));
        let Tolerance { limit, reason } = NORM_ESTIMATE;
        prop_assert!(estimate <= norm * (1.0 + limit), "{} > {} ({})", estimate, norm, reason);
        prop_assert!(estimate >= norm / 3.0, "{} < {} / 3", estimate, norm);
    }
}

#[test]
fn decimals_in_f64_are_the_worksheet_itself() {
    for scene in shipped_scenes() {
        let sheet = door::worksheet(&scene.model, |x| x);
        assert_eq!(door::worksheet(&scene.model, f64::from_decimal), sheet, "{}", scene.name);
    }
}

/// Scenes on which f64 fails as printed fail in exact numbers too, at the same line.
#[test]
fn what_fails_as_printed_fails_in_exact_numbers() {
    let mut failed = 0;
    for scene in small_scenes() {
        for variant in PUBLISHED {
            let double = solve(&scene, variant, Arithmetic::default());
            let exact = solve(&scene, variant, arithmetic(ScalarName::Exact, None));
            match (double, exact) {
                (Ok(_), Ok(_)) => (),
                (Err(Error::Listing(a)), Err(Error::Listing(b))) => {
                    assert_eq!((a.line, a.cause), (b.line, b.cause), "{}", scene.name);
                    failed += 1;
                }
                (Err(Error::Singular(a)), Err(Error::Singular(b))) => {
                    assert_eq!(a.iteration, b.iteration, "{} {variant}", scene.name);
                    assert_eq!(b.pivot, 0.0, "an exact matrix is singular or it is not");
                    failed += 1;
                }
                (a, b) => panic!("{} {variant}: {:?} and {:?}", scene.name, a.err(), b.err()),
            }
        }
    }
    assert!(failed > 0, "some scene is here to fail");
}
