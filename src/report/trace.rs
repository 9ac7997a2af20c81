//! A trace for people and for machines.

use std::collections::BTreeMap;
use std::io::{self, Write};

use serde::Serialize;
use serde_json::Value as Json;

use super::failure::Failure;
use super::json::{self, Found};
use super::layout::{counted, filled, listed};
use super::numbers::six_digits;
use super::text::fitted;
use engine::error::Error;
use mathcad::array::Table;
use mathcad::{self, Listing};
use paper::listings::Which;
use problem::model::{Model, NodeId, TriangleId};
use problem::scene::Scene;
use studies::audit::trace::{Access, Kept, Product, Step, text_of};
use studies::lesson::figure_numbers;

/// How much of a trace is shown, and how.
pub struct TraceOptions {
    /// Only what the conditions decided, a line for each.
    pub summary: bool,
    /// The first and the last printed line.
    pub lines: [usize; 2],
    /// All digits, not six.
    pub exact: bool,
    /// The characters of a line of text.
    pub width: usize,
}

/// What is traced.
#[derive(Clone, Copy)]
pub struct Traced<'a> {
    /// Which of the paper's listings it is.
    pub which: Which,
    /// The listing, or the edit of it.
    pub listing: &'a Listing,
    /// The scene on which it is executed.
    pub scene: &'a Scene,
    /// The scene's model.
    pub model: &'a Model,
}

/// Writes a trace for people: turn by turn, then what is outside the turns, then what `trace()` wrote.
/// A listing may loop twice over the same turns; a trace that is too long to be kept is written in the
/// order of execution, so that what is held grows with the listing, not with the trace.
pub struct TraceWriter<'a, W> {
    out: W,
    of: Traced<'a>,
    shown: &'a TraceOptions,
    /// What was executed so far, as long as all of it is kept.
    kept: Option<Kept>,
    turn: Option<Turn>,
    /// The printed lines outside the turns, how often each was executed, and how it was last.
    outside: Vec<(usize, usize, Step)>,
    /// What went wrong when it was written; nothing is written after that.
    failed: io::Result<()>,
}

/// A turn of the outer loop, as far as it is executed.
struct Turn {
    number: usize,
    /// The statements for a target edge as long as they wrote no `ct`.
    edge: Option<Vec<Step>>,
    /// The target edges for which no `ct` was written.
    skipped: usize,
    /// What its conditions decided: a line, when it was first written, and how often.
    decided: BTreeMap<String, (usize, usize)>,
}

/// The statements for one target edge that are kept at most; beyond it all of them are shown.
const MOST_KEPT: usize = 10_000;

impl<'a, W: Write> TraceWriter<'a, W> {
    /// Starts a trace on `out`.
    pub fn new(out: W, of: Traced<'a>, shown: &'a TraceOptions) -> Self {
        let kept = Some(Kept::default());
        TraceWriter { out, of, shown, kept, turn: None, outside: Vec::new(), failed: Ok(()) }
    }

    /// Takes a statement that was executed.
    pub fn step(&mut self, step: Step) {
        let Some(kept) = &mut self.kept else { return self.tell(step) };
        let Err(step) = kept.keep(step) else { return };
        let kept = self.kept.take().unwrap_or_default();
        let many = kept.steps.len();
        self.failed = self.write(&format!(
            "(more than {many} statements: shown in the order of execution, not loop beside loop)\n"
        ));
        kept.steps.into_iter().chain([step]).for_each(|step| self.tell(step));
    }

    fn tell(&mut self, step: Step) {
        match step.turn {
            None => self.outside(step),
            Some(number) if self.failed.is_ok() => self.failed = self.in_turn(number, step),
            Some(_) => (),
        }
    }

    /// Ends the trace; `output` is what `trace()` wrote.
    ///
    /// # Errors
    /// Something was not written.
    pub fn finish(mut self, output: &[String]) -> io::Result<()> {
        let mut kept = self.kept.take().unwrap_or_default().steps;
        kept.sort_by_key(|step| step.turn);
        kept.into_iter().for_each(|step| self.tell(step));
        std::mem::replace(&mut self.failed, Ok(()))?;
        self.end_turn()?;
        let outside = std::mem::take(&mut self.outside);
        if !outside.is_empty() {
            self.write("\noutside these\n")?;
        }
        for (line, times, last) in outside {
            let text = executed_outside(self.of.listing, (line, times, &last), self.shown);
            self.write(&text)?;
        }
        if output.is_empty() {
            return Ok(());
        }
        self.write(&format!("\n{}", filled("trace() wrote: ", 4, self.shown.width, output, " | ")))
    }

