//! A listing: its lines, and the program they spell.

use std::fmt;

use super::failure::ParseError;
use super::lexer::{self, Complaint, Names, Spanned, Token};
use super::parser;
use super::settings::Limits;
use super::syntax::{Expr, Kind, Slot, Statement, Step};

/// A printed line of a listing.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Line {
    /// The line's number in the print, from 1. Under a reading that moves or repeats lines the
    /// numbers need not ascend.
    pub printed: usize,
    /// The line's number in the file, from 1.
    pub in_file: usize,
    /// How deep the line stands: Mathcad's bars to its left.
    pub level: usize,
    /// The text of the line behind its indentation.
    pub text: String,
}

/// A program as printed, and read.
#[derive(Clone, Debug)]
pub struct Listing {
    pub(super) name: String,
    pub(super) lines: Vec<Line>,
    /// The names that the listing uses, by their number.
    pub names: Names,
    /// The parameters of its header, in their order.
    pub parameters: Vec<Slot>,
    /// Its statements; loops and conditions contain theirs.
    pub program: Vec<Statement>,
    /// What the program does with the name of each slot.
    pub(super) used: Vec<Used>,
    /// How deep its blocks and expressions stand within each other.
    pub(super) depth: usize,
}

/// The line between the two blocks of `try`.
pub const ON_ERROR: &str = "on error";

/// Returns a line that has no string without its remark.
fn without_remark(line: &str) -> &str {
    line.split('#').next().unwrap_or_default()
}

/// What a program does with a name.
#[derive(Clone, Debug, Default)]
pub(super) struct Used {
    read: bool,
    called: bool,
    pub written: bool,
}

/// Notes what statements do with each name; the variables of the series around them, `bound`, are the series'
/// own.
fn note(block: &[Statement], bound: &mut Vec<Slot>, used: &mut [Used]) {
    for statement in block {
        statement.step.written().into_iter().for_each(|slot| used[slot].written = true);
        statement.on_line().into_iter().for_each(|expr| note_within(expr, bound, used));
        statement.blocks.iter().for_each(|block| note(block, bound, used));
    }
}

fn note_within(expr: &Expr, bound: &mut Vec<Slot>, used: &mut [Used]) {
    let depth = bound.len();
    match &expr.kind {
        Kind::Name(name) => used[*name].read |= !bound.contains(name),
        Kind::Call(name) => used[*name].called = true,
        Kind::Series { function, name } => {
            used[*function].called = true;
            bound.push(*name);
        }
        Kind::Program(block) => note(block, bound, used),
        Kind::Literal(_) | Kind::Group | Kind::Array { .. } => {}
        Kind::Apply(_) | Kind::Chain(_) | Kind::If => {}
    }
    expr.parts.iter().for_each(|part| note_within(part, bound, used));
    bound.truncate(depth);
}

impl Listing {
    /// Reads a listing in the notation of `listings/README.md`, under the default [`Limits`].
    ///
    /// `name` is what messages call the listing.
    ///
    /// # Errors
    /// Names the first place at which the text leaves the notation.
    pub fn parse(name: &str, text: &str) -> Result<Self, ParseError> {
        Self::parse_within(name, text, &Limits::default())
    }

    /// Reads a listing under limits of the caller's.
    ///
    /// # Errors
    /// Names the first place at which the text leaves the notation, or the limit that it
    /// exceeds.
    pub fn parse_within(name: &str, text: &str, limits: &Limits) -> Result<Self, ParseError> {
        Self::from_lines(name, Line::all(&text.lines().collect::<Vec<_>>(), 0), limits)
    }

