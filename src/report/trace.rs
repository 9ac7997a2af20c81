//! A trace for people and for machines.

use std::fmt::Write as _;

use serde_json::{Value as Json, json};

use super::json::pairs_value;
use crate::paper::listings::Which;
use crate::paper::mathcad::Listing;
use crate::paper::mathcad::array::Table;
use crate::paper::mirror::Pairs;
use crate::problem::model::{Model, TriangleId};
use crate::studies::audit::trace::{Access, MOST_STEPS, Product, Step, Trace, text_of};

/// The trace as text: the steps turn by turn, what `trace()` wrote, and what came out.
pub fn text(trace: &Trace, listing: &Listing, model: &Model) -> String {
    let mut text = String::new();
    for turn in turns(trace) {
        writeln!(text, "\n{}", heading(trace.which, turn, model)).expect("a String takes any text");
        let steps: Vec<&Step> = trace.steps.iter().filter(|s| s.turn == Some(turn)).collect();
        let (kept, skipped) = without_missed_edges(trace.which, listing, &steps);
        for step in kept {
            write_step(&mut text, listing, step);
        }
        if skipped > 0 {
            writeln!(
                text,
                "  (lines 4-7 for {skipped} more edges: the node is outside their boxes)"
            )
            .expect("a String takes any text");
        }
    }
    text += &outside(trace, listing);
    if trace.steps.len() == MOST_STEPS {
        writeln!(text, "\n(only the first {MOST_STEPS} statements are shown)")
            .expect("a String takes any text");
    }
    if !trace.output.is_empty() {
        writeln!(text, "\ntrace() wrote: {}", trace.output.join(" | "))
            .expect("a String takes any text");
    }
    text
}

/// The statements outside the turns, a line each: how often it was executed, and what it wrote last.
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
    let mut text = "\noutside these\n".to_string();
    for (line, times, last) in lines {
        let written = listed(&last.writes, " ← ");
        let last = if written.is_empty() { String::new() } else { format!(", last ⇒ {written}") };
        let printed = text_of(listing, line);
        writeln!(text, "  {line:>2}  {printed}   ({times} times{last})")
            .expect("a String takes any text");
    }
    text
}

/// The turns in ascending order.
fn turns(trace: &Trace) -> Vec<usize> {
    let mut turns: Vec<usize> = trace.steps.iter().filter_map(|step| step.turn).collect();
    turns.sort_unstable();
    turns.dedup();
    turns
}

fn heading(which: Which, turn: usize, model: &Model) -> String {
    match which {
        Which::CCnt => format!(
            "contact node {} (i1 = {turn} of {})",
            model.contact.nodes.get(turn - 1).map_or(0, |node| node.number()),
            model.contact.nodes.len()
        ),
        Which::Km => {
            let triangle = model.triangle(TriangleId::from_number(turn));
            let nodes = triangle.nodes.map(|node| node.to_string()).join(", ");
            format!("element n = {turn} of {} (nodes {nodes})", model.triangles.len())
        }
    }
}

/// Leaves out, for `c_cnt`, the turns over target edges that wrote no `ct`; tells how many they were.
fn without_missed_edges<'s>(
    which: Which,
    listing: &Listing,
    steps: &[&'s Step],
) -> (Vec<&'s Step>, usize) {
    if which == Which::Km {
        return (steps.to_vec(), 0);
    }
    let (mut kept, mut skipped) = (Vec::new(), 0);
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
            kept.extend(turn);
        }
        rest = after;
    }
    (kept, skipped)
}

/// A printed line, what it read, what it wrote.
fn write_step(text: &mut String, listing: &Listing, step: &Step) {
    let printed = text_of(listing, step.line);
    let mut line = format!("  {:>2}  {printed}\n", step.line);
    let reads = listed(&step.reads, " = ");
    if !reads.is_empty() {
        line += &format!("        {reads}\n");
    }
    let writes = listed(&step.writes, " ← ");
    if !writes.is_empty() {
        line += &format!("      ⇒ {writes}\n");
    } else if printed.contains(" if ") || printed.starts_with("if ") {
        let held = printed.starts_with("if ");
        line += if held { "" } else { "      ⇒ the condition does not hold\n" };
    }
    text.push_str(&line);
}

/// Names and values, each once.
fn listed(accesses: &[Access], sign: &str) -> String {
    let mut seen: Vec<String> = Vec::new();
    for access in accesses {
        let item = format!("{}{sign}{}", access.name, value(&access.value));
        if !seen.contains(&item) {
            seen.push(item);
        }
    }
    seen.join(", ")
}

/// A number, `(a  b)` for a column, `(a  b; c  d)` for a matrix, or what the value is.
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

/// The trace as JSON.
pub fn json(trace: &Trace, listing: &Listing, scene: &str) -> String {
    let steps: Vec<Json> = trace
        .steps
        .iter()
        .map(|step| {
            json!({
                "turn": step.turn, "line": step.line, "text": text_of(listing, step.line),
                "reads": step.reads, "writes": step.writes,
            })
        })
        .collect();
    let (result, failure) = match &trace.result {
        Ok(product) => (product_value(product), Json::Null),
        Err(failure) => (Json::Null, Json::from(failure.to_string())),
    };
    let document = json!({
        "scene": scene, "listing": trace.which.name(), "steps": steps, "trace": trace.output, "result": result,
        "failure": failure,
    });
    document.to_string() + "\n"
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

/// Entries that are not zero: row, column, value.
fn entries(matrix: &Table<f64>, of: impl Fn(usize, usize) -> f64) -> Vec<(usize, usize, f64)> {
    let places = (1..=matrix.rows()).flat_map(|i| (1..=matrix.cols()).map(move |j| (i, j)));
    places.map(|(i, j)| (i, j, of(i, j))).filter(|(_, _, x)| *x != 0.0).collect()
}

/// What an edited listing changes against the listing as printed.
pub fn changes(printed: &Product, edited: &Product, model: &Model) -> String {
    let lines = match (printed, edited) {
        (Product::Pairs(a), Product::Pairs(b)) => pair_changes(a, b, model),
        (Product::Matrix(a), Product::Matrix(b))
            if (a.rows(), a.cols()) == (b.rows(), b.cols()) =>
        {
            let changed = entries(a, |i, j| b[(i, j)] - a[(i, j)]);
            let mut lines = vec![format!("{} entries of MJS", changed.len())];
            lines.extend(changed.iter().take(20).map(|(i, j, _)| {
                format!("MJS[{i},{j}]: {} as printed, {} edited", a[(*i, *j)], b[(*i, *j)])
            }));
            if changed.len() > 20 {
                lines.push(format!("and {} more", changed.len() - 20));
            }
            if changed.is_empty() { vec![] } else { lines }
        }
        _ => vec!["the shape of the result".into()],
    };
    match lines.as_slice() {
        [] => "\nThe edit changes nothing on this scene.\n".into(),
        lines => format!("\nThe edit changes:\n  {}\n", lines.join("\n  ")),
    }
}

fn pair_changes(a: &Pairs<f64>, b: &Pairs<f64>, model: &Model) -> Vec<String> {
    let mut lines = Vec::new();
    let mut compare = |what: String, a: Option<f64>, b: Option<f64>| {
        if a.map(f64::to_bits) != b.map(f64::to_bits) {
            let show = |x: Option<f64>| x.map_or("none".to_string(), |x| x.to_string());
            lines.push(format!("{what}: {} as printed, {} edited", show(a), show(b)));
        }
    };
    for (k, node) in model.contact.nodes.iter().enumerate() {
        let number = |n: Option<&usize>| n.map(|n| *n as f64);
        let i1 = k + 1;
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
