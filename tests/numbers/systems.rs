//! Linear systems at the edges: residuals, bounds on errors, iterations that stop, digits modulo a
//! prime, and matrices that are nearly singular.

use std::sync::atomic::{AtomicUsize, Ordering};

use dashu_int::IBig;
use dashu_ratio::RBig;
use nalgebra::{DMatrix, DVector};
use plane_contact::numbers::scalar::{Bounded, BoundedDouble, F64x2, Scalar};
use plane_contact::numbers::solve::{
    Arithmetic, Condensed, DenseCholesky, DenseCondensed, Factors, NotConverged, Precision,
    ScalarName, Singular, Solver, SparseCholesky, SparseLu, SparseSquare, SparseSymmetric,
    Unsolved, conjugate_gradients, error_bound, error_of_rest, inverse_norm, lift, refine,
    solve_dense,
};

use crate::common::tolerances::{TWO_PARTS, assert_near};

/// Makes a vector of its entries.
macro_rules! dvector {
    ($($x:expr),*) => { DVector::from_vec(vec![$($x),*]) };
}

/// The inverse of a matrix for its factors; counts what is solved.
struct Inverse {
    inverse: DMatrix<f64>,
    solved: AtomicUsize,
}

impl Inverse {
    fn from_rows(n: usize, rows: &[f64]) -> Self {
        Inverse { inverse: DMatrix::from_row_slice(n, n, rows), solved: AtomicUsize::new(0) }
    }
}

impl Factors<f64> for Inverse {
    fn solve(&self, b: &DVector<f64>) -> DVector<f64> {
        self.solved.fetch_add(1, Ordering::Relaxed);
        &self.inverse * b
    }
}

/// The product of 49 and the double next to 1/49 is half an epsilon short of 1.
#[test]
fn a_residual_is_over_the_norms_of_the_matrix_and_of_the_vectors() {
    let matrix = DMatrix::from_diagonal(&dvector![49.0, 98.0]);
    for solver in [Solver::DenseLu, Solver::SparseLu] {
        let solved = f64::solve(matrix.clone(), &dvector![1.0, 1.0], solver, None).unwrap();
        let expected = f64::EPSILON / 2.0 / (98.0 / 49.0 + 1.0);
        assert!((solved.residual / expected - 1.0).abs() < 1e-9, "{solver} {}", solved.residual);
    }
    let matrix = SparseSymmetric::new(2, [(0, 0, 2.0), (1, 0, -1.0), (1, 1, 1.0)].into_iter());
    let cholesky = SparseCholesky::new(matrix.clone()).unwrap();
    let (x, b) = (dvector![1.0, 0.0], dvector![1.0, 0.0]);
    // A x − b is (1, −1), and the norms are 3, 1 and 1.
    assert_eq!(cholesky.residual(&x, &b), 0.25);
    assert_eq!(matrix.residual(&x, &b), 0.25);
}

/// The inverse of 2 ± 1/2 is at most 2/3; the rest of 1 ± 1/8 with x = 1/2 at most 1/8 + 1/4.
#[test]
fn a_bound_follows_from_the_errors_of_the_matrix_and_of_the_load() {
    let half = Inverse::from_rows(1, &[0.5]);
    let number = Bounded::new;
    let bound = |a, b, x| {
        error_bound(&half, [(0, 0, a)].into_iter(), &dvector![b], &DVector::from_element(1, x))
    };
    let found = bound(number(2.0, 0.5), number(1.0, 0.125), 0.5);
    assert!((found - 0.25).abs() < 1e-12, "{found}");
    let exact = DVector::from_element(1, BoundedDouble::new(F64x2::from_f64(0.0), 0.0));
    assert_eq!(error_of_rest(&half, &exact, &dvector![1.0]), 0.0);
    assert_eq!(error_of_rest(&half, &exact, &dvector![2.0]), f64::INFINITY, "it may be singular");
}

