//! The marks of answers to exercises, for people and for machines.

use serde_json::{Value, json};

use super::json::headed;
use super::layout::{Table, listed};
use super::numbers::{or_dash, short};
use crate::studies::lesson::exercise::{Answers, Mark};

/// A file of answers and its marks.
pub struct Marked {
    /// The name of the file, as given.
    pub file: String,
    pub answers: Answers,
    pub marks: Vec<Mark>,
}

impl Marked {
    /// Returns whether every answer is right.
    pub fn is_right(&self) -> bool {
        self.right() == self.marks.len()
    }

    fn right(&self) -> usize {
        self.marks.iter().filter(|mark| mark.right).count()
    }
}

/// Lays out a line a file: who answered, how many are right, and what is wrong.
pub fn text(marked: &[Marked]) -> String {
    let wrong = |marked: &&Marked| {
        let wrong = marked.marks.iter().filter(|mark| !mark.right);
        let in_words = |mark: &Mark| {
            let Mark { node, of, said, found, .. } = mark;
            format!("node {node}: {of} is {}, not {}", short(*found), or_dash(*said, short))
        };
        listed(wrong.map(in_words))
    };
    Table::of(marked)
        .column("file", |marked| marked.file.clone())
        .column("student", |marked| marked.answers.student.clone())
        .column("exercise", |marked| marked.answers.exercise)
        .column("right", |marked| format!("{} of {}", marked.right(), marked.marks.len()))
        .column("wrong", wrong)
        .text()
}

pub fn json(marked: &[Marked]) -> String {
    let row = |marked: &Marked| {
        json!({
            "file": marked.file,
            "student": marked.answers.student,
            "exercise": marked.answers.exercise,
            "seed": marked.answers.seed,
            "right": marked.right(),
            "of": marked.marks.len(),
            "marks": marked.marks,
        })
    };
    headed(None, &marked.iter().map(row).collect::<Vec<Value>>())
}
