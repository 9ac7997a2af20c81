//! A trace for people and for machines.

use std::collections::BTreeSet;

use serde_json::{Value as Json, json};

use super::json::{headed, pairs_value};
use super::layout::listed;
use crate::paper::listings::Which;
use crate::paper::mathcad::Listing;
use crate::paper::mathcad::array::Table;
use crate::paper::mirror::Pairs;
use crate::problem::model::{Model, TriangleId};
use crate::problem::scene::Scene;
use crate::studies::audit::trace::{Access, Product, Step, Trace, text_of};

/// Changed entries of a matrix that are listed at most.
const MOST_CHANGES: usize = 20;

/// Writes the steps turn by turn, then those outside the turns, then what `trace()` wrote.
pub fn text(trace: &Trace, listing: &Listing, model: &Model) -> String {
    let turns: BTreeSet<usize> = trace.steps.iter().filter_map(|step| step.turn).collect();
    let mut text = String::new();
    for turn in turns {
        text += &format!("\n{}\n", heading(trace.which, turn, model));
        let steps: Vec<&Step> = trace.steps.iter().filter(|s| s.turn == Some(turn)).collect();
        let (shown, skipped) = without_missed_edges(trace.which, listing, &steps);
        text.extend(shown.into_iter().map(|step| step_in_words(listing, step)));
        if skipped > 0 {
            text += &format!(
                "  (lines 4-7 for {skipped} more edges: the node is outside their boxes)\n"
            );
        }
    }
    text += &outside(trace, listing);
    if trace.is_cut {
        let shown = trace.steps.len();
        text += &format!("\n(only the first {shown} statements are shown)\n");
    }
    if !trace.output.is_empty() {
        text += &format!("\ntrace() wrote: {}\n", trace.output.join(" | "));
    }
    text
}

fn heading(which: Which, turn: usize, model: &Model) -> String {
    match which {
        Which::CCnt => {
            let nodes = &model.contact.nodes;
            let node = nodes.get(turn - 1).map_or(0, |node| node.number());
            format!("contact node {node} (i1 = {turn} of {})", nodes.len())
        }
        Which::Km => {
            let nodes = listed(model.triangle(TriangleId::from_number(turn)).nodes);
            format!("element n = {turn} of {} (nodes {nodes})", model.triangles.len())
        }
    }
}