/// The column sums are 5, 8 and 9: the ascent ends at the second, which the signs of its zeros led to.
#[test]
fn the_norm_of_an_inverse_is_climbed_in_as_few_solutions_as_it_takes() {
    let inverse = Inverse::from_rows(3, &[0.0, 2.0, -3.0, 2.0, 3.0, -3.0, -3.0, -3.0, -3.0]);
    assert_eq!(inverse_norm(&inverse, &dvector![1.0, 1.0, 1.0]), 8.0);
    assert_eq!(inverse.solved.into_inner(), 6);
    let inverse = Inverse::from_rows(3, &[0.0, 2.0, -3.0, 2.0, 3.0, -3.0, -3.0, -3.0, -3.0]);
    let entries = (0..3).map(|i| (i, i, Bounded::new(1.0, 1.0 / 16.0)));
    let b = DVector::from_element(3, Bounded::new(0.0, 1.0));
    let found = error_bound(&inverse, entries, &b, &DVector::zeros(3));
    assert!((found - 8.0 / (1.0 - 8.0 / 16.0)).abs() < 1e-9, "{found}");
}

/// What is orthogonal to equal loads and does not move the first equation is found by a load of
/// changing signs, 1, −4/3, 5/3 and −2.
#[test]
fn a_norm_that_the_ascent_is_blind_to_is_found() {
    let u = dvector![0.0, 1.0, -1.0, 0.0];
    let inverse = Inverse { inverse: &u * u.transpose(), solved: AtomicUsize::new(0) };
    let found = inverse_norm(&inverse, &DVector::from_element(4, 1.0));
    assert!((found - 2.0 * 6.0 / 12.0).abs() < 1e-12, "{found}");
}

#[test]
fn no_weight_is_no_norm_even_where_solutions_overflow() {
    let overflowing = Inverse::from_rows(1, &[f64::INFINITY]);
    assert_eq!(inverse_norm(&overflowing, &dvector![0.0]), 0.0);
    assert_eq!(inverse_norm(&overflowing, &DVector::zeros(0)), 0.0);
}

#[test]
fn conjugate_gradients_stop_where_they_cannot_go_on() {
    let dense = DMatrix::from_fn(10, 10, |i, j| {
        if i == j { 3.0 + i as f64 / 7.0 } else { 1.0 / (2.0 + i as f64 + j as f64) }
    });
    let matrix = SparseSymmetric::of_lower(&dense);
    let b = DVector::from_fn(10, |i, _| 1.0 / (3.0 + i as f64));
    let stopped = conjugate_gradients(&matrix, &b, 0.0, f64::EPSILON).unwrap_err();
    let Unsolved::NotConverged(stopped) = stopped else { panic!("{stopped:?}") };
    assert_eq!(stopped.iterations, 20 * 10 + 200);
    assert!(stopped.residual < 1e-15);
    let matrix = SparseSymmetric::new(2, [(0, 0, 1.0), (1, 0, -1.0), (1, 1, -1.0)].into_iter());
    let stopped = conjugate_gradients(&matrix, &dvector![1.0, 1.0], 1e-9, f64::EPSILON);
    assert_eq!(stopped, Err(Unsolved::Singular(Singular { column: 1, pivot: -1.0 })));
}

/// In each step the second unknown, which should be 0, becomes `part` of what it was.
struct Shrinking {
    part: f64,
}

impl Factors<f64> for Shrinking {
    fn solve(&self, b: &DVector<f64>) -> DVector<f64> {
        dvector![b[0], b[0] / 2.0 + b[1] * (1.0 - self.part)]
    }
}

/// The residuals are 1, 1/4, then `part` of the last one each time.
#[test]
fn a_refinement_goes_on_as_long_as_its_changes_halve() {
    let identity = SparseSymmetric::new(2, [(0, 0, 1.0), (1, 1, 1.0)].into_iter());
    let refined = |part| refine(&Shrinking { part }, &identity, &dvector![1.0, 0.0], [1e-6; 2]);
    assert_eq!(refined(0.5), Ok(dvector![1.0, 2_f64.powi(-19)]));
    assert_eq!(refined(0.75), Err(NotConverged { iterations: 2, residual: 0.1875 }));
}

