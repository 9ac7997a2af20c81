//! What functions make of matrices: parts, joins, lengths, determinants, systems of equations.

use super::arithmetic::{finite, kind, sum};
use super::failure::{Cause, Subscripts};
use super::value::{Array, Grid, Value};
use nalgebra::DMatrix;
use nalgebra::linalg::{Schur, SymmetricEigen};

/// The numbers that an elimination works through in the time of a statement.
const NUMBERS_A_STEP: u64 = 16;

/// The rows of a system beyond which only entries that are not 0 are eliminated, in an order in which
/// they stay few: the 2,328 equations of `audit strand --prices` take 20 ms by them, and 350 ms by
/// [`factor`]; the whole command 36 s and 103 s. Up to there the page's interpreter has the same bits.
#[cfg(feature = "sparse")]
const DENSE: usize = 500;

/// Returns the steps that the elimination of a matrix of n rows takes: about n³/3 products, of which
/// many take the time of one statement, and a number for each entry.
pub fn steps(matrix: &Value) -> u64 {
    let n = matrix.size().0 as u64;
    n.saturating_mul(n).saturating_mul(1 + n / (3 * NUMBERS_A_STEP))
}

/// Returns the magnitude of a number, the length of a column or the determinant of a square matrix.
/// ```
/// assert_eq!(plane_contact_mathcad::evaluate("(|−2|   |(3; 4)|   |(1 2; 3 4)|)").unwrap().to_string(), "2 5 -2");
/// ```
pub fn magnitude(value: &Value) -> Result<Value, Cause> {
    match value {
        Value::Number(x) => Ok(Value::Number(x.abs())),
        Value::Array(a) if a.cols() == 1 => {
            finite(sum(a.entries().map(|x| x * x)).sqrt()).map(Value::Number)
        }
        Value::Array(_) => determinant(value),
        other => Err(kind("a number or an array", other)),
    }
}

/// Returns the determinant of a square matrix.
/// ```
/// assert_eq!(plane_contact_mathcad::evaluate("determinant((2 1; 1 3))").unwrap().to_string(), "5");
/// ```
pub fn determinant(value: &Value) -> Result<Value, Cause> {
    let a = square(value)?;
    let determinant = match a.rows() {
        2 => a.at(0, 0) * a.at(1, 1) - a.at(0, 1) * a.at(1, 0),
        _ => {
            let (rows, _, sign) = factor(a);
            rows.iter().enumerate().fold(sign, |product, (k, row)| product * row[k])
        }
    };
    finite(determinant).map(Value::Number)
}

/// Returns the solution of `a`·x = `b` by elimination with row pivots.
///
/// # Errors
/// The sizes do not match, or the matrix is singular.
/// ```
/// assert_eq!(plane_contact_mathcad::evaluate("lsolve((2 1; 1 3), (5; 10))").unwrap().to_string(), "1; 3");
/// ```
pub fn lsolve(a: &Value, b: &Value) -> Result<Value, Cause> {
    let (Value::Array(a), Value::Array(b)) = (a, b) else {
        return Err(kind("a square matrix and a column", if a.number().is_some() { a } else { b }));
    };
    let n = a.rows();
    if n != a.cols() || n != b.rows() || b.cols() != 1 {
        return Err(Cause::sizes("lsolve", a.size(), b.size()));
    }
    #[cfg(feature = "sparse")]
    if n > DENSE {
        let x = numbers::sparse_lu::solved(&a.sparse(), numbers(b)).ok_or(Cause::Singular)?;
        let x = x.into_iter().map(finite).collect::<Result<Vec<_>, _>>()?;
        return Ok(Array::column(x).into());
    }
    substituted(&factor(a), &numbers(b)).map(|x| Array::column(x).into())
}

/// Returns the inverse of a square matrix L·U, as LAPACK's `getri` does: that of U, from which the columns of
/// X·L = U^−1 follow, the last one first.
/// ```
/// assert_eq!(plane_contact_mathcad::evaluate("(2 0; 0 4)^−1").unwrap().to_string(), "0.5 0; 0 0.25");
/// ```
pub fn inverse(value: &Value) -> Result<Value, Cause> {
    let a = square(value)?;
    let n = a.rows();
    let (rows, order, _) = factor(a);
    let mut x = vec![vec![0.0; n]; n];
    for j in 0..n {
        if finite(rows[j][j])? == 0.0 {
            return Err(Cause::Singular);
        }
        let reciprocal = 1.0 / rows[j][j];
        for (i, row) in x[..j].iter_mut().enumerate() {
            row[j] = 0.0 - reciprocal * sum((i..j).map(|k| row[k] * rows[k][j]));
        }
        x[j][j] = reciprocal;
    }
    for j in (0..n).rev() {
        for row in &mut x {
            row[j] -= sum((j + 1..n).map(|k| row[k] * rows[k][j]));
        }
    }
    x.iter().flatten().try_for_each(|x| finite(*x).map(drop))?;
    let mut places = vec![0; n];
    order.iter().enumerate().for_each(|(k, &j)| places[j] = k);
    Ok(Array::from_fn(n, n, |i, j| x[i][places[j]]).into())
}

