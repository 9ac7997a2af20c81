//! The operations on values.
//!
//! Every number comes from one IEEE 754 operation after another in the printed order: no fused
//! multiply-add, no other order of a sum. A matrix product adds k = 1, 2, ... to the first product,
//! not to 0.

use std::rc::Rc;

use super::failure::Cause;
use super::settings::Settings;
use super::syntax::{Comparison, Operation};
use super::value::{Array, Value};

/// Returns a finite number, or the overflow that Mathcad reports: no number comes of an overflow before.
pub fn finite(result: f64) -> Result<f64, Cause> {
    match result {
        result if result.is_finite() => Ok(result),
        result if result.is_nan() => Err(Cause::Overflow { result: f64::INFINITY }),
        result => Err(Cause::Overflow { result }),
    }
}

/// Returns what an operation makes of two numbers; 0/0 is as the worksheet's `zero-over-zero` says.
pub fn calculate(operation: Operation, x: f64, y: f64, settings: &Settings) -> Result<f64, Cause> {
    match operation {
        Operation::Add => finite(x + y),
        Operation::Subtract => finite(x - y),
        Operation::Multiply => finite(x * y),
        Operation::Divide if y != 0.0 => finite(x / y),
        Operation::Divide if x == 0.0 && settings.zero_over_zero_is_zero => Ok(0.0),
        Operation::Divide => Err(Cause::Singularity { numerator: x, denominator: y }),
    }
}

/// Returns `x^y`: by repeated squaring from the last bit where y is whole.
/// ```
/// assert_eq!(plane_contact_mathcad::evaluate("(2^10   2^−1   2^0.5)").unwrap().to_string(), "1024 0.5 1.4142135623730951");
/// ```
pub fn power(x: f64, y: f64) -> Result<f64, Cause> {
    let result = if y.fract() != 0.0 || y.abs() >= 1e15 {
        x.powf(y)
    } else if y < 0.0 {
        1.0 / whole_power(x, -y as u64)
    } else {
        whole_power(x, y as u64)
    };
    match result {
        _ if x == 0.0 && y < 0.0 => Err(Cause::Singularity { numerator: 1.0, denominator: 0.0 }),
        result if result.is_nan() => Err(Cause::Complex { name: "a power".into() }),
        result => finite(result),
    }
}

fn whole_power(x: f64, mut n: u64) -> f64 {
    let (mut power, mut square) = (1.0, x);
    while n > 0 {
        if n % 2 == 1 {
            power *= square;
        }
        square *= square;
        n /= 2;
    }
    power
}

/// Returns whether `x` and `y` compare so, under the worksheet's `exact-boolean`.
/// ```
/// assert_eq!(plane_contact_mathcad::evaluate("(1 < 2   2 ≤ 1   0.1 + 0.2 = 0.3)").unwrap().to_string(), "1 0 0");
/// ```
pub fn compare(comparison: Comparison, x: f64, y: f64, settings: &Settings) -> bool {
    let [x, y] = [x, y].map(|x| if settings.tiny_is_zero && x.abs() < 1e-307 { 0.0 } else { x });
    let same = x == y || !settings.exact_boolean && nearly_equal(x, y);
    match comparison {
        Comparison::Equal => same,
        Comparison::Unequal => !same,
        Comparison::Less => x < y && !same,
        Comparison::LessOrEqual => x < y || same,
        Comparison::Greater => x > y && !same,
        Comparison::GreaterOrEqual => x > y || same,
    }
}

/// Returns whether the difference over the mean is below 1e-12: Mathcad's relative comparison.
fn nearly_equal(x: f64, y: f64) -> bool {
    ((x - y) / (x / 2.0 + y / 2.0)).abs() < 1e-12
}

/// Returns what an operation on values costs: how many numbers it works through, and how many its
/// result has.
pub fn cost(operation: Operation, left: &Value, right: &Value) -> (u64, usize) {
    match (operation, left, right) {
        (Operation::Multiply, Value::Array(a), Value::Array(b)) => {
            let size = a.rows().saturating_mul(b.cols());
            ((size as u64).saturating_mul(a.cols() as u64), size)
        }
        _ => (left.count().max(right.count()) as u64, left.count().max(right.count())),
    }
}

