//! `plane-contact snapshot verify` on answers that pages of exercises exported.

use std::io;
use std::path::{Path, PathBuf};

use plane_contact::engine::error::Result;
use plane_contact::error::InputError;
use plane_contact::files::json;
use plane_contact::report::answers::{self as report, MarkedAnswers};
use plane_contact::studies::lesson::exercise::{ANSWERS, Answers};

use crate::commands::print_either;

/// Returns whether the text of a file has answers: whether it names a kind.
pub fn are_in(text: &[u8]) -> bool {
    json::has_field(text, "kind")
}

/// Marks the answers in the texts of files; returns whether all are right.
pub fn verify(files: &[PathBuf], texts: Vec<io::Result<Vec<u8>>>, json: bool) -> Result<bool> {
    let marked = files.iter().zip(texts).map(|(file, text)| marked(file, text));
    let marked = marked.collect::<Result<Vec<_>>>()?;
    print_either(json, || report::json(&marked), || report::report(&marked))?;
    Ok(marked.iter().all(MarkedAnswers::is_right))
}

fn marked(file: &Path, text: io::Result<Vec<u8>>) -> Result<MarkedAnswers> {
    let name = file.display().to_string();
    let fix = "give files as the page of an exercise saves them";
    let text = text
        .map_err(|why| InputError::new(&name, format!("the answers cannot be read: {why}"), fix))?;
    let kind = json::Kind { name: "answers", fix, has_values: false };
    let answers: Answers = json::read(&text, &kind).map_err(|error| error.within(&name))?;
    if answers.kind != ANSWERS {
        let what = format!("{:?} is no kind of answers", answers.kind);
        return Err(InputError::new("field kind", what, fix).within(&name).into());
    }
    Ok(MarkedAnswers { file: name, marks: answers.marks(), answers })
}
