//! The audit for people and for machines.

use std::collections::BTreeSet;

use schemars::JsonSchema;
use serde::Serialize;
use serde_json::Value;

use super::claims;
use super::json::of_scene;
use super::layout::{Table, aligned, listed};
use super::numbers::{or_dash, percent, short};
use super::tables::certainty;
use engine::{BodySummary, Cycle, Distance};
use paper::listings::Which;
use problem::model::NodeId;
use problem::modelling::Variant;
use problem::scene::Scene;
use studies::audit::claims::Judged;
use studies::audit::findings::{Finding, Measured, Verdict};
use studies::audit::readings::Effect;
use studies::audit::variants::{End, VariantRow};
use studies::audit::{Assumption, Audit, Compared, Rubbing};

pub fn text(audit: &Audit, scene: &Scene) -> String {
    format!(
        "Audit of scene {} ({})\n\n\
         Claims of the paper, and what they assume\n{}\n\
         1. Readings: what the other reading changes, at the initial shape and at the end\n{}\n\
         2. Findings (`audit --finding C4` explains one)\n{}\n\
         3. Variants side by side\n{}{}{}",
        scene.name,
        scene.title,
        claims::text(&audit.claims, &audit.assumptions),
        readings(&audit.readings),
        findings(&audit.findings),
        variants(&audit.variants),
        against(audit),
        rubbing(&audit.friction)
    )
}

/// Lays out the readings; why one fails stands under the table, each reason once.
fn readings(effects: &[Effect]) -> String {
    let mut failures: Vec<&str> = Vec::new();
    for why in effects.iter().filter_map(failure) {
        if !failures.contains(&why) {
            failures.push(why);
        }
    }
    let remark = |effect: &Effect| match failure(effect) {
        Some(why) => {
            let at = failures.iter().position(|known| *known == why).expect("it was collected");
            format!(": fails ({})", at + 1)
        }
        None if effect.changes() => String::new(),
        None => ": nothing depends on it".into(),
    };
    let count = |count: Option<usize>| or_dash(count, |n| n.to_string());
    let table = Table::of(effects)
        .column("id", |effect| effect.id)
        .column("reading", |effect| effect.reading.clone())
        .column("lines", |effect| effect.lines)
        .column("dy changed", |effect| count(effect.statuses))
        .column("MJS entries changed", |effect| count(effect.entries))
        .column("largest difference", |effect| or_dash(effect.displacement, short))
        .column("of what", |effect| effect.of.clone() + &remark(effect))
        .text();
    let notes = failures.iter().zip(1..).map(|(why, k)| format!("  ({k}) {why}\n"));
    table + &notes.collect::<String>()
}

/// Returns why a reading cannot be run, in one line.
fn failure(effect: &Effect) -> Option<&str> {
    effect.failure.as_deref().map(first_line)
}

fn first_line(text: &str) -> &str {
    text.lines()
        .next()
        .unwrap_or("")
        .trim_start_matches("the published algorithm fails as printed: ")
}

fn findings(findings: &[(&Finding, Measured)]) -> String {
    let lines = |of: &Finding| format!("{} {}", of.listing, listed(of.lines));
    Table::of(findings)
        .column("id", |(finding, _)| finding.id)
        .column("line", |(finding, _)| lines(finding).trim_end().to_string())
        .column("verdict", |(_, measured)| measured.verdict.name())
        .column("value", |(_, measured)| short(measured.number))
        .column("what the value is", |(finding, _)| finding.number)
        .column("what the listing does that the text does not say", |(finding, _)| finding.title)
        .text()
}

fn variants(rows: &[VariantRow]) -> String {
    let head = "variant;in contact;contact state;force on target over load;eq. (1) left;\
                largest von Mises stress;error in u;error in energy norm;largest friction needed;\
                nodes pulling";
    let notes = rows
        .iter()
        .filter_map(|row| Some(format!("  {}: {}\n", row.variant, certainty(row.certainty?)?)));
    aligned(head.split(';'), rows.iter().map(variant)) + &notes.collect::<String>()
}

/// Returns the cells of a variant; of one that failed its name, and why.
fn variant(row: &VariantRow) -> Vec<String> {
    let name = row.variant.to_string();
    match &row.end {
        End::Failure { failure } => vec![name, first_line(failure).into()],
        End::Result {
            in_contact,
            target_share,
            eq1_residual,
            cycle,
            bodies,
            distance,
            friction_needed,
            pulling,
            ..
        } => {
            let off = |of: fn(&Distance) -> f64| or_dash(distance.as_ref(), |d| percent(of(d), 2));
            vec![
                name,
                in_contact.last().map_or(String::new(), usize::to_string),
                match row.variant {
                    Variant::Unilateral => "in equilibrium".into(),
                    _ => state(cycle.as_ref()),
                },
                percent(*target_share, 1),
                short(*eq1_residual),
                stresses(bodies),
                off(|distance| distance.displacement_relative),
                off(|distance| distance.energy_relative),
                or_dash(*friction_needed, short),
                pulling.len().to_string(),
            ]
        }
    }
}

fn state(cycle: Option<&Cycle>) -> String {
    match cycle {
        None => "new in the last iteration".into(),
        Some(Cycle { length: 1, .. }) => "settled".into(),
        Some(cycle) => format!("cycle of {}", cycle.length),
    }
}

/// Writes the largest von Mises stress of each body behind its name.
fn stresses(bodies: &[BodySummary]) -> String {
    listed(bodies.iter().map(|body| format!("{} {}", body.name, short(body.max_von_mises_stress))))
}