/// Solves equations whose solution is known by digits modulo a prime.
fn lifted(rows: &[&[(i64, u32)]], x: &[(i64, u32)]) -> Option<Vec<RBig>> {
    let number = |(p, q): (i64, u32)| RBig::from(p) / RBig::from(q);
    let entry = |i: usize, j: usize| number(rows[i][j]);
    let n = rows.len();
    let row = |i: usize| {
        (0..n).map(|j| entry(i.max(j), i.min(j)) * number(x[j])).fold(RBig::ZERO, |sum, x| sum + x)
    };
    let b: Vec<RBig> = (0..n).map(row).collect();
    let lower = (0..n).flat_map(|j| (j..n).map(move |i| (i, j)));
    // Rational numbers are no scalars: of them a matrix is made by a map.
    let places = SparseSymmetric::new(n, lower.map(|(i, j)| (i, j, (8 * i + j) as f64)));
    let matrix = places.map(|place| entry(*place as usize / 8, *place as usize % 8));
    let solution = lift(&matrix, &b)?;
    let expected: Vec<RBig> = x.iter().map(|x| number(*x)).collect();
    assert_eq!(solution, expected);
    Some(solution)
}

#[test]
fn solutions_are_lifted_from_a_prime() {
    assert_eq!(lifted(&[], &[]), Some(vec![]));
    // The bound on the digits is met by 3, and by entries that are as large as what they are equal to.
    for (a, x) in [(1, 3), (3, 1), (1, -3), (-5, 7), (7, 0), (1, i64::MAX), (-9, i64::MIN + 1)] {
        assert!(lifted(&[&[(a, 1)]], &[(x, 1)]).is_some(), "{a} {x}");
        assert!(lifted(&[&[(a, 9)]], &[(x, 35)]).is_some(), "{a} {x}");
    }
    let rows: [&[(i64, u32)]; 3] = [
        &[(4, 3)],
        &[(-1_000_000_007, 5), (i64::MAX, 3)],
        &[(2, 7), (0, 1), (123_456_789_012, 11)],
    ];
    for x in [[(1, 2), (-1, 3), (5, 1)], [(0, 1), (-7, 1), (i64::MAX, 1_000_003)]] {
        assert!(lifted(&rows, &x).is_some(), "{x:?}");
    }
    assert_eq!(lifted(&[&[(1, 1)], &[(1, 1), (1, 1)]], &[(1, 1), (1, 1)]), None, "it is singular");
    let prime = (1 << 61) - 1;
    assert_eq!(lifted(&[&[(prime, 1)]], &[(1, 1)]), None, "it is singular modulo the prime");
}

/// Returns the rows and columns of some equations, ascending.
fn part(matrix: &SparseSymmetric, equations: &[usize]) -> SparseSymmetric {
    let place = |e: usize| equations.binary_search(&e).ok();
    let of_part = |(i, j, value)| Some((place(i)?, place(j)?, value));
    let entries: Vec<_> = matrix.entries().filter_map(of_part).collect();
    SparseSymmetric::new(equations.len(), entries.into_iter())
}

/// Condenses a matrix as one part.
pub fn condensed_to(matrix: &SparseSymmetric, kept: &[usize]) -> Option<Condensed> {
    let all = (0..matrix.size()).collect();
    Condensed::new(&[all], |equations| part(matrix, equations), kept)
}

/// The pivot of the second equation is `part` of its entry, that of the third all of it.
#[test]
fn what_little_holds_is_not_condensed() {
    let condensed = |part: f64, size: f64, kept: &[usize]| {
        let springs = [(0, 0, 1.0), (1, 0, -1.0), (1, 1, 1.0 + part), (2, 1, -part), (2, 2, 1.0)];
        let springs = springs.map(|(i, j, k)| (i, j, size * k));
        let condensed = condensed_to(&SparseSymmetric::new(3, springs.into_iter()), kept);
        condensed.map(|condensed| condensed.schur().clone())
    };
    for size in [1e-6, 1.0, 1e6] {
        assert!(condensed(1e-9, size, &[2]).is_none(), "inside, {size}");
        assert!(condensed(1e-7, size, &[2]).is_some(), "inside, {size}");
        assert!(condensed(1e-9, size, &[1]).is_none(), "of what is kept, {size}");
        let schur = condensed(1e-7, size, &[1]).expect("it is held");
        assert!((schur[(0, 0)] / (1e-7 * size) - 1.0).abs() < 1e-6, "{schur}");
    }
}

