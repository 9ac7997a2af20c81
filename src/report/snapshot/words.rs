//! Differences and their causes in words.

use indexmap::IndexMap;
use serde_json::Value;

use studies::snapshot::{Difference, Explanation, Kind, Number, Presence, VerifiedRun};

/// The most characters of a fact that is printed whole.
const WIDTH: usize = 70;

/// Returns a fact in words, shortened where it is long.
pub fn short(value: &Value) -> String {
    let text = value.to_string();
    match text.char_indices().nth(WIDTH) {
        Some((end, _)) => format!("{}...", &text[..end]),
        None => text,
    }
}

/// Returns why a run differs.
pub fn explanation(explanation: &Explanation) -> String {
    let mut text = format!("cause: {} ({})\n", explanation.cause, explanation.class);
    text += &format!("  known by: {}\n", explanation.known_by);
    for other in explanation.causes.iter().skip(1) {
        text += &format!("  also: {}: {}, was {}\n", other.place, other.is, other.was);
    }
    match (&explanation.first, &explanation.flip) {
        (None, _) => text += "nothing that was recorded differs\n",
        (Some(first), None) => text += &format!("first difference: {first}\n"),
        (Some(first), Some(flip)) => {
            text += &format!("first difference: {first}\n");
            let later = if explanation.later > 0 { "; everything later follows" } else { "" };
            text += &format!("first divergence: {}{later}\n", turn(flip));
            text.extend(flip.line.iter().map(|line| format!("  {line}\n")));
        }
    }
    text
}

fn turn(flip: &studies::snapshot::Flip) -> String {
    let node = flip.node.map_or(String::new(), |node| format!(", node {node}"));
    let line = flip.line.as_deref().and_then(|line| line.split_once(':'));
    let line = line.map_or(String::new(), |(place, _)| format!(", {place}"));
    format!("iteration {}{node}{line}: {}", flip.iteration, flip.words)
}

/// Returns where a run is that one side alone has.
pub fn presence(presence: Presence) -> &'static str {
    match presence {
        Presence::Both => "on both sides",
        Presence::Missing => "missing: the old side alone has it",
        Presence::New => "new: the old side does not have it",
    }
}

/// Returns the cause of a run's differences, or the first of them, in a line.
pub fn headline(run: &VerifiedRun) -> String {
    match (&run.explanation, run.differences.first()) {
        _ if run.presence != Presence::Both => presence(run.presence).into(),
        (Some(explanation), _) => format!("{} ({})", explanation.cause, explanation.class),
        (None, Some(first)) => difference(first),
        (None, None) => "nothing was compared".into(),
    }
}

/// Returns a difference in a line.
pub fn difference(difference: &Difference) -> String {
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
            let limit = if w.bounded { "limit" } else { "no bound is known, limit" };
            let by = Number((w.is.0 - w.was.0).abs());
            format!(
                "{entry}: {} of {} numbers differ, most at {} component {}: {:e}, was {:e}; by \
                 {by:.3e}, {limit} {:.3e}",
                w.differing, w.of, w.at, w.component, w.is, w.was, w.limit
            )
        }
        Kind::Expected { was, is, limit, reason } => {
            let is = is.map_or("nothing".into(), |is| format!("{is:e}"));
            format!("{entry}: {is}, expected {was:e} within {limit:.3e} ({reason})")
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
fn by_quantity<'a>(differences: &[&'a Difference]) -> Vec<(&'a str, Vec<&'a Difference>)> {
    let mut groups: IndexMap<(bool, &str), Vec<&Difference>> = IndexMap::new();
    for difference in differences {
        let words: Vec<&str> = difference.entry.splitn(3, ' ').collect();
        let in_iteration = words.len() == 3 && words[0] == "iteration";
        let quantity = if in_iteration { words[2] } else { &difference.entry };
        groups.entry((in_iteration, quantity)).or_default().push(difference);
    }
    groups.into_iter().map(|((_, quantity), group)| (quantity, group)).collect()
}
