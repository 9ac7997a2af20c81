//! The functions that a listing may call: some of Mathcad's own, those of its worksheet, and those
//! that the caller defines.

use std::ops::RangeInclusive;
use std::rc::Rc;

use super::arithmetic::{finite, fold, kind, map, sum};
use super::failure::Cause;
use super::matrices;
use super::sheet::{Defined, Sheet};
use super::value::{Array, Value};
use super::x87;
use numbers::scalar::Scalar;

#[derive(Clone)]
pub enum Function {
    Builtin(&'static Builtin),
    /// A function of the worksheet.
    Program(Defined),
    /// A function from outside: it returns its value, or why there is none.
    Outside(Rc<Outside>),
}

pub type Outside = dyn Fn(&[Value]) -> Result<Value, String>;

/// One of Mathcad's own functions.
pub struct Builtin {
    pub name: &'static str,
    /// How many arguments it has.
    pub arguments: RangeInclusive<usize>,
    /// Returns what a call costs: the numbers that it may store, and its steps.
    pub cost: fn(&[Value]) -> (usize, u64),
    pub meaning: Meaning,
}

/// What a function makes of its arguments.
pub enum Meaning {
    /// A number of a number, and of an array each number's; where there is none, by the magnitude. Its last
    /// bit need not be Mathcad's.
    Elementary(fn(f64) -> f64, Option<f64>),
    /// A value of its arguments and `ORIGIN`.
    Values(fn(&[Value], i32) -> Result<Value, Cause>),
    /// `→(x)`: an expression of which each operation takes arrays entry by entry.
    Vectorize,
    /// `trace(x, y, ...)`: a line of output, which is also its value.
    Trace,
}

/// The steps that a function of a number takes, such as a sine or a power.
pub const FUNCTION: u64 = 8;

/// All built-in functions, each of which is known by this table alone.
static BUILTINS: [Builtin; 46] = {
    use Meaning::*;
    const ANY: RangeInclusive<usize> = 0..=usize::MAX;
    const fn row(
        name: &'static str,
        arguments: RangeInclusive<usize>,
        cost: fn(&[Value]) -> (usize, u64),
        function: fn(&[Value], i32) -> Result<Value, Cause>,
    ) -> Builtin {
        Builtin { name, arguments, cost, meaning: Values(function) }
    }
    const fn elementary(name: &'static str, function: fn(f64) -> f64) -> Builtin {
        with_pole(name, function, None)
    }
    const fn with_pole(name: &'static str, function: fn(f64) -> f64, pole: Option<f64>) -> Builtin {
        let cost: fn(&[Value]) -> (usize, u64) = |x| (size(x), (1 + FUNCTION) * size(x) as u64);
        Builtin { name, arguments: 1..=1, cost, meaning: Elementary(function, pole) }
    }
    [
        elementary("sin", x87::sin),
        elementary("cos", x87::cos),
        elementary("tan", x87::tan),
        with_pole("cot", |x| 1.0 / x87::tan(x), Some(0.0)),
        elementary("sec", |x| 1.0 / x87::cos(x)),
        with_pole("csc", |x| 1.0 / x87::sin(x), Some(0.0)),
        elementary("asin", f64::asin),
        elementary("acos", f64::acos),
        elementary("atan", f64::atan),
        elementary("sinh", f64::sinh),
        elementary("cosh", f64::cosh),
        elementary("tanh", f64::tanh),
        elementary("asinh", f64::asinh),
        elementary("acosh", f64::acosh),
        with_pole("atanh", f64::atanh, Some(1.0)),
        elementary("exp", f64::exp),
        with_pole("ln", f64::ln, Some(0.0)),
        elementary("floor", f64::floor),
        elementary("ceil", f64::ceil),
        elementary("trunc", f64::trunc),
        // √(x), or √(n, x), the n-th root.
        row("√", 1..=2, free, |x, _| root(x)),
        // log(x) to the base of 10, or log(x, b).
        row("log", 1..=2, free, |x, _| log(x)),
        // mod(x, y), the remainder, with the sign of x.
        row("mod", 2..=2, free, |x, _| remainder(x)),
        // So many products, at most.
        row("factorial", 1..=1, |_| (0, 50), |n, _| factorial(n)),
        // identity(n), the n x n matrix.
        row("identity", 1..=1, square, |n, _| whole(&n[0]).map(identity)),
        // The numbers of rows and of columns; 0 for what is no array.
        row("rows", 1..=1, free, |v, _| Ok(extent(&v[0]).0.into())),
        row("cols", 1..=1, free, |v, _| Ok(extent(&v[0]).1.into())),
        row("length", 1..=1, free, |v, _| Ok(extent(&v[0]).0.into())),
        // The subscript of the last entry of a column.
        row("last", 1..=1, free, |v, origin| last(&v[0], origin)),
        // Of all the numbers of all arguments.
        row("mean", ANY, read, |x, _| mean(x)),
        row("min", ANY, read, |x, _| fold(x, <f64 as Scalar>::min)),
        row("max", ANY, read, |x, _| fold(x, <f64 as Scalar>::max)),
        // A column in ascending order.
        row("sort", 1..=1, sorting, |v, _| sort(&v[0])),
        // round(x), or round(x, n) to n decimal places.
        row("round", 1..=2, copied, |x, _| round(x)),
        // Arrays side by side, or one below the other.
        row("augment", ANY, copied, |arrays, _| matrices::join(arrays, false)),
        row("stack", ANY, copied, |arrays, _| matrices::join(arrays, true)),
        // submatrix(x, row, last row, column, last column).
        row("submatrix", 5..=5, copied, |x, origin| {
            matrices::part(&x[0], numbers(&x[1..])?, origin)
        }),
        // lsolve(m, v), the solution of m·x = v.
        row("lsolve", 2..=2, eliminated, |x, _| matrices::lsolve(&x[0], &x[1])),
        row("determinant", 1..=1, eliminated, |m, _| matrices::determinant(&m[0])),
        // Of a column; over a range they are series.
        row("∑", 1..=1, copied, |v, _| total(&v[0])),
        row("∏", ANY, copied, |_, _| {
            let message = "it multiplies over a range, as ∏(i ∈ 1 .. 3, v[i])".into();
            Err(Cause::Function { name: "∏".into(), message })
        }),
        // ×(a, b), of columns of three.
        row("×", 2..=2, free, |x, _| matrices::cross(&x[0], &x[1])),
        // Of a matrix whose eigenvalues are real, in ascending order.
        row("eigenvals", 1..=1, eigen, |m, _| matrices::eigenvals(&m[0])),
        row("eigenvecs", 1..=1, vectors, |m, _| matrices::eigenvecs(&m[0])),
        Builtin { name: "→", arguments: 1..=1, cost: free, meaning: Vectorize },
        Builtin { name: "trace", arguments: ANY, cost: written, meaning: Trace },
    ]
};

impl Function {
    /// Returns the function that a name stands for: the worksheet's, or else Mathcad's own.
    pub fn named(sheet: &Sheet, name: &str) -> Option<Self> {
        sheet.function(name).cloned().or_else(|| Function::builtin(name))
    }

