//! A trace for people and for machines.

use std::collections::BTreeSet;

use schemars::JsonSchema;
use serde::Serialize;
use serde_json::Value as Json;

use super::failure::Failure;
use super::json::{Found, of_scene};
use super::layout::{counted, filled, listed};
use super::numbers::six_digits;
use crate::paper::listings::Which;
use crate::paper::mathcad::Listing;
use crate::paper::mathcad::array::Table;
use crate::problem::model::{Model, NodeId, TriangleId};
use crate::problem::scene::Scene;
use crate::studies::audit::trace::{Access, Product, Step, Trace, text_of};

/// How much of a trace is shown, and how.
pub struct Shown {
    /// Only what the conditions decided, a line for each.
    pub summary: bool,
    /// The first and the last printed line.
    pub lines: [usize; 2],
    /// All digits, not six.
    pub exact: bool,
    /// The characters of a line of text.
    pub width: usize,
}

/// Writes the steps turn by turn, then those outside the turns, then what `trace()` wrote.
pub fn text(
    trace: &Trace,
    listing: &Listing,
    scene: &Scene,
    model: &Model,
    shown: &Shown,
) -> String {
    let turns: BTreeSet<usize> = trace.steps.iter().filter_map(|step| step.turn).collect();
    let mut text = String::new();
    for turn in turns {
        text += &format!("\n{}\n", heading(trace.which, turn, scene, model));
        let steps: Vec<&Step> = trace.steps.iter().filter(|s| s.turn == Some(turn)).collect();
        let (mut steps, skipped) = without_missed_edges(trace.which, listing, &steps);
        steps.retain(|step| shown.has(step));
        text += &match shown.summary {
            true => decisions(listing, &steps, shown),
            false => steps.into_iter().map(|step| step_in_words(listing, step, shown)).collect(),
        };
        if skipped > 0 && shown.lines[0] <= 7 && shown.lines[1] >= 4 {
            text += &format!(
                "  (lines 4-7 for {}: the node is outside {})\n",
                counted(skipped, "more edge", "more edges"),
                if skipped == 1 { "its box" } else { "their boxes" }
            );
        }
    }
    if !shown.summary {
        text += &outside(trace, listing, shown);
    }
    if trace.is_cut {
        let kept = trace.steps.len();
        text += &format!("\n(only the first {kept} statements are shown)\n");
    }
    if !trace.output.is_empty() {
        text += "\n";
        text += &filled("trace() wrote: ", 4, shown.width, &trace.output, " | ");
    }
    text
}

impl Shown {
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
    let target: BTreeSet<NodeId> = model.target_edges().flat_map(|edge| edge.nodes).collect();
    let own = match model.contact.nodes.iter().position(|other| *other == node) {
        Some(k) => Some(format!("2.{}", k + 1)),
        None => target.iter().position(|other| *other == node).map(|k| format!("1.{}", k + 1)),
    };
    match own.filter(|_| scene.name == "fig1") {
        Some(own) => format!("{node} ({own} of fig. 1)"),
        None => node.to_string(),
    }
}

/// Writes what each condition decided, and what followed: yes and what was written, or no and the
/// first operand that is false. What happened more than once is counted.
fn decisions(listing: &Listing, steps: &[&Step], shown: &Shown) -> String {
    let mut lines: Vec<(String, usize)> = Vec::new();
    for (step, held) in steps.iter().filter_map(|step| Some((step, step.held?))) {
        let text = text_of(listing, step.line);
        let condition = text.split_once("if ").map_or(text, |(_, condition)| condition);
        let operands = step.operands.iter();
        let failed = operands.into_iter().find(|(_, truth)| *truth == Some(false));
        let failed = failed.map_or(condition, |(operand, _)| operand);
        let told = match held {
            true if step.writes.is_empty() => format!("yes  {condition}"),
            true => format!("yes  {}", accesses(&step.writes, " ← ", shown).join(", ")),
            false => format!("no   {failed} is false"),
        };
        let line = format!("  {:>2}  {told}", step.line);
        match lines.iter_mut().find(|(other, _)| *other == line) {
            Some((_, times)) => *times += 1,
            None => lines.push((line, 1)),
        }
    }
    let counted = |(line, times): (String, usize)| match times {
        1 => line + "\n",
        n => format!("{line}   ({n} times)\n"),
    };
    lines.into_iter().map(counted).collect()
}

