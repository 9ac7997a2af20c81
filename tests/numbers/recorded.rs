//! What the scalars and the solvers make of random numbers, recorded: of every operation the value, its
//! digits and its bound, to the last bit that is printed.

use std::fmt::Write;

use fastrand::Rng;
use nalgebra::{DMatrix, DVector};
use plane_contact::memory;
use plane_contact::numbers::scalar::{
    Bounded, BoundedDouble, Exact, F64x2, Rounded, Scalar, WithBound, compared, scope,
};
use plane_contact::numbers::solve::{
    Arithmetic, FactorSize, Inputs, Pattern, Precision, ScalarName, Solver, SparseCholesky,
    SparseSquare, SparseSymmetric, cost, inverse_norm,
};

use crate::common::recorded::{RECORDED_SOLVERS, assert_recorded, assert_recorded_exactly};

/// Numbers at which operations turn, beside random ones.
const SPECIAL: [f64; 14] = [
    0.0,
    -0.0,
    1.0,
    -3.0,
    0.1,
    1e15,
    1e16,
    4e-290,
    3e-160,
    7e180,
    -2e300,
    5e-324,
    0.75,
    1.0 + f64::EPSILON,
];

fn text<T: Scalar>(x: T) -> String {
    let value = x.to_f64();
    let mut text = if value.abs() < 1e16 && value.fract() == 0.0 {
        format!("{value}")
    } else {
        format!("{value:.9e}")
    };
    let digits = x.digits().filter(|digits| digits.len() > 17);
    digits.iter().for_each(|digits| write!(text, " {digits}").expect("room"));
    let bound = x.error_bound().filter(|bound| *bound != 0.0);
    bound.iter().for_each(|bound| write!(text, " ±{bound:.5e}").expect("room"));
    text
}

/// Writes what every operation makes of some numbers.
fn operations<T: Scalar>(name: &str, rng: &mut Rng, out: &mut String) {
    let random = |rng: &mut Rng| (rng.f64() - 0.5) * 10_f64.powi(rng.i32(-6..7));
    for round in 0..24 {
        let mut draw =
            || if rng.u8(..3) == 0 { SPECIAL[rng.usize(..SPECIAL.len())] } else { random(rng) };
        let raw = [draw(), draw(), draw()];
        let [a, b, c] =
            if round % 2 == 0 { raw.map(T::from_f64) } else { raw.map(T::from_decimal) };
        // Numbers that carry errors.
        let (x, y, z) = (
            a / T::from_f64(3.0),
            a * b - c,
            if round % 5 == 0 { a } else { b / T::from_f64(7.0) },
        );
        let values = [
            ("x", x),
            ("y", y),
            ("z", z),
            ("x+y", x + y),
            ("x-y", x - y),
            ("x*y", x * y),
            ("x/y", x / y),
            ("y/z", y / z),
            ("-x", -x),
            ("|y|", Scalar::abs(y)),
            ("min", Scalar::min(x, z)),
            ("max", Scalar::max(y, z)),
            ("root", Scalar::abs(x).root()),
            ("length", T::length(x, y)),
            ("short", T::length(z, z)),
            ("side", T::orientation([x, y], [z, x], [y, z])),
            ("scale", T::scale(Scalar::abs(z))),
        ];
        writeln!(out, "{name} {raw:?}").expect("room");
        for (what, value) in values {
            writeln!(out, "  {what} {}", text(value)).expect("room");
        }
        let (shared, over) = T::over_common(vec![x, y, z]);
        let shared: Vec<String> = shared.into_iter().map(text).collect();
        let comparisons =
            || [x < y, x <= z, y > z, y == z, x.same(y), x.same(x), Scalar::is_finite(x / y)];
        let (found, unsure) = compared(comparisons);
        writeln!(out, "  hypot {:.9e} {:.9e}", Scalar::hypot(x, y), Scalar::hypot(z, T::zero()))
            .expect("room");
        writeln!(out, "  common {shared:?} / {}", text(over)).expect("room");
        writeln!(out, "  {found:?} unsure {}", unsure.len()).expect("room");
        for unsure in unsure {
            writeln!(out, "    {:.6e} {:.6e}", unsure.margin, unsure.bound).expect("room");
        }
    }
}

