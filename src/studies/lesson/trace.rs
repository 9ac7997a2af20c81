//! The statements that a listing executes, by contact node (`c_cnt`) or by element (`Km`).

use std::rc::Rc;

use mathcad::observe::Executed;
use mathcad::{Array, Failure, Line, Listing, Recorder, Settings};
use paper::door::Call;
use paper::listings::{self, Which};
use paper::mirror::Pairs;

/// A listing executed, and what is kept of that.
pub struct Trace {
    /// Its statements in order of execution; of more than are kept, the first.
    pub steps: Vec<Step>,
    /// What the listing returned, or why it failed.
    pub result: Result<Product, Box<Failure>>,
}

/// What a listing returns.
#[derive(Clone, Debug, PartialEq)]
pub enum Product {
    /// What `c_cnt` computes: ct, yt, dy, k_cnt.
    Pairs(Pairs<f64>),
    /// What `Km` computes: MJS, 2R x 2R, force/length.
    Matrix(Rc<Array>),
}

/// A statement that was executed.
pub struct Step {
    /// The contact node's place in `cnt`, or the element's row in `EL`; nothing outside the loops.
    pub turn: Option<usize>,
    /// The number of the printed line, from 1.
    pub line: usize,
}

/// Executes `listing` (as `which`) on the tables of `call`: `c_cnt` on the initial shape, `Km` on
/// the contact pairs that were found. Keeps the statements of the turns that are `wanted`, up to `most`.
pub fn trace(
    which: Which,
    listing: &Listing,
    settings: &Settings,
    call: &Call,
    wanted: impl Fn(Option<usize>) -> bool,
    most: usize,
) -> Trace {
    let (mut turn, mut steps) = (None, Vec::new());
    let mut recorder = Recorder::new(|done: &Executed| {
        if let Some(begun) = turn_begun(which, text_of(listing, done.line), done) {
            turn = begun;
        }
        if wanted(turn) && steps.len() < most {
            steps.push(Step { turn, line: done.line });
        }
    });
    let result = match which {
        Which::CCnt => {
            listings::c_cnt(listing, settings, &call.sheet, &call.sheet.node, Some(&mut recorder))
                .map(|(pairs, _)| Product::Pairs(pairs))
        }
        Which::Km => {
            listings::km(listing, settings, &call.sheet, &call.pairs.k_cnt, Some(&mut recorder))
                .map(|(matrix, _)| Product::Matrix(matrix))
        }
    };
    // Hands over the last statement.
    drop(recorder);
    Trace { steps, result }
}

/// The text of a printed line; empty where the listing has no such line.
fn text_of(listing: &Listing, printed: usize) -> &str {
    let is_it = |line: &&Line| line.printed == printed;
    let lines = listing.lines();
    // Most listings number their lines one by one.
    let at = lines.get(printed.wrapping_sub(1)).filter(is_it);
    at.or_else(|| lines.iter().find(is_it)).map_or("", |line| &line.text)
}

/// Whether a `for` line begins another turn: over the contact nodes, over the elements, or over
/// something else (none).
fn turn_begun(which: Which, text: &str, done: &Executed) -> Option<Option<usize>> {
    let range = text.strip_prefix("for ")?;
    let written = done.writes.first().and_then(|written| written.value.number())?;
    let outer = match which {
        Which::CCnt => range.starts_with("i1 ") && range.contains("rows(cnt)"),
        Which::Km => range.starts_with("n "),
    };
    let other = which == Which::CCnt && range.starts_with("i1 ");
    if outer { Some(Some(written as usize)) } else { other.then_some(None) }
}
