//! Errors of the input: what is wrong, where, and how to fix it. A fault of the program panics.

use std::fmt;

/// A value, or the error of the input that refuses it.
pub type Result<T, E = InputError> = std::result::Result<T, E>;

/// An error of the input: what is wrong, where, and how to fix it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct InputError {
    /// What is wrong, with the value that was found.
    pub what: String,
    /// The file and field where it is wrong.
    pub place: String,
    /// How to put it right.
    pub fix: String,
}

impl InputError {
    /// Describes an error; `place` is a field such as `loads[2].on`.
    pub fn new(place: impl Into<String>, what: impl Into<String>, fix: impl Into<String>) -> Self {
        InputError { what: what.into(), place: place.into(), fix: fix.into() }
    }

    /// Returns the same error with its place inside `outer`.
    pub fn within(mut self, outer: &str) -> Self {
        self.place =
            if self.place.is_empty() { outer.into() } else { format!("{outer}: {}", self.place) };
        self
    }
}

impl fmt::Display for InputError {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let (what, place, fix) = (indented(&self.what), indented(&self.place), indented(&self.fix));
        write!(f, "{what}\n  where: {place}\n  fix:   {fix}")
    }
}

/// Returns text in which a value with a line break begins no line of its own.
fn indented(text: &str) -> String {
    let lines =
        text.split('\n').enumerate().map(|(k, line)| match k == 0 || line.starts_with(' ') {
            true => line.to_string(),
            false => format!("  {line}"),
        });
    lines.collect::<Vec<_>>().join("\n")
}

impl std::error::Error for InputError {}
