//! Listings. Text goes through lexer, parser and interpreter; behind a zero byte stand draws: of a
//! scene on which the printed listings have the mirror's bits, and of edits, under which they fail or
//! end with numbers.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::rc::Rc;

use arbitrary::{Result, Unstructured};
use plane_contact::mathcad::array::Table;
use plane_contact::mathcad::xmcd::document::{self, Content};
use plane_contact::mathcad::xmcd::page::Page;
use plane_contact::mathcad::{self, Array, Limits, Listing, Settings, Sheet, Value, file};
use plane_contact::output::evaluation;
use plane_contact::paper::door;
use plane_contact::paper::edited::Edited;
use plane_contact::paper::listings::{self, Which, settings};
use plane_contact::paper::mirror::{Cause, Failure, Km, Pairs, Reading, Worksheet, c_cnt};

use super::{drawn, sound};

/// Limits that a run reaches in a moment, those of depth as they are.
pub fn limits() -> Limits {
    Limits { characters: 1 << 16, entries: 1 << 16, steps: 1 << 14, ..Limits::default() }
}

pub fn hold(data: &[u8]) {
    if let Some(draws) = data.strip_prefix(b"\0") {
        // A scene that is refused has no listing to execute.
        let _ = on_a_scene(&mut Unstructured::new(draws));
    } else if let Ok(text) = std::str::from_utf8(data) {
        of_text(text);
    }
}

/// Reads a file of listings and calls the first. Behind `#!` its first line has the settings.
fn of_text(text: &str) {
    let programs = match file::listings("fuzz", text, &limits()) {
        Ok(programs) => programs,
        Err(error) => return assert!(!error.message.is_empty() && error.column > 0, "{error}"),
    };
    programs.iter().for_each(reads_back);
    let asked = text.lines().next().and_then(|line| line.strip_prefix("#!"));
    let settings: Settings = asked.and_then(|list| list.parse().ok()).unwrap_or_default();
    let mut sheet = Sheet::default();
    let values = [
        Value::Number(2.5),
        Value::from(Array::column(vec![3.0, 1.0, 2.0])),
        Value::from(Array::from_rows(2, vec![4.0, 1.0, 1.0, 3.0])),
        Value::Number(3.0),
    ];
    let named = ["x", "v", "A", "n"].into_iter().zip(&values);
    for (name, value) in named {
        sheet.define(name, value.clone());
    }
    let programs: Vec<Rc<Listing>> = programs.into_iter().map(Rc::new).collect();
    for program in &programs {
        sheet.define_program(program.clone());
    }
    let given: Vec<Value> =
        (0..programs[0].parameters.len()).map(|k| values[k % values.len()].clone()).collect();
    match programs[0].runner(&sheet, &settings, &limits()).call(&given) {
        Ok(outcome) => {
            outcome.locals.values().chain([&outcome.value]).for_each(is_finite);
            sound::document(&evaluation::json(&outcome));
        }
        Err(failure) => drop(sound::document(&evaluation::error_json(&failure))),
    }
}

/// A listing is read back from its text; and from a worksheet, but for parentheses, which Mathcad
/// needs at other places.
pub fn reads_back(listing: &Listing) {
    let parsed = |text: &str| {
        let limits = Limits { characters: 1 << 20, ..limits() };
        Listing::parse_within("fuzz", text, &limits)
    };
    let text = listing.to_string();
    let again = parsed(&text).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(again.to_string(), text);
    let once = by_worksheet(listing);
    match parsed(&once) {
        Ok(again) => assert_eq!(by_worksheet(&again), once, "{listing}"),
        Err(error) => assert!(error.message.ends_with("deep"), "{error} of\n{listing}"),
    }
}

/// Writes a listing as a worksheet, and reads it back as text.
fn by_worksheet(listing: &Listing) -> String {
    let mut page = Page::default();
    page.program(listing);
    let written = page.finish(listing.function(), &Settings::default());
    let read = document::read(&written, "fuzz").expect("a worksheet that was written");
    match &read.regions[0].content {
        Content::Function { text, .. } => text.clone(),
        Content::Definition { name, entry: None, lines, .. } => {
            format!("{name}() :=\n  {}\n", lines.join("\n  "))
        }
        other => panic!("{other:?} of\n{listing}"),
    }
}

/// No value of the interpreter is infinite or no number.
pub fn is_finite(value: &Value) {
    let (rows, cols) = value.size();
    match value {
        Value::Array(_) | Value::Nested(_) => (0..rows).for_each(|i| {
            (0..cols).for_each(|j| is_finite(&value.entry(i, j).unwrap_or_default()));
        }),
        value => assert!(value.number().is_none_or(f64::is_finite), "{value}"),
    }
}

