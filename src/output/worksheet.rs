//! A worksheet of Mathcad, executed beside the results that it saved.

use serde::Serialize;

use super::json;
use super::model::{Report, Table};
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
        Agreement::Digits { digits } => format!("same to {digits} digits"),
        Agreement::SameFailure { saved, ours } => format!("both fail: «{saved}»; here: {ours}"),
        Agreement::Fails { ours: why } => {
            format!("nothing saved to compare with; it fails here: {why}")
        }
        Agreement::Differs { saved, ours } => {
            format!("differs: saved {}; here {}", short(saved), short(ours))
        }
        Agreement::Unsupported { construct } => return format!("unsupported: {construct}"),
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
    let digits = count(&|v| matches!(v, Agreement::Digits { .. }));
    let failures = count(&|v| matches!(v, Agreement::SameFailure { .. }));
    let differ = count(&|v| matches!(v, Agreement::Differs { .. }));
    let fail = count(&|v| matches!(v, Agreement::Fails { .. }));
    let unsupported = count(&|v| matches!(v, Agreement::Unsupported { .. }));
    format!(
        "{same} results same to the last bit, {digits} to ten digits or more, {failures} failures in \
         both, {differ} differ, {fail} regions fail here alone, {unsupported} are unsupported"
    )
}

/// A worksheet that was executed, as JSON.
#[derive(Serialize)]
struct Executed<'a> {
    file: &'a str,
    regions: &'a [ExecutedRegion],
}

/// Writes the regions on one line.
pub fn json(file: &str, regions: &[ExecutedRegion]) -> String {
    json::streamed(&Executed { file, regions })
}
