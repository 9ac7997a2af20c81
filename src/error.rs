//! A fault of the input: what, where, how to mend it. A fault of ours is a panic.

use std::fmt;

/// What is wrong with the input, where, and how to mend it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct InputError {
    /// What is wrong, with the values.
    pub what: String,
    /// File and field.
    pub place: String,
    /// How to mend it.
    pub mend: String,
}

impl InputError {
    /// An input error; `place` is a field such as `loads[2].on`.
    pub fn new(place: impl Into<String>, what: impl Into<String>, mend: impl Into<String>) -> Self {
        InputError { what: what.into(), place: place.into(), mend: mend.into() }
    }

    /// The same error, its place inside `outer`.
    pub fn within(mut self, outer: &str) -> Self {
        self.place =
            if self.place.is_empty() { outer.into() } else { format!("{outer}: {}", self.place) };
        self
    }
}

impl fmt::Display for InputError {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "{}\n  where: {}\n  mend:  {}", self.what, self.place, self.mend)
    }
}

impl std::error::Error for InputError {}
