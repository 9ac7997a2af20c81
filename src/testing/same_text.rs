//! Printed texts compared: words are exact, a number may differ by one in its last printed digit, and is not compared
//! where it is rounding itself (below 1e-9): residuals and what rounding does to a displacement.

/// Numbers below this are rounding.
const NOISE: f64 = 1e-9;

/// Compares texts as this file's head says.
pub fn same_text(expected: &str, value: &str) -> bool {
    let (expected, value) = (expected.trim_end(), value.trim_end());
    let [e, v] = [expected, value].map(pieces);
    // Where rounding itself is printed otherwise, columns may have other widths.
    let is_folded = numbers(&e).zip(numbers(&v)).any(|(e, v)| is_noise(e) && e.len() != v.len());
    match is_folded {
        false => same_pieces(&e, &v),
        true => same_pieces(&pieces(&folded(expected)), &pieces(&folded(value))),
    }
}

fn same_pieces(expected: &[Piece], value: &[Piece]) -> bool {
    let is_same = |(e, v): (&Piece, &Piece)| match (e, v) {
        (Piece::Words(e), Piece::Words(v)) => e == v,
        (Piece::Number(e), Piece::Number(v)) => same_number(e, v),
        (Piece::Words(_), Piece::Number(_)) | (Piece::Number(_), Piece::Words(_)) => false,
    };
    expected.len() == value.len() && expected.iter().zip(value).all(is_same)
}

/// A part of a text.
#[derive(Clone, Copy)]
enum Piece<'t> {
    Words(&'t str),
    /// A number that is not whole, or 0.
    Number(&'t str),
}

/// Divides a text.
fn pieces(text: &str) -> Vec<Piece<'_>> {
    let (mut pieces, mut start, mut at) = (Vec::new(), 0, 0);
    while let Some(c) = text[at..].chars().next() {
        let before = text[..at].chars().next_back();
        let is_inside = before.is_some_and(|c| c.is_alphanumeric() || matches!(c, '.' | '_'));
        let sign = usize::from(c == '-');
        let length = if is_inside { None } else { number(&text[at + sign..]).map(|n| sign + n) };
        match length {
            Some(length) => {
                pieces.extend([
                    Piece::Words(&text[start..at]),
                    Piece::Number(&text[at..at + length]),
                ]);
                at += length;
                start = at;
            }
            None => at += c.len_utf8(),
        }
    }
    pieces.push(Piece::Words(&text[start..]));
    pieces
}

/// Returns the length of the number at the start of a text, if one is there that is not whole, or 0.
fn number(text: &str) -> Option<usize> {
    let end = text.find(|c: char| !c.is_ascii_alphanumeric() && !matches!(c, '.' | '-' | '_'));
    let word = text[..end.unwrap_or(text.len())].trim_end_matches(['.', '-']);
    let starts = word.starts_with(|c: char| c.is_ascii_digit());
    let is_number =
        starts && word.parse::<f64>().is_ok() && (word.contains(['.', 'e']) || word == "0");
    is_number.then_some(word.len())
}

fn numbers<'t>(pieces: &[Piece<'t>]) -> impl Iterator<Item = &'t str> {
    pieces.iter().filter_map(|piece| match piece {
        Piece::Words(_) => None,
        Piece::Number(number) => Some(*number),
    })
}

fn is_noise(number: &str) -> bool {
    number.parse::<f64>().is_ok_and(|x| x.abs() < NOISE)
}

/// Returns a text with one blank in place of several, and one dash.
fn folded(text: &str) -> String {
    let mut folded = String::new();
    text.chars().for_each(|c| match (c, folded.chars().next_back()) {
        (' ' | '-', Some(last)) if last == c => (),
        (_, _) => folded.push(c),
    });
    folded
}

/// Compares numbers by value and printed digits.
fn same_number(expected: &str, value: &str) -> bool {
    if is_noise(expected) || is_noise(value) {
        return is_noise(expected) && is_noise(value);
    }
    let [(e, step), (v, own)] = [expected, value].map(|number| {
        let (mantissa, exponent) = number.split_once('e').unwrap_or((number, "0"));
        let decimals = mantissa.split_once('.').map_or(0, |(_, decimals)| decimals.len());
        let exponent: i32 = exponent.parse().expect("a whole exponent");
        (number.parse::<f64>().expect("a number"), 10f64.powi(exponent - decimals as i32))
    });
    step == own && (e == v || (e - v).abs() <= 1.001 * step)
}
