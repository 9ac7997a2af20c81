//! The words of the lesson in Russian. The English text is the key of `messages.tsv`, a message a row:
//! English, Russian. A value stands in both as `{name}`. The page looks a text up when it shows it.

use std::fmt::Display;

use serde_json::{Value, json};

base::choices! {
    /// The language with which a lesson opens.
    Language {
        /// English.
        En = "en",
        /// Russian; numbers have a decimal comma.
        Ru = "ru",
    }
}

/// The table of messages: of each its English and its Russian.
pub fn messages() -> impl Iterator<Item = (&'static str, &'static str)> {
    rows(include_str!("messages.tsv"))
}

/// What the interpreter of the listings says, the more special before the general: sentences and their parts.
pub fn of_interpreter() -> impl Iterator<Item = (&'static str, &'static str)> {
    rows(include_str!("interpreter.tsv"))
}

fn rows(table: &'static str) -> impl Iterator<Item = (&'static str, &'static str)> {
    table.lines().skip(1).filter_map(|row| row.split_once('\t'))
}

/// Returns a message with values, each of which stands in it as `{name}`, for the page to say.
pub fn fill(english: &str, values: &[(&str, &dyn Display)]) -> Value {
    let texts = values.iter().map(|(name, value)| (name.to_string(), json!(value.to_string())));
    json!({ "text": english, "values": texts.collect::<Value>() })
}
