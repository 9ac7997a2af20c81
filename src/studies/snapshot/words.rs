//! Differences in words.

use indexmap::IndexMap;
use output::numbers::with_unit;
use serde_json::Value;

use super::{Change, Difference, Entry, Kind, Number, Presence, Quantity, Status, VerifiedRun};

/// The most characters of a fact that is printed whole.
const WIDTH: usize = 70;

/// Returns a fact in words, shortened where it is long.
fn short(value: &Value) -> String {
    let text = value.to_string();
    match text.char_indices().nth(WIDTH) {
        Some((end, _)) => format!("{}...", &text[..end]),
        None => text,
    }
}

/// The most changes of what went in that are printed.
const CHANGES: usize = 10;

/// Returns what went into a run and differs, and where it first differs.
pub fn first(run: &VerifiedRun) -> String {
    let mut text: String = run.changes.iter().take(CHANGES).map(change).collect();
    if let Some(more @ 1..) = run.changes.len().checked_sub(CHANGES) {
        text += &format!("and {more} more changes\n");
    }
    let Some(first) = &run.first else { return text };
    let node = first.node.map_or(String::new(), |node| format!(", node {node}"));
    text += &format!("first difference: {}{node}\n", first.entry);
    if let Some(Status { iteration, node, words, line, rounding }) = &first.status {
        text += &format!("first status: iteration {iteration}, node {node}: {words}\n");
        text.extend(line.iter().map(|line| format!("  {line}\n")));
        let decided = |what| format!("  rounding decides {what}\n");
        text.extend(rounding.iter().map(decided));
    }
    text
}

fn change(Change { place, was, is }: &Change) -> String {
    format!("changed: {place}: {is}, was {was}\n")
}

/// Returns the first change of what went into a run that differs, or else its first difference, in a line.
pub fn headline(run: &VerifiedRun) -> String {
    match (run.changes.first(), run.differences.first()) {
        _ if run.presence != Presence::Both => run.presence.explained(),
        (Some(first), _) => change(first).trim_end().into(),
        (None, Some(first)) => difference(first),
        (None, None) => "nothing was compared".into(),
    }
}

/// Returns a difference in a line.
fn difference(difference: &Difference) -> String {
    let entry = &difference.entry;
    match &difference.kind {
        Kind::Missing => format!("{entry}: missing"),
        Kind::Extra => format!("{entry}: new"),
        Kind::Unit { was, is } => {
            let [is, was] = [is, was].map(|unit| if unit.is_empty() { "none" } else { unit });
            format!("unit of {entry}: {is}, was {was}")
        }
        Kind::Fact { was, is } => format!("{entry}: {}", fact(was, is)),
        Kind::Shape { was, is, at } => {
            let at = at.map_or(String::new(), |at| format!(", first at row {at}"));
            format!("{entry}: {is} numbers, were {was}{at}")
        }
        Kind::Numbers(w) => {
            let limit = if w.bounded { "limit" } else { "rounding not measured, limit" };
            let by = (w.is.0 - w.was.0).abs();
            let part = by / w.was.0.abs();
            let part = if part.is_finite() { format!(" ({part:.1e} of it)") } else { "".into() };
            let unit = if by.is_finite() { &*w.unit } else { "" };
            let is = with_unit(&format!("{:e}", w.is), &w.unit);
            let by = with_unit(&format!("{:.3e}", Number(by)), unit);
            format!(
                "{entry}: {} of {} numbers differ, most at {} component {}: {is}, was {:e}; by {by}{part}, {limit} {:.3e}",
                w.differing, w.of, w.at, w.component, w.was, w.limit
            )
        }
    }
}

/// Returns what a fact is and was; of lists of the same length that are long, the first place where
/// they differ.
fn fact(was: &Value, is: &Value) -> String {
    if let (Value::Array(old), Value::Array(new)) = (was, is)
        && old.len() == new.len()
        && was.to_string().len().max(is.to_string().len()) > WIDTH
    {
        let pairs = || old.iter().zip(new).enumerate().filter(|(_, (was, is))| was != is);
        let first = pairs().next().map_or(String::new(), |(k, (was, is))| {
            format!("entry {}: {}, was {}", k + 1, short(is), short(was))
        });
        return format!("{} of {} entries differ; {first}", pairs().count(), old.len());
    }
    format!("{}, was {}", short(is), short(was))
}

/// Returns the differences, discrete facts first, those of several iterations in one line.
pub fn summary(differences: &[Difference]) -> String {
    let (facts, numbers): (Vec<&Difference>, Vec<&Difference>) =
        differences.iter().partition(|difference| difference.is_discrete());
    let mut text = String::new();
    for (title, group) in [("facts", facts), ("numbers", numbers)] {
        if group.is_empty() {
            continue;
        }
        text += &format!("{title}:\n");
        for (quantity, of_quantity) in by_quantity(&group) {
            let more = match of_quantity.len() - 1 {
                0 => String::new(),
                more => format!("; and {quantity} of {more} later iterations"),
            };
            text += &format!("  {}{more}\n", difference(of_quantity[0]));
        }
    }
    text
}

/// Groups differences by what differs, whatever the iteration, in their order.
fn by_quantity<'a>(differences: &[&'a Difference]) -> Vec<(Quantity, Vec<&'a Difference>)> {
    let mut groups: IndexMap<(bool, Quantity), Vec<&Difference>> = IndexMap::new();
    for difference in differences {
        let Entry { iteration, quantity } = difference.entry;
        groups.entry((iteration.is_some(), quantity)).or_default().push(difference);
    }
    groups.into_iter().map(|((_, quantity), group)| (quantity, group)).collect()
}
