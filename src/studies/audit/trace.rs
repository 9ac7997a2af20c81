//! What a listing reads and writes as it runs, line by line, by contact node (`c_cnt`) or by
//! element (`Km`).

use serde::Serialize;
use serde_json::Value as Json;

use mathcad::array::Table;
use mathcad::observe::{Executed, Named};
use mathcad::{Failure, Line, Listing, Observer, Recorder, Settings, Value};
use paper::door::Call;
use paper::listings::{self, Which};
use paper::mirror::Pairs;

/// A listing executed, and what is kept of that.
pub struct Trace {
    /// Its statements in order of execution, each with the turn of the outer loop that it belongs
    /// to.
    pub steps: Vec<Step>,
    /// Whether there were more than are kept.
    pub is_cut: bool,
    /// What the listing returned, or why it failed.
    pub result: Result<Product, Box<Failure>>,
}

/// What a listing returns.
#[derive(Clone, Debug, PartialEq)]
pub enum Product {
    /// What `c_cnt` computes: ct, yt, dy, k_cnt.
    Pairs(Pairs<f64>),
    /// What `Km` computes: MJS, 2R x 2R, force/length.
    Matrix(Table<f64>),
}

/// A statement that was executed.
pub struct Step {
    /// The contact node's place in `cnt`, or the element's row in `EL`; nothing outside the loops.
    pub turn: Option<usize>,
    /// The number of the printed line, from 1.
    pub line: usize,
    /// The number of the line in the listing's file, from 1; of a line that an edit moves or
    /// repeats, in the edit's.
    pub in_file: usize,
    /// Whether the condition was true; none without one.
    pub held: Option<bool>,
    /// The operands of an `∧`, each with its truth; none where it failed or was not evaluated.
    pub operands: Vec<(String, Option<bool>)>,
    /// What was read, in order, each value of a name once.
    pub reads: Vec<Access>,
    /// What was written, in order.
    pub writes: Vec<Access>,
}

/// A value that was read or written.
#[derive(Clone, Debug, Serialize)]
pub struct Access {
    /// The name, with the subscripts of an entry: `ct[3]`.
    pub name: String,
    /// The value.
    pub value: Json,
}

/// Statements, as many as are kept at once.
#[derive(Default)]
pub struct Kept {
    /// The statements.
    pub steps: Vec<Step>,
    /// The numbers that they read and wrote, and one more for each name.
    numbers: usize,
}

impl Kept {
    const MOST_STEPS: usize = 200_000;
    const MOST_NUMBERS: usize = 1 << 20;

    /// Keeps a statement.
    ///
    /// # Errors
    /// There is no room for it.
    pub fn keep(&mut self, step: Step) -> Result<(), Step> {
        if self.steps.len() >= Self::MOST_STEPS || self.numbers >= Self::MOST_NUMBERS {
            return Err(step);
        }
        self.numbers += step.reads.iter().chain(&step.writes).map(Access::numbers).sum::<usize>();
        self.steps.push(step);
        Ok(())
    }
}

/// Executes `listing` (as `which`) on the tables of `call`: `c_cnt` on the initial shape, `Km` on
/// the contact pairs that were found. Only the turns that `wanted` asks for are kept.
pub fn trace(
    which: Which,
    listing: &Listing,
    settings: &Settings,
    call: &Call,
    wanted: impl Fn(usize) -> bool,
) -> Trace {
    let (mut kept, mut is_cut) = (Kept::default(), false);
    let outcome = follow(which, listing, settings, call, wanted, |step| {
        is_cut |= kept.keep(step).is_err();
    });
    Trace { steps: kept.steps, is_cut, result: outcome.map(|(product, _)| product) }
}

/// Executes a listing as [`trace`] does, and hands over `each` statement of the turns that `wanted`
/// asks for as it is executed: none is kept.
///
/// # Errors
/// The listing fails: says in which line.
pub fn follow(
    which: Which,
    listing: &Listing,
    settings: &Settings,
    call: &Call,
    wanted: impl Fn(usize) -> bool,
    mut each: impl FnMut(Step),
) -> listings::Traced<Product> {
    let mut turn = None;
    let mut recorder = Recorder::new(|done: &Executed| {
        let text = text_of(listing, done.line);
        if let Some(begun) = turn_begun(which, text, done) {
            turn = begun;
        }
        if turn.is_none_or(&wanted) {
            each(Step::new(turn, done));
        }
    });
    run(which, listing, settings, call, &mut recorder)
}

/// Executes a listing and returns what it computes, with the lines that its own `trace` wrote.
///
/// # Errors
/// The listing fails: says in which line.
pub fn run<O: Observer>(
    which: Which,
    listing: &Listing,
    settings: &Settings,
    call: &Call,
    observer: &mut O,
) -> listings::Traced<Product> {
    match which {
        Which::CCnt => listings::c_cnt(listing, settings, &call.sheet, &call.sheet.node, observer)
            .map(|(pairs, output)| (Product::Pairs(pairs), output)),
        Which::Km => listings::km(listing, settings, &call.sheet, &call.pairs.k_cnt, observer)
            .map(|(matrix, output)| (Product::Matrix(matrix), output)),
    }
}

/// The text of a printed line; empty where the listing has no such line.
pub fn text_of(listing: &Listing, printed: usize) -> &str {
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

impl Step {
    fn new(turn: Option<usize>, done: &Executed) -> Self {
        // A long line may read the same array a hundred times.
        let mut reads: Vec<&Named> = Vec::new();
        for read in &done.reads {
            if !reads.contains(&read) {
                reads.push(read);
            }
        }
        Step {
            turn,
            line: done.line,
            in_file: done.in_file,
            held: done.held,
            operands: done.operands.clone(),
            reads: reads.into_iter().map(Access::new).collect(),
            writes: done.writes.iter().map(Access::new).collect(),
        }
    }
}

impl Access {
    fn new(named: &Named) -> Self {
        let subscripts: Vec<String> = named.subscripts.iter().map(i64::to_string).collect();
        let name = match subscripts.as_slice() {
            [] => named.name.clone(),
            some => format!("{}[{}]", named.name, some.join(",")),
        };
        Access { name, value: json(&named.value) }
    }

    /// Returns the count of the numbers that it shows, and one more.
    fn numbers(&self) -> usize {
        let row = |row: &Json| row.as_array().map_or(1, Vec::len);
        1 + self.value.as_array().map_or(0, |rows| rows.iter().map(row).sum())
    }
}

/// Returns whether the entries of a value are shown.
fn is_small(value: &Value) -> bool {
    value.count() <= 36
}

/// A number as a number, a small array as its entries (a matrix as rows), all else by its kind.
fn json(value: &Value) -> Json {
    match value {
        Value::Number(x) => Json::from(*x),
        Value::Array(_) if !is_small(value) => Json::from(value.kind()),
        Value::Array(a) if a.cols() == 1 => Json::from(a.entries()),
        Value::Array(a) => a.entries().chunks(a.cols().max(1)).map(Json::from).collect(),
        other => Json::from(other.kind()),
    }
}
