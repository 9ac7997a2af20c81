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

    /// Returns the same error with what may be its cause beside how to fix it.
    pub fn hinting(mut self, cause: Option<&str>) -> Self {
        self.fix.extend(cause.map(|cause| format!(". {cause}")));
        self
    }
}

impl fmt::Display for InputError {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        // A value with a line break begins no line of its own.
        let lines = self.what.split('\n').enumerate();
        let indented = |(k, line): (usize, &str)| match k == 0 || line.starts_with(' ') {
            true => line.to_string(),
            false => format!("  {line}"),
        };
        let what = lines.map(indented).collect::<Vec<_>>().join("\n");
        let place = self.place.replace('\n', "\\n");
        write!(f, "{what}\n  where: {place}\n  fix:   {}", self.fix)
    }
}

impl std::error::Error for InputError {}