fn on_a_scene(u: &mut Unstructured) -> Result<()> {
    let reading = drawn::reading(u)?;
    let edits = u.int_in_range(0..=3)?;
    let Ok(scene) = drawn::scene(u)?.build() else { return Ok(()) };
    let sheet = door::worksheet(&scene.model, |x| x);
    let shape = scene.model.nodes.iter().map(|[x, y]| {
        let moves = [0.0, 1e-3, -1e-3, 0.02, -0.1];
        Ok([x + u.choose(&moves)?, y + u.choose(&moves)?])
    });
    let node_n = door::node_n(&scene.model, &shape.collect::<Result<Vec<_>>>()?);
    let k_cnt = is_mirrored(&sheet, &node_n, &reading);
    if edits > 0 {
        let which = *u.choose(Which::ALL)?;
        let text = drawn::edited(u, &printed(which, &reading).to_string(), edits)?;
        executed(which, &text, &sheet, &node_n, &k_cnt, &reading);
    }
    Ok(())
}

/// Executes an edited listing: it fails with words, or ends with numbers.
fn executed(
    which: Which,
    text: &str,
    sheet: &Worksheet<f64>,
    node_n: &Table<f64>,
    k_cnt: &Table<f64>,
    reading: &Reading,
) {
    let edited = match Edited::new("fuzz", text) {
        Ok(edited) => edited,
        Err(error) => return sound::input_error(&error),
    };
    let (listing, settings) = (edited.listing(), settings(reading));
    let run = match which {
        Which::CCnt => listings::c_cnt(&listing, &settings, sheet, node_n, None)
            .map(|(pairs, _)| [bits(pairs.yt.as_slice()), bits(pairs.k_cnt.as_matrix())].concat()),
        Which::Km => listings::km(&listing, &settings, sheet, k_cnt, None)
            .map(|(matrix, _)| bits(matrix.entries())),
    };
    match run {
        Ok(bits) => assert!(bits.into_iter().all(|x| f64::from_bits(x).is_finite())),
        Err(failure) => assert!(!failure.to_string().is_empty()),
    }
}

thread_local! {
    /// The printed listings under the readings that came so far.
    static READ: RefCell<BTreeMap<(&'static str, String), Rc<Listing>>> = RefCell::default();
}

fn printed(which: Which, reading: &Reading) -> Rc<Listing> {
    let read = |read: &RefCell<BTreeMap<_, Rc<Listing>>>| {
        let key = (which.name(), reading.to_string());
        let under = || Rc::new(which.under(reading));
        read.borrow_mut().entry(key).or_insert_with(under).clone()
    };
    READ.with(read)
}

type Stop = (usize, Cause);
type PairBits = (Vec<usize>, Vec<u64>, Vec<usize>, Vec<u64>);

/// Interpreter and mirror have the same bits, or fail at the same line for the same cause. Returns the
/// pairs with which `Km` is called.
fn is_mirrored(sheet: &Worksheet<f64>, node_n: &Table<f64>, reading: &Reading) -> Table<f64> {
    let settings = settings(reading);
    let mirror = c_cnt(sheet, reading, node_n);
    let listing = printed(Which::CCnt, reading);
    let executed = listings::c_cnt(&listing, &settings, sheet, node_n, None);
    let of_mirror = mirror.as_ref().map(pair_bits).map_err(stop);
    assert_eq!(of_mirror, executed.map(|(p, _)| pair_bits(&p)).map_err(|f| printed_stop(&f)));
    let k_cnt = mirror.map_or_else(|_| Table::filled(sheet.R(), 4, 0.0), |pairs| pairs.k_cnt);
    let mirror = Km(sheet, reading, &k_cnt).map(|m| m.to_table());
    let executed = listings::km(&printed(Which::Km, reading), &settings, sheet, &k_cnt, None);
    let flat = |table: &Table<f64>| bits(table.as_matrix());
    let table = |array| Table::try_from(&Value::Array(array)).expect("numbers");
    assert_eq!(
        mirror.as_ref().map(flat).map_err(stop),
        executed.map(|(array, _)| flat(&table(array))).map_err(|f| printed_stop(&f))
    );
    k_cnt
}

fn bits<'a>(values: impl IntoIterator<Item = &'a f64>) -> Vec<u64> {
    values.into_iter().map(|x| x.to_bits()).collect()
}

fn pair_bits(pairs: &Pairs<f64>) -> PairBits {
    let Pairs { ct, yt, dy, k_cnt } = pairs;
    let [ct, dy] = [ct, dy].map(|column| column.as_slice().to_vec());
    (ct, bits(yt.as_slice()), dy, bits(k_cnt.as_matrix()))
}

fn stop(failure: &Failure) -> Stop {
    (failure.line, failure.cause)
}

fn printed_stop(failure: &mathcad::Failure) -> Stop {
    let cause = match failure.cause {
        mathcad::Cause::IndexOutside { .. } | mathcad::Cause::IndexBelowOrigin { .. } => {
            Cause::InvalidIndex
        }
        mathcad::Cause::Singularity { .. } => Cause::Singularity,
        mathcad::Cause::Overflow { .. } => Cause::Overflow,
        _ => panic!("the mirror does not know {failure}"),
    };
    (failure.line, cause)
}
