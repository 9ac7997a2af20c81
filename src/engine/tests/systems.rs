//! Linear systems at the edges: residuals, norms of inverses, and matrices that are nearly singular.

use std::sync::atomic::{AtomicUsize, Ordering};

use dashu_int::IBig;
use dashu_ratio::RBig;
use engine::linear::{
    Arithmetic, Factors, Precision, ScalarName, Schur, Singular, Solver, SparseCholesky, SparseLu,
    SparseSymmetric, inverse_norm, solve_dense,
};
use nalgebra::{DMatrix, DVector};
use numbers::scalar::{Exact, F64x2, Scalar, scope};
use numbers::square::SparseSquare;

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

impl Factors for Inverse {
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
        let solved =
            f64::solve(&SparseSquare::from_dense(&matrix), &dvector![1.0, 1.0], solver).unwrap();
        let expected = f64::EPSILON / 2.0 / (98.0 / 49.0 + 1.0);
        assert!((solved.residual / expected - 1.0).abs() < 1e-9, "{solver} {}", solved.residual);
    }
    let matrix = SparseSymmetric::new(2, [(0, 0, 2.0), (1, 0, -1.0), (1, 1, 1.0)].into_iter());
    let (x, b) = (dvector![1.0, 0.0], dvector![1.0, 0.0]);
    // A x − b is (1, −1), and the norms are 3, 1 and 1.
    assert_eq!(matrix.residual(&x, &b), 0.25);
}

/// The column sums are 5, 8 and 9: the ascent ends at the second, which the signs of its zeros led to.
#[test]
fn the_norm_of_an_inverse_is_climbed_in_as_few_solutions_as_it_takes() {
    let inverse = Inverse::from_rows(3, &[0.0, 2.0, -3.0, 2.0, 3.0, -3.0, -3.0, -3.0, -3.0]);
    assert_eq!(inverse_norm(&inverse, &dvector![1.0, 1.0, 1.0]), 8.0);
    assert_eq!(inverse.solved.into_inner(), 6);
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

/// The pivot of the second equation is `part` of its entry, that of the third all of it.
#[test]
fn what_little_holds_is_not_reduced() {
    let reduced = |part: f64, size: f64, last: &[usize]| {
        let springs = [(0, 0, 1.0), (1, 0, -1.0), (1, 1, 1.0 + part), (2, 1, -part), (2, 2, 1.0)];
        let springs = springs.map(|(i, j, k)| (i, j, size * k));
        let schur = Schur::new(SparseSymmetric::new(3, springs.into_iter()), last.to_vec());
        schur.map(|schur| schur.complement().clone())
    };
    for size in [1e-6, 1.0, 1e6] {
        assert!(reduced(1e-9, size, &[2]).is_none(), "of the first, {size}");
        assert!(reduced(1e-7, size, &[2]).is_some(), "of the first, {size}");
        assert!(reduced(1e-9, size, &[1]).is_none(), "of the last, {size}");
        let schur = reduced(1e-7, size, &[1]).expect("it is held");
        assert!((schur[(0, 0)] / (1e-7 * size) - 1.0).abs() < 1e-6, "{schur}");
    }
}

/// Returns the lower triangle of a dense matrix, zeros left out.
pub fn lower(matrix: &DMatrix<f64>) -> SparseSymmetric {
    let n = matrix.nrows();
    let entries = (0..n * n).map(|k| (k % n, k / n, matrix[k]));
    SparseSymmetric::new(n, entries.filter(|(.., value)| *value != 0.0))
}

/// Compares what is left of a matrix on its last equations, and a solution by it, with elimination.
#[track_caller]
fn reduced_as_by_elimination(dense: &DMatrix<f64>, last: &[usize]) {
    let n = dense.nrows();
    let b = DVector::from_fn(n, |i, _| (i % 11) as f64 - 4.0);
    let reduced = Schur::new(lower(dense), last.to_vec()).expect("it is held");
    let first: Vec<usize> = (0..n).filter(|e| !last.contains(e)).collect();
    let block = |rows: &[usize], columns: &[usize]| dense.select_rows(rows).select_columns(columns);
    let factors = block(&first, &first).cholesky().expect("it is held");
    let joining = block(&first, last);
    let schur = block(last, last) - joining.transpose() * factors.solve(&joining);
    assert!((reduced.complement() - &schur).amax() < 1e-11);
    let eliminated = reduced.eliminate(&b);
    let left = b.select_rows(last) - joining.transpose() * factors.solve(&b.select_rows(&first));
    assert!((&eliminated.last - &left).amax() < 1e-11);
    let moved = schur.cholesky().expect("it is held").solve(&eliminated.last);
    assert!((dense * reduced.expand(&eliminated, &moved) - &b).amax() < 1e-11);
}

/// Two full blocks and equations that both reach: factors of several dense blocks. The last equations
/// stand anywhere.
#[test]
fn full_blocks_are_reduced_as_by_elimination() {
    let (n, ends) = (450, 200);
    let reaches = |block: usize, k: usize| k >= 2 * ends || k / ends == block;
    let dense = DMatrix::from_fn(n, n, |i, j| {
        let joined = (0..2).any(|block| reaches(block, i) && reaches(block, j));
        let apart = 1.0 / (1.0 + i.abs_diff(j) as f64);
        if i == j { 40.0 + (i % 7) as f64 } else { f64::from(joined) * apart }
    });
    for last in [vec![440, 3, 190, 397, 441, 210], (0..60).map(|k| 7 * k + 1).collect()] {
        reduced_as_by_elimination(&dense, &last);
    }
}

/// A chain from a full block, all of whose equations are the last ones, in an order in which neighbours
/// stand apart.
#[test]
fn a_chain_beside_a_full_block_is_what_is_left() {
    let (full, n) = (240, 400);
    let dense = DMatrix::from_fn(n, n, |i, j| match i.abs_diff(j) {
        0 => 40.0 + (i % 7) as f64,
        1 => 1.0,
        apart if i.max(j) < full => 1.0 / (1.0 + apart as f64),
        _ => 0.0,
    });
    let last: Vec<usize> = (0..n - full).map(|k| full + 77 * k % (n - full)).collect();
    reduced_as_by_elimination(&dense, &last);
}

/// Free pairs of equations that are alike, the first and the last of nine: the first is named.
#[test]
fn of_what_moves_alike_the_first_is_named() {
    let matrix = |first: f64| {
        let diagonal = (0..9).map(move |i| (i, i, if i == 4 { first } else { 1.0 }));
        SparseSymmetric::new(9, diagonal.chain([(1, 0, -1.0), (8, 7, -1.0)]))
    };
    let singular = |first| SparseCholesky::new(&matrix(first)).map(|_| ()).unwrap_err();
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
            f64::solve(&matrix, &DVector::zeros(200), Solver::DenseLu).is_err(),
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
        let dense = f64::solve(&matrix, &DVector::zeros(16), Solver::DenseLu);
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
        f64::solve(&matrix, &dvector![1.0, 2.0, 4.0], Solver::SparseLu).unwrap().x
    };
    assert_eq!(solved([(0, 0), (1, 1), (2, 1), (1, 2)]), dvector![1.0, 4.0, -2.0]);
    assert_eq!(solved([(0, 0), (1, 0), (2, 1), (1, 2)]), dvector![1.0, 4.0, 1.0]);
}