fn numbers(array: &Array) -> Vec<f64> {
    array.entries().copied().collect()
}

fn square(value: &Value) -> Result<&Array, Cause> {
    match value {
        Value::Array(a) if a.rows() == a.cols() && a.rows() > 0 => Ok(a),
        _ => Err(kind("a square matrix", value)),
    }
}

/// Solves the equations of a factored matrix for one right side.
fn substituted((rows, order, _): &Factors, b: &[f64]) -> Result<Vec<f64>, Cause> {
    let n = order.len();
    let mut x: Vec<f64> = order.iter().map(|&i| b[i]).collect();
    for k in 0..n {
        x[k] -= sum((0..k).map(|j| rows[k][j] * x[j]));
    }
    for k in (0..n).rev() {
        if finite(rows[k][k])? == 0.0 {
            return Err(Cause::Singular);
        }
        let known = sum((k + 1..n).map(|j| rows[k][j] * x[j]));
        x[k] = finite(over_pivot(x[k] - known, rows[k][k]))?;
    }
    Ok(x)
}

/// Divides by a pivot as LAPACK does: times its reciprocal, where that is a number.
fn over_pivot(x: f64, pivot: f64) -> f64 {
    let reciprocal = 1.0 / pivot;
    if reciprocal.is_finite() { x * reciprocal } else { x / pivot }
}

/// The rows of an eliminated matrix in the order in which they are pivots, each the largest of its column,
/// with the factors left of the pivot; their places before; and the sign of that order.
type Factors = (Vec<Vec<f64>>, Vec<usize>, f64);

/// Factors a square matrix by elimination; the products of an entry are added up before they are subtracted
/// from it.
fn factor(a: &Array) -> Factors {
    let n = a.rows();
    let mut rows: Vec<Vec<f64>> = (0..n).map(|i| (0..n).map(|j| *a.at(i, j)).collect()).collect();
    let mut sums = vec![vec![0.0; n]; n];
    let (mut order, mut sign): (Vec<usize>, _) = ((0..n).collect(), 1.0);
    for k in 0..n {
        rows[k..].iter_mut().zip(&sums[k..]).for_each(|(row, sums)| row[k] -= sums[k]);
        let size = |at: usize| rows[at][k].abs();
        let largest = (k + 1..n).fold(k, |best, at| if size(at) > size(best) { at } else { best });
        if largest != k {
            rows.swap(k, largest);
            sums.swap(k, largest);
            order.swap(k, largest);
            sign = -sign;
        }
        let (pivot, below) = rows[k..].split_first_mut().expect("there is a row k");
        pivot.iter_mut().zip(&sums[k]).skip(k + 1).for_each(|(x, sum)| *x -= sum);
        for (row, sums) in below.iter_mut().zip(&mut sums[k + 1..]) {
            // Most rows of a stiffness matrix have no entry there: `audit strand --prices` takes 38 s with
            // this line, and 341 s without it to the same bytes. Without a pivot all have none.
            if row[k] == 0.0 {
                continue;
            }
            row[k] = over_pivot(row[k], pivot[k]);
            for (sum, p) in sums[k + 1..].iter_mut().zip(&pivot[k + 1..]) {
                *sum += row[k] * p;
            }
        }
    }
    (rows, order, sign)
}

/// Returns the entries row by row of a value that has so many rows and columns.
/// ```
/// assert_eq!(plane_contact_mathcad::evaluate("(a   b) ← (1   2)\n(a   b) ← (b   a)\na").unwrap().to_string(), "2");
/// ```
pub fn spread(value: &Value, rows: usize, cols: usize) -> Result<Vec<Value>, Cause> {
    if value.size() != (rows, cols) {
        return Err(Cause::sizes("←", (rows, cols), value.size()));
    }
    let places = (0..rows).flat_map(|i| (0..cols).map(move |j| (i, j)));
    Ok(places.map(|(i, j)| value.entry(i, j).unwrap_or_else(|| value.clone())).collect())
}

