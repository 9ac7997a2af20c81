//! Tests of the notation, the interpreter and worksheets, a file per subject.

extern crate plane_contact_mathcad as mathcad;

mod evidence;
mod limits;
mod notation;
mod recorder;
mod regions;
mod rules;
mod semantics;
mod values;
mod xmcd;

use fastrand::Rng;
use mathcad::failure::Fallible;
use mathcad::xmcd::page::Page;
use mathcad::{Array, Ended, Limits, Listing, Settings, Sheet, Value};

/// One of few.
fn one_of<T: Clone>(rng: &mut Rng, from: &[T]) -> T {
    from[rng.usize(..from.len())].clone()
}

/// Writes listings as a worksheet.
fn worksheet(listings: &[Listing]) -> String {
    let mut page = Page::default();
    for listing in listings {
        page.program(listing);
    }
    page.finish("", &Settings::default())
}

/// Makes a listing `f(x)` of the given lines.
fn program(lines: &str) -> Listing {
    let body: String = lines.lines().map(|line| format!("  {line}\n")).collect();
    Listing::parse("f", &format!("f(x) :=\n{body}")).unwrap_or_else(|error| panic!("{error}"))
}

/// Returns the program's outcome under `settings`, with x = 5, the worksheet's v = (1 2 3)ᵀ, and
/// m = (1 2; 3 4).
fn outcome(lines: &str, settings: &Settings) -> Fallible<Ended> {
    let mut worksheet = Sheet::empty();
    worksheet.define("v", Array::column(vec![1.0, 2.0, 3.0]));
    worksheet.define("m", Array::from_fn(2, 2, |i, j| (2 * i + j + 1) as f64));
    called(&program(lines), &worksheet, settings)
}

/// Calls a program with x = 5 in a worksheet.
fn called(program: &Listing, worksheet: &Sheet, settings: &Settings) -> Fallible<Ended> {
    program.runner(worksheet, settings, &Limits::default()).call(&[Value::Number(5.0)])
}

/// Returns the program's value as text, rows separated by `;`, under `settings`.
fn value_under(settings: &Settings, lines: &str) -> String {
    outcome(lines, settings).unwrap_or_else(|failure| panic!("{failure}")).value.to_string()
}

/// Returns the program's value as text in a default worksheet.
fn value(lines: &str) -> String {
    value_under(&Settings::default(), lines)
}
