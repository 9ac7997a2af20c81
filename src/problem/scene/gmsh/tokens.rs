//! The sequence of numbers and words in a file, the same for text and for binary.

use std::borrow::Cow;
use std::str::FromStr;

use super::{GmshError, Result};

#[derive(Clone, Copy, PartialEq)]
pub enum Encoding {
    Text,
    /// Numbers in bytes, the least significant first.
    Binary,
}

pub struct Tokens<'a> {
    file: &'a [u8],
    /// The place behind what was read.
    at: usize,
    /// The place where the last token began, which errors report.
    last: usize,
    pub encoding: Encoding,
}

impl<'a> Tokens<'a> {
    /// Starts at the beginning of a file, which is text.
    pub fn new(file: &'a [u8]) -> Self {
        Tokens { file, at: 0, last: 0, encoding: Encoding::Text }
    }

    /// Returns what was not read yet.
    fn rest(&self) -> &'a [u8] {
        &self.file[self.at..]
    }

    /// Returns the bytes of the last token.
    fn token(&self) -> &'a [u8] {
        &self.file[self.last..self.at]
    }

    /// Passes over blanks, and begins the token behind them.
    fn begin_word(&mut self) {
        self.at += run(self.rest(), u8::is_ascii_whitespace);
        self.last = self.at;
    }

    /// Reads the next whole number, which takes four bytes in a binary file.
    pub fn int(&mut self, expected: &str) -> Result<i32> {
        self.number(expected, i32::from_le_bytes)
    }

    /// Reads the next [`Self::int`], which must be at least `least`.
    pub fn int_from(&mut self, least: usize, expected: &str) -> Result<usize> {
        let found = self.int(expected)?;
        let number = usize::try_from(found).ok().filter(|&number| number >= least);
        number.ok_or_else(|| self.unexpected(found, expected))
    }

    /// Reads the next count or number of 4.1, which takes eight bytes in a binary file.
    pub fn size(&mut self, expected: &str) -> Result<usize> {
        let found = self.number(expected, u64::from_le_bytes)?;
        usize::try_from(found).map_err(|_| self.unexpected(found, expected))
    }

    /// Reads the next [`Self::size`], which must be at least `least`.
    pub fn size_from(&mut self, least: usize, expected: &str) -> Result<usize> {
        let found = self.size(expected)?;
        if found < least { Err(self.unexpected(found, expected)) } else { Ok(found) }
    }

    /// Reads the next real number, which takes eight bytes in a binary file.
    pub fn double(&mut self, expected: &str) -> Result<f64> {
        self.number(expected, f64::from_le_bytes)
    }

    /// Reads the next number, which takes `N` bytes in a binary file.
    fn number<T: FromStr + TryFrom<u32>, const N: usize>(
        &mut self,
        expected: &str,
        of_bytes: fn([u8; N]) -> T,
    ) -> Result<T> {
        match self.encoding {
            Encoding::Text => match self.digits().and_then(|number| T::try_from(number).ok()) {
                Some(number) => Ok(number),
                None => self.parse(expected),
            },
            Encoding::Binary => self.raw(expected).map(of_bytes),
        }
    }

    /// Reads the next `N` bytes.
    fn raw<const N: usize>(&mut self, expected: &str) -> Result<[u8; N]> {
        self.last = self.at;
        let Some(raw) = self.rest().first_chunk() else {
            return Err(self.unexpected("the end of the file", expected));
        };
        self.at += N;
        Ok(*raw)
    }

    /// Reads the next word as a `T`.
    pub fn parse<T: FromStr>(&mut self, expected: &str) -> Result<T> {
        self.word();
        let word = std::str::from_utf8(self.token()).ok().filter(|word| !word.is_empty());
        let parsed = word.and_then(|word| word.parse().ok());
        parsed.ok_or_else(|| {
            let digits = word.unwrap_or_default().trim_start_matches('-');
            let is_large = digits.len() > 9 && digits.bytes().all(|byte| byte.is_ascii_digit());
            let largest = if size_of::<T>() == 4 { i32::MAX as u64 } else { u64::MAX };
            let beyond = format!(", beyond the largest number {largest}");
            let beyond = if is_large { &*beyond } else { "" };
            self.unexpected(shown(self.token()) + beyond, expected)
        })
    }

    /// Reads the next word if it is up to nine digits, as most are; any number type holds them.
    fn digits(&mut self) -> Option<u32> {
        self.begin_word();
        let rest = self.rest();
        let length = run(rest, u8::is_ascii_digit);
        let ends = rest.get(length).is_none_or(u8::is_ascii_whitespace);
        if !(ends && (1..=9).contains(&length)) {
            return None;
        }
        self.at += length;
        Some(self.token().iter().fold(0, |number, digit| 10 * number + u32::from(digit - b'0')))
    }

    /// Reads the next word, which ends at white space; empty at the end of the file.
    fn word(&mut self) {
        self.begin_word();
        self.at += run(self.rest(), |byte| !byte.is_ascii_whitespace());
    }

    /// Reads a count with a line to itself, which is text in binary files too (2.2).
    pub fn count_line(&mut self, expected: &str) -> Result<usize> {
        let count = self.parse(expected)?;
        self.line_end()?;
        Ok(count)
    }

    /// Reads the text between the line's first and last quotation mark.
    pub fn quoted(&mut self, expected: &str) -> Result<String> {
        self.line();
        let line = String::from_utf8_lossy(self.token());
        if let Cow::Owned(line) = &line {
            let found = format!("{}, which is not in UTF-8 (as Latin-1 is not)", line.trim());
            return Err(self.unexpected(found, "a name in UTF-8: rename the group, and save again"));
        }
        let name = line.trim().strip_prefix('"').and_then(|line| line.strip_suffix('"'));
        let name = name.map(str::to_owned);
        name.ok_or_else(|| self.unexpected(format!("{:?}", line.trim()), expected))
    }

    /// Returns whether a quotation mark comes next on the line.
    pub fn is_quote_next(&self) -> bool {
        self.rest().trim_ascii_start().starts_with(b"\"")
    }

    /// Reads the end of the line, with only blanks before it; the end of the file is accepted.
    pub fn line_end(&mut self) -> Result<()> {
        self.line();
        match self.token().trim_ascii() {
            [] => Ok(()),
            line => Err(self.unexpected(shown(line), "the end of the line")),
        }
    }

    /// Reads the rest of the line, with its end.
    fn line(&mut self) {
        self.last = self.at;
        let length = run(self.rest(), |byte| *byte != b'\n') + 1;
        self.at = self.file.len().min(self.at + length);
    }

    /// Reads the name of the section that begins here, without `$`; None at the file's end.
    ///
    /// # Errors
    /// Something else is there than what was `expected`.
    pub fn section(&mut self, expected: &str) -> Result<Option<String>> {
        self.word();
        if self.token().is_empty() {
            return Ok(None);
        }
        let name = std::str::from_utf8(self.token()).ok().and_then(|word| word.strip_prefix('$'));
        match name.filter(|name| !name.is_empty() && !name.starts_with("End")).map(str::to_owned) {
            Some(name) => {
                self.line_end()?;
                Ok(Some(name))
            }
            None => Err(self.unexpected(shown(self.token()), expected)),
        }
    }

    /// Reads the line `keyword`.
    pub fn keyword(&mut self, keyword: &str) -> Result<()> {
        self.word();
        if self.token() != keyword.as_bytes() {
            return Err(self.unexpected(shown(self.token()), keyword));
        }
        self.line_end()
    }

    /// Reads the four bytes that are the number 1 in the order that is read.
    pub fn byte_order(&mut self) -> Result<()> {
        let expected = "the number 1 in four bytes, which tells their order";
        match self.raw(expected)? {
            [1, 0, 0, 0] => Ok(()),
            [0, 0, 0, 1] => Err(self.refused(
                "the numbers of this binary file have their most significant byte first: save the mesh \
                 again on this machine, or as text (in Gmsh set Mesh.Binary = 0)",
            )),
            found => Err(self.unexpected(format!("the bytes {found:?}"), expected)),
        }
    }

    /// Skips the section `name`, of which the first line is read.
    pub fn skip(&mut self, name: &str) -> Result<()> {
        let end = format!("$End{name}");
        let mut windows = self.rest().windows(end.len());
        let Some(distance) = windows.position(|window| window == end.as_bytes()) else {
            self.last = self.file.len();
            return Err(self.unexpected("the end of the file", end));
        };
        self.at += distance;
        self.keyword(&end)
    }

    /// Skips a byte order mark at the beginning of the file.
    ///
    /// # Errors
    /// It is that of UTF-16.
    pub fn skip_mark(&mut self) -> Result<()> {
        match self.file {
            [0xEF, 0xBB, 0xBF, ..] => self.at = 3,
            [0xFF, 0xFE, ..] | [0xFE, 0xFF, ..] => {
                return Err(self.unexpected("a file in UTF-16", "ASCII or UTF-8: save it so"));
            }
            _ => (),
        }
        Ok(())
    }

    /// Returns an error at the last token: `found` in place of `expected`.
    pub fn unexpected(&self, found: impl ToString, expected: impl ToString) -> GmshError {
        let (found, expected) = (found.to_string(), expected.to_string());
        let error = self.refused(format!("found {found}, expected {expected}"));
        GmshError { expected: Some(expected), ..error }
    }

    /// Returns an error at the last token: what is wrong there.
    pub fn refused(&self, what: impl Into<String>) -> GmshError {
        let read = &self.file[..self.last];
        let place = match self.encoding {
            Encoding::Text => {
                format!("line {}", 1 + read.iter().filter(|byte| **byte == b'\n').count())
            }
            Encoding::Binary => format!("byte {}", self.last),
        };
        GmshError { place, what: what.into(), expected: None }
    }
}

/// Returns how many of the first bytes are `such`.
fn run(bytes: &[u8], such: impl Fn(&u8) -> bool) -> usize {
    bytes.iter().position(|byte| !such(byte)).unwrap_or(bytes.len())
}

/// Returns a word for an error message: in quotation marks and cut short, or the end of the file.
fn shown(word: &[u8]) -> String {
    const MOST: usize = 40;
    match word.len() {
        0 => "the end of the file".to_owned(),
        1..=MOST => format!("{:?}", String::from_utf8_lossy(word)),
        _ => format!("{:?} and more", String::from_utf8_lossy(&word[..MOST])),
    }
}