/// Writes the lines outside the turns: how often each was executed, and what it wrote last.
fn outside(trace: &Trace, listing: &Listing) -> String {
    let mut lines: Vec<(usize, usize, &Step)> = Vec::new();
    for step in trace.steps.iter().filter(|step| step.turn.is_none()) {
        match lines.iter_mut().find(|(line, _, _)| *line == step.line) {
            Some((_, times, last)) => (*times, *last) = (*times + 1, step),
            None => lines.push((step.line, 1, step)),
        }
    }
    if lines.is_empty() {
        return String::new();
    }
    let in_words = |(line, times, last): (usize, usize, &Step)| {
        let written = accesses(&last.writes, " ← ");
        let last = if written.is_empty() { String::new() } else { format!(", last ⇒ {written}") };
        format!("  {line:>2}  {}   ({times} times{last})\n", text_of(listing, line))
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
fn step_in_words(listing: &Listing, step: &Step) -> String {
    let printed = text_of(listing, step.line);
    let mut text = format!("  {:>2}  {printed}\n", step.line);
    let [reads, writes] = [accesses(&step.reads, " = "), accesses(&step.writes, " ← ")];
    if !reads.is_empty() {
        text += &format!("        {reads}\n");
    }
    if !writes.is_empty() {
        text += &format!("      ⇒ {writes}\n");
    } else if printed.contains(" if ") && !printed.starts_with("if ") {
        text += "      ⇒ the condition does not hold\n";
    }
    text
}

/// Writes names and values, each pair once.
fn accesses(accesses: &[Access], sign: &str) -> String {
    let mut seen: Vec<String> = Vec::new();
    for access in accesses {
        let item = format!("{}{sign}{}", access.name, value(&access.value));
        if !seen.contains(&item) {
            seen.push(item);
        }
    }
    listed(seen)
}

/// Writes a number, `(a  b)` for a column, `(a  b;  c  d)` for a matrix, or the kind of value.
fn value(value: &Json) -> String {
    match value {
        Json::String(text) => text.clone(),
        Json::Array(rows) => {
            let rows: Vec<String> = rows.iter().map(row).collect();
            let separator = if matches!(value[0], Json::Array(_)) { ";  " } else { "  " };
            format!("({})", rows.join(separator))
        }
        number => row(number),
    }
}

fn row(value: &Json) -> String {
    match value {
        Json::Array(entries) => entries.iter().map(row).collect::<Vec<_>>().join("  "),
        number => number.as_f64().unwrap_or(f64::NAN).to_string(),
    }
}

pub fn json(trace: &Trace, listing: &Listing, scene: &Scene) -> String {
    let step = |step: &Step| {
        json!({
            "turn": step.turn, "line": step.line, "text": text_of(listing, step.line),
            "reads": step.reads, "writes": step.writes,
        })
    };
    headed(
        Some(scene),
        &json!({
            "scene": scene.name,
            "listing": trace.which.name(),
            "steps": trace.steps.iter().map(step).collect::<Vec<_>>(),
            "trace": trace.output,
            "result": trace.result.as_ref().ok().map(product_value),
            "failure": trace.result.as_ref().err().map(ToString::to_string),
        }),
    )
}

fn product_value(product: &Product) -> Json {
    match product {
        Product::Pairs(pairs) => pairs_value(pairs),
        Product::Matrix(matrix) => {
            let entries = entries(matrix, |i, j| matrix[(i, j)]);
            json!({ "rows": matrix.rows(), "cols": matrix.cols(), "entries": entries })
        }
    }
}

/// Returns the values of `of` that are not zero, each with its row and its column in `matrix`.
fn entries(matrix: &Table<f64>, of: impl Fn(usize, usize) -> f64) -> Vec<(usize, usize, f64)> {
    let places = (1..=matrix.rows()).flat_map(|i| (1..=matrix.cols()).map(move |j| (i, j)));
    places.map(|(i, j)| (i, j, of(i, j))).filter(|(_, _, x)| *x != 0.0).collect()
}

/// Tells what an edited listing changes against the listing as printed.
pub fn changes(printed: &Product, edited: &Product, model: &Model) -> String {
    let lines = match (printed, edited) {
        (Product::Pairs(a), Product::Pairs(b)) => pair_changes(a, b, model),
        (Product::Matrix(a), Product::Matrix(b))
            if (a.rows(), a.cols()) == (b.rows(), b.cols()) =>
        {
            matrix_changes(a, b)
        }
        _ => vec!["the shape of the result".into()],
    };
    match lines.as_slice() {
        [] => "\nThe edit changes nothing on this scene.\n".into(),
        lines => format!("\nThe edit changes:\n  {}\n", lines.join("\n  ")),
    }
}

fn matrix_changes(a: &Table<f64>, b: &Table<f64>) -> Vec<String> {
    let changed = entries(a, |i, j| b[(i, j)] - a[(i, j)]);
    if changed.is_empty() {
        return Vec::new();
    }
    let line = |(i, j, _): &(usize, usize, f64)| {
        format!("MJS[{i},{j}]: {} as printed, {} edited", a[(*i, *j)], b[(*i, *j)])
    };
    let more = changed.len().saturating_sub(MOST_CHANGES);
    std::iter::once(format!("{} entries of MJS", changed.len()))
        .chain(changed.iter().take(MOST_CHANGES).map(line))
        .chain((more > 0).then(|| format!("and {more} more")))
        .collect()
}

fn pair_changes(a: &Pairs<f64>, b: &Pairs<f64>, model: &Model) -> Vec<String> {
    let mut lines = Vec::new();
    let mut compare = |what: String, a: Option<f64>, b: Option<f64>| {
        if a.map(f64::to_bits) != b.map(f64::to_bits) {
            let [a, b] = [a, b].map(|x| x.map_or("none".to_string(), |x| x.to_string()));
            lines.push(format!("{what}: {a} as printed, {b} edited"));
        }
    };
    for (i1, node) in (1..).zip(&model.contact.nodes) {
        let number = |n: Option<&usize>| n.map(|n| *n as f64);
        compare(format!("ct[{i1}] (node {node})"), number(a.ct.get(i1)), number(b.ct.get(i1)));
        compare(format!("yt[{i1}] (node {node})"), a.yt.get(i1).copied(), b.yt.get(i1).copied());
        compare(format!("dy[{i1}] (node {node})"), number(a.dy.get(i1)), number(b.dy.get(i1)));
    }
    for n in 1..=model.nodes.len() {
        for j in 1..=4 {
            let entry = |p: &Pairs<f64>| p.k_cnt.get(n, j).copied();
            compare(format!("k_cnt[{n},{j}]"), entry(a), entry(b));
        }
    }
    lines
}
