//! The words of pages and reports in Russian. The English text is the key of `messages.tsv`, a message a
//! row: English, Russian.
//!
//! A key is the text in the code: `{share} of the load` stands for every text that is made with it. Its
//! Russian half has the values by their names; one without a name has its number, `{1}`. A value is said in
//! Russian too, but `{title!}` is taken as it is: what a scene names, a command, an error. A text that is
//! nowhere in the table is divided at what joins two texts: the end of a sentence, `; `, `: `, `, `.

use std::collections::HashMap;
use std::sync::LazyLock;

use serde_json::Value;

base::choices! {
    /// The language of a page or a report.
    Language {
        /// English.
        En = "en",
        /// Russian; numbers in sentences have a decimal comma, data in tables a point.
        Ru = "ru",
    }
}

/// What joins two texts.
const JOINTS: [&str; 6] = [". ", "; ", ": ", " (", ", ", "."];

/// The table of messages: of each its English and its Russian.
pub fn messages() -> impl Iterator<Item = (&'static str, &'static str)> {
    include_str!("messages.tsv").lines().skip(1).filter_map(|row| row.split_once('\t'))
}

/// A part of a message: text, or the name of a value.
#[derive(Clone, Copy)]
enum Part {
    Text(&'static str),
    Value(&'static str),
}

/// A message with values.
struct Template {
    english: Vec<Part>,
    russian: Vec<Part>,
}

/// The messages with values, those with the longest texts first.
static TEMPLATES: LazyLock<Vec<Template>> = LazyLock::new(|| {
    let messages = messages().filter(|(english, _)| english.contains('{'));
    let mut templates: Vec<Template> = messages
        .map(|(english, russian)| Template { english: parts(english), russian: parts(russian) })
        .collect();
    templates.sort_by_key(|template| std::cmp::Reverse(length(&template.english)));
    templates
});

/// The messages without values.
static SENTENCES: LazyLock<HashMap<&str, &str>> =
    LazyLock::new(|| messages().filter(|(english, _)| !english.contains('{')).collect());

/// Divides a message at its values.
fn parts(message: &'static str) -> Vec<Part> {
    let split =
        message.split_inclusive(['{', '}']).flat_map(|piece| match piece.strip_suffix('}') {
            Some(name) => [Some(Part::Value(name)), None],
            None => [Some(Part::Text(piece.trim_end_matches('{'))), None],
        });
    split.flatten().filter(|part| !matches!(part, Part::Text(""))).collect()
}

fn length(parts: &[Part]) -> usize {
    let texts = parts.iter().map(|part| match part {
        Part::Text(text) => text.len(),
        Part::Value(_) => 0,
    });
    texts.sum()
}

impl Language {
    /// Returns a text in this language; one that the table does not have, in English.
    pub fn say(self, english: &str) -> String {
        match self {
            Language::En => english.to_string(),
            Language::Ru => said(english).unwrap_or_else(|| english.to_string()),
        }
    }

    /// Says every text of a value of JSON.
    pub fn say_all(self, value: Value) -> Value {
        match value {
            Value::String(text) => Value::String(self.say(&text)),
            Value::Array(items) => items.into_iter().map(|item| self.say_all(item)).collect(),
            Value::Object(fields) => {
                fields.into_iter().map(|(name, value)| (name, self.say_all(value))).collect()
            }
            Value::Null | Value::Bool(_) | Value::Number(_) => value,
        }
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

    /// Says the texts of HTML, and those of its attributes `title`, `alt` and `aria-label`.
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
        if words.is_empty() {
            return text.to_string();
        }
        let one_line = words.split_whitespace().collect::<Vec<_>>().join(" ");
        match self {
            Language::En => text.to_string(),
            Language::Ru => text.replacen(words, &self.say(&one_line), 1),
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
        ["title", "alt", "aria-label"].into_iter().fold(tag.to_string(), said)
    }
}

/// Returns a text in Russian; nothing where a part of it is not in the table.
fn said(english: &str) -> Option<String> {
    if let Some(russian) = SENTENCES.get(english) {
        return Some(russian.to_string());
    }
    let templates = TEMPLATES.iter();
    let whole = templates
        .filter_map(|template| filled(template, &template.english, english, &mut Vec::new()));
    let parts = || JOINTS.iter().filter_map(|joint| divided(english, joint));
    let found = whole.chain(std::iter::once_with(parts).flatten()).next();
    found.or_else(|| is_data(english).then(|| with_comma(english)))
}

/// Returns a template's Russian for a text whose rest is that of the template's `parts`, each way in which the
/// text can be divided being tried.
fn filled<'a>(
    template: &Template,
    parts: &[Part],
    text: &'a str,
    values: &mut Vec<(&'static str, &'a str)>,
) -> Option<String> {
    match parts {
        [] => text.is_empty().then(|| in_russian(template, values))?,
        [Part::Text(start), rest @ ..] => filled(template, rest, text.strip_prefix(start)?, values),
        [Part::Value(name), rest @ ..] => {
            let ends: Vec<usize> = match rest {
                [] => vec![text.len()],
                [Part::Text(next), ..] => text.match_indices(next).map(|(end, _)| end).collect(),
                [Part::Value(_), ..] => Vec::new(),
            };
            ends.into_iter().find_map(|end| {
                values.push((name, &text[..end]));
                let found = filled(template, rest, &text[end..], values);
                values.pop();
                found
            })
        }
    }
}

/// Fills the values in; nothing where one cannot be said in Russian.
fn in_russian(template: &Template, values: &[(&str, &str)]) -> Option<String> {
    let part = |part: &Part| match *part {
        Part::Text(text) => Some(text.to_string()),
        Part::Value(name) => {
            let value =
                |name: &str| values.iter().find(|(own, _)| *own == name).map(|(_, value)| *value);
            match name.strip_suffix('!') {
                Some(name) => value(name).map(str::to_string),
                None => said(value(name)?),
            }
        }
    };
    template.russian.iter().map(part).collect()
}

/// Says both sides of a joint; in a sentence with a decimal comma a semicolon stands between two numbers.
fn divided(english: &str, joint: &str) -> Option<String> {
    let sides = english.match_indices(joint).map(|(at, _)| english.split_at(at));
    let mut sides = sides.filter(|(before, _)| !before.is_empty());
    sides.find_map(|(before, after)| {
        let (before, after) = (said(before)?, &after[joint.len()..]);
        let is_number = |text: &str| text.ends_with(|c: char| c.is_ascii_digit());
        match (joint, after) {
            (_, "") => Some(before + joint.trim_end()),
            (", ", after) if is_number(&before) && before.contains(',') => {
                Some(format!("{before}; {}", said(after)?))
            }
            (_, after) => Some(format!("{before}{joint}{}", said(after)?)),
        }
    })
}

/// Whether a text has no English in it: names, numbers, units and signs.
fn is_data(text: &str) -> bool {
    let is_letter = |c: char| c.is_ascii_lowercase();
    let is_plain = |word: &str| {
        word.contains(is_letter)
            && !word.contains(|c: char| c.is_ascii_digit() || "_[]^".contains(c))
    };
    let words = text.split(' ').filter(|word| is_plain(word)).count();
    words == 0 || !text.contains(' ')
}

/// Writes the numbers of a text with a decimal comma.
fn with_comma(text: &str) -> String {
    let digit = |c: Option<char>| c.is_some_and(|c| c.is_ascii_digit());
    let mut before = None;
    let mut rest = text.chars().peekable();
    let mut result = String::new();
    while let Some(c) = rest.next() {
        let is_point = c == '.' && digit(before) && digit(rest.peek().copied());
        result.push(if is_point { ',' } else { c });
        before = Some(c);
    }
    result
}