/// Returns the entries of a column of three numbers.
fn three(value: &Value) -> Result<Vec<f64>, Cause> {
    match value {
        Value::Array(array) if value.size() == (3, 1) => Ok(numbers(array)),
        other => Err(kind("a column of three numbers", other)),
    }
}

/// Returns the cross product of two columns of three numbers.
/// ```
/// assert_eq!(plane_contact_mathcad::evaluate("×((1; 2; 3), (4; 5; 6))").unwrap().to_string(), "-3; 6; -3");
/// ```
pub fn cross(a: &Value, b: &Value) -> Result<Value, Cause> {
    let (a, b) = (three(a)?, three(b)?);
    let entries = [(1, 2), (2, 0), (0, 1)].map(|(k, l)| finite(a[k] * b[l] - a[l] * b[k]));
    Ok(Array::column(entries.into_iter().collect::<Result<_, _>>()?).into())
}

/// Returns the eigenvalues of a square matrix, in ascending order.
///
/// # Errors
/// Some are complex.
/// ```
/// assert_eq!(plane_contact_mathcad::evaluate("eigenvals((3 0; 0 1))").unwrap().to_string(), "1; 3");
/// ```
pub fn eigenvals(value: &Value) -> Result<Value, Cause> {
    Ok(Array::column(eigen(value)?.0).into())
}

/// Returns the eigenvectors of a square matrix, of length 1, as columns in the order of [`eigenvals`].
///
/// # Errors
/// Some are complex, or, of a matrix that is not symmetric, two eigenvalues are the same.
/// ```
/// assert_eq!(plane_contact_mathcad::evaluate("eigenvecs((3 0; 0 1))").unwrap().to_string(), "0 1; 1 0");
/// ```
pub fn eigenvecs(value: &Value) -> Result<Value, Cause> {
    let (values, vectors) = eigen(value)?;
    let vectors = match vectors {
        Some(vectors) => vectors,
        None => null_vectors(&dense(square(value)?), &values)?,
    };
    Ok(Array::from_fn(values.len(), values.len(), |i, j| vectors[(i, j)]).into())
}

fn dense(a: &Array) -> DMatrix<f64> {
    DMatrix::from_fn(a.rows(), a.cols(), |i, j| *a.at(i, j))
}

/// Returns the eigenvalues in ascending order and, of a symmetric matrix, the eigenvectors.
fn eigen(value: &Value) -> Result<(Vec<f64>, Option<DMatrix<f64>>), Cause> {
    /// The rounds of the QR algorithm; it takes two or three for each eigenvalue.
    const ROUNDS: usize = 100_000;
    let matrix = dense(square(value)?);
    let no_end = || Cause::Function { name: "eigenvals".into(), message: "no convergence".into() };
    if matrix == matrix.transpose() {
        let found = SymmetricEigen::try_new(matrix, f64::EPSILON, ROUNDS).ok_or_else(no_end)?;
        let mut order: Vec<usize> = (0..found.eigenvalues.len()).collect();
        order.sort_by(|i, j| found.eigenvalues[*i].total_cmp(&found.eigenvalues[*j]));
        let values = order.iter().map(|k| finite(found.eigenvalues[*k]));
        let values = values.collect::<Result<_, _>>()?;
        return Ok((values, Some(found.eigenvectors.select_columns(&order))));
    }
    let found = Schur::try_new(matrix, f64::EPSILON, ROUNDS).ok_or_else(no_end)?.eigenvalues();
    let found = found.ok_or_else(|| Cause::Complex { name: "eigenvals".into() })?;
    let mut values = found.iter().map(|x| finite(*x)).collect::<Result<Vec<_>, _>>()?;
    values.sort_by(f64::total_cmp);
    Ok((values, None))
}

/// Returns for each eigenvalue a column of length 1 that the matrix multiplies by it.
fn null_vectors(matrix: &DMatrix<f64>, values: &[f64]) -> Result<DMatrix<f64>, Cause> {
    // Rounding parts a double eigenvalue by some square root of the unit roundoff.
    let apart = f64::EPSILON.sqrt() * matrix.norm();
    if values.windows(2).any(|pair| pair[1] - pair[0] <= apart) {
        let construct = "eigenvectors of an eigenvalue that occurs twice".into();
        return Err(Cause::Unsupported { construct });
    }
    let n = values.len();
    let columns = values.iter().map(|value| {
        let shifted = matrix - DMatrix::identity(n, n) * *value;
        // Singular values descend: the last row belongs to the least.
        shifted.svd(false, true).v_t.expect("it was asked for").row(n - 1).transpose()
    });
    Ok(DMatrix::from_columns(&columns.collect::<Vec<_>>()))
}

