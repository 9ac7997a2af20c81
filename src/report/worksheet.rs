//! A worksheet of Mathcad, executed beside the results that it saved.

use serde_json::{Value, json};

use super::json::line;
use crate::paper::mathcad::json as values;
use crate::paper::mathcad::worksheet::{Checked, Verdict};

/// Lays out each region with what came of it, what a worksheet of questions decides, and how many
/// regions came out how.
pub fn text(regions: &[Checked], decided: &[(String, String)]) -> String {
    let mut text = String::new();
    for region in regions {
        let tag = if region.tag.is_empty() { String::new() } else { format!(" ({})", region.tag) };
        let first = region.text.lines().next().unwrap_or_default();
        let shown: String = first.chars().take(90).collect();
        let more = if shown.len() < region.text.trim_end().len() { " ..." } else { "" };
        text += &format!("{:>4}{tag}  {shown}{more}\n        {}\n", region.id, words(region));
    }
    for (question, answer) in decided {
        text += &format!("\nQuestion: {question}\n  {answer}\n");
    }
    text + "\n" + &summary(regions)
}

/// Says what came of a region.
fn words(region: &Checked) -> String {
    let inputs: Vec<&str> = region.inputs.iter().map(String::as_str).collect();
    let from = match inputs.as_slice() {
        [] => String::new(),
        ids => format!(" (with the saved results of {} as input)", ids.join(", ")),
    };
    let verdict = match &region.verdict {
        Verdict::NothingSaved => "nothing saved to compare with".into(),
        Verdict::Same => "same to the last bit".into(),
        Verdict::Digits(digits) => format!("same to {digits} digits"),
        Verdict::SameFailure { saved, ours } => format!("both fail: «{saved}»; here: {ours}"),
        Verdict::Fails(why) => format!("nothing saved to compare with; it fails here: {why}"),
        Verdict::Differs { saved, ours } => {
            format!("differs: saved {}; here {}", short(saved), short(ours))
        }
        Verdict::Beyond(construct) => return format!("beyond us: {construct}"),
    };
    verdict + &from
}

fn short(value: &str) -> String {
    let cut: String = value.chars().take(120).collect();
    if cut.len() < value.len() { cut + " ..." } else { cut }
}

/// How many regions came out how.
fn summary(regions: &[Checked]) -> String {
    let count = |is: &dyn Fn(&Verdict) -> bool| regions.iter().filter(|r| is(&r.verdict)).count();
    let same = count(&|v| *v == Verdict::Same);
    let digits = count(&|v| matches!(v, Verdict::Digits(_)));
    let failures = count(&|v| matches!(v, Verdict::SameFailure { .. }));
    let differ = count(&|v| matches!(v, Verdict::Differs { .. }));
    let beyond = count(&|v| matches!(v, Verdict::Beyond(_)));
    format!(
        "{same} results same to the last bit, {digits} to ten digits or more, {failures} failures in \
         both, {differ} differ, {beyond} regions beyond us\n"
    )
}

/// Writes the regions on one line.
pub fn json(name: &str, regions: &[Checked], decided: &[(String, String)]) -> String {
    let regions: Vec<_> = regions.iter().map(region).collect();
    let decided = decided.iter().map(|(q, a)| json!({ "question": q, "decides": a }));
    let decided: Vec<_> = decided.collect();
    line(&json!({ "file": name, "regions": regions, "questions": decided }))
}

fn region(region: &Checked) -> Value {
    let mut fields = serde_json::Map::new();
    fields.insert("region".into(), region.id.clone().into());
    fields.insert("tag".into(), region.tag.clone().into());
    fields.insert("text".into(), region.text.clone().into());
    let (verdict, more): (_, Vec<(&str, Value)>) = match &region.verdict {
        Verdict::NothingSaved => ("nothing saved", vec![]),
        Verdict::Same => ("same", vec![]),
        Verdict::Digits(digits) => ("digits", vec![("digits", (*digits).into())]),
        Verdict::SameFailure { saved, ours } => {
            ("failure", vec![("saved", saved.clone().into()), ("ours", ours.clone().into())])
        }
        Verdict::Differs { saved, ours } => {
            ("differs", vec![("saved", saved.clone().into()), ("ours", ours.clone().into())])
        }
        Verdict::Fails(why) => ("fails", vec![("ours", why.clone().into())]),
        Verdict::Beyond(construct) => ("beyond", vec![("construct", construct.clone().into())]),
    };
    fields.insert("verdict".into(), verdict.into());
    fields.extend(more.into_iter().map(|(name, value)| (name.to_string(), value)));
    fields.insert("inputs".into(), json!(region.inputs));
    if let Some(value) = &region.value {
        fields.insert("value".into(), values::write(value));
    }
    fields.into()
}
