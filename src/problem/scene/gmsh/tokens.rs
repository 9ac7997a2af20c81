//! The sequence of numbers and words in a file, the same for text and for binary.

use std::str::FromStr;

use super::error::{Fault, GmshError, Place, Result};

#[derive(Clone, Copy, Default, PartialEq)]
pub enum Encoding {
    #[default]
    Text,
    LittleEndian,
    BigEndian,
}

#[derive(Default)]
pub struct Tokens<'a> {
    bytes: &'a [u8],
    at: usize,
    /// The place where the last token began, which errors report.
    last: usize,
    pub encoding: Encoding,
}

impl<'a> Tokens<'a> {
    /// Starts at the beginning of a file, which is text.
    pub fn new(bytes: &'a [u8]) -> Self {
        Tokens { bytes, at: 0, last: 0, encoding: Encoding::Text }
    }

    /// Reads the next whole number, which takes four bytes in a binary file.
    pub fn int(&mut self, expected: &str) -> Result<i32> {
        self.number(expected, i32::from_le_bytes, i32::from_be_bytes)
    }

    /// Reads the next [`Self::int`], which must be at least `least`.
    pub fn int_from(&mut self, least: usize, expected: &str) -> Result<usize> {
        let found = self.int(expected)?;
        let number = usize::try_from(found).ok().filter(|&number| number >= least);
        number.ok_or_else(|| self.unexpected(found, expected))
    }

    /// Reads the next count or number of 4.1, which takes eight bytes in a binary file.
    pub fn size(&mut self, expected: &str) -> Result<usize> {
        let found = self.number(expected, u64::from_le_bytes, u64::from_be_bytes)?;
        usize::try_from(found).map_err(|_| self.unexpected(found, expected))
    }

    /// Reads the next [`Self::size`], which must be at least `least`.
    pub fn size_from(&mut self, least: usize, expected: &str) -> Result<usize> {
        let found = self.size(expected)?;
        if found < least { Err(self.unexpected(found, expected)) } else { Ok(found) }
    }

    /// Reads the next real number, which takes eight bytes in a binary file.
    pub fn double(&mut self, expected: &str) -> Result<f64> {
        self.number(expected, f64::from_le_bytes, f64::from_be_bytes)
    }

    /// Reads the next number, which takes `N` bytes in a binary file.
    fn number<T: FromStr + TryFrom<u32>, const N: usize>(
        &mut self,
        expected: &str,
        little: fn([u8; N]) -> T,
        big: fn([u8; N]) -> T,
    ) -> Result<T> {
        match self.encoding {
            Encoding::Text => match self.digits().and_then(|number| T::try_from(number).ok()) {
                Some(number) => Ok(number),
                None => self.parse(expected),
            },
            Encoding::LittleEndian => self.raw(expected).map(little),
            Encoding::BigEndian => self.raw(expected).map(big),
        }
    }

    /// Reads the next `N` bytes.
    fn raw<const N: usize>(&mut self, expected: &str) -> Result<[u8; N]> {
        self.last = self.at;
        let Some(raw) = self.bytes[self.at..].first_chunk() else {
            return Err(self.unexpected("the end of the file", expected));
        };
        self.at += N;
        Ok(*raw)
    }

    /// Reads the next word as a `T`.
    pub fn parse<T: FromStr>(&mut self, expected: &str) -> Result<T> {
        let word = self.word();
        let parsed = std::str::from_utf8(word)
            .ok()
            .filter(|word| !word.is_empty())
            .and_then(|word| word.parse().ok());
        parsed.ok_or_else(|| self.unexpected(shown(word), expected))
    }

    /// Reads the next word if it is up to nine digits, as most are; any number type holds them.
    fn digits(&mut self) -> Option<u32> {
        let blanks = run(&self.bytes[self.at..], |byte| byte.is_ascii_whitespace());
        let rest = &self.bytes[self.at + blanks..];
        let length = run(rest, u8::is_ascii_digit);
        let ends = rest.get(length).is_none_or(u8::is_ascii_whitespace);
        if !(ends && (1..=9).contains(&length)) {
            return None;
        }
        self.last = self.at + blanks;
        self.at = self.last + length;
        Some(rest[..length].iter().fold(0, |number, digit| 10 * number + u32::from(digit - b'0')))
    }

