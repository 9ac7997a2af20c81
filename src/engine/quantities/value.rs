//! The value of a quantity, made of what a field of the table holds.

use crate::contact::Status;
use crate::solution::Cycle;
use problem::model::{NodeId, TriangleId};

/// The value of a quantity.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// There is none, or it is not determined.
    Unknown,
    /// A whole number that counts something.
    Count(usize),
    /// A number with the quantity's unit.
    Number(f64),
    /// The components of a vector or a tensor, or of all vectors one after the other.
    Components(Vec<f64>),
    /// One of several states, and its number in files for viewers.
    State(u8, String),
    /// Words, such as the name of a body.
    Words(String),
}

impl Value {
    /// Returns the numbers of a measured value or of a state; None of what is no number, or not
    /// known.
    pub fn numbers(&self) -> Option<Vec<f64>> {
        let numbers = match self {
            Value::Number(x) => vec![*x],
            Value::Components(x) => x.clone(),
            Value::State(number, _) => vec![f64::from(*number)],
            Value::Unknown | Value::Count(_) | Value::Words(_) => return None,
        };
        Some(numbers).filter(|numbers| numbers.iter().all(|x| x.is_finite()))
    }
}

impl From<&usize> for Value {
    fn from(count: &usize) -> Self {
        Value::Count(*count)
    }
}

impl From<&f64> for Value {
    fn from(x: &f64) -> Self {
        Value::Number(*x)
    }
}

impl<const N: usize> From<&[f64; N]> for Value {
    fn from(components: &[f64; N]) -> Self {
        Value::Components(components.to_vec())
    }
}

impl From<&Vec<[f64; 2]>> for Value {
    fn from(vectors: &Vec<[f64; 2]>) -> Self {
        Value::Components(vectors.as_flattened().to_vec())
    }
}

impl From<&NodeId> for Value {
    fn from(node: &NodeId) -> Self {
        Value::Count(node.number())
    }
}

impl From<&TriangleId> for Value {
    fn from(triangle: &TriangleId) -> Self {
        Value::Count(triangle.number())
    }
}

impl From<&String> for Value {
    fn from(words: &String) -> Self {
        Value::Words(words.clone())
    }
}

impl From<&bool> for Value {
    fn from(is: &bool) -> Self {
        Value::State(u8::from(*is), u8::from(*is).to_string())
    }
}

impl From<&Option<f64>> for Value {
    fn from(x: &Option<f64>) -> Self {
        x.map_or(Value::Unknown, Value::Number)
    }
}

impl From<&Option<Status>> for Value {
    fn from(status: &Option<Status>) -> Self {
        let number = |status: &Status| match status {
            Status::Open => 0,
            Status::Stick => 1,
            Status::Slip(_) => 2,
        };
        let state = |status: &Status| Value::State(number(status), status.to_string());
        status.as_ref().map_or(Value::Unknown, state)
    }
}

impl From<&Option<Cycle>> for Value {
    fn from(cycle: &Option<Cycle>) -> Self {
        Value::Words(match cycle {
            None => "new".into(),
            Some(Cycle { length: 1, .. }) => "unchanged".into(),
            Some(Cycle { length, members }) => format!("as in {} (period of {length})", members[0]),
        })
    }
}

impl From<&Vec<u8>> for Value {
    fn from(list: &Vec<u8>) -> Self {
        Value::Words(list.iter().map(ToString::to_string).collect::<Vec<_>>().join(" "))
    }
}

impl From<&Option<Vec<Status>>> for Value {
    fn from(statuses: &Option<Vec<Status>>) -> Self {
        let words = |list: &Vec<Status>| {
            list.iter().map(ToString::to_string).collect::<Vec<_>>().join(", ")
        };
        statuses.as_ref().map_or(Value::Unknown, |list| Value::Words(words(list)))
    }
}