#[test]
fn operations_of_every_scalar() {
    let mut out = String::new();
    let mut rng = Rng::with_seed(11);
    operations::<f32>("f32", &mut rng, &mut out);
    operations::<f64>("f64", &mut rng, &mut out);
    operations::<F64x2>("f64x2", &mut rng, &mut out);
    operations::<Bounded>("f64-bounded", &mut rng, &mut out);
    operations::<BoundedDouble>("f64x2-bounded", &mut rng, &mut out);
    scope(|| operations::<Exact>("exact", &mut rng, &mut out));
    // IEEE 754 rounds the same everywhere.
    assert_recorded_exactly("scalars", &out);
}

/// Springs between neighbours of a grid, its first row held by the ground; `shift` off the diagonal
/// above it.
fn springs(rng: &mut Rng, columns: usize, rows: usize, shift: f64) -> DMatrix<f64> {
    let n = columns * rows;
    let mut matrix = DMatrix::zeros(n, n);
    let mut join = |i: usize, j: usize, stiffness: f64| {
        for (row, column, sign) in [(i, i, 1.0), (j, j, 1.0), (i, j, -1.0), (j, i, -1.0)] {
            matrix[(row, column)] += sign * stiffness;
        }
    };
    for i in 0..n {
        if (i + 1) % columns != 0 {
            join(i, i + 1, 1.0 + rng.f64());
        }
        if i + columns < n {
            join(i, i + columns, 10.0 * rng.f64() + 0.1);
        }
    }
    (0..columns).for_each(|i| matrix[(i, i)] += 5.0);
    (1..n).for_each(|i| matrix[(i - 1, i)] += shift);
    matrix
}

/// Writes a number that a library computed, in `f32` and of bounds the first digit or two.
fn rounded<T: Scalar>(scalar: ScalarName, x: T) -> String {
    match scalar {
        ScalarName::F32 => format!(" ~{:.2e}", x.to_f64()),
        _ => format!(" {}", text(x).replace('±', "~")),
    }
}

/// Writes the solutions of equations by every solver that is offered.
fn solutions<T: Precision>(scalar: ScalarName, out: &mut String) {
    let mut rng = Rng::with_seed(12);
    for (round, solver) in
        (0..4).flat_map(|round| RECORDED_SOLVERS.iter().map(move |solver| (round, *solver)))
    {
        let asked = Arithmetic { scalar, solver: Some(solver), inputs: Inputs::default() };
        // Rounding decides whether a library's factors show that the last of them is singular.
        let is_rounded = matches!(scalar, ScalarName::F32 | ScalarName::F64 | ScalarName::Bounded);
        if asked.check().is_err() || is_rounded && round == 3 {
            continue;
        }
        let is_lu = matches!(solver, Solver::DenseLu | Solver::SparseLu);
        let matrix = springs(&mut rng, 2 + round, 3, if is_lu { 0.3 } else { 0.0 });
        let n = matrix.nrows();
        // Nothing holds the last of them.
        let held = |i: usize, j: usize| if round == 3 && i == j && i < 5 { 5.0 } else { 0.0 };
        let matrix = DMatrix::from_fn(n, n, |i, j| {
            T::from_f64(matrix[(i, j)] - held(i, j)) / T::from_f64(3.0)
        });
        let b = DVector::from_fn(n, |i, _| T::from_f64(rng.f64() - 0.3 * (i % 2) as f64));
        let solved = T::sweep(|| T::solve(&SparseSquare::from_dense(&matrix), &b, solver));
        let found = match solved {
            Ok(solved) => solved.x.iter().map(|x| rounded(scalar, *x)).collect(),
            Err(why) => format!(" {why:?}"),
        };
        writeln!(out, "{scalar} {solver} {n}:{found}").expect("room");
    }
}

#[test]
fn equations_by_every_solver() {
    let mut out = String::new();
    solutions::<f32>(ScalarName::F32, &mut out);
    solutions::<f64>(ScalarName::F64, &mut out);
    solutions::<F64x2>(ScalarName::F64x2, &mut out);
    solutions::<Bounded>(ScalarName::Bounded, &mut out);
    solutions::<BoundedDouble>(ScalarName::BoundedDouble, &mut out);
    scope(|| solutions::<Exact>(ScalarName::Exact, &mut out));
    assert_recorded("equations", &out);
}

