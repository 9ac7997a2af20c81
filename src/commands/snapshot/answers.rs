//! `plane-contact snapshot verify` on answers that pages of exercises exported.

use std::io;
use std::path::{Path, PathBuf};

use plane_contact::engine::error::Result;
use plane_contact::error::InputError;
use plane_contact::files::json;
use plane_contact::report::answers::{self as report, MarkedAnswers};
use plane_contact::studies::lesson::exercise::{ANSWERS, Answers};

use super::verify::DIFFERS;
use crate::commands::{TablesArgs, print, report_error};

/// Returns whether the text of a file has answers: whether it names a kind.
pub fn are_in(text: &[u8]) -> bool {
    json::has_field(text, "kind")
}

/// Marks the answers in the texts of files; what cannot be read is named, and the others are marked all the
/// same. Returns the exit status: that of the first error, else whether all answers are right.
pub fn verify(
    files: &[PathBuf],
    texts: Vec<io::Result<Vec<u8>>>,
    json: bool,
    tables: &TablesArgs,
) -> Result<u8> {
    let marked = files.iter().zip(texts).map(|(file, text)| marked(file, text));
    let (marked, failures): (Vec<_>, Vec<_>) = marked.partition(Result::is_ok);
    let marked: Vec<MarkedAnswers> = marked.into_iter().flatten().collect();
    match json {
        true => print(&report::json(&marked))?,
        false => tables.print(report::report(&marked))?,
    }
    let failures = failures.into_iter().filter_map(Result::err);
    let statuses: Vec<u8> = failures.map(|error| report_error(&error)).collect();
    let all_right = marked.iter().all(MarkedAnswers::is_right);
    Ok(statuses.first().copied().unwrap_or(if all_right { 0 } else { DIFFERS }))
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
    let marks = answers.marks().map_err(|error| error.within(&name))?;
    Ok(MarkedAnswers { file: name, marks, answers })
}