/// The second pivot is 11111111, and 1e-8 of its entry too: that is what may be left of one.
#[test]
fn a_pivot_of_the_least_part_is_not_large() {
    let condensed = |more: f64| {
        let entry = 1_111_111_100_000_000.0 + more;
        let entries = [(0, 0, 1.0), (1, 0, 33_333_333.0), (1, 1, entry), (2, 2, 1.0)];
        condensed_to(&SparseSymmetric::new(3, entries.into_iter()), &[2]).is_some()
    };
    assert_eq!([0.0, 1.0].map(condensed), [false, true]);
}

/// Compares the condensation of a matrix, and a solution by it, with elimination.
#[track_caller]
fn condensed_as_by_elimination(dense: &DMatrix<f64>, kept: &[usize]) {
    let n = dense.nrows();
    let b = DVector::from_fn(n, |i, _| (i % 11) as f64 - 4.0);
    let condensed = condensed_to(&SparseSymmetric::of_lower(dense), kept).expect("it is held");
    let inside: Vec<usize> = (0..n).filter(|e| !kept.contains(e)).collect();
    let block = |rows: &[usize], columns: &[usize]| dense.select_rows(rows).select_columns(columns);
    let factors = block(&inside, &inside).cholesky().expect("it is held");
    let joining = block(&inside, kept);
    let schur = block(kept, kept) - joining.transpose() * factors.solve(&joining);
    assert!((condensed.schur() - &schur).amax() < 1e-11);
    let eliminated = condensed.eliminate(&b);
    let left = b.select_rows(kept) - joining.transpose() * factors.solve(&b.select_rows(&inside));
    assert!((&eliminated.kept - &left).amax() < 1e-11);
    let moved = schur.cholesky().expect("it is held").solve(&eliminated.kept);
    let solution = condensed.expand(&eliminated, &moved);
    assert!((dense * solution - &b).amax() < 1e-11);
}

/// Two full blocks and equations that both reach: factors of several dense blocks. What is kept
/// stands anywhere.
#[test]
fn full_blocks_are_condensed_as_by_elimination() {
    let (n, ends) = (450, 200);
    let reaches = |block: usize, k: usize| k >= 2 * ends || k / ends == block;
    let dense = DMatrix::from_fn(n, n, |i, j| {
        let joined = (0..2).any(|block| reaches(block, i) && reaches(block, j));
        let apart = 1.0 / (1.0 + i.abs_diff(j) as f64);
        if i == j { 40.0 + (i % 7) as f64 } else { f64::from(joined) * apart }
    });
    for kept in [vec![440, 3, 190, 397, 441, 210], (0..60).map(|k| 7 * k + 1).collect()] {
        condensed_as_by_elimination(&dense, &kept);
    }
    let b = DVector::from_fn(n, |i, _| (i % 11) as f64 - 4.0);
    let cholesky = SparseCholesky::new(SparseSymmetric::of_lower(&dense)).expect("it is held");
    assert!((&dense * cholesky.solve(&b) - &b).amax() < 1e-11);
}

/// A full block, and a chain from it whose equations are all kept, in an order in which neighbours
/// stand apart.
#[test]
fn a_chain_is_kept_beside_a_full_block() {
    let (full, n) = (240, 400);
    let dense = DMatrix::from_fn(n, n, |i, j| match i.abs_diff(j) {
        0 => 40.0 + (i % 7) as f64,
        1 => 1.0,
        apart if i.max(j) < full => 1.0 / (1.0 + apart as f64),
        _ => 0.0,
    });
    let kept: Vec<usize> = (0..n - full).map(|k| full + 77 * k % (n - full)).collect();
    condensed_as_by_elimination(&dense, &kept);
}

