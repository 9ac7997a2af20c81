//! The marks of answers to exercises, for people and for machines.

use schemars::JsonSchema;
use serde::Serialize;

use super::json;
use super::layout::listed;
use super::model::{Report, Table};
use super::numbers::{or_dash, short};
use studies::lesson::exercise::{Answers, Mark};

/// A file of answers and its marks.
pub struct MarkedAnswers {
    /// The name of the file, as given.
    pub file: String,
    /// What the file contains.
    pub answers: Answers,
    /// The mark of each value that was asked for.
    pub marks: Vec<Mark>,
}

impl MarkedAnswers {
    /// Returns whether every answer is right.
    pub fn is_right(&self) -> bool {
        self.right() == self.marks.len()
    }

    fn right(&self) -> usize {
        self.marks.iter().filter(|mark| mark.right).count()
    }
}

/// Reports a row for each file: who answered, how many answers are right, and what is wrong.
pub fn report(marked: &[MarkedAnswers]) -> Report {
    let wrong = |marked: &&MarkedAnswers| {
        let wrong = marked.marks.iter().filter(|mark| !mark.right);
        listed(wrong.map(|Mark { node, of, said, found, .. }| {
            format!("node {node}: {of} is {}, not {}", short(*found), or_dash(*said, short))
        }))
    };
    let table = Table::from_rows(marked)
        .column("file", |marked| marked.file.clone())
        .column("student", |marked| marked.answers.student.clone())
        .column("exercise", |marked| marked.answers.exercise)
        .column("right", |marked| marked.right())
        .column("questions", |marked| marked.marks.len())
        .column("wrong", wrong);
    Report::default().table("", table)
}

/// The marks of files of answers.
#[derive(Serialize, JsonSchema)]
pub struct Document<'a> {
    answers: Vec<Row<'a>>,
}

/// The marks of a file of answers.
#[derive(Serialize, JsonSchema)]
struct Row<'a> {
    file: &'a str,
    student: &'a str,
    exercise: u64,
    seed: u64,
    /// The number of right answers.
    right: usize,
    /// The number of questions.
    of: usize,
    marks: &'a [Mark],
}

/// Returns the marks of each file as JSON.
pub fn json(marked: &[MarkedAnswers]) -> String {
    let rows = marked.iter().map(|marked| Row {
        file: &marked.file,
        student: &marked.answers.student,
        exercise: marked.answers.exercise,
        seed: marked.answers.seed,
        right: marked.right(),
        of: marked.marks.len(),
        marks: &marked.marks,
    });
    json::line(None, &Document { answers: rows.collect() })
}