    fn in_turn(&mut self, number: usize, step: Step) -> io::Result<()> {
        let Traced { which, listing, scene, model } = self.of;
        if self.turn.as_ref().is_none_or(|turn| turn.number != number) {
            self.end_turn()?;
            self.turn = Some(Turn::new(number));
            self.write(&format!("\n{}\n", heading(which, number, scene, model)))?;
        }
        let turn = self.turn.as_mut().expect("it has begun");
        for step in turn.shown_now(which, text_of(listing, step.line), step) {
            self.show(&step)?;
        }
        Ok(())
    }

    fn show(&mut self, step: &Step) -> io::Result<()> {
        if !self.shown.has(step) {
            return Ok(());
        }
        if !self.shown.summary {
            return self.write(&step_in_words(self.of.listing, step, self.shown));
        }
        if let (Some(turn), Some(held)) = (&mut self.turn, step.held) {
            let line = decision(self.of.listing, step, held, self.shown);
            let place = turn.decided.len();
            turn.decided.entry(line).or_insert((place, 0)).1 += 1;
        }
        Ok(())
    }

    fn outside(&mut self, step: Step) {
        if self.shown.summary || !self.shown.has(&step) {
            return;
        }
        match self.outside.iter_mut().find(|(line, _, _)| *line == step.line) {
            Some((_, times, last)) => (*times, *last) = (*times + 1, step),
            None => self.outside.push((step.line, 1, step)),
        }
    }

    fn end_turn(&mut self) -> io::Result<()> {
        let Some(mut turn) = self.turn.take() else { return Ok(()) };
        turn.end_edge();
        let mut decided: Vec<_> = turn.decided.into_iter().collect();
        decided.sort_by_key(|(_, (place, _))| *place);
        for (line, (_, times)) in decided {
            self.write(&match times {
                1 => line + "\n",
                n => format!("{line}   ({n} times)\n"),
            })?;
        }
        if turn.skipped == 0 || self.shown.lines[0] > 7 || self.shown.lines[1] < 4 {
            return Ok(());
        }
        self.write(&format!(
            "  (lines 4-7 for {}: the node is outside {})\n",
            counted(turn.skipped, "more edge", "more edges"),
            if turn.skipped == 1 { "its box" } else { "their boxes" }
        ))
    }

    fn write(&mut self, text: &str) -> io::Result<()> {
        self.out.write_all(fitted(text, self.shown.width).as_bytes())
    }
}

impl Turn {
    fn new(number: usize) -> Self {
        Turn { number, edge: None, skipped: 0, decided: BTreeMap::new() }
    }

    /// Returns what is shown once `step` was executed: of `c_cnt` nothing for a target edge as long as
    /// no `ct` was written.
    fn shown_now(&mut self, which: Which, text: &str, step: Step) -> Vec<Step> {
        if which == Which::CCnt && text.starts_with("for ") {
            self.end_edge();
            self.edge = text.contains("rows(trg)").then(Vec::new);
        }
        let Some(edge) = &mut self.edge else { return vec![step] };
        let wrote_ct = step.writes.iter().any(|written| written.name.starts_with("ct["));
        edge.push(step);
        let is_shown = wrote_ct || edge.len() > MOST_KEPT;
        if is_shown { self.edge.take().unwrap_or_default() } else { Vec::new() }
    }

    fn end_edge(&mut self) {
        self.skipped += usize::from(self.edge.take().is_some());
    }
}

impl TraceOptions {
    fn has(&self, step: &Step) -> bool {
        (self.lines[0]..=self.lines[1]).contains(&step.line)
    }
}

