//! A mutant, as cargo-mutants lists it, and what became of it when the tree was built.

use serde::{Deserialize, Serialize};

#[derive(Clone, Copy, Serialize, Deserialize)]
pub struct Point {
    pub line: usize,
    pub column: usize,
}

#[derive(Clone, Copy, Serialize, Deserialize)]
pub struct Span {
    pub start: Point,
    pub end: Point,
}

#[derive(Clone, Serialize, Deserialize)]
pub struct Function {
    pub function_name: String,
    pub span: Span,
}

/// What became of a mutant before any test ran.
#[derive(Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum State {
    /// It is in the build.
    #[default]
    Built,
    /// It does not compile.
    Unviable,
    /// It stands in a constant, which the compiler computes.
    Constant,
    /// No rewriting holds it, for this reason.
    Inexpressible(String),
}

#[derive(Clone, Serialize, Deserialize)]
pub struct Mutant {
    /// Its number: its place in the list.
    #[serde(default)]
    pub id: usize,
    /// The number of the first mutant of its place, which is what a test reaches.
    #[serde(default)]
    pub first: usize,
    #[serde(default)]
    pub state: State,
    /// The line that it stands in, without the white space around it.
    #[serde(default)]
    pub text: String,
    pub name: String,
    pub file: String,
    pub function: Option<Function>,
    pub genre: String,
    pub replacement: String,
    pub span: Span,
}

impl Mutant {
    pub fn place(&self) -> (String, usize, usize) {
        (self.genre.clone(), self.span.start.line, self.span.start.column)
    }

    /// What it replaces and in which function, without where that stands.
    pub fn what(&self) -> &str {
        self.name.splitn(2, ": ").last().unwrap_or(&self.name)
    }

    /// The folder of its file below `src`; for a file in a folder of files, the file.
    pub fn module(&self) -> String {
        let inside = self.file.trim_start_matches("src/");
        inside.split('/').take(2).collect::<Vec<_>>().join("/")
    }
}