#[test]
fn sparse_matrices() {
    let mut out = String::new();
    let mut rng = Rng::with_seed(13);
    for (columns, rows) in [(1, 4), (3, 3), (4, 5), (9, 7)] {
        let dense = springs(&mut rng, columns, rows, 0.0);
        let n = dense.nrows();
        let matrix = SparseSymmetric::of_lower(&dense);
        let b = DVector::from_fn(n, |_, _| rng.f64());
        let sum = |v: &DVector<f64>| v.iter().zip(1..).map(|(x, k)| x * f64::from(k)).sum::<f64>();
        let factors = SparseCholesky::new(matrix.clone()).expect("it is held");
        let diagonal = matrix.diagonal();
        let square = SparseSquare::from_dense(&dense);
        let places: f64 = square
            .entries()
            .zip(1..)
            .map(|((i, j, x), k)| x * f64::from(k) + (i + 3 * j) as f64)
            .sum();
        writeln!(
            out,
            "{n}: times {:.9e} solve {:.9e} diagonal {:.9e} norm {:.9e} shifted {:.9e} inverse {:.9e} \
             square {:.9e} {:.9e}",
            sum(&matrix.times(&b)), sum(&factors.solve(&b)), sum(&diagonal), matrix.norm(),
            matrix.with_diagonal(0.25).norm(), inverse_norm(&factors, &b),
            places, sum(&(square.map(|x| 2.0 * x).dense() * &b)),
        )
        .expect("room");
        let pattern = Pattern::new(n, |visit| matrix.entries().for_each(|(i, j, _)| visit(i, j)));
        let size = FactorSize::sparse_cholesky(&pattern);
        writeln!(out, "  {size:?} {:?} {:?}", size.as_lu(), FactorSize::dense_lu(n)).expect("room");
    }
    for (n, growing, iterations) in
        [(5, false, 1), (40, true, 3), (300, false, 20), (120, true, 20)]
    {
        let seconds = cost::seconds(n, growing, iterations);
        let judged = cost::check(n, growing, iterations).err().map(|why| why.to_string());
        let memory = memory::check(n, iterations, Some(1 << 20)).err().map(|why| why.to_string());
        writeln!(
            out,
            "{n} {growing} {iterations}: {seconds:.9e} {judged:?} {} {memory:?}",
            memory::needed(n, iterations)
        )
        .expect("room");
    }
    assert_recorded("matrices", &out);
}

fn of_two<V: Rounded>(x: WithBound<V>, y: WithBound<V>) -> [WithBound<V>; 6] {
    [x + y, x - y, x * y, x / y, Scalar::abs(x).root(), Scalar::length(x, y)]
}

/// Numbers with bounds that were given.
#[test]
fn bounds() {
    let mut out = String::new();
    let mut rng = Rng::with_seed(14);
    for _ in 0..60 {
        let mut draw = || {
            let value = (rng.f64() - 0.5) * 10_f64.powi(rng.i32(-3..4));
            let error =
                rng.choice([0.0, 1e-12, 0.01, 0.5, f64::INFINITY, f64::NAN]).unwrap_or_default();
            (value, error * f64::abs(value))
        };
        let ((x, ex), (y, ey)) = (draw(), draw());
        let (single, double) = (WithBound::new(x, ex), WithBound::new(F64x2::from_f64(x), ex));
        let (other, wide) = (WithBound::new(y, ey), WithBound::new(F64x2::from_f64(y), ey));
        writeln!(out, "{x:.6e} ±{ex:.6e} {y:.6e} ±{ey:.6e}").expect("room");
        for z in of_two(single, other) {
            writeln!(out, "  {} off {:.5e} double {}", text(z), z.off(), text(z.in_double()))
                .expect("room");
        }
        for z in of_two(double, wide) {
            writeln!(out, "  {} off {:.5e}", text(z), z.off()).expect("room");
        }
        let (_, unsure) = compared(|| [single < other, single == other, double > wide]);
        writeln!(out, "  {unsure:?}").expect("room");
    }
    assert_recorded_exactly("bounds", &out);
}