fn heading(which: Which, turn: usize, scene: &Scene, model: &Model) -> String {
    match which {
        Which::CCnt => {
            let nodes = &model.contact.nodes;
            let node = nodes.get(turn - 1).map(|node| named(scene, model, *node));
            format!("contact node {} (i1 = {turn} of {})", node.unwrap_or_default(), nodes.len())
        }
        Which::Km => {
            let nodes = model.triangle(TriangleId::from_number(turn)).nodes;
            let nodes = listed(nodes.map(|node| named(scene, model, node)));
            format!("element n = {turn} of {} (nodes {nodes})", model.triangles.len())
        }
    }
}

/// Writes a node's number; in the scene of the paper's fig. 1, with the number that it has there.
fn named(scene: &Scene, model: &Model, node: NodeId) -> String {
    match in_figure(scene, model, node) {
        Some(own) => format!("{node} ({own} of fig. 1)"),
        None => node.to_string(),
    }
}

/// Returns the number of a node in the paper's fig. 1; nothing in another scene, and for a node that
/// has none.
pub(super) fn in_figure(scene: &Scene, model: &Model, node: NodeId) -> Option<String> {
    let numbers = if scene.name == "fig1" { figure_numbers(model) } else { Vec::new() };
    numbers.into_iter().find(|(other, _)| *other == node).map(|(_, number)| number)
}

/// Writes what a condition decided, and what followed: yes and what was written, or no and the first
/// operand that is false.
fn decision(listing: &Listing, step: &Step, held: bool, shown: &TraceOptions) -> String {
    let text = text_of(listing, step.line);
    let condition = text.split_once("if ").map_or(text, |(_, condition)| condition);
    let failed = step.operands.iter().find(|(_, truth)| *truth == Some(false));
    let failed = failed.map_or(condition, |(operand, _)| operand);
    let outcome = match held {
        true if step.writes.is_empty() => format!("yes  {condition}"),
        true => format!("yes  {}", accesses(&step.writes, " ← ", shown).join(", ")),
        false => format!("no   {failed} is false"),
    };
    format!("  {:>2}  {outcome}", step.line)
}

/// Writes a line outside the turns: how often it was executed, and what it wrote last.
fn executed_outside(
    listing: &Listing,
    (line, times, last): (usize, usize, &Step),
    shown: &TraceOptions,
) -> String {
    let written = accesses(&last.writes, " ← ", shown).join(", ");
    let last = if written.is_empty() { String::new() } else { format!(", last ⇒ {written}") };
    let text = format!("{}   ({}{last})", text_of(listing, line), counted(times, "time", "times"));
    filled(&format!("  {line:>2}  "), 8, shown.width, text.split(' '), " ")
}

/// Writes a printed line, what it read, and what it wrote.
fn step_in_words(listing: &Listing, step: &Step, shown: &TraceOptions) -> String {
    let printed = text_of(listing, step.line);
    let start = format!("  {:>2}  ", step.line);
    let mut text = filled(&start, 8, shown.width, printed.split(' '), " ");
    let reads = accesses(&step.reads, " = ", shown);
    let writes = accesses(&step.writes, " ← ", shown);
    if !reads.is_empty() {
        text += &filled("        ", 8, shown.width, reads, ", ");
    }
    if !writes.is_empty() {
        text += &filled("      ⇒ ", 8, shown.width, writes, ", ");
    } else if step.held == Some(false) {
        text += "      ⇒ the condition does not hold\n";
    }
    text
}

/// Writes names and values, each pair once.
fn accesses(accesses: &[Access], sign: &str, shown: &TraceOptions) -> Vec<String> {
    let mut seen: Vec<String> = Vec::new();
    for access in accesses {
        let item = format!("{}{sign}{}", access.name, value(&access.value, shown));
        if !seen.contains(&item) {
            seen.push(item);
        }
    }
    seen
}

/// Writes a number, `(a  b)` for a column, `(a  b;  c  d)` for a matrix, or the kind of value.
fn value(value: &Json, shown: &TraceOptions) -> String {
    match value {
        Json::String(text) => text.clone(),
        Json::Array(rows) => {
            let rows: Vec<String> = rows.iter().map(|value| row(value, shown)).collect();
            let separator = if matches!(value[0], Json::Array(_)) { ";  " } else { "  " };
            format!("({})", rows.join(separator))
        }
        number => row(number, shown),
    }
}