    /// Reads the next word, which ends at white space; empty at the end of the file.
    fn word(&mut self) -> &'a [u8] {
        self.at += run(&self.bytes[self.at..], |byte| byte.is_ascii_whitespace());
        self.last = self.at;
        let rest = &self.bytes[self.at..];
        let word = &rest[..run(rest, |byte| !byte.is_ascii_whitespace())];
        self.at += word.len();
        word
    }

    /// Reads a count with a line to itself, which is text in binary files too (2.2).
    pub fn count_line(&mut self, expected: &str) -> Result<usize> {
        let count = self.parse(expected)?;
        self.line_end()?;
        Ok(count)
    }

    /// Reads the text between the line's first and last quotation mark.
    pub fn quoted(&mut self, expected: &str) -> Result<String> {
        let line = self.line();
        let name = std::str::from_utf8(line)
            .ok()
            .and_then(|line| line.trim().strip_prefix('"')?.strip_suffix('"'));
        name.map(str::to_owned).ok_or_else(|| {
            let line = String::from_utf8_lossy(line);
            self.unexpected(format!("{:?}", line.trim()), expected)
        })
    }

    /// Reads the end of the line, with only blanks before it; the end of the file is accepted.
    pub fn line_end(&mut self) -> Result<()> {
        let line = self.line().trim_ascii();
        if !line.is_empty() {
            return Err(self.unexpected(shown(line), "the end of the line"));
        }
        Ok(())
    }

    fn line(&mut self) -> &'a [u8] {
        self.last = self.at;
        let rest = &self.bytes[self.at..];
        let length = run(rest, |&byte| byte != b'\n');
        self.at += rest.len().min(length + 1);
        &rest[..length]
    }

    /// Reads the name of the section that begins here, without `$`; None at the file's end.
    pub fn section(&mut self) -> Result<Option<String>> {
        let word = self.word();
        if word.is_empty() {
            return Ok(None);
        }
        match std::str::from_utf8(word).ok().and_then(|word| word.strip_prefix('$')) {
            Some(name) if !name.is_empty() && !name.starts_with("End") => {
                self.line_end()?;
                Ok(Some(name.to_owned()))
            }
            _ => Err(self.unexpected(shown(word), "the beginning of a section, such as $Nodes")),
        }
    }

    /// Reads the line `keyword`.
    pub fn keyword(&mut self, keyword: &str, expected: &str) -> Result<()> {
        let word = self.word();
        if word != keyword.as_bytes() {
            return Err(self.unexpected(shown(word), expected));
        }
        self.line_end()
    }

    /// Skips to the next occurrence of `keyword`.
    pub fn skip_to(&mut self, keyword: &str) -> Result<()> {
        self.last = self.bytes.len();
        let mut windows = self.bytes[self.at..].windows(keyword.len());
        let distance = windows.position(|window| window == keyword.as_bytes());
        self.at += distance.ok_or_else(|| self.unexpected("the end of the file", keyword))?;
        Ok(())
    }

    /// Reads the byte order in which the next four bytes are the number 1.
    pub fn byte_order(&mut self) -> Result<Encoding> {
        let expected = "the number 1 in four bytes, which tells their order";
        match self.raw(expected)? {
            [1, 0, 0, 0] => Ok(Encoding::LittleEndian),
            [0, 0, 0, 1] => Ok(Encoding::BigEndian),
            found => Err(self.unexpected(format!("the bytes {found:?}"), expected)),
        }
    }

    /// Returns an error at the last token: `found` in place of `expected`.
    pub fn unexpected(&self, found: impl ToString, expected: impl ToString) -> GmshError {
        self.error(Fault::Unexpected { found: found.to_string(), expected: expected.to_string() })
    }

    pub fn error(&self, fault: Fault) -> GmshError {
        let place = match self.encoding {
            Encoding::Text => {
                let ends = self.bytes[..self.last].iter().filter(|&&byte| byte == b'\n');
                Place::Line(1 + ends.count())
            }
            _ => Place::Byte(self.last),
        };
        GmshError { place, fault }
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
