//! A line's text as tokens.
//!
//! Spaces mean nothing, but for one place: within round brackets they separate the elements of a
//! row. There a [`Token::Gap`] stands
//!
//! - for two or more spaces behind an operand, whatever follows but `;`, as in `(a − c   b + c)`
//!   and `(a   −b)`,
//! - for one space between two operands, as in `(0 0 0)` and `(|a| |b|)`.
//!
//! A bar closes what the last open bracket is a bar for, if an operand stands before it; otherwise
//! it opens.

use std::collections::HashMap;
use std::fmt;
use std::rc::Rc;

use super::syntax::{OPERATORS, Slot, Span};

/// A word, number or sign of a line.
#[derive(Clone, Debug, PartialEq)]
pub enum Token {
    Number(f64),
    /// A string in quotation marks, which hold none themselves.
    Text(Rc<str>),
    Name(Slot),
    /// A name that is followed by `(` without a space: a function.
    Function(Slot),
    /// A sign, a bracket or a keyword, as the syntax tree knows it.
    Sign(&'static str),
    /// The bar that closes `|x|`; the one that opens it is a sign.
    ClosingBar,
    /// The space between two elements of a row.
    Gap,
    /// Tokens of several kinds, in words; only where one is expected.
    Words(&'static str),
}

/// Writes the token as messages name it.
impl fmt::Display for Token {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Token::Number(x) => write!(f, "`{x}`"),
            Token::Text(text) => write!(f, "`\"{text}\"`"),
            Token::Name(_) | Token::Function(_) => f.write_str("a name"),
            Token::Sign(sign) => write!(f, "`{sign}`"),
            Token::ClosingBar => f.write_str("`|`"),
            Token::Gap => f.write_str("the space between two elements"),
            Token::Words(words) => f.write_str(words),
        }
    }
}

/// The signs that are no operators.
const SIGNS: [&str; 18] =
    [":=", "..", "<-", "←", "∈", "^", "ᵀ", "|", ",", ";", "(", ")", "[", "]", "⟨", "⟩", "{", "}"];

/// The words that no name can be.
const KEYWORDS: &str = "for while if otherwise try return break continue in and or not transpose";

/// Returns the keyword that a word is.
pub fn keyword(word: &str) -> Option<&'static str> {
    KEYWORDS.split(' ').find(|keyword| *keyword == word)
}

/// What `<` and a minus sign behind it may mean.
pub const ARROW: &str = "`<` and `-` without brackets, which may mean two things: write `x <- 1` to \
                         assign 1, or `x < (-1)` to compare with -1";

/// Returns the sign that a sign or keyword stands for as typed in ASCII, or else itself. `<-` stays
/// what it is: the grammar knows where it assigns.
fn printed(typed: &'static str) -> &'static str {
    match OPERATORS.iter().find(|row| row.typed == typed) {
        Some(row) => row.sign,
        None if typed == "in" => "∈",
        None => typed,
    }
}

/// Returns the longest sign at the start of a text. None starts with a letter of ASCII or a digit: half of the
/// time of reading a listing went into looking for one there.
fn sign(text: &str) -> Option<&'static str> {
    let first = text.bytes().next().filter(|byte| !byte.is_ascii_alphanumeric())?;
    let operators = OPERATORS.iter().flat_map(|row| [row.sign, row.typed]);
    let signs = operators.chain(SIGNS).filter(|sign| sign.as_bytes()[0] == first);
    signs.filter(|sign| text.starts_with(sign)).max_by_key(|sign| sign.len())
}

/// The names of a listing in the order of their first appearance.
#[derive(Clone, Debug, Default)]
pub struct Names {
    names: Vec<String>,
    slots: HashMap<String, Slot>,
}

impl Names {
    /// Returns the slot of `name`, a new one where the name is new.
    fn intern(&mut self, name: &str) -> Slot {
        self.find(name).unwrap_or_else(|| {
            self.names.push(name.into());
            self.slots.insert(name.into(), self.names.len() - 1);
            self.names.len() - 1
        })
    }

    /// Returns the slot of `name`, if the listing has it.
    pub fn find(&self, name: &str) -> Option<Slot> {
        self.slots.get(name).copied()
    }

    pub fn name(&self, slot: Slot) -> &str {
        &self.names[slot]
    }

    /// Returns all names, in the order of their slots.
    pub fn all(&self) -> impl Iterator<Item = &str> {
        self.names.iter().map(String::as_str)
    }

    pub fn len(&self) -> usize {
        self.names.len()
    }
}

/// A token and where it stands in its line, in bytes.
pub type Spanned = (Token, Span);

/// A place in a line, in bytes, and what is wrong there.
pub type Complaint = (usize, String);