/// Returns the entry of a value, which messages call `name`.
pub fn entry(
    value: &Value,
    subscripts: Subscripts,
    origin: i32,
    name: &dyn Fn() -> String,
) -> Result<Value, Cause> {
    let (i, j) = offsets(subscripts, origin, name)?;
    if let Value::Number(_) | Value::Text(_) = value {
        return Err(kind("an array", value));
    }
    let (rows, cols) = value.size();
    let entry = value.entry(i, j).filter(|_| subscripts.col.is_some() || cols == 1);
    entry.ok_or_else(|| Cause::IndexOutside { name: name(), subscripts, rows, cols })
}

/// Returns row and column from 0; the column of a lone subscript is the first.
pub fn offsets(
    subscripts: Subscripts,
    origin: i32,
    name: &dyn Fn() -> String,
) -> Result<(usize, usize), Cause> {
    let offset = |x: f64| {
        let whole = x as i64;
        if whole as f64 == x && whole >= i64::from(origin) {
            Ok((whole - i64::from(origin)) as usize)
        } else if x.fract() != 0.0 {
            Err(Cause::IndexNotWhole { name: name(), subscripts })
        } else if x < f64::from(origin) {
            Err(Cause::IndexBelowOrigin { name: name(), subscripts, origin })
        } else {
            Ok((x - f64::from(origin)) as usize)
        }
    };
    Ok((offset(subscripts.row)?, subscripts.col.map_or(Ok(0), offset)?))
}

/// Returns the column `j` of an array, counted from `origin`.
/// ```
/// assert_eq!(plane_contact_mathcad::evaluate("(1 2; 3 4)⟨2⟩").unwrap().to_string(), "2; 4");
/// ```
pub fn column(array: &Value, j: f64, origin: i32) -> Result<Value, Cause> {
    let rows = array.size().0;
    part(array, [origin.into(), f64::from(origin) + rows as f64 - 1.0, j, j], origin)
}

/// Returns rows and columns of an array, from the first and third of `at` to the second and fourth,
/// counted from `origin`.
/// ```
/// assert_eq!(plane_contact_mathcad::evaluate("submatrix((1 2; 3 4; 5 6), 2, 3, 1, 1)").unwrap().to_string(), "3; 5");
/// ```
pub fn part(array: &Value, at: [f64; 4], origin: i32) -> Result<Value, Cause> {
    if let Value::Number(_) | Value::Text(_) = array {
        return Err(kind("an array", array));
    }
    let name = || "the array".into();
    let [i, last_i, j, last_j] =
        at.map(|row| offsets(Subscripts { row, col: None }, origin, &name).map(|(i, _)| i));
    let (i, last_i, j, last_j) = (i?, last_i?, j?, last_j?);
    let (rows, cols) = array.size();
    if last_i < i || last_j < j || last_i >= rows || last_j >= cols {
        let subscripts = Subscripts { row: at[1], col: Some(at[3]) };
        return Err(Cause::IndexOutside { name: name(), subscripts, rows, cols });
    }
    let entry = |k, l| array.entry(i + k, j + l).unwrap_or_default();
    Ok(Value::grid(Grid::from_fn(last_i - i + 1, last_j - j + 1, entry)))
}

/// Puts arrays side by side, or one below the other.
/// ```
/// assert_eq!(plane_contact_mathcad::evaluate("stack((1 2), augment((3;), (4;)))").unwrap().to_string(), "1 2; 3 4");
/// ```
pub fn join(arrays: &[Value], below: bool) -> Result<Value, Cause> {
    let along = |a: &Value| if below { a.size().1 } else { a.size().0 };
    let Some(first) = arrays.first() else {
        return Err(Cause::Arguments { expected: 2, found: 0 });
    };
    if let Some(other) = arrays.iter().find(|a| along(a) != along(first)) {
        let operation = if below { "stack" } else { "augment" };
        return Err(Cause::sizes(operation, first.size(), other.size()));
    }
    let lines = arrays.iter().flat_map(|a| {
        let (rows, cols) = a.size();
        (0..if below { rows } else { cols }).map(move |k| (a, k))
    });
    let lines: Vec<(&Value, usize)> = lines.collect();
    let entry = |a: &Value, i, j| match a {
        Value::Number(_) | Value::Text(_) => a.clone(),
        a => a.entry(i, j).unwrap_or_default(),
    };
    Ok(Value::grid(match below {
        true => Grid::from_fn(lines.len(), along(first), |i, j| entry(lines[i].0, lines[i].1, j)),
        false => Grid::from_fn(along(first), lines.len(), |i, j| entry(lines[j].0, i, lines[j].1)),
    }))
}