    /// Reads a listing from its lines, the first being its header, under limits of the caller's.
    ///
    /// # Errors
    /// Those of [`Listing::parse_within`].
    pub fn from_lines(name: &str, lines: Vec<Line>, limits: &Limits) -> Result<Self, ParseError> {
        let mut reader = Reader { name, lines: &lines, names: Names::default(), limits, next: 0 };
        let (parameters, body) = reader.header()?;
        let program = match body {
            Some(body) => vec![body],
            None => reader.block(1)?,
        };
        if let Some(line) = lines.get(reader.next) {
            let message = match line.level {
                0 => "found a line beside the header, expected it indented",
                _ => "found a line below a function whose body stands behind `:=`",
            };
            return reader.refuse(line, message);
        }
        let names = reader.names;
        let mut used = vec![Used::default(); names.len()];
        note(&program, &mut vec![], &mut used);
        let depth = program.iter().map(|statement| statement.depth(usize::MAX)).max().unwrap_or(0);
        let name = name.into();
        Ok(Listing { name, names, parameters, program, lines, used, depth })
    }

    /// Returns the listing's name, as its header has it.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Returns the name of the function that the first line defines.
    pub fn function(&self) -> &str {
        self.names.name(0)
    }

    /// Returns the names that the program takes from its worksheet: those that it reads or calls,
    /// and neither receives nor writes to.
    pub fn free_names(&self) -> Vec<&str> {
        let is_free = |(slot, used): &(Slot, &Used)| {
            (used.read || used.called) && !used.written && !self.parameters.contains(slot)
        };
        let free = self.used.iter().enumerate().filter(is_free);
        free.map(|(slot, _)| self.names.name(slot)).collect()
    }

    /// Returns whether the program calls a function of that name.
    #[cfg(feature = "files")]
    pub(super) fn calls(&self, name: &str) -> bool {
        self.names.find(name).is_some_and(|slot| self.used[slot].called)
    }

    /// Returns the lines, those that are a remark alone left out.
    pub fn lines(&self) -> &[Line] {
        &self.lines
    }
}

/// Writes the listing's text, the lines that are a remark alone left out.
impl fmt::Display for Listing {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.lines.iter().try_for_each(|line| writeln!(f, "{line}"))
    }
}

impl Line {
    /// Returns the lines of a listing, those that are a remark alone left out; so many others stand before it in its
    /// file.
    pub fn all(lines: &[&str], before: usize) -> Vec<Line> {
        let numbered = lines.iter().zip(before + 1..);
        let lines = numbered.filter(|(text, _)| !without_remark(text).trim().is_empty());
        lines.enumerate().map(|(k, (text, in_file))| Line::new(k + 1, in_file, text)).collect()
    }

    /// Makes a line of `text` with its indentation.
    pub(super) fn new(printed: usize, in_file: usize, text: &str) -> Self {
        let behind = text.trim_start_matches(' ');
        let spaces = text.len() - behind.len();
        // An odd space stays with the text, where it is refused.
        Line { printed, in_file, level: spaces / 2, text: text[spaces / 2 * 2..].trim_end().into() }
    }
}

impl fmt::Display for Line {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:1$}{2}", "", 2 * self.level, self.text)
    }
}

struct Reader<'a> {
    name: &'a str,
    lines: &'a [Line],
    names: Names,
    limits: &'a Limits,
    next: usize,
}