    pub fn builtin(name: &str) -> Option<Self> {
        BUILTINS.iter().find(|builtin| builtin.name == name).map(Function::Builtin)
    }
}

fn free(_: &[Value]) -> (usize, u64) {
    (0, 0)
}

fn read(arguments: &[Value]) -> (usize, u64) {
    (0, size(arguments) as u64)
}

/// Each number is read and written.
fn copied(arguments: &[Value]) -> (usize, u64) {
    (size(arguments), 2 * size(arguments) as u64)
}

fn square(arguments: &[Value]) -> (usize, u64) {
    let n = whole(&arguments[0]).unwrap_or(0);
    (n.saturating_mul(n), n.saturating_mul(n) as u64)
}

/// A comparison for each halving.
fn sorting(arguments: &[Value]) -> (usize, u64) {
    let size = size(arguments);
    (size, (size as u64).saturating_mul(1 + u64::from(size.max(1).ilog2())))
}

fn eliminated(arguments: &[Value]) -> (usize, u64) {
    let (numbers, steps) = copied(arguments);
    let matrix = arguments.first().filter(|matrix| matches!(matrix, Value::Array(_)));
    (numbers, steps.saturating_add(matrix.map_or(0, matrices::steps)))
}

/// Some ten eliminations.
fn eigen(arguments: &[Value]) -> (usize, u64) {
    let (numbers, steps) = eliminated(arguments);
    (2 * numbers, steps.saturating_mul(10))
}

/// An elimination of another matrix for each.
fn vectors(arguments: &[Value]) -> (usize, u64) {
    let (numbers, steps) = eigen(arguments);
    (numbers, steps.saturating_mul(size(arguments).isqrt() as u64))
}

/// The line is kept twice, as output and as a value; a number takes eight bytes.
fn written(arguments: &[Value]) -> (usize, u64) {
    let characters = arguments.iter().map(characters).fold(0, usize::saturating_add);
    let numbers = characters.saturating_mul(2).div_ceil(8);
    (numbers, numbers.saturating_add(characters) as u64)
}

/// Returns the characters that a value is written in, or more.
fn characters(value: &Value) -> usize {
    // All 17 digits and as many zeros as the exponent asks for.
    let of_number = |x: f64| 24 + Scalar::abs(x).max(f64::MIN_POSITIVE).log10().abs() as usize;
    match value {
        Value::Array(array) => array.entries().map(|x| of_number(*x)).sum(),
        Value::Number(x) => of_number(*x),
        Value::Nested(_) | Value::Text(_) => 8 * value.count(),
    }
}

fn size(values: &[Value]) -> usize {
    values.iter().map(Value::count).sum()
}

fn whole(value: &Value) -> Result<usize, Cause> {
    match value {
        Value::Number(n) if *n >= 0.0 && n.fract() == 0.0 => Ok(*n as usize),
        _ => Err(kind("a whole number", value)),
    }
}

/// Returns so many arguments, which must be numbers.
fn numbers<const N: usize>(arguments: &[Value]) -> Result<[f64; N], Cause> {
    let mut numbers = [0.0; N];
    for (number, argument) in numbers.iter_mut().zip(arguments) {
        *number = argument.number().ok_or_else(|| kind("a number", argument))?;
    }
    Ok(numbers)
}

/// Returns an elementary function's value of a number, or of each number of an array.
pub fn elementary(
    argument: &Value,
    function: fn(f64) -> f64,
    pole: Option<f64>,
    name: &'static str,
) -> Result<Value, Cause> {
    each(argument, |x| match pole == Some(x.abs()) {
        true => Err(Cause::Domain { name: name.into(), argument: x }),
        false => real(function(x), name),
    })
}

fn each(argument: &Value, function: impl Fn(f64) -> Result<f64, Cause>) -> Result<Value, Cause> {
    match argument {
        Value::Number(x) => function(*x).map(Value::Number),
        Value::Array(array) => map(array.clone(), function),
        other => Err(kind("a number or an array of numbers", other)),
    }
}

/// Returns a function's result at a point where it has one, if that is a number that is real.
fn real(result: f64, name: &'static str) -> Result<f64, Cause> {
    if result.is_nan() { Err(Cause::Complex { name: name.into() }) } else { finite(result) }
}

/// Returns the number of rows and columns: none of what is no array.
fn extent(value: &Value) -> (usize, usize) {
    match value {
        Value::Array(_) | Value::Nested(_) => value.size(),
        Value::Number(_) | Value::Text(_) => (0, 0),
    }
}

/// Returns the subscript of a column's last entry.
fn last(value: &Value, origin: i32) -> Result<Value, Cause> {
    match (value, value.size()) {
        (Value::Array(_) | Value::Nested(_), (rows, 1)) if rows > 0 => {
            Ok(Value::Number(f64::from(origin) + rows as f64 - 1.0))
        }
        _ => Err(kind("a column", value)),
    }
}

/// Returns the mean of all numbers of all arguments, which are added one after another.
fn mean(arguments: &[Value]) -> Result<Value, Cause> {
    let total = fold(arguments, |sum, x| sum + x)?;
    let mean = total.number().map(|total| total / size(arguments) as f64);
    mean.map_or(Ok(total), |mean| finite(mean).map(Value::Number))
}

fn identity(n: usize) -> Value {
    Array::from_fn(n, n, |i, j| f64::from(i == j)).into()
}

fn sort(value: &Value) -> Result<Value, Cause> {
    match value {
        Value::Array(column) if column.cols() == 1 => {
            let mut entries: Vec<f64> = column.entries().copied().collect();
            entries.sort_by(f64::total_cmp);
            Ok(Array::column(entries).into())
        }
        _ => Err(kind("a column of numbers", value)),
    }
}

/// Rounds a number, or each number of an array, halves away from 0, to so many decimal places.
fn round(arguments: &[Value]) -> Result<Value, Cause> {
    let [places] = if arguments.len() == 1 { [0.0] } else { numbers(&arguments[1..])? };
    if places.fract() != 0.0 {
        return Err(kind("a whole number of places", &arguments[1]));
    }
    let scale = 10_f64.powf(places);
    each(&arguments[0], |x| match x * scale {
        _ if scale == 0.0 => Ok(0.0),
        scaled if scaled.is_finite() => finite(scaled.round() / scale),
        // All its digits stand before that place.
        _ => Ok(x),
    })
}

fn root(arguments: &[Value]) -> Result<Value, Cause> {
    if arguments.len() == 1 {
        return numbers(arguments).and_then(|[x]| real(x.sqrt(), "√").map(Value::Number));
    }
    let [n, x] = numbers(arguments)?;
    if n == 0.0 || x == 0.0 && n < 0.0 {
        return Err(Cause::Singularity { numerator: 1.0, denominator: 0.0 });
    }
    let root = match x < 0.0 && n % 2.0 != 0.0 && n.fract() == 0.0 {
        true => -(-x).powf(1.0 / n),
        false => x.powf(1.0 / n),
    };
    // The nearest whole number, where it is the root.
    let whole = root.round();
    real(if whole.powf(n) == x { whole } else { root }, "√").map(Value::Number)
}

fn log(arguments: &[Value]) -> Result<Value, Cause> {
    let ln = |x: f64| match x {
        0.0 => Err(Cause::Domain { name: "log".into(), argument: x }),
        x => real(x.ln(), "log"),
    };
    if arguments.len() == 1 {
        return numbers(arguments).and_then(|[x]| ln(x).map(|_| x.log10().into()));
    }
    let [x, base] = numbers(arguments)?;
    let (numerator, denominator) = (ln(x)?, ln(base)?);
    if denominator == 0.0 {
        return Err(Cause::Singularity { numerator, denominator });
    }
    let log = numerator / denominator;
    // The nearest whole number, where it is the logarithm.
    let whole = log.round();
    Ok(if base.powf(whole) == x { whole } else { log }.into())
}

fn remainder(arguments: &[Value]) -> Result<Value, Cause> {
    match numbers(arguments)? {
        [x, 0.0] => Err(Cause::Singularity { numerator: x, denominator: 0.0 }),
        [x, y] => Ok(Value::Number(x % y)),
    }
}

fn factorial(arguments: &[Value]) -> Result<Value, Cause> {
    let [n] = numbers(arguments)?;
    if n < 0.0 || n.fract() != 0.0 {
        return Err(Cause::Domain { name: "factorial".into(), argument: n });
    }
    let product = (1..=n.min(200.0) as u32).fold(1.0, |product, k| product * f64::from(k));
    finite(product).map(Value::Number)
}

fn total(value: &Value) -> Result<Value, Cause> {
    match value {
        Value::Array(a) => finite(sum(a.entries().copied())).map(Value::Number),
        other => Err(kind("an array of numbers", other)),
    }
}