/// Splits the `text` of a line into tokens; from `#` on it is a remark.
///
/// # Errors
/// Names a character or number that the notation does not know, or brackets more than
/// `depth` deep.
pub fn tokens(text: &str, names: &mut Names, depth: usize) -> Result<Vec<Spanned>, Complaint> {
    let mut found: Vec<Spanned> = vec![];
    let mut open: Vec<&'static str> = vec![];
    let mut end = 0;
    loop {
        let rest = text[end..].trim_start_matches(' ');
        if rest.is_empty() || rest.starts_with('#') {
            return Ok(found);
        }
        let (at, last) = (text.len() - rest.len(), found.last().map(|(last, _)| last));
        let behind_operand = last.is_some_and(ends_operand);
        let (token, length) = match (sign(rest), rest.chars().next()) {
            (Some("-"), _) if last == Some(&Token::Sign("<")) => {
                return Err((at, format!("found {ARROW}")));
            }
            (Some("|"), _) if behind_operand && open.last() == Some(&"|") => (Token::ClosingBar, 1),
            (Some(sign), _) => (Token::Sign(printed(sign)), sign.len()),
            (None, Some('"')) => self::text(rest).map_err(|message| (at, message))?,
            (None, Some(c)) if c.is_ascii_digit() => number(rest).map_err(|what| (at, what))?,
            (None, Some(c)) if is_letter(c) => {
                let length = name_length(rest);
                let name = &rest[..length];
                let token = match keyword(name) {
                    Some(keyword) => Token::Sign(printed(keyword)),
                    None if rest[length..].starts_with('(') => Token::Function(names.intern(name)),
                    None => Token::Name(names.intern(name)),
                };
                (token, length)
            }
            (None, c) => {
                let found = c.map(String::from).unwrap_or_default();
                return Err((at, format!("found {found:?}, which is no part of the notation")));
            }
        };
        let closing = matches!(token, Token::Sign(")" | "," | ";"));
        let wanted = if starts_operand(&token) { 1 } else { 2 };
        let spaces = at - end;
        if open.last() == Some(&"(") && behind_operand && !closing && spaces >= wanted {
            found.push((Token::Gap, end..at));
        }
        match token {
            Token::Sign(bracket @ ("(" | "[" | "⟨" | "|" | "{")) => open.push(bracket),
            Token::Sign(")" | "]" | "⟩" | "}") | Token::ClosingBar => drop(open.pop()),
            _ => {}
        }
        if open.len() > depth {
            return Err((at, format!("found brackets more than {depth} deep")));
        }
        end = at + length;
        found.push((token, at..end));
    }
}

/// Returns how many bytes the name at the start of `rest` has. A full stop belongs to a name if a
/// letter or a digit follows: Mathcad's literal subscript.
pub fn name_length(rest: &str) -> usize {
    let ordinary = |c: char| is_letter(c) || c.is_numeric() || c == '\'';
    let next = rest.chars().skip(1).map(Some).chain([None]);
    let inside = rest.chars().zip(next).take_while(|(c, next)| match c {
        '.' => next.is_some_and(ordinary),
        c => ordinary(*c),
    });
    inside.map(|(c, _)| c.len_utf8()).sum()
}

/// The roots, sums, products, `×` and `→` are functions with names of one sign.
fn is_letter(c: char) -> bool {
    (c.is_alphabetic() || matches!(c, '_' | '√' | '∑' | '∏' | '×' | '→')) && c != 'ᵀ'
}

fn number(rest: &str) -> Result<(Token, usize), String> {
    let digits = |s: &str| s.find(|c: char| !c.is_ascii_digit()).unwrap_or(s.len());
    let mut length = digits(rest);
    if let Some(fraction) = rest[length..].strip_prefix('.') {
        length += if digits(fraction) > 0 { 1 + digits(fraction) } else { 0 };
    }
    if let Some(exponent) = rest[length..].strip_prefix(['e', 'E']) {
        let behind = exponent.strip_prefix(['+', '-', '−']).unwrap_or(exponent);
        let sign = exponent.len() - behind.len();
        length += if digits(behind) > 0 { 1 + sign + digits(behind) } else { 0 };
    }
    match rest[..length].replace('−', "-").parse() {
        Ok(x) if f64::is_finite(x) => Ok((Token::Number(x), length)),
        _ => Err("found a number too large".into()),
    }
}

fn text(rest: &str) -> Result<(Token, usize), String> {
    let inside = rest[1..].split('"').next().unwrap_or_default();
    if inside.len() + 1 == rest.len() {
        return Err("found a string without its second quotation mark".into());
    }
    Ok((Token::Text(inside.into()), inside.len() + 2))
}

fn starts_operand(token: &Token) -> bool {
    let operand = matches!(token, Token::Number(_) | Token::Text(_) | Token::Name(_));
    // Within brackets `if` is the function.
    operand || matches!(token, Token::Function(_) | Token::Sign("(" | "|" | "{" | "if"))
}

fn ends_operand(token: &Token) -> bool {
    let operand = matches!(token, Token::Number(_) | Token::Text(_) | Token::Name(_));
    operand || matches!(token, Token::ClosingBar | Token::Sign(")" | "]" | "⟩" | "}" | "ᵀ"))
}