/// Describes the two solutions without the print's mistakes, of which the first is what the errors
/// of the variants are against.
fn against(audit: &Audit) -> String {
    let line = |what: &str, other: &Option<Compared>| {
        other.as_ref().map_or(format!("  {what}: there is none\n"), |other| {
            format!(
                "  {what} (unilateral, {}, friction {}, {} geometry): {} in contact, \
                 largest von Mises stress {}\n",
                other.model.coupling,
                other.model.friction,
                other.model.geometry,
                other.in_contact,
                stresses(&other.bodies)
            )
        })
    };
    if audit.friction.is_empty() {
        return String::new();
    }
    "  error in u: largest difference of a node's displacement over the largest displacement; in energy \
     norm: that of the difference over that of the whole\n"
        .to_string()
        + &line("error: against the equilibrium under the scene's own friction", &audit.equilibrium)
        + &line("the reference solution", &audit.reference)
}

/// Lays out which nodes stick and slide under each coefficient of friction, with their pressure and
/// shear.
fn rubbing(cases: &[Rubbing]) -> String {
    if cases.is_empty() {
        return String::new();
    }
    let nodes: BTreeSet<NodeId> = cases
        .iter()
        .flat_map(|case| case.nodes.iter().flatten().map(|contact| contact.node))
        .collect();
    let mut table = Table::of(nodes).column("node", |node| *node);
    for case in cases {
        let cell = |node: &NodeId| {
            let contact = case.nodes.as_ref().ok()?.iter().find(|c| c.node == *node)?;
            let [pressure, shear] = [contact.pressure, contact.shear].map(|x| or_dash(x, tenth));
            Some(format!("{pressure} {shear} {}", contact.status?))
        };
        table = table
            .column(format!("friction {}", case.friction), |node| or_dash(cell(node), |cell| cell));
    }
    let none = cases.iter().filter_map(|case| {
        let why = case.nodes.as_ref().err()?;
        Some(format!("  friction {}: {why}\n", case.friction))
    });
    format!(
        "\n4. Pressure, shear and status of the nodes in contact by coefficient of friction \
         (unilateral, mortar)\n{}{}",
        table.text(),
        none.collect::<String>()
    )
}

fn tenth(x: f64) -> String {
    // 0 added to −0 is 0.
    format!("{:.1}", (10.0 * x).round() / 10.0 + 0.0)
}

/// The audit of a scene as JSON.
#[derive(Serialize, JsonSchema)]
pub struct Document<'a> {
    scene: &'a str,
    claims: &'a [Judged],
    assumptions: &'a [Assumption],
    readings: &'a [Effect],
    findings: Vec<FindingRow>,
    variants: &'a [VariantRow],
    equilibrium: &'a Option<Compared>,
    reference: &'a Option<Compared>,
    friction: &'a [Rubbing],
}

/// A finding on a scene.
#[derive(Serialize, JsonSchema)]
pub struct FindingRow {
    id: &'static str,
    /// `c_cnt`, `Km`, or `-` where it is the iterations'.
    listing: &'static str,
    /// The printed lines that do it, from 1.
    lines: &'static [usize],
    /// What the listing does that the text does not say.
    title: &'static str,
    verdict: Verdict,
    /// What was measured.
    number: f64,
    /// What the number is, with its unit.
    of: &'static str,
    detail: String,
}

impl FindingRow {
    pub fn new(finding: &Finding, measured: &Measured) -> Self {
        let Finding { id, listing, lines, title, number: of, .. } = *finding;
        let Measured { verdict, number, ref detail } = *measured;
        FindingRow { id, listing, lines, title, verdict, number, of, detail: detail.clone() }
    }
}

/// Returns the audit of a scene as JSON.
pub fn json(audit: &Audit, scene: &Scene) -> String {
    of_scene(scene, &document(audit, scene))
}

/// Returns what an audit of a scene found, without a head.
pub fn value(audit: &Audit, scene: &Scene) -> Value {
    serde_json::to_value(document(audit, scene)).expect("a document is JSON")
}

fn document<'a>(audit: &'a Audit, scene: &'a Scene) -> Document<'a> {
    Document {
        scene: &scene.name,
        claims: &audit.claims,
        assumptions: &audit.assumptions,
        readings: &audit.readings,
        findings: audit.findings.iter().map(|(f, m)| FindingRow::new(f, m)).collect(),
        variants: &audit.variants,
        equilibrium: &audit.equilibrium,
        reference: &audit.reference,
        friction: &audit.friction,
    }
}

/// Returns what a scene shows of one finding as JSON.
pub fn finding_json(finding: &Finding, measured: &Measured, scene: &Scene) -> String {
    of_scene(scene, &FindingRow::new(finding, measured))
}

/// Explains a finding: its lines, the values on `scene`, why it matters, what a repair would be.
pub fn explain(finding: &Finding, measured: &Measured, scene: &Scene) -> String {
    format!(
        "{}: {}\n\nListing\n{}\nOn scene {}: {} ({} {})\n  {}\n\n\
         Why it matters\n  {}\n\nA repair\n  {}\n",
        finding.id,
        finding.title,
        quoted(finding),
        scene.name,
        measured.verdict.name(),
        short(measured.number),
        finding.number,
        measured.detail,
        finding.why,
        finding.repair
    )
}

fn quoted(finding: &Finding) -> String {
    let Ok(which) = finding.listing.parse::<Which>() else {
        return "  none: it is in what the paper does around the listings\n".into();
    };
    let printed: Vec<&str> = which.text().lines().filter(|line| !line.starts_with('#')).collect();
    let line = |n: &usize| format!("  {} {n:>2}  {}\n", which.name(), printed[n - 1].trim_start());
    finding.lines.iter().map(line).collect()
}
