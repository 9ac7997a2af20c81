//! The functions that a listing may call: some of Mathcad's own, those of its worksheet, and those
//! that the caller defines.

use super::sheet::{Defined, Sheet};
use super::value::Value;
use super::x87;

pub enum Function<'l> {
    /// `identity(n)`, the n x n matrix.
    Identity,
    /// `rows(v)`, a whole number; 0 for what is no array.
    Rows,
    /// `cols(v)`, a whole number; 0 for what is no array.
    Cols,
    /// `length(v)`, the number of entries of a column.
    Length,
    /// `last(v)`, the subscript of the last entry of a column.
    Last,
    /// `mean(x, y, ...)`, of all the numbers of all arguments.
    Mean,
    /// `sort(v)`, a column in ascending order.
    Sort,
    /// `round(x)`, or `round(x, n)` to n decimal places.
    Round,
    /// `min(x, y, ...)`, of all the numbers of all arguments.
    Min,
    /// `max(x, y, ...)`, of all the numbers of all arguments.
    Max,
    /// `trace(x, y, ...)`: a line of output, which is also its value.
    Trace,
    /// `augment(x, y, ...)`, arrays side by side.
    Augment,
    /// `stack(x, y, ...)`, arrays one below the other.
    Stack,
    /// `submatrix(x, row, last row, column, last column)`.
    Submatrix,
    /// `lsolve(m, v)`, the solution of m·x = v.
    Lsolve,
    /// `determinant(m)`, which Mathcad writes as `|m|`.
    Determinant,
    /// `∑(v)`, the sum of a column, and the sum over a range.
    Sum,
    /// `∏`, the product over a range.
    Product,
    /// `√(x)`, or `√(n, x)`, the n-th root.
    Root,
    /// `log(x)` to the base of 10, or `log(x, b)`.
    Log,
    /// `mod(x, y)`, the remainder, with the sign of x.
    Mod,
    /// `factorial(n)`.
    Factorial,
    /// A function of one number, or of each number of an array.
    Elementary(Elementary),
    /// A function of the worksheet.
    Program(Defined),
    Outside(Outside<'l>),
}

/// A function of one number.
pub type Elementary = fn(f64) -> f64;

/// A function from outside: it returns its value, or why there is none.
pub type Outside<'l> = Box<dyn FnMut(&[Value]) -> Result<Value, String> + 'l>;

/// The functions of one number, also of each number of an array. Their last bit need not be
/// Mathcad's.
const ELEMENTARY: [(&str, Elementary); 20] = [
    ("sin", x87::sin),
    ("cos", x87::cos),
    ("tan", x87::tan),
    ("cot", |x| 1.0 / x87::tan(x)),
    ("sec", |x| 1.0 / x87::cos(x)),
    ("csc", |x| 1.0 / x87::sin(x)),
    ("asin", f64::asin),
    ("acos", f64::acos),
    ("atan", f64::atan),
    ("sinh", f64::sinh),
    ("cosh", f64::cosh),
    ("tanh", f64::tanh),
    ("asinh", f64::asinh),
    ("acosh", f64::acosh),
    ("atanh", f64::atanh),
    ("exp", f64::exp),
    ("ln", f64::ln),
    ("floor", f64::floor),
    ("ceil", f64::ceil),
    ("trunc", f64::trunc),
];

impl Function<'_> {
    /// Returns the function that a name stands for: the worksheet's, or else Mathcad's own.
    pub fn named(sheet: Option<&Sheet>, name: &str) -> Option<Self> {
        let defined = sheet.and_then(|sheet| sheet.defined(name));
        defined
            .map(|defined| Function::Program(defined.clone()))
            .or_else(|| Function::builtin(name))
    }

    pub fn builtin(name: &str) -> Option<Self> {
        Some(match name {
            "identity" => Function::Identity,
            "rows" => Function::Rows,
            "cols" => Function::Cols,
            "length" => Function::Length,
            "last" => Function::Last,
            "mean" => Function::Mean,
            "sort" => Function::Sort,
            "round" => Function::Round,
            "min" => Function::Min,
            "max" => Function::Max,
            "trace" => Function::Trace,
            "augment" => Function::Augment,
            "stack" => Function::Stack,
            "submatrix" => Function::Submatrix,
            "lsolve" => Function::Lsolve,
            "determinant" => Function::Determinant,
            "∑" => Function::Sum,
            "∏" => Function::Product,
            "√" => Function::Root,
            "log" => Function::Log,
            "mod" => Function::Mod,
            "factorial" => Function::Factorial,
            name => {
                let (_, function) = ELEMENTARY.into_iter().find(|(known, _)| *known == name)?;
                Function::Elementary(function)
            }
        })
    }
}