/// Returns what one of the four operations makes of two numbers or arrays.
/// ```
/// assert_eq!(plane_contact_mathcad::evaluate("(1 2; 3 4) − 1").unwrap().to_string(), "0 1; 2 3");
/// ```
pub fn operate(
    operation: Operation,
    left: Value,
    right: Value,
    settings: &Settings,
) -> Result<Value, Cause> {
    let of = |x, y| calculate(operation, x, y, settings);
    match (operation, left, right) {
        (_, Value::Number(x), Value::Number(y)) => of(x, y).map(Value::Number),
        (Operation::Divide, _, Value::Array(a)) if a.cols() > 1 => {
            Err(kind("a number or a column to divide by", &Value::Array(a)))
        }
        (_, Value::Number(x), Value::Array(a)) => map(a, |y| of(x, y)),
        (_, Value::Array(a), Value::Number(y)) => map(a, |x| of(x, y)),
        (Operation::Multiply, Value::Array(a), Value::Array(b)) => product(&a, &b),
        (_, Value::Array(a), Value::Array(b)) if a.size() != b.size() => {
            Err(Cause::sizes(operation.sign(), a.size(), b.size()))
        }
        (_, Value::Array(mut a), Value::Array(b)) => {
            for (x, y) in Rc::make_mut(&mut a).entries_mut().zip(b.entries()) {
                *x = of(*x, *y)?;
            }
            Ok(Value::Array(a))
        }
        (_, Value::Number(_) | Value::Array(_), other) | (_, other, _) => {
            Err(kind("a number or an array", &other))
        }
    }
}

/// Returns the failure of a value that should have been `expected`.
pub fn kind(expected: &'static str, found: &Value) -> Cause {
    Cause::Kind { expected, found: found.kind() }
}

/// Maps every entry, in place if nothing else shares the array.
pub fn map(mut array: Rc<Array>, f: impl Fn(f64) -> Result<f64, Cause>) -> Result<Value, Cause> {
    for x in Rc::make_mut(&mut array).entries_mut() {
        *x = f(*x)?;
    }
    Ok(Value::Array(array))
}

/// Returns the matrix product; of two columns of one length, the scalar product. What has one entry
/// is a number.
/// ```
/// assert_eq!(plane_contact_mathcad::evaluate("(1 2; 3 4)·(5; 6)").unwrap().to_string(), "17; 39");
/// assert_eq!(plane_contact_mathcad::evaluate("(1; 2; 3)·(4; 5; 6)").unwrap().to_string(), "32");
/// ```
fn product(a: &Array, b: &Array) -> Result<Value, Cause> {
    let column = |a: &Array| a.cols() == 1 && a.rows() > 1;
    if column(a) && column(b) && a.rows() == b.rows() {
        return finite(sum(a.entries().zip(b.entries()).map(|(x, y)| x * y))).map(Value::Number);
    }
    if a.cols() != b.rows() {
        return Err(Cause::sizes("·", a.size(), b.size()));
    }
    let product = Array::from_fn(a.rows(), b.cols(), |i, j| {
        sum((0..a.cols()).map(|k| a.at(i, k) * b.at(k, j)))
    });
    product.entries().try_for_each(|&x| finite(x).map(drop))?;
    match product.size() {
        (1, 1) => Ok(Value::Number(*product.at(0, 0))),
        _ => Ok(product.into()),
    }
}

/// Adds the terms one after another, from the first; returns 0 if there is none.
pub fn sum(terms: impl Iterator<Item = f64>) -> f64 {
    terms.reduce(|sum, term| sum + term).unwrap_or(0.0)
}

/// Returns `−x`, entry by entry.
pub fn negative(value: Value) -> Result<Value, Cause> {
    match value {
        Value::Number(x) => Ok(Value::Number(-x)),
        Value::Array(a) => map(a, |x| Ok(-x)),
        other => Err(kind("a number or an array", &other)),
    }
}

/// Returns `xᵀ`; a number is its own transpose.
/// ```
/// assert_eq!(plane_contact_mathcad::evaluate("(1 2; 3 4)ᵀ").unwrap().to_string(), "1 3; 2 4");
/// ```
pub fn transpose(value: Value) -> Result<Value, Cause> {
    match value {
        Value::Number(_) => Ok(value),
        // In place: 100 times faster than to copy a column of 20,000.
        Value::Array(mut a) if a.rows() == 1 || a.cols() == 1 => {
            Rc::make_mut(&mut a).turn();
            Ok(Value::Array(a))
        }
        Value::Array(a) => Ok(a.transposed().into()),
        Value::Nested(v) => Ok(Value::grid(v.grid().transposed())),
        other => Err(kind("a number or an array", &other)),
    }
}

/// Combines all numbers of the values by `f`, one after another: Mathcad's `min` and `max` flatten
/// their arguments.
/// ```
/// assert_eq!(plane_contact_mathcad::evaluate("(max(1, (7; 3))   min((4 2; 5 6)))").unwrap().to_string(), "7 2");
/// ```
pub fn fold(values: &[Value], f: impl Fn(f64, f64) -> f64) -> Result<Value, Cause> {
    let mut result = None;
    let mut take = |x| result = Some(result.map_or(x, |old| f(old, x)));
    for value in values {
        match value {
            Value::Number(x) => take(*x),
            Value::Array(a) => a.entries().copied().for_each(&mut take),
            other => return Err(kind("a number or an array", other)),
        }
    }
    result
        .map(Value::Number)
        .ok_or(Cause::Kind { expected: "at least one number", found: "none".into() })
}
