//! The one reader of JSON: scenes, snapshots, sweeps, results, inputs of programs.

mod strict;

use serde::de::{DeserializeOwned, Deserializer, IgnoredAny};
use serde_json::Value;

use super::kind::kind_of;
use super::read::utf8;
use strict::Strict;

use crate::error::{InputError, Result};
use crate::limits;
use crate::plain::{Unknown, plain, unknown};
use crate::suggestion::did_you_mean;

/// The version of the format of the documents that the program writes and reads.
pub const FORMAT: u32 = 1;

/// The version of the program.
pub const VERSION: &str = env!("CARGO_PKG_VERSION");

/// Returns whether a text begins as every document that the program writes: with the two versions.
pub(super) fn is_from_program(head: &[u8]) -> bool {
    let head: String = String::from_utf8_lossy(head).split_whitespace().collect();
    let version = head.strip_prefix("{\"format\":").and_then(|rest| rest.split_once(','));
    version.is_some_and(|(format, rest)| {
        format.parse::<u32>().is_ok() && rest.starts_with("\"version\":\"")
    })
}

/// A kind of document.
pub struct Kind {
    /// What errors call it, such as `snapshot`.
    pub name: &'static str,
    /// What to do about one that is malformed.
    pub fix: &'static str,
}

/// Reads a document in UTF-8, with or without a byte order mark.
///
/// # Errors
/// Names the field that is malformed or given twice, with line and column, or what follows the
/// document; or says that it is in another encoding, or has too many values.
pub fn read<T: DeserializeOwned>(text: &[u8], kind: &Kind) -> Result<T> {
    let whole = format!("the {}", kind.name);
    let bytes = text;
    let text = utf8(text).map_err(|what| InputError::new(&whole, what, "save it as UTF-8"));
    let text = text.map_err(|error| instead(bytes, kind).unwrap_or(error))?;
    check_size(text, &whole)?;
    let mut source = serde_json::Deserializer::from_str(text);
    let place = |path: &str| if path.is_empty() { whole.clone() } else { format!("field {path}") };
    let document = deserialize(&mut source, kind, place, |error| words(error, text));
    let document = document.map_err(|error| instead(bytes, kind).unwrap_or(error))?;
    source.end().map_err(|error| {
        let what = format!("more follows, from line {}, column {}", error.line(), error.column());
        InputError::new(format!("the end of {whole}"), what, kind.fix)
    })?;
    Ok(document)
}

/// Checks that a document, of which `whole` is the name, is none too large to be read.
///
/// # Errors
/// It has too many bytes or values.
pub fn check_size(text: &str, whole: &str) -> Result<()> {
    limits::BYTES.check(text.len(), whole)?;
    limits::VALUES.check(values(text), whole)
}

/// Reads what the values of a field of a document hold.
///
/// # Errors
/// Names the field that is malformed.
pub fn read_field<T: DeserializeOwned>(value: &Value, kind: &Kind, field: &str) -> Result<T> {
    let place =
        |path: &str| format!("field {field}{}{path}", if path.is_empty() { "" } else { "." });
    deserialize(value, kind, place, plain)
}

/// The most bytes of a field's place that an error shows.
const MOST_OF_A_PLACE: usize = 200;

/// Reads what `source` holds; `place` names a path, which is empty of the whole, and `words` says what
/// is wrong.
fn deserialize<'de, T: DeserializeOwned, D: Deserializer<'de, Error = serde_json::Error>>(
    source: D,
    kind: &Kind,
    place: impl Fn(&str) -> String,
    words: impl Fn(&serde_json::Error) -> String,
) -> Result<T> {
    serde_path_to_error::deserialize(Strict(source)).map_err(|error| {
        let place = match error.path().to_string() {
            path if path == "." || path == "?" => place(""),
            path if path.len() > MOST_OF_A_PLACE => {
                place(&path[..path.floor_char_boundary(MOST_OF_A_PLACE)]) + "..."
            }
            path => place(path.trim_end_matches(".?")),
        };
        let (error, what) = (error.inner(), words(error.inner()));
        let at = match (error.line(), error.column()) {
            (0, _) => String::new(),
            (line, column) => format!(", line {line}, column {}", column.max(1)),
        };
        InputError::new(place + &at, what, meant(error) + kind.fix)
    })
}