/// Chains of springs of stiffness 1, each held at its first equation and pulled at its last one, which
/// is kept: one that is large enough to be solved beside another, and two.
#[test]
fn large_chains_are_condensed_to_their_ends() {
    for chains in [1, 2] {
        let n = 20_000 / chains;
        let springs = (0..chains).flat_map(|c| {
            let chain = (0..n).flat_map(move |k| [(k, k, if k + 1 < n { 2.0 } else { 1.0 })]);
            let chain = chain.chain((1..n).map(|k| (k, k - 1, -1.0)));
            chain.map(move |(i, j, k)| (c * n + i, c * n + j, k))
        });
        let kept: Vec<usize> = (0..chains).map(|c| (c + 1) * n - 1).collect();
        let matrix = SparseSymmetric::new(chains * n, springs);
        let parts: Vec<Vec<usize>> = (0..chains).map(|c| (c * n..(c + 1) * n).collect()).collect();
        let condensed = Condensed::new(&parts, |equations| part(&matrix, equations), &kept);
        let condensed = condensed.expect("the chains are held");
        let of_all = n as f64;
        assert!((condensed.schur()[(0, 0)] * of_all - 1.0).abs() < 1e-6);
        let eliminated = condensed.eliminate(&DVector::zeros(chains * n));
        let u = condensed.expand(&eliminated, &DVector::from_element(chains, of_all));
        assert!((0..chains * n).all(|k| (u[k] - (k % n + 1) as f64).abs() < 1e-6 * of_all));
    }
}

/// Free pairs of equations that are alike, the first and the last of nine: the first is named.
#[test]
fn of_what_moves_alike_the_first_is_named() {
    let matrix = |first: f64| {
        let diagonal = (0..9).map(move |i| (i, i, if i == 4 { first } else { 1.0 }));
        SparseSymmetric::new(9, diagonal.chain([(1, 0, -1.0), (8, 7, -1.0)]))
    };
    let singular = |first| SparseCholesky::new(matrix(first)).map(|_| ()).unwrap_err();
    assert!(singular(1.0).column < 2, "{:?}", singular(1.0));
    assert_eq!(singular(-2.0), Singular { column: 4, pivot: -2.0 });
    assert_eq!(singular(0.0), Singular { column: 4, pivot: 0.0 });
    assert_eq!(singular(f64::NAN).column, 4);
}

/// The last pivot is below 16 epsilons for each of 200 equations, which is what dense LU judges by.
#[test]
fn sparse_lu_refuses_what_dense_lu_does() {
    let factored = |pivot: f64| {
        let mut matrix = SparseSquare::zeros(200);
        (0..200).for_each(|k| matrix[(k, k)] = 1.0);
        (matrix[(198, 199)], matrix[(199, 198)]) = (-1.0, -1.0);
        matrix[(199, 199)] = 1.0 + pivot;
        (
            SparseLu::new(&matrix).is_err(),
            f64::solve(matrix.dense(), &DVector::zeros(200), Solver::DenseLu, None).is_err(),
        )
    };
    assert_eq!(factored(4e-13), (true, true));
    assert_eq!(factored(1e-12), (false, false));
}

/// Dense LU takes the second pivot, 4e-14 beside a 1, for 0: it is below 16 epsilons for each of 16
/// equations. A load moves the matrix 1e7 times as far as it is large, or 5e10 times.
#[test]
fn dense_lu_judges_only_what_loads_move_far() {
    let factored = |last: f64| {
        let mut matrix = SparseSquare::zeros(16);
        (0..16).for_each(|k| matrix[(k, k)] = 1.0);
        (matrix[(0, 1)], matrix[(1, 0)]) = (1.0, 1.0);
        (matrix[(1, 2)], matrix[(2, 1)]) = (4e-14, 4e-14);
        matrix[(2, 2)] = last;
        let dense = f64::solve(matrix.dense(), &DVector::zeros(16), Solver::DenseLu, None);
        assert!(dense.is_err(), "{last}");
        SparseLu::new(&matrix).is_ok()
    };
    assert_eq!([0.0, 4e-17].map(factored), [true, false]);
}

/// A chain that a weak spring holds at one end: dense LU would take it for singular where loads of 1
/// on each of 5,000 equations move it 6e10 times as far as a link gives way.
#[test]
fn a_large_matrix_is_singular_where_loads_move_it_too_far() {
    let chain = |spring: f64| {
        let mut matrix = SparseSquare::zeros(5000);
        (0..5000).for_each(|k| matrix[(k, k)] = 2.0);
        (1..5000).for_each(|k| (matrix[(k, k - 1)], matrix[(k - 1, k)]) = (-1.0, -1.0));
        (matrix[(0, 0)], matrix[(4999, 4999)]) = (1.0 + spring, 1.0);
        SparseLu::new(&matrix).map(|_| ())
    };
    assert_eq!([1e-4, 1e-5, 1e-6].map(chain), [Ok(()); 3]);
    for spring in [1e-8, 0.0] {
        let singular = chain(spring).expect_err("it is hardly held");
        assert!(singular.column > 2500 && singular.pivot < 1e-8, "{singular:?}");
    }
}

