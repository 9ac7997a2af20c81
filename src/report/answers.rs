//! The marks of answers to exercises, for people and for machines.

use serde::Serialize;

use super::json;
use super::layout::listed;
use super::model::{Cell, Report, Table};
use super::numbers::{or_dash, short};
use studies::lesson::exercise::{Answers, Mark, WEIGHT_POINTS};

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
        self.marks.iter().all(|mark| mark.right)
    }

    /// Returns what the right answers count.
    fn points(&self) -> usize {
        self.marks.iter().filter(|mark| mark.right).map(|mark| mark.points).sum()
    }

    fn possible(&self) -> usize {
        self.marks.iter().map(|mark| mark.points).sum()
    }

    /// Returns how many answers to a question are right, such as `3 of 4`.
    fn right_of(&self, question: &str) -> String {
        let marks = self.marks.iter().filter(|mark| mark.of == question);
        let (right, wrong): (Vec<_>, Vec<_>) = marks.partition(|mark| mark.right);
        format!("{} of {}", right.len(), right.len() + wrong.len())
    }

    fn wrong(&self) -> String {
        let wrong = self.marks.iter().filter(|mark| !mark.right);
        listed(wrong.map(|Mark { node, of, said, found, .. }| {
            format!("node {node}: {of} is {}, not {}", short(*found), or_dash(*said, short))
        }))
    }
}

/// Reports the marks of a class, a row for each file.
pub fn report(marked: &[MarkedAnswers]) -> Report {
    let table = Table::from_rows(marked)
        .column("student", |marked| marked.answers.student.clone())
        .column("exercise", |marked| marked.answers.exercise)
        .column("seed", |marked| marked.answers.seed)
        .column("score", |marked| Cell::Percent {
            part: marked.points() as f64 / marked.possible() as f64,
            decimals: 0,
        })
        .column("points", |marked| marked.points())
        .column("of", |marked| marked.possible())
        .column("ct", |marked| marked.right_of("ct"))
        .column("dy", |marked| marked.right_of("dy"))
        .column("k1", |marked| marked.right_of("k1"))
        .column("file", |marked| marked.file.clone())
        .column("wrong", |marked| marked.wrong());
    let title = format!("Marks: ct and dy count 1 each, k1 of a node in contact {WEIGHT_POINTS}");
    Report::default().table(title, table)
}

/// The marks of files of answers.
#[derive(Serialize)]
pub struct Document<'a> {
    answers: Vec<Row<'a>>,
}

/// The marks of a file of answers.
#[derive(Serialize)]
struct Row<'a> {
    file: &'a str,
    student: &'a str,
    exercise: u64,
    seed: u64,
    /// What the right answers count.
    points: usize,
    /// What all answers count.
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
        points: marked.points(),
        of: marked.possible(),
        marks: &marked.marks,
    });
    json::line(None, &Document { answers: rows.collect() })
}
