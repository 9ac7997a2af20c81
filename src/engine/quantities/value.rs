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

impl<const N: usize> From<&[f64; N]> for Value {
    fn from(components: &[f64; N]) -> Self {
        Value::Components(components.to_vec())
    }
}

/// How a field of each type becomes a value.
macro_rules! from {
    ($($field:ident: $type:ty => $value:expr;)+) => {$(
        impl From<&$type> for Value {
            fn from($field: &$type) -> Self {
                $value
            }
        }
    )+};
}

from! {
    count: usize => Value::Count(*count);
    x: f64 => Value::Number(*x);
    vectors: Vec<[f64; 2]> => Value::Components(vectors.as_flattened().to_vec());
    node: NodeId => Value::Count(node.number());
    triangle: TriangleId => Value::Count(triangle.number());
    words: String => Value::Words(words.clone());
    is: bool => Value::State(u8::from(*is), u8::from(*is).to_string());
    x: Option<f64> => x.map_or(Value::Unknown, Value::Number);
    status: Option<Status> => match status {
        None => Value::Unknown,
        Some(Status::Open) => Value::State(0, Status::Open.to_string()),
        Some(Status::Stick) => Value::State(1, Status::Stick.to_string()),
        Some(Status::Slip(sense)) => Value::State(2, Status::Slip(*sense).to_string()),
    };
    cycle: Option<Cycle> => Value::Words(match cycle {
        None => "new".into(),
        Some(Cycle { length: 1, .. }) => "unchanged".into(),
        Some(Cycle { length, members }) => format!("as in {} (period of {length})", members[0]),
    });
    list: Vec<u8> => Value::Words(joined(list, " "));
    statuses: Option<Vec<Status>> => match statuses {
        None => Value::Unknown,
        Some(list) => Value::Words(joined(list, ", ")),
    };
}

fn joined<T: ToString>(list: &[T], between: &str) -> String {
    list.iter().map(T::to_string).collect::<Vec<_>>().join(between)
}
