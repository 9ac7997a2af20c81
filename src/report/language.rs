//! The words of pages and reports in Russian. The English text is the key of `messages.tsv`, a message a
//! row: English, Russian.
//!
//! A key is the text in the code: `{share} of the load` stands for every text that is made with it. Its
//! Russian half has the values by their names; one without a name has its number, `{1}`. A value is said in
//! Russian too, but `{title!}` is taken as it is where the table does not have it: what a scene names, a
//! command, an error. A text that is
//! nowhere in the table is divided at what joins two texts: the end of a sentence, `; `, `: `, `, `.

use std::collections::HashMap;
use std::sync::LazyLock;

use serde_json::Value;

use super::model::{Block, Cell, Report, Table};

base::choices! {
    /// The language of a page or a report.
    Language {
        /// English.
        En = "en",
        /// Russian; numbers in sentences have a decimal comma, data in tables a point.
        Ru = "ru",
    }
}

/// How the numbers of a text are written in Russian.
#[derive(Clone, Copy)]
enum Numbers {
    /// With a decimal comma.
    OfSentence,
    /// With a point.
    OfData,
}

/// What joins two sentences, and what joins two texts in one: what belongs to the first, and what stands between
/// both.
const END_OF_SENTENCE: (&str, &str) = (".", " ");
const JOINTS: [(&str, &str); 5] = [("", "; "), ("", ": "), ("", " ("), ("", ", "), ("", ".")];

