//! The words of the lesson in Russian. The English text is the key of `messages.tsv`, a message a row:
//! English, Russian. A value stands in both as `{name}`, and is filled in once the text was looked up.

use std::collections::HashMap;
use std::fmt::Display;
use std::sync::LazyLock;

use serde_json::Value;

base::choices! {
    /// The language of a lesson.
    Language {
        /// English.
        En = "en",
        /// Russian; numbers in sentences have a decimal comma, data in tables a point.
        Ru = "ru",
    }
}

/// The table of messages: of each its English and its Russian.
pub fn messages() -> impl Iterator<Item = (&'static str, &'static str)> {
    include_str!("messages.tsv").lines().skip(1).filter_map(|row| row.split_once('\t'))
}

static RUSSIAN: LazyLock<HashMap<&str, &str>> = LazyLock::new(|| messages().collect());

impl Language {
    /// Returns a text in this language. What the table does not have stays: names, titles of users'
    /// scenes, what the interpreter says.
    pub fn say(self, english: &str) -> &str {
        match self {
            Language::En => english,
            Language::Ru => RUSSIAN.get(english).unwrap_or(&english),
        }
    }

    /// Says a text with values, each of which stands in it as `{name}`.
    pub fn fill(self, english: &str, values: &[(&str, &dyn Display)]) -> String {
        values.iter().fold(self.say(english).to_string(), |text, (name, value)| {
            text.replace(&format!("{{{name}}}"), &value.to_string())
        })
    }

    /// Returns the messages whose English a script has in `t("...")`: what it needs in this language.
    pub fn messages_of(self, script: &str) -> Option<Value> {
        let asked = |english: &str| script.contains(&format!("t(\"{english}\""));
        match self {
            Language::En => None,
            Language::Ru => {
                Some(Value::from_iter(messages().filter(|(english, _)| asked(english))))
            }
        }
    }

    /// Says the texts of HTML, and those of its attributes `title` and `aria-label`.
    pub fn say_html(self, html: &str) -> String {
        let pieces = html.split_inclusive('>').map(|piece| match piece.split_once('<') {
            Some((text, tag)) => format!("{}<{}", self.say_within(text), self.say_attributes(tag)),
            None => piece.to_string(),
        });
        pieces.collect()
    }

    /// Says a text between blanks, which stay.
    fn say_within(self, text: &str) -> String {
        let words = text.trim();
        let one_line = words.split_whitespace().collect::<Vec<_>>().join(" ");
        match self.say(&one_line) {
            same if same == one_line => text.to_string(),
            said => text.replacen(words, said, 1),
        }
    }

    fn say_attributes(self, tag: &str) -> String {
        let said = |tag: String, name: &str| match tag.split_once(&format!(" {name}=\"")) {
            Some((before, rest)) => {
                let (text, after) = rest.split_once('"').expect("an attribute ends");
                format!("{before} {name}=\"{}\"{after}", self.say(text))
            }
            None => tag,
        };
        ["title", "aria-label"].into_iter().fold(tag.to_string(), said)
    }
}
