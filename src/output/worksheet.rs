//! A worksheet of Mathcad, executed beside the results that it saved.

use std::collections::BTreeSet;

use serde::Serialize;
use serde_json::{Value, json};

use super::json;
use super::model::{Report, Table};
use mathcad::json::Written;
use mathcad::worksheet::{Agreement, ExecutedRegion};

/// Reports each region with what came of it, and how many regions came out how.
pub fn report(regions: &[ExecutedRegion]) -> Report {
    let table = Table::from_rows(regions)
        .column("region", |region| region.id.clone())
        .column("tag", |region| region.tag.clone())
        .column("text", |region| {
            let first = region.text.lines().next().unwrap_or_default();
            let shown: String = first.chars().take(90).collect();
            let more = if shown.len() < region.text.trim_end().len() { " ..." } else { "" };
            shown + more
        })
        .column("compared with Mathcad", words);
    Report::default().table("Regions", table).line(summary(regions))
}

/// Says what came of a region.
fn words(region: &&ExecutedRegion) -> String {
    let inputs: Vec<&str> = region.inputs.iter().map(String::as_str).collect();
    let from = match inputs.as_slice() {
        [] => String::new(),
        ids => format!(" (with the saved results of {} as input)", ids.join(", ")),
    };
    let agreement = match &region.agreement {
        Agreement::NothingSaved => "nothing saved to compare with".into(),
        Agreement::Same => "same to the last bit".into(),
        Agreement::Digits(digits) => format!("same to {digits} digits"),
        Agreement::SameFailure { saved, ours } => format!("both fail: «{saved}»; here: {ours}"),
        Agreement::Fails(why) => format!("nothing saved to compare with; it fails here: {why}"),
        Agreement::Differs { saved, ours } => {
            format!("differs: saved {}; here {}", short(saved), short(ours))
        }
        Agreement::Unsupported(construct) => return format!("unsupported: {construct}"),
    };
    agreement + &from
}

fn short(value: &str) -> String {
    let cut: String = value.chars().take(120).collect();
    if cut.len() < value.len() { cut + " ..." } else { cut }
}

/// How many regions came out how.
fn summary(regions: &[ExecutedRegion]) -> String {
    let count =
        |is: &dyn Fn(&Agreement) -> bool| regions.iter().filter(|r| is(&r.agreement)).count();
    let same = count(&|v| *v == Agreement::Same);
    let digits = count(&|v| matches!(v, Agreement::Digits(_)));
    let failures = count(&|v| matches!(v, Agreement::SameFailure { .. }));
    let differ = count(&|v| matches!(v, Agreement::Differs { .. }));
    let fail = count(&|v| matches!(v, Agreement::Fails(_)));
    let unsupported = count(&|v| matches!(v, Agreement::Unsupported(_)));
    format!(
        "{same} results same to the last bit, {digits} to ten digits or more, {failures} failures in \
         both, {differ} differ, {fail} regions fail here alone, {unsupported} are unsupported"
    )
}

/// A worksheet that was executed, as JSON.
#[derive(Serialize)]
struct Executed<'a> {
    file: &'a str,
    regions: Vec<RegionRow<'a>>,
}

/// A region as it was executed.
#[derive(Serialize)]
struct RegionRow<'a> {
    region: &'a str,
    tag: &'a str,
    /// The region in the text notation.
    text: &'a str,
    /// How the region compares with what Mathcad saved.
    #[serde(flatten)]
    verdict: Value,
    /// The regions whose saved results went into this one.
    inputs: &'a BTreeSet<String>,
    /// The region's value: a number, words, or a list of rows; absent where there is none.
    #[serde(skip_serializing_if = "Option::is_none")]
    value: Option<Written<'a>>,
}

/// Writes the regions on one line.
pub fn json(file: &str, regions: &[ExecutedRegion]) -> String {
    let regions = regions.iter().map(|region| RegionRow {
        region: &region.id,
        tag: &region.tag,
        text: &region.text,
        verdict: verdict(&region.agreement),
        inputs: &region.inputs,
        value: region.value.as_ref().map(Written),
    });
    json::streamed(&Executed { file, regions: regions.collect() })
}

fn verdict(verdict: &Agreement) -> Value {
    match verdict {
        Agreement::NothingSaved => json!({ "verdict": "nothing saved" }),
        Agreement::Same => json!({ "verdict": "same" }),
        Agreement::Digits(digits) => json!({ "verdict": "digits", "digits": digits }),
        Agreement::SameFailure { saved, ours } => {
            json!({ "verdict": "failure", "saved": saved, "ours": ours })
        }
        Agreement::Differs { saved, ours } => {
            json!({ "verdict": "differs", "saved": saved, "ours": ours })
        }
        Agreement::Fails(ours) => json!({ "verdict": "fails", "ours": ours }),
        Agreement::Unsupported(construct) => {
            json!({ "verdict": "unsupported", "construct": construct })
        }
    }
}
