//! The sequence of numbers and words in a file, the same for text and for binary.

use std::borrow::Cow;
use std::io::{self, Read};
use std::str::FromStr;

use super::error::{Fault, GmshError, Place, Result};

#[derive(Clone, Copy, Default, PartialEq)]
pub enum Encoding {
    #[default]
    Text,
    LittleEndian,
    BigEndian,
}

/// The bytes that are read at a time.
const PART: usize = 1 << 18;

/// The bytes of the longest word or line; what is longer ends there.
const LONGEST: usize = 1 << 16;

pub struct Tokens<'a> {
    source: Box<dyn Read + 'a>,
    /// The part of the file that is held, of which the bytes from `at` on are not read yet.
    held: Vec<u8>,
    at: usize,
    /// The place in `held` where the last token began, which errors report.
    last: usize,
    /// The bytes of the file before `held`, and the line ends among them.
    before: [usize; 2],
    /// Whether nothing follows `held`.
    is_all: bool,
    /// Why the file could not be read on.
    broken: Option<String>,
    pub encoding: Encoding,
}

impl Default for Tokens<'_> {
    fn default() -> Self {
        Tokens::new(io::empty())
    }
}

impl<'a> Tokens<'a> {
    /// Starts at the beginning of a file, which is text.
    pub fn new(source: impl Read + 'a) -> Self {
        Tokens {
            source: Box::new(source),
            held: Vec::new(),
            at: 0,
            last: 0,
            before: [0; 2],
            is_all: false,
            broken: None,
            encoding: Encoding::Text,
        }
    }

    /// Begins a token: from here on the longest one is held, or the rest of the file.
    fn begin(&mut self) {
        if self.held.len() - self.at < LONGEST && !self.is_all {
            self.read_on();
        }
        self.last = self.at;
    }

    /// Holds the next part of the file, and nothing that was read.
    fn read_on(&mut self) {
        let read = self.held.drain(..self.at);
        let ends = read.as_slice().iter().filter(|byte| **byte == b'\n').count();
        drop(read);
        self.before = [self.before[0] + self.at, self.before[1] + ends];
        self.at = 0;
        let wanted = PART - self.held.len();
        let got = (&mut self.source).take(wanted as u64).read_to_end(&mut self.held);
        self.is_all = got.as_ref().map_or(true, |got| *got < wanted);
        self.broken = got.err().map(|why| why.to_string());
    }

    /// Passes over blanks, and begins the token behind them.
    fn begin_word(&mut self) {
        loop {
            self.begin();
            self.at += run(&self.held[self.at..], u8::is_ascii_whitespace);
            if self.at < self.held.len() || self.is_all {
                break;
            }
        }
        self.begin();
    }

    /// Returns the bytes of the last token.
    fn token(&self) -> &[u8] {
        &self.held[self.last..self.at]
    }

    /// Returns how many of the next bytes are `such`, at most those of the longest token.
    fn run_of(&self, such: impl Fn(&u8) -> bool) -> usize {
        let rest = &self.held[self.at..];
        run(&rest[..rest.len().min(LONGEST)], such)
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
        self.begin();
        let Some(raw) = self.held[self.at..].first_chunk() else {
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
            let found = shown(self.token());
            let found = if is_large {
                format!("{found}, beyond the largest number {largest}")
            } else {
                found
            };
            self.unexpected(found, expected)
        })
    }

    /// Reads the next word if it is up to nine digits, as most are; any number type holds them.
    fn digits(&mut self) -> Option<u32> {
        self.begin_word();
        let rest = &self.held[self.at..];
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
        self.at += self.run_of(|byte| !byte.is_ascii_whitespace());
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
        self.begin();
        let length = self.run_of(|byte| *byte != b'\n') + 1;
        self.at = self.held.len().min(self.at + length);
    }

    /// Reads the name of the section that begins here, without `$`; None at the file's end.
    ///
    /// # Errors
    /// Something else is there than what was `expected`.
    pub fn section(&mut self, expected: &str) -> Result<Option<String>> {
        self.word();
        if self.token().is_empty() && self.broken.is_none() {
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
    pub fn keyword(&mut self, keyword: &str, expected: &str) -> Result<()> {
        self.word();
        if self.token() != keyword.as_bytes() {
            return Err(self.unexpected(shown(self.token()), expected));
        }
        self.line_end()
    }

    /// Skips to the next occurrence of `keyword`.
    fn skip_to(&mut self, keyword: &str) -> Result<()> {
        loop {
            self.begin();
            let rest = &self.held[self.at..];
            let mut windows = rest.windows(keyword.len());
            if let Some(distance) = windows.position(|window| window == keyword.as_bytes()) {
                self.at += distance;
                return Ok(());
            }
            if self.is_all {
                self.last = self.held.len();
                return Err(self.unexpected("the end of the file", keyword));
            }
            // It may begin in this part and end in the next one.
            self.at = self.held.len() - (keyword.len() - 1);
        }
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

    /// Skips the section `name`, of which the first line is read.
    pub fn skip(&mut self, name: &str) -> Result<()> {
        let end = format!("$End{name}");
        self.skip_to(&end)?;
        self.keyword(&end, &end)
    }

    /// Skips a byte order mark at the beginning of the file.
    ///
    /// # Errors
    /// It is that of UTF-16.
    pub fn skip_mark(&mut self) -> Result<()> {
        self.begin();
        match self.held[..] {
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
        self.error(Fault::Unexpected { found: found.to_string(), expected: expected.to_string() })
    }

    /// Returns an error at the last token; where the file could not be read on, that is the fault.
    pub fn error(&self, fault: Fault) -> GmshError {
        let read = &self.held[..self.last];
        let [bytes, ends] = self.before;
        let place = match self.encoding {
            Encoding::Text => {
                Place::Line(1 + ends + read.iter().filter(|byte| **byte == b'\n').count())
            }
            Encoding::LittleEndian | Encoding::BigEndian => Place::Byte(bytes + self.last),
        };
        let broken = self.broken.as_ref().filter(|_| self.at == self.held.len());
        let fault = broken.map_or(fault, |why| Fault::Broken { why: why.clone() });
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
