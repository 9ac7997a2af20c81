//! Solvers of sparse and dense matrices, and the limit of exact numbers.

use engine::linear::cost;
use engine::linear::{
    DenseLu, Factors, Precision, Solver, SparseCholesky, SparseSymmetric, residual,
};
use fastrand::Rng;
use nalgebra::{DMatrix, DVector};
use numbers::scalar::{F64x2, Scalar};
use numbers::square::SparseSquare;

/// A chain of springs of stiffness 1 between `n` nodes, the first tied to the ground by a
/// spring of stiffness `ground`.
fn chain(n: usize, ground: f64) -> SparseSymmetric {
    let springs = (1..n).flat_map(|i| [(i, i, 1.0), (i - 1, i - 1, 1.0), (i, i - 1, -1.0)]);
    SparseSymmetric::new(n, springs.chain([(0, 0, ground)]))
}

#[test]
fn a_chain_stretches_as_springs_in_series() {
    let cholesky = SparseCholesky::new(&chain(5, 1.0)).unwrap();
    let pull = DVector::from_fn(5, |i, _| f64::from(i == 4));
    let u = cholesky.solve(&pull);
    assert!((u - DVector::from_fn(5, |i, _| i as f64 + 1.0)).amax() < 1e-14);
}

#[test]
fn an_unrestrained_chain_is_singular() {
    assert!(SparseCholesky::new(&chain(5, 0.0)).is_err());
    assert!(SparseCholesky::new(&chain(5, 1e-16)).is_err());
    assert!(SparseCholesky::new(&chain(5, 1e-10)).is_ok());
}

#[test]
fn a_matrix_without_equations_is_solved() {
    let nothing = SparseSymmetric::<f64>::new(0, std::iter::empty());
    let cholesky = SparseCholesky::new(&nothing).unwrap();
    assert_eq!(cholesky.solve(&DVector::zeros(0)).len(), 0);
    let lu = DenseLu::new(DMatrix::<f64>::zeros(0, 0)).unwrap();
    assert_eq!(lu.solve(&DVector::zeros(0)).len(), 0);
}

/// The first pivot is 0 without an exchange of rows.
#[test]
fn dense_lu_exchanges_rows() {
    let matrix = DMatrix::from_row_slice(3, 3, &[0.0, 2.0, 1.0, 4.0, 0.0, 1.0, 2.0, 1.0, 0.0]);
    let x = DVector::from_row_slice(&[1.0, -2.0, 3.0]);
    let b = &matrix * &x;
    let entries = SparseSquare::from_dense(&matrix);
    let lu = DenseLu::new(matrix).unwrap();
    assert!((lu.solve(&b) - &x).amax() < 1e-14);
    assert_eq!(residual(&entries, &x, &b), 0.0);
    // |A| |x| + |b| is 5 · 3 + 7.
    let off = DVector::from_row_slice(&[2.0, -2.0, 3.0]);
    assert_eq!(residual(&entries, &off, &b), 4.0 / (5.0 * 3.0 + 7.0));
}

/// The cube of the equations counts; where numbers grow longer by a factor of the equations with each
/// iteration behind the first, their power.
#[test]
fn exact_numbers_have_a_limit_of_equations() {
    assert_eq!(cost::most_equations(false, 20), 1000);
    assert_eq!(cost::most_equations(true, 1), 1000);
    assert_eq!(cost::most_equations(true, 4), 31, "31 to the power of 6 is 0.9e9");
    assert!(cost::check(1000, false, 20).is_ok());
    let error = cost::check(32, true, 4).unwrap_err();
    assert!(
        error.to_string().contains("32 free equations: an exact run of 4 iterations may have 31")
    );
}

/// Two networks of springs, of stiffness 1 and of stiffness `soft`, the first tied to the ground by a
/// spring of stiffness 1, the other by one of stiffness `ground`; the soft ones' equations stand between
/// the others.
fn networks<T: Scalar>(rng: &mut Rng, n: usize, soft: f64, ground: f64) -> SparseSquare<T> {
    let mut a = SparseSquare::zeros(2 * n);
    for (part, stiffness, ground) in [(0, 1.0, 1.0), (1, soft, ground)] {
        a[(part, part)] += T::from_f64(ground);
        for i in 1..n {
            for j in [i - 1, rng.usize(0..i)] {
                let (p, q, k) =
                    (2 * i + part, 2 * j + part, T::from_f64(stiffness * (0.5 + rng.f64())));
                a[(p, p)] += k;
                a[(q, q)] += k;
                a[(p, q)] -= k;
                a[(q, p)] -= k;
            }
        }
    }
    a
}

/// Checks that every solver calls a network that nothing holds singular, whatever load it has, and
/// finds what holds the force `ground` on one that a spring of that stiffness holds.
fn check_networks<T: Precision>(solvers: &[Solver], epsilon: f64) {
    let mut rng = Rng::with_seed(41);
    for round in 0..12 {
        let n = [2, 3, 7, 30][round % 4];
        let soft = [1.0, 1e-3, 1e3][round % 3];
        let part = |i: usize| f64::from(i % 2 == 1);
        let loads = [
            DVector::from_fn(2 * n, |_, _| rng.f64() - 0.5),
            // In balance, and none at all.
            DVector::from_fn(2 * n, |i, _| if i == 1 { -1.0 } else { f64::from(i == 2 * n - 1) }),
            DVector::from_fn(2 * n, |i, _| 1.0 - part(i)),
        ];
        let free = networks::<T>(&mut rng, n, soft, 0.0);
        for (load, solver) in loads.iter().flat_map(|load| solvers.iter().map(move |s| (load, s))) {
            let found = T::solve(&free, &load.map(T::from_f64), *solver);
            assert!(found.is_err(), "{solver} {round} {found:?}");
        }
        for digits in [0.125, 0.25, 0.5] {
            let ground = soft * epsilon.powf(digits);
            let held = networks::<T>(&mut rng, n, soft, ground);
            let load = DVector::from_fn(2 * n, |i, _| if i == 1 { ground } else { 0.0 });
            // In f32 a pivot of LDLᵀ that lost half of the digits is none.
            let is_coarse = |s: &Solver| epsilon > 1e-10 && *s == Solver::SparseCholesky;
            for solver in solvers.iter().filter(|s| digits < 0.2 || !is_coarse(s)) {
                let found = T::solve(&held, &load.map(T::from_f64), *solver);
                let x = found.unwrap_or_else(|why| panic!("{solver} {round} {digits} {why:?}")).x;
                let off = |i: usize| (x[i] - T::from_f64(part(i))).to_f64().abs();
                let most = (0..2 * n).map(off).fold(0.0, f64::max);
                let limit = 100.0 * n as f64 * epsilon.powf(1.0 - digits);
                assert!(most < limit, "{solver} {round} {digits}: {most:e}");
            }
        }
    }
}

#[test]
fn every_solver_tells_what_nothing_holds_from_what_is_held_softly() {
    use Solver::{DenseLu, SparseCholesky};
    check_networks::<f32>(&[DenseLu, SparseCholesky], f32::EPSILON.into());
    check_networks::<f64>(Solver::ALL, f64::EPSILON);
    check_networks::<F64x2>(&[DenseLu, SparseCholesky], f64::EPSILON.powi(2));
}
