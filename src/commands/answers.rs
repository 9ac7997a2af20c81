//! `plane-contact verify` on answers that pages of exercises exported.

use std::path::Path;

use plane_contact::answer::error::Result;
use plane_contact::error::InputError;
use plane_contact::files;
use plane_contact::plain::plain;
use plane_contact::report::answers::{self as report, Marked};
use plane_contact::studies::lesson::exercise::{ANSWERS, Answers};

use super::print_either;

/// Returns whether a file has answers: the kind that it names.
pub fn are_in(file: &Path) -> bool {
    #[derive(serde::Deserialize)]
    struct Kind {
        kind: String,
    }
    let text = files::read(file).unwrap_or_default();
    serde_json::from_slice(&text).is_ok_and(|Kind { kind }| kind == ANSWERS)
}

/// Marks the answers of files; returns whether all are right.
pub fn verify(files: &[impl AsRef<Path>], json: bool) -> Result<bool> {
    let marked = files.iter().map(|file| marked(file.as_ref())).collect::<Result<Vec<_>>>()?;
    print_either(json, || report::json(&marked), || report::text(&marked))?;
    Ok(marked.iter().all(Marked::is_right))
}

fn marked(file: &Path) -> Result<Marked> {
    let name = file.display().to_string();
    let fault = |why: String| {
        let what = format!("these are no answers: {why}");
        InputError::new(&name, what, "give files as the page of an exercise saves them")
    };
    let text = files::read(file).map_err(|why| fault(why.to_string()))?;
    let answers: Answers = serde_json::from_slice(&text).map_err(|why| fault(plain(&why)))?;
    Ok(Marked { file: name, marks: answers.marks(), answers })
}