/// The same rows and values in the same order, but other numbers of them in each column.
#[test]
fn sparse_lu_reads_every_column() {
    let solved = |places: [(usize, usize); 4]| {
        let mut matrix = SparseSquare::zeros(3);
        places.iter().for_each(|at| matrix[*at] = 1.0);
        f64::solve_sparse(&matrix, &dvector![1.0, 2.0, 4.0]).unwrap().x
    };
    assert_eq!(solved([(0, 0), (1, 1), (2, 1), (1, 2)]), dvector![1.0, 4.0, -2.0]);
    assert_eq!(solved([(0, 0), (1, 0), (2, 1), (1, 2)]), dvector![1.0, 4.0, 1.0]);
}

#[test]
fn sparse_lu_reads_every_place_and_value() {
    let solved = |entries: [(usize, usize, f64); 2]| {
        let mut matrix = SparseSquare::zeros(2);
        entries.iter().for_each(|(i, j, a)| matrix[(*i, *j)] = *a);
        let solution = f64::solve_sparse(&matrix, &dvector![2.0, 8.0]).unwrap();
        [solution.x[0], solution.x[1]]
    };
    assert_eq!(solved([(0, 0, 2.0), (1, 1, 4.0)]), [1.0, 2.0]);
    assert_eq!(solved([(0, 0, 4.0), (1, 1, 2.0)]), [0.5, 4.0]);
    assert_eq!(solved([(1, 0, 2.0), (0, 1, 4.0)]), [4.0, 0.5]);
}

/// A pivot of 1e-40 beside a 1 would be taken for one of rounding.
#[test]
fn the_largest_pivot_of_a_column_is_taken() {
    let matrix = DMatrix::from_row_slice(2, 2, &[1e-40, 1.0, 1.0, 0.0]).map(F64x2::from_f64);
    let b = dvector![3.0, 2.0].map(F64x2::from_f64);
    let solved = F64x2::solve(matrix, &b, Solver::DenseLu, None).unwrap();
    assert_eq!([solved.x[0].to_f64(), solved.x[1].to_f64()], [2.0, 3.0]);
}

/// What the first row says of the first unknown is exact; the second one would round it.
#[test]
fn of_pivots_of_one_size_the_first_is_taken() {
    let number = F64x2::from_f64;
    for d in 3..20 {
        let part = number(1.0) / number(f64::from(d));
        let matrix = DMatrix::from_row_slice(2, 2, &[number(1.0), number(0.0), number(1.0), part]);
        let b = dvector![number(1.0), number(1e10) / number(7.0)];
        let solved = F64x2::solve(matrix, &b, Solver::DenseLu, None).unwrap();
        assert_eq!(solved.x[0], number(1.0), "{d}");
    }
}

/// Its size as an `f64` is infinite.
#[test]
fn an_exact_number_beyond_every_float_is_a_pivot() {
    let large = RBig::from(IBig::from(10).pow(600));
    let solved = solve_dense(|_, _| large.clone(), vec![&large * &large]);
    assert_eq!(solved, Ok(vec![large]));
}

#[test]
fn a_column_of_zeros_is_singular_in_double_doubles() {
    let matrix = DMatrix::from_diagonal(&dvector![1.0, 0.0, 2.0]).map(F64x2::from_f64);
    let b = DVector::from_element(3, F64x2::from_f64(1.0));
    for solver in [Solver::DenseLu, Solver::SparseCholesky] {
        let unsolved = F64x2::solve(matrix.clone(), &b, solver, None).map(|_| ()).unwrap_err();
        assert_eq!(unsolved, Unsolved::Singular(Singular { column: 1, pivot: 0.0 }), "{solver}");
    }
}