/// Returns how many values a document has at most: each stands behind a comma or opens a list or an object.
fn values(text: &str) -> usize {
    let (mut count, mut bytes) = (0, text.bytes());
    while let Some(byte) = bytes.next() {
        match byte {
            b',' | b'[' | b'{' => count += 1,
            b'"' => skip_string(&mut bytes),
            _ => (),
        }
    }
    count
}

/// Skips a string behind its first quote.
fn skip_string(bytes: &mut std::str::Bytes) {
    while let Some(byte) = bytes.next() {
        match byte {
            b'"' => return,
            b'\\' => drop(bytes.next()),
            _ => (),
        }
    }
}

/// Returns what `error` says of `text`, and shows what stands there in place of JSON.
fn words(error: &serde_json::Error, text: &str) -> String {
    let said = plain(error);
    let found = word(text, error.line(), error.column());
    let bare = found.trim_start_matches(['-', '+']).to_lowercase();
    let expected = match &*said {
        "number out of range" => return format!("{found} is a {said}"),
        "expected value" if goes_on(text, error.line(), error.column()) => {
            return "a second field stands in an object of one".into();
        }
        "key must be a string" => "text in double quotes",
        "expected value" | "expected ident" | "invalid number" => {
            if ["nan", "inf", "infinity"].contains(&bare.as_str()) {
                "a finite number"
            } else if found == "[" || serde_json::from_str::<IgnoredAny>(&found).is_ok() {
                "text in double quotes"
            } else {
                "a value"
            }
        }
        _ => return said,
    };
    format!("{found} where {expected} is expected")
}

/// Returns whether a list or an object ends at a place, and a comma follows.
fn goes_on(text: &str, line: usize, column: usize) -> bool {
    let line = text.split('\n').nth(line - 1).unwrap_or_default();
    let behind = line.get(column.saturating_sub(1)..).unwrap_or_default();
    let behind = behind.strip_prefix([']', '}']);
    behind.is_some_and(|behind| behind.trim_start().starts_with(','))
}

/// Returns the word at a place: letters and digits with what may stand in a number, or the one
/// character that is there.
fn word(text: &str, line: usize, column: usize) -> String {
    /// The most characters that are shown.
    const MOST: usize = 40;
    let line = text.split('\n').nth(line - 1).unwrap_or_default();
    let is_of_word = |c: char| c.is_alphanumeric() || "+-._".contains(c);
    let at = line.floor_char_boundary(column.saturating_sub(1));
    let start = line[..at].trim_end_matches(is_of_word).len();
    let end = line[at..].find(|c| !is_of_word(c)).map_or(line.len(), |length| at + length);
    let word = if start < end { &line[start..end] } else { &line[at..] };
    word.chars().take(if start < end { MOST } else { 1 }).collect()
}

/// Returns the name that an unknown one was meant to be, and the fields that there are.
fn meant(error: &serde_json::Error) -> String {
    let error = error.to_string();
    let Some(Unknown { kind, name, known }) = unknown(&error) else { return String::new() };
    let near = did_you_mean(name, known.iter().copied());
    match kind {
        "field" if !known.is_empty() => format!("{near}the fields are {}; ", known.join(", ")),
        _ => near,
    }
}

/// Returns the error of a file that is another kind than the wanted one; None where it is not known to be.
///
/// ```
/// use plane_contact_base::files::json::{Kind, instead};
///
/// let kind = Kind { name: "scene file", fix: "see the guide" };
/// let error = instead(b"$MeshFormat", &kind).expect("a mesh");
/// assert_eq!(error.what, "this is a Gmsh mesh, not a scene file");
/// ```
pub fn instead(file: &[u8], wanted: &Kind) -> Option<InputError> {
    let article = if wanted.name.starts_with(['a', 'e', 'i', 'o', 'u']) { "an" } else { "a" };
    let is_wanted = format!("{article} {}", wanted.name);
    let found = kind_of(file).filter(|found| *found != is_wanted)?;
    let what = format!("this is {found}, not {is_wanted}");
    Some(InputError::new(format!("the {}", wanted.name), what, wanted.fix))
}