impl Reader<'_> {
    /// Reads the first line: the parameters, and the body if it stands on that line too.
    fn header(&mut self) -> Result<(Vec<Slot>, Option<Statement>), ParseError> {
        let empty = Line::new(1, 1, "");
        let line = self.lines.first().unwrap_or(&empty);
        let (found, limit) = (self.lines.len(), self.limits.lines);
        if found > limit {
            return self.refuse(line, format!("found {found} lines, expected at most {limit}"));
        }
        let tokens = self.tokens(line)?;
        self.next = 1;
        let sign = tokens.iter().position(|(token, _)| *token == Token::Sign(":="));
        let (header, body) = tokens.split_at(sign.map_or(tokens.len(), |at| at + 1));
        let parameters = parser::header(header).map_err(|wrong| self.error(line, wrong))?;
        if body.is_empty() {
            return Ok((parameters, None));
        }
        let body = parser::statement(body, 0).map_err(|wrong| self.error(line, wrong))?;
        self.check_depth(line, &body)?;
        if !body.blocks.is_empty() || matches!(body.step, Step::Break | Step::Continue) {
            return self.refuse(line, "found a block behind `:=`, expected it indented below");
        }
        Ok((parameters, Some(body)))
    }

    /// Reads the lines that stand `level` deep from here on, with all blocks within them.
    fn block(&mut self, level: usize) -> Result<Vec<Statement>, ParseError> {
        let mut block = vec![];
        while let Some(line) = self.lines.get(self.next).filter(|line| line.level >= level) {
            if line.level > level {
                let (found, expected) = (2 * line.level, 2 * level);
                let message = format!("found {found} spaces of indentation, expected {expected}");
                return self.refuse(line, message);
            }
            if level > self.limits.depth {
                let message = format!("found blocks more than {} deep", self.limits.depth);
                return self.refuse(line, message);
            }
            let tokens = self.tokens(line)?;
            let statement = parser::statement(&tokens, self.next);
            let mut statement = statement.map_err(|complaint| self.error(line, complaint))?;
            self.check_depth(line, &statement)?;
            self.next += 1;
            for (k, body) in statement.blocks.iter_mut().enumerate() {
                // Between the two blocks of `try`.
                if k > 0 {
                    let other = self.lines.get(self.next);
                    let is_between = |other: &Line| {
                        other.level == level && without_remark(&other.text).trim_end() == ON_ERROR
                    };
                    if !other.is_some_and(is_between) {
                        let last = &self.lines[self.next - 1];
                        let message =
                            format!("expected a line `{ON_ERROR}` below, beside its `try`");
                        return Err(self.error(last, (last.text.len(), message)));
                    }
                    self.next += 1;
                }
                if body.is_empty() {
                    *body = self.block(level + 1)?;
                }
            }
            block.push(statement);
        }
        if block.is_empty() {
            let at = &self.lines[self.next - 1];
            return Err(self.error(at, (at.text.len(), "expected an indented line below".into())));
        }
        Ok(block)
    }

    fn tokens(&mut self, line: &Line) -> Result<Vec<Spanned>, ParseError> {
        let (length, limit) = (line.text.chars().count(), self.limits.characters);
        if length > limit {
            let message = format!("found {length} characters, expected at most {limit}");
            return self.refuse(line, message);
        }
        if line.text.starts_with(' ') {
            return self.refuse(line, "found an odd space, expected two for each level");
        }
        let tokens = lexer::tokens(&line.text, &mut self.names, self.limits.depth);
        tokens.map_err(|complaint| self.error(line, complaint))
    }

    fn check_depth(&self, line: &Line, statement: &Statement) -> Result<(), ParseError> {
        let limit = self.limits.depth;
        let deep = |expr: &&Expr| expr.depth(limit + 1) > limit;
        // What stands on the line: `x otherwise` has it in its block.
        let inside = statement.blocks.iter().flatten().flat_map(Statement::on_line);
        match statement.on_line().into_iter().chain(inside).find(deep) {
            Some(expr) => {
                let message = format!("found operators and brackets more than {limit} deep");
                Err(self.error(line, (expr.span.start, message)))
            }
            None => Ok(()),
        }
    }

    fn refuse<T>(&self, line: &Line, message: impl Into<String>) -> Result<T, ParseError> {
        Err(self.error(line, (0, message.into())))
    }

    fn error(&self, line: &Line, (at, message): Complaint) -> ParseError {
        ParseError {
            listing: self.name.into(),
            line: line.printed,
            file_line: line.in_file,
            column: 2 * line.level + line.text[..at].chars().count() + 1,
            text: line.to_string().chars().take(300).collect(),
            message,
        }
    }
}
