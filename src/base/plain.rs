//! Words for people: what serde says of a value of the wrong kind, and numbers in messages.

use std::fmt::Display;
use std::path::Path;

/// Whether a character is a control character, or changes the direction of the text behind it.
pub fn is_hidden(c: char) -> bool {
    let turns = matches!(
        c,
        '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}'
    );
    turns || c.is_control()
}

/// Whether a character is hidden and no line feed or tab.
pub fn controls_a_terminal(c: char) -> bool {
    is_hidden(c) && !['\n', '\t'].contains(&c)
}

/// Returns words of a user on one line: what would break it, or control a terminal, becomes U+FFFD.
pub fn on_a_line(words: &str) -> String {
    let words = words.split_whitespace().collect::<Vec<_>>().join(" ");
    words.replace(is_hidden, "\u{fffd}")
}

/// Returns a path on one line: what would break it, or control a terminal, becomes U+FFFD.
pub fn shown(path: &Path) -> String {
    path.to_string_lossy().replace(is_hidden, "\u{fffd}")
}

/// What serde calls the kinds of values, found or expected.
const KINDS: &[(&str, &str)] = &[
    ("sequence", "a list"),
    ("a sequence", "a list"),
    ("map", "an object"),
    ("a map", "an object"),
    ("f64", "a number"),
    ("usize", "a whole number"),
    ("u64", "a whole number"),
    ("u32", "a whole number"),
    ("integer", "the number"),
    ("floating point", "the number"),
    ("a string", "text"),
    ("string", "the text"),
    ("boolean", "the value"),
    ("length", "a list of"),
];

/// What serde says of JSON that is malformed, by how it begins.
const SYNTAX: &[(&str, &str)] = &[
    ("trailing characters", "the list is too long"),
    ("trailing comma", "no value follows the comma"),
    ("expected `:`", "a colon is missing behind a name"),
    ("expected `,` or `]`", "a comma, or the end of the list, is missing"),
    ("expected `,` or `}`", "a comma, or the end of the object, is missing"),
    ("control character", "a line break or another control character stands in a text"),
    ("invalid escape", "what follows the backslash is no escape of JSON"),
    ("invalid unicode", "the escape \\u stands for no character"),
    ("lone leading surrogate", "the escape \\u stands for no character"),
    ("unexpected end of hex", "the escape \\u stands for no character"),
    ("recursion limit", "lists and objects stand too deep in each other: 127 levels are read"),
];

/// A name that there is not.
pub struct Unknown<'a> {
    /// Of what: `field` or `variant`.
    pub kind: &'a str,
    /// The name.
    pub name: &'a str,
    /// The names that there are.
    pub known: Vec<&'a str>,
}

/// Returns the unknown name of which serde's words speak.
pub fn unknown(words: &str) -> Option<Unknown<'_>> {
    let (kind, rest) = words.strip_prefix("unknown ")?.split_once(" `")?;
    let (name, known) = rest.split_once("`, expected ").or(rest.split_once("`, there are no "))?;
    Some(Unknown { kind, name, known: known.split('`').skip(1).step_by(2).collect() })
}

/// Returns what `error` says, with the kinds of JSON in place of those of Rust, and without the line.
///
/// ```
/// let error = serde_json::from_str::<Vec<f64>>(r#"["x"]"#).expect_err("no number");
/// let words = "the text \"x\" where a number is expected";
/// assert_eq!(plane_contact_base::plain::plain(&error), words);
/// ```
pub fn plain(error: &impl Display) -> String {
    let text = error.to_string();
    let text = text.rsplit_once(" at line ").map_or(&*text, |(text, _)| text);
    if let Some((_, words)) = SYNTAX.iter().find(|(start, _)| text.starts_with(start)) {
        return (*words).into();
    }
    if let Some(rest) = text.strip_prefix("EOF while parsing ") {
        return format!("the text ends within {rest}");
    }
    if let Some(field) = text.strip_prefix("missing field ") {
        return format!("the field {:?} is missing", field.trim_matches('`'));
    }
    if let Some(Unknown { kind, name, known }) = unknown(text) {
        return match kind {
            "field" => format!("there is no field {name:?} here"),
            _ => format!("{name:?} is none of {}", known.join(", ")),
        };
    }
    let starts = ["invalid type: ", "invalid value: ", "invalid "];
    let Some(rest) = starts.iter().find_map(|start| text.strip_prefix(start)) else {
        return text.into();
    };
    let Some((found, expected)) = rest.split_once(", expected ") else { return text.into() };
    format!("{} where {} is expected", of_json(found), of_json(expected))
}

/// Returns the words for a kind, and for a value whose kind comes first.
fn of_json(words: &str) -> String {
    if words.starts_with("struct ") {
        return "an object".into();
    }
    if let Some(length) = words.strip_prefix("a tuple of size ") {
        return format!("a list of {length}");
    }
    let known = |(rust, plain): &(&str, &str)| {
        let value = words.strip_prefix(rust)?;
        let is_whole = value.is_empty() || value.starts_with([' ', '`']) && !rust.starts_with("a ");
        is_whole.then(|| format!("{plain}{value}").replace('`', ""))
    };
    KINDS.iter().find_map(known).unwrap_or_else(|| words.into())
}

/// Writes a word as a shell takes it, in quotes.
pub fn shell_quoted(word: &str) -> String {
    format!("'{}'", word.replace('\'', "'\\''"))
}

/// Writes a word as a shell takes it: in quotes where it has more than letters, digits and `_./-`.
pub fn shell_word(word: &str) -> String {
    let is_plain = |c: char| c.is_alphanumeric() || "_./-".contains(c);
    match !word.is_empty() && word.chars().all(is_plain) {
        true => word.into(),
        false => shell_quoted(word),
    }
}

/// Writes a number with six digits at most, and a very large or a very small one as 2.5e-7.
pub fn six_digits(x: f64) -> String {
    let rounded: f64 = format!("{x:.5e}").parse().unwrap_or(x);
    match rounded.abs() {
        size if size == 0.0 || (1e-5..1e9).contains(&size) => rounded.to_string(),
        _ => format!("{rounded:e}"),
    }
}