/// The bytes of text below which a template is short.
const SHORT: usize = 10;

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
            Language::Ru => Numbers::OfSentence.said_or_kept(english),
        }
    }

    /// Says a report, but for its code and the words within its figures; in tables, numbers stay as they are.
    pub fn say_report(self, report: Report) -> Report {
        match self {
            Language::En => report,
            Language::Ru => Report { blocks: report.blocks.into_iter().map(block).collect() },
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

fn block(block: Block) -> Block {
    let sentence = |text: String| Numbers::OfSentence.said_or_kept(&text);
    match block {
        Block::Heading { level, text } => Block::Heading { level, text: sentence(text) },
        Block::Line { level, text } => Block::Line { level, text: sentence(text) },
        Block::Code(lines) => Block::Code(lines),
        Block::Table { title, table } => {
            let headings = table.headings.into_iter().map(sentence);
            let rows = table.cells.into_iter().map(|row| row.into_iter().map(cell).collect());
            Block::Table { title: sentence(title), table: Table::new(headings, rows) }
        }
        Block::Figure { title, svg } => Block::Figure { title: sentence(title), svg },
    }
}

fn cell(cell: Cell) -> Cell {
    match cell {
        Cell::Text(text) => Cell::Text(Numbers::OfData.said_or_kept(&text)),
        Cell::Missing(Some(why)) => Cell::Missing(Some(SENTENCES.get(why).unwrap_or(&why))),
        Cell::Empty
        | Cell::Missing(None)
        | Cell::Integer(_)
        | Cell::Number { .. }
        | Cell::Percent { .. } => cell,
    }
}

impl Numbers {
    fn said_or_kept(self, english: &str) -> String {
        let mut translator = Translator { numbers: self, known: HashMap::new() };
        translator.said(english).unwrap_or_else(|| english.to_string())
    }

    /// Writes what is no words.
    fn written(self, data: &str) -> String {
        match self {
            Numbers::OfSentence => with_comma(data),
            Numbers::OfData => data.to_string(),
        }
    }
}

/// What says a text in Russian.
struct Translator {
    numbers: Numbers,
    /// What was tried of the text. Else each part that cannot be said is tried anew from every joint before
    /// it: 2^18 times in a list of 18 findings.
    known: HashMap<String, Option<String>>,
}

impl Translator {
    /// Returns a text in Russian; nothing where a part of it is not in the table.
    fn said(&mut self, english: &str) -> Option<String> {
        if let Some(known) = self.known.get(english) {
            return known.clone();
        }
        let exact = SENTENCES.get(english).map(|russian| russian.to_string());
        let said = exact
            .or_else(|| self.divided(english, END_OF_SENTENCE))
            .or_else(|| TEMPLATES.iter().find_map(|template| self.made_with(template, english)))
            .or_else(|| JOINTS.iter().find_map(|joint| self.divided(english, *joint)))
            .or_else(|| is_data(english).then(|| self.numbers.written(english)));
        self.known.insert(english.to_string(), said.clone());
        said
    }

    /// Returns the Russian of a text that is made with a template. A short one between two values would join the
    /// items of a list.
    fn made_with(&mut self, template: &Template, english: &str) -> Option<String> {
        let begins_with_value = matches!(template.english[0], Part::Value(_));
        if begins_with_value && length(&template.english) < SHORT && english.contains(", ") {
            return None;
        }
        self.filled(template, &template.english, english, &mut Vec::new())
    }

    /// Returns the Russian of a template for a text whose rest has the template's `parts`: the first way to
    /// divide it in which every value can be said.
    fn filled<'a>(
        &mut self,
        template: &Template,
        parts: &[Part],
        text: &'a str,
        values: &mut Vec<(&'static str, &'a str)>,
    ) -> Option<String> {
        match parts {
            [] if text.is_empty() => self.in_russian(template, values),
            [] => None,
            [Part::Text(start), rest @ ..] => {
                self.filled(template, rest, text.strip_prefix(start)?, values)
            }
            [Part::Value(name), rest @ ..] => ends(text, rest).into_iter().find_map(|end| {
                values.push((name, &text[..end]));
                let found = self.filled(template, rest, &text[end..], values);
                values.pop();
                found
            }),
        }
    }

    /// Fills the values in; nothing where one cannot be said.
    fn in_russian(&mut self, template: &Template, values: &[(&str, &str)]) -> Option<String> {
        let value = |name| values.iter().find(|(own, _)| *own == name).map(|(_, value)| *value);
        let part = |part: &Part| match *part {
            Part::Text(text) => Some(text.to_string()),
            Part::Value(name) => match name.strip_suffix('!') {
                Some(name) => {
                    value(name).map(|own| (*SENTENCES.get(own).unwrap_or(&own)).to_string())
                }
                None => self.said(value(name)?),
            },
        };
        template.russian.iter().map(part).collect()
    }

    /// Says both sides of a joint; between two numbers with a decimal comma stands a semicolon.
    fn divided(&mut self, english: &str, (own, joint): (&str, &str)) -> Option<String> {
        let end = if joint == " (" { ")" } else { "" };
        let whole = [own, joint].concat();
        english.match_indices(&whole).filter(|(at, _)| *at > 0).find_map(|(at, _)| {
            let (before, after) = (&english[..at + own.len()], &english[at + whole.len()..]);
            let (before, after) = (self.said(before)?, after.strip_suffix(end)?);
            match (joint, after) {
                (_, "") => return Some(before + joint.trim_end()),
                (".", _) => return None,
                _ => (),
            }
            let is_number = before.contains(',') && before.ends_with(|c: char| c.is_ascii_digit());
            let joint = if joint == ", " && is_number { "; " } else { joint };
            Some([&before, joint, &self.said(after)?, end].concat())
        })
    }
}

/// Returns where a value may end that stands before the rest of a template.
fn ends(text: &str, rest: &[Part]) -> Vec<usize> {
    match rest {
        [] => vec![text.len()],
        [Part::Text(next), ..] => text.match_indices(next).map(|(end, _)| end).collect(),
        [Part::Value(_), ..] => {
            text.char_indices().map(|(end, _)| end).chain([text.len()]).collect()
        }
    }
}

/// Whether a text has no English in it: one name, or numbers with units, signs, and words that Russian has too.
fn is_data(text: &str) -> bool {
    let words: Vec<&str> = text.split(' ').collect();
    let is_english = |k: usize| {
        let word = words[k].trim_matches(|c: char| !c.is_alphanumeric());
        let is_name = word.contains(|c: char| c.is_ascii_digit() || "_[]^".contains(c));
        let is_unit = k > 0 && words[k - 1].ends_with(|c: char| c.is_ascii_digit());
        let is_kept = SENTENCES.get(word).is_some_and(|russian| *russian == word);
        word.contains(|c: char| c.is_ascii_lowercase()) && !is_name && !is_unit && !is_kept
    };
    words.len() == 1 || !(0..words.len()).any(is_english)
}

/// Writes the numbers of a text with a decimal comma.
fn with_comma(text: &str) -> String {
    let is_digit = |c: Option<&char>| c.is_some_and(char::is_ascii_digit);
    let letters: Vec<char> = text.chars().collect();
    let letter = |(k, c): (usize, &char)| match c {
        '.' if k > 0 && is_digit(letters.get(k - 1)) && is_digit(letters.get(k + 1)) => ',',
        c => *c,
    };
    letters.iter().enumerate().map(letter).collect()
}