/// Writes the lines outside the turns: how often each was executed, and what it wrote last.
fn outside(trace: &Trace, listing: &Listing, shown: &Shown) -> String {
    let mut lines: Vec<(usize, usize, &Step)> = Vec::new();
    for step in trace.steps.iter().filter(|step| step.turn.is_none() && shown.has(step)) {
        match lines.iter_mut().find(|(line, _, _)| *line == step.line) {
            Some((_, times, last)) => (*times, *last) = (*times + 1, step),
            None => lines.push((step.line, 1, step)),
        }
    }
    if lines.is_empty() {
        return String::new();
    }
    let in_words = |(line, times, last): (usize, usize, &Step)| {
        let written = accesses(&last.writes, " ← ", shown).join(", ");
        let last = if written.is_empty() { String::new() } else { format!(", last ⇒ {written}") };
        let text =
            format!("{}   ({}{last})", text_of(listing, line), counted(times, "time", "times"));
        filled(&format!("  {line:>2}  "), 8, shown.width, text.split(' '), " ")
    };
    "\noutside these\n".to_string() + &lines.into_iter().map(in_words).collect::<String>()
}

/// Leaves out, for `c_cnt`, the turns over target edges that wrote no `ct`; counts them.
fn without_missed_edges<'s>(
    which: Which,
    listing: &Listing,
    steps: &[&'s Step],
) -> (Vec<&'s Step>, usize) {
    if which == Which::Km {
        return (steps.to_vec(), 0);
    }
    let (mut shown, mut skipped) = (Vec::new(), 0);
    let over_edges = |s: &Step| text_of(listing, s.line).contains("rows(trg)");
    let mut rest = steps;
    while let Some(first) = rest.first() {
        let next_loop = |s: &&Step| text_of(listing, s.line).starts_with("for ");
        let end = rest[1..].iter().position(next_loop).map_or(rest.len(), |k| k + 1);
        let (turn, after) = rest.split_at(end);
        let wrote_ct = turn.iter().any(|s| s.writes.iter().any(|w| w.name.starts_with("ct[")));
        if over_edges(first) && !wrote_ct {
            skipped += 1;
        } else {
            shown.extend(turn);
        }
        rest = after;
    }
    (shown, skipped)
}

/// Writes a printed line, what it read, and what it wrote.
fn step_in_words(listing: &Listing, step: &Step, shown: &Shown) -> String {
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
fn accesses(accesses: &[Access], sign: &str, shown: &Shown) -> Vec<String> {
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
fn value(value: &Json, shown: &Shown) -> String {
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

fn row(value: &Json, shown: &Shown) -> String {
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
#[derive(Serialize, JsonSchema)]
pub struct Document<'a> {
    scene: &'a str,
    /// `c_cnt` or `Km`.
    listing: &'static str,
    /// The statements in order of execution.
    steps: Vec<StepRow<'a>>,
    /// What the listing's own `trace` wrote.
    trace: &'a [String],
    /// What the listing computes; null where it failed.
    result: Option<Computed>,
    /// Why it failed; null where it did not.
    failure: Option<Failure>,
}

/// A statement as it was executed.
#[derive(Serialize, JsonSchema)]
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
#[derive(Serialize, JsonSchema)]
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

/// Returns a trace as JSON; `failure` is why the listing failed.
pub fn json(trace: &Trace, listing: &Listing, scene: &Scene, failure: Option<Failure>) -> String {
    let document = Document {
        scene: &scene.name,
        listing: trace.which.name(),
        steps: trace.steps.iter().map(|step| StepRow::new(step, listing)).collect(),
        trace: &trace.output,
        result: trace.result.as_ref().ok().map(Computed::from),
        failure,
    };
    of_scene(scene, &document)
}

/// Returns the values of `of` that are not zero, each with its row and its column in `matrix`.
fn entries(matrix: &Table<f64>, of: impl Fn(usize, usize) -> f64) -> Vec<(usize, usize, f64)> {
    let places = (1..=matrix.rows()).flat_map(|i| (1..=matrix.cols()).map(move |j| (i, j)));
    places.map(|(i, j)| (i, j, of(i, j))).filter(|(_, _, x)| *x != 0.0).collect()
}
