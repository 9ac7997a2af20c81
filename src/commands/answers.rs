//! `plane-contact verify` on answers that pages of exercises exported.

use std::path::Path;

use plane_contact::answer::error::Result;
use plane_contact::error::InputError;
use plane_contact::files::{self, json};
use plane_contact::report::answers::{self as report, Marked};
use plane_contact::studies::lesson::exercise::{ANSWERS, Answers};

use super::print_either;

/// Returns whether a file has answers: the kind that it names.
pub fn are_in(file: &Path) -> bool {
    json::has_field(&files::read(file).unwrap_or_default(), "kind")
}

/// Marks the answers of files; returns whether all are right.
pub fn verify(files: &[impl AsRef<Path>], json: bool) -> Result<bool> {
    let marked = files.iter().map(|file| marked(file.as_ref())).collect::<Result<Vec<_>>>()?;
    print_either(json, || report::json(&marked), || report::text(&marked))?;
    Ok(marked.iter().all(Marked::is_right))
}

fn marked(file: &Path) -> Result<Marked> {
    let name = file.display().to_string();
    let fix = "give files as the page of an exercise saves them";
    let text = files::read(file)
        .map_err(|why| InputError::new(&name, format!("the answers cannot be read: {why}"), fix))?;
    let kind = json::Kind { name: "answers", fix, has_values: false };
    let answers: Answers = json::read(&text, &kind).map_err(|error| error.within(&name))?;
    if answers.kind != ANSWERS {
        let what = format!("{:?} is no kind of answers", answers.kind);
        return Err(InputError::new("field kind", what, fix).within(&name).into());
    }
    Ok(Marked { file: name, marks: answers.marks(), answers })
}
