//! The tables of readings and of findings that the program's own tables give: `listings/READING.md`, section 4,
//! and the section after it. INSTA_UPDATE=always writes them.

use crate::citations::READING;
use crate::common::golden_file::assert_file;
use crate::common::page::{self, markdown};
use plane_contact::paper::listings::Which;
use plane_contact::paper::mirror::{Ambiguity, DefaultFrom, READINGS};
use plane_contact::studies::audit::Case;
use plane_contact::studies::audit::findings::{FINDINGS, Finding};

/// The page of a finding, in its folder.
const PAGE: &str = "README.md";

#[test]
fn the_tables_of_readings_and_findings_are_the_programs() {
    let page = std::fs::read_to_string(READING).expect("the page is there");
    let head = "id | lines | open | values, the default first | why this default";
    let readings = markdown(head, READINGS.iter().map(reading));
    let head = "id | line | what the listing does | on the smallest scene | repair";
    let findings = markdown(head, FINDINGS.iter().map(finding));
    let page = filled(&page, "readings", &readings);
    assert_file(READING, &filled(&page, "findings", &findings));
}

/// Returns a page with `text` between the comments `name` and `end`.
fn filled(page: &str, name: &str, text: &str) -> String {
    let begin = format!("<!-- {name} -->\n");
    let (above, rest) = page.split_once(&begin).expect("the page marks the table");
    let (_, below) = rest.split_once("<!-- end -->").expect("the page marks the table's end");
    format!("{above}{begin}{text}<!-- end -->{below}")
}

fn reading(row: &Ambiguity) -> String {
    let values: Vec<String> =
        row.values.iter().map(|value| format!("`{}`: {}", value.name, value.words)).collect();
    let default = match row.default {
        DefaultFrom::First => "",
        DefaultFrom::Scene => "the scene's `plane`; ",
        DefaultFrom::Variant => "the variant's; ",
    };
    let values = default.to_string() + &values.join("; ");
    page::row(&[row.id, row.lines, row.what, &values, row.why])
}

fn finding(finding: &Finding) -> String {
    let id = format!("[{0}](../golden/findings/{0}/{PAGE})", finding.id);
    let lines: Vec<String> = finding.lines.iter().map(usize::to_string).collect();
    let listing = finding.listing.map_or("-", Which::name);
    let lines = format!("{listing} {}", lines.join(", "));
    let measured = finding.measure(&Case::new(finding.scene()).with_equivalents(0));
    let value = format!("{:.3}", measured.number.expect("a number"));
    let value = value.trim_end_matches('0').trim_end_matches('.');
    let shown = format!("{value} = {}", finding.number);
    page::row(&[&id, lines.trim_end(), finding.title, &shown, finding.repair])
}