/// Nothing holds the direction of the load.
#[test]
fn factors_and_iterations_tell_a_singular_matrix() {
    let matrix = DMatrix::from_row_slice(2, 2, &[1.0, -1.0, -1.0, 1.0]);
    let unsolved = |solver| {
        f64::solve(matrix.clone(), &dvector![1.0, 1.0], solver, None).map(|_| ()).unwrap_err()
    };
    for solver in [Solver::SparseCholesky, Solver::Refined, Solver::Cg] {
        assert!(matches!(unsolved(solver), Unsolved::Singular(_)), "{solver}");
    }
}

/// In a column of numbers of 2^20, or of its inverse, so is the pivot that counts as 0.
#[test]
fn a_pivot_is_measured_by_its_column() {
    let solved = |epsilons: f64, size: f64| {
        let mut matrix = DMatrix::from_diagonal_element(4, 4, F64x2::from_f64(1.0));
        matrix[(0, 3)] = F64x2::from_f64(size);
        matrix[(3, 3)] = F64x2::from_f64(epsilons * f64::EPSILON * f64::EPSILON * size);
        F64x2::solve(matrix, &DVector::zeros(4), Solver::DenseLu, None)
    };
    for size in [2_f64.powi(20), 2_f64.powi(-20)] {
        let column = |unsolved| matches!(unsolved, Unsolved::Singular(Singular { column: 3, .. }));
        assert!(solved(60.0, size).is_err_and(column), "{size}");
        assert!(solved(70.0, size).is_ok(), "{size}");
    }
}

#[test]
fn a_last_equation_without_entries_has_no_diagonal() {
    let matrix = SparseSymmetric::new(3, [(0, 0, 1.0), (1, 0, 2.0)].into_iter());
    assert_eq!(matrix.diagonal(), dvector![1.0, 0.0, 0.0]);
    let raised: Vec<_> = matrix.with_diagonal(0.5).entries().collect();
    assert_eq!(raised, [(0, 0, 1.5), (1, 0, 2.0)]);
}

#[test]
fn only_plain_doubles_are_the_default() {
    let default = Arithmetic::default();
    assert!(default.is_default());
    assert!(!Arithmetic { scalar: ScalarName::F32, ..default }.is_default());
    assert!(!Arithmetic { solver: Some(Solver::SparseCholesky), ..default }.is_default());
    assert!(!Arithmetic { tol: Some(1e-9), ..default }.is_default());
}

/// Condensed to its last equations, and these solved, a system has the solution that it has whole: of
/// more columns than are computed together, of few, and without first or last ones.
#[test]
fn a_dense_system_is_solved_in_two_parts() {
    for (first, last) in [(130, 300), (300, 130), (3, 2), (1, 64), (0, 5), (5, 0)] {
        let n = first + last;
        let entry = |i: usize, j: usize| ((i * j + i + j) % 11) as f64 / 11.0;
        let matrix = DMatrix::from_fn(n, n, |i, j| match i == j {
            true => n as f64 + i as f64,
            false => entry(i.max(j), i.min(j)),
        });
        // Above the diagonal nothing is read.
        let read = DMatrix::from_fn(n, n, |i, j| if i < j { f64::NAN } else { matrix[(i, j)] });
        let expected = DVector::from_fn(n, |i, _| (i as f64 * 0.7).sin());
        let b = &matrix * &expected;
        let condensed = DenseCondensed::new(&read, first).expect("it is positive definite");
        let part = |from: usize, count: usize| b.rows(from, count).into_owned();
        let [z, left] = condensed.eliminate(part(0, first), part(first, last));
        let schur = condensed.schur().view((0, 0), (last, last)).into_owned();
        let own = DenseCholesky::new(&schur).expect("so is what is left").solve(&left);
        let found = condensed.expand(z, &own);
        for (x, expected) in found.iter().chain(&own).zip(&expected) {
            assert_near("solution", *x, *expected, 1.0, &TWO_PARTS);
        }
    }
    let indefinite = DMatrix::from_diagonal(&DVector::from_vec(vec![1.0, -1.0, 1.0]));
    assert!(DenseCondensed::new(&indefinite, 1).is_some());
    assert!(DenseCondensed::new(&indefinite, 2).is_none());
}