fn row(value: &Json, shown: &TraceOptions) -> String {
    match value {
        Json::Array(entries) => {
            entries.iter().map(|value| row(value, shown)).collect::<Vec<_>>().join("  ")
        }
        number => {
            let x = number.as_f64().unwrap_or(f64::NAN);
            if shown.exact { x.to_string() } else { six_digits(x) }
        }
    }
}

/// A trace as JSON.
#[derive(Serialize)]
pub struct Document<'a> {
    #[serde(flatten)]
    executed: Executed<'a>,
    /// The statements in order of execution.
    steps: Vec<StepRow<'a>>,
    #[serde(flatten)]
    end: End<'a>,
}

/// What is executed.
#[derive(Serialize)]
struct Executed<'a> {
    scene: &'a str,
    /// `c_cnt` or `Km`.
    listing: &'static str,
}

/// What the listing came to.
#[derive(Serialize)]
struct End<'a> {
    /// What the listing's own `trace` wrote.
    trace: &'a [String],
    /// What the listing computes; null where it failed.
    result: Option<Computed>,
    /// Why it failed; null where it did not.
    failure: Option<Failure>,
}

/// A statement as it was executed.
#[derive(Serialize)]
struct StepRow<'a> {
    /// The turn of the outer loop, from 1; null outside it.
    turn: Option<usize>,
    /// The printed line, from 1.
    line: usize,
    text: &'a str,
    reads: &'a [Access],
    writes: &'a [Access],
}

impl<'a> StepRow<'a> {
    fn new(step: &'a Step, listing: &'a Listing) -> Self {
        let Step { turn, line, ref reads, ref writes, .. } = *step;
        StepRow { turn, line, text: text_of(listing, line), reads, writes }
    }
}

/// What a listing computes: of `c_cnt` the pairs, of `Km` the entries of MJS that are not 0, each
/// with its row and its column, from 1, force/length.
#[derive(Serialize)]
#[serde(untagged)]
enum Computed {
    Pairs(Found),
    Matrix { rows: usize, cols: usize, entries: Vec<(usize, usize, f64)> },
}

impl From<&Product> for Computed {
    fn from(product: &Product) -> Self {
        match product {
            Product::Pairs(pairs) => Computed::Pairs(pairs.into()),
            Product::Matrix(matrix) => Computed::Matrix {
                rows: matrix.rows(),
                cols: matrix.cols(),
                entries: entries(matrix, |i, j| matrix[(i, j)]),
            },
        }
    }
}

/// A trace written as JSON, each statement as it is executed.
pub struct JsonTrace<'o> {
    stream: json::Stream<'o>,
    listing: &'o Listing,
    written: io::Result<()>,
}

impl<'o> JsonTrace<'o> {
    /// Writes the start of the document.
    ///
    /// # Errors
    /// It was not written.
    pub fn new(out: &'o mut dyn Write, of: &'o Traced) -> io::Result<Self> {
        let executed = Executed { scene: &of.scene.name, listing: of.which.name() };
        let stream = json::Stream::new(out, of.scene, &executed, "steps")?;
        Ok(JsonTrace { stream, listing: of.listing, written: Ok(()) })
    }

    /// Writes a statement; what was not written is reported at the end.
    pub fn step(&mut self, step: &Step) {
        if self.written.is_ok() {
            self.written = self.stream.item(&StepRow::new(step, self.listing));
        }
    }

    /// Writes what the listing computed and its own `trace` wrote, or why it failed.
    ///
    /// # Errors
    /// Something was not written.
    pub fn finish(self, outcome: Result<&(Product, Vec<String>), &Error>) -> io::Result<()> {
        self.written?;
        let computed = outcome.ok();
        self.stream.finish(&End {
            trace: computed.map_or(&[], |(_, output)| output),
            result: computed.map(|(product, _)| product.into()),
            failure: outcome.err().map(Failure::from),
        })
    }
}

/// Returns the values of `of` that are not zero, each with its row and its column in `matrix`.
fn entries(matrix: &Table<f64>, of: impl Fn(usize, usize) -> f64) -> Vec<(usize, usize, f64)> {
    let places = (1..=matrix.rows()).flat_map(|i| (1..=matrix.cols()).map(move |j| (i, j)));
    places.map(|(i, j)| (i, j, of(i, j))).filter(|(_, _, x)| *x != 0.0).collect()
}
