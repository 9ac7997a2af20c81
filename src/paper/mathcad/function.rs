//! The functions that a listing may call: a few of Mathcad's own, and those that the caller
//! defines.

use super::value::Value;

pub enum Function<'l> {
    /// `identity(n)`, the n x n matrix.
    Identity,
    /// `rows(v)`, a whole number.
    Rows,
    /// `min(x, y, ...)`, of all the numbers of all arguments.
    Min,
    /// `max(x, y, ...)`, of all the numbers of all arguments.
    Max,
    /// `trace(x, y, ...)`: a line of output, which is also its value.
    Trace,
    Outside(Outside<'l>),
}

/// A function from outside: it returns its value, or why there is none.
pub type Outside<'l> = Box<dyn FnMut(&[Value]) -> Result<Value, String> + 'l>;

impl Function<'_> {
    pub fn builtin(name: &str) -> Option<Self> {
        match name {
            "identity" => Some(Function::Identity),
            "rows" => Some(Function::Rows),
            "min" => Some(Function::Min),
            "max" => Some(Function::Max),
            "trace" => Some(Function::Trace),
            _ => None,
        }
    }
}