#[test]
fn sparse_lu_reads_every_place_and_value() {
    let solved = |entries: [(usize, usize, f64); 2]| {
        let mut matrix = SparseSquare::zeros(2);
        entries.iter().for_each(|(i, j, a)| matrix[(*i, *j)] = *a);
        let solution = f64::solve(&matrix, &dvector![2.0, 8.0], Solver::SparseLu).unwrap();
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
    let solved = F64x2::solve(&SparseSquare::from_dense(&matrix), &b, Solver::DenseLu).unwrap();
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
        let solved = F64x2::solve(&SparseSquare::from_dense(&matrix), &b, Solver::DenseLu).unwrap();
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
        let solved = F64x2::solve(&SparseSquare::from_dense(&matrix), &b, solver);
        assert_eq!(solved.unwrap_err(), Singular { column: 1, pivot: 0.0 }, "{solver}");
    }
}

/// Two springs in a row that nothing holds.
#[test]
fn factors_tell_a_singular_matrix() {
    fn check<T: Precision>(solvers: &[Solver]) {
        let matrix = [1.0, -1.0, 0.0, -1.0, 2.0, -1.0, 0.0, -1.0, 1.0].map(T::from_f64);
        let matrix = SparseSquare::from_dense(&DMatrix::from_row_slice(3, 3, &matrix));
        for solver in solvers {
            let b = DVector::from_fn(3, |i, _| T::from_f64(f64::from(i == 2)));
            assert!(T::solve(&matrix, &b, *solver).is_err(), "{solver}");
        }
    }
    check::<f64>(Solver::ALL);
    check::<f32>(&[Solver::DenseLu, Solver::SparseCholesky]);
    check::<F64x2>(&[Solver::DenseLu, Solver::SparseCholesky]);
    scope(|| check::<Exact>(&[Solver::DenseLu, Solver::SparseCholesky]));
}

/// Less than 16 epsilons for each of four equations count as 0: in a column of numbers of 2^20, or of its inverse, beside
/// as large numbers.
#[test]
fn a_pivot_is_measured_by_its_column() {
    let solved = |epsilons: f64, size: f64| {
        let mut matrix = DMatrix::from_diagonal_element(4, 4, F64x2::from_f64(1.0));
        matrix[(0, 3)] = F64x2::from_f64(size);
        matrix[(3, 3)] = F64x2::from_f64(epsilons * f64::EPSILON * f64::EPSILON * size);
        F64x2::solve(&SparseSquare::from_dense(&matrix), &DVector::zeros(4), Solver::DenseLu)
    };
    for size in [1.0, 2_f64.powi(20), 2_f64.powi(-20)] {
        assert!(solved(60.0, size).is_err_and(|why| why.column == 3), "{size}");
        assert!(solved(70.0, size).is_ok(), "{size}");
    }
}

#[test]
fn a_last_equation_without_entries_has_no_diagonal() {
    let matrix = SparseSymmetric::new(3, [(0, 0, 1.0), (1, 0, 2.0)].into_iter());
    assert_eq!(matrix.diagonal(), dvector![1.0, 0.0, 0.0]);
    let raised: Vec<_> = matrix.softly_held().entries().collect();
    assert_eq!(raised, [(0, 0, 1.0 + 1e-10), (1, 0, 2.0)]);
}

#[test]
fn only_plain_doubles_are_the_default() {
    let default = Arithmetic::default();
    assert!(default.is_default());
    assert!(!Arithmetic { scalar: ScalarName::F32, ..default }.is_default());
    assert!(!Arithmetic { solver: Some(Solver::SparseCholesky), ..default }.is_default());
}
