//! What the golden scenes reach of the listings: every line executed, every condition both ways,
//! each operand of each `∧` decisive.

use std::fmt::Write as _;

use crate::common::coverage::Coverage;
use crate::common::golden_floats::assert_golden;
use crate::common::shipped::shipped_scenes;
use plane_contact::engine::Request;
use plane_contact::mathcad::Listing;
use plane_contact::paper::door;
use plane_contact::paper::listings::{self, Which, settings};
use plane_contact::paper::mirror::{Reading, c_cnt};

/// Operands that can never be the only false one, on any scene:
/// - c_cnt 17, 18: ct = 0 leaves yt = 0 (lines 9, 10), so that yt < 0 is false too;
/// - c_cnt 17, 18: where i1 is the last (the first), yt[i1+1] (yt[i1−1]) is not there to be true;
/// - Km 13: with i = j, cx[i] and cx[j] are one.
const NEVER_ALONE: [(&str, usize, &str); 6] = [
    ("c_cnt", 17, "ct[i1] > 0"),
    ("c_cnt", 18, "ct[i1] > 0"),
    ("c_cnt", 17, "i1 < rows(cnt)"),
    ("c_cnt", 18, "i1 ≥ 2"),
    ("Km", 13, "cx[i] = 0"),
    ("Km", 13, "cx[j] = 0"),
];

#[test]
fn the_golden_scenes_cover_the_listings() {
    let reading = Reading::default();
    let (mut of_c_cnt, mut of_km) = (Coverage::default(), Coverage::default());
    let (text_c_cnt, text_km) = (Which::CCnt.under(&reading), Which::Km.under(&reading));
    for scene in shipped_scenes() {
        let model = Request::new(&scene).reading(reading).model().unwrap();
        let sheet = door::worksheet(&model, |x| x);
        let settings = settings(&reading);
        // A scene may be there to show where the listing stops; what it reached before counts.
        let _ = listings::c_cnt(&text_c_cnt, &settings, &sheet, &sheet.node, &mut of_c_cnt);
        if let Ok(pairs) = c_cnt(&sheet, &reading, &sheet.node) {
            let _ = listings::km(&text_km, &settings, &sheet, &pairs.k_cnt, &mut of_km);
        }
    }
    let text = format!("c_cnt\n{}\nKm\n{}", table(&text_c_cnt, &of_c_cnt), table(&text_km, &of_km));
    assert_golden("listings", "coverage", &text);
    let gaps: Vec<&str> = text.lines().filter(|line| line.contains("NO")).collect();
    assert!(gaps.is_empty(), "not covered:\n{}", gaps.join("\n"));
}

/// A line a printed line: executed or not; below it its condition, and the operands of its `∧`.
fn table(listing: &Listing, coverage: &Coverage) -> String {
    let said = |covered: bool| if covered { "yes" } else { "NO" };
    let mut text = String::new();
    // Line 1 is the header: it is called, not executed.
    for line in &listing.lines()[1..] {
        let number = line.printed;
        writeln!(text, "{number:>2} executed {}", said(coverage.lines.contains_key(&number)))
            .unwrap();
        if let Some(condition) = coverage.conditions.get(&number) {
            let (held, failed) = (said(condition.held > 0), said(condition.failed > 0));
            writeln!(text, "   condition true {held}, false {failed}: {}", condition.text).unwrap();
        } else if line.text.contains("if ") {
            writeln!(text, "   condition NO").unwrap();
        }
        for ((_, _), operands) in coverage.conjunctions.range((number, 0)..(number + 1, 0)) {
            for operand in operands {
                let (admitted, refused) = (said(operand.admitted > 0), said(operand.refused > 0));
                let refused =
                    match NEVER_ALONE.contains(&(listing.name(), number, operand.text.as_str())) {
                        true if operand.refused == 0 => "never",
                        _ => refused,
                    };
                writeln!(
                    text,
                    "   operand decides true {admitted}, false {refused}: {}",
                    operand.text
                )
                .unwrap();
            }
        }
    }
    text
}
