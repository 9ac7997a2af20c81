//! The audit for people and for machines.

use serde_json::json;

use super::json::line;
use super::layout::{Table, aligned, listed};
use super::numbers::{or_dash, percent, short};
use crate::answer::contact::ContactNode;
use crate::answer::{BodySummary, Cycle, Distance};
use crate::paper::listings::Which;
use crate::problem::modelling::Variant;
use crate::problem::scene::Scene;
use crate::studies::audit::findings::{Finding, Measured};
use crate::studies::audit::readings::Effect;
use crate::studies::audit::variants::{End, VariantRow};
use crate::studies::audit::{Audit, ReferenceSummary};

const FRICTION: [f64; 4] = [0.1, 0.2, 0.4, 0.8];

pub fn text(audit: &Audit, scene: &Scene) -> String {
    format!(
        "Audit of scene {} ({})\n\n\
         1. Readings: what the other reading changes, at the initial shape and at the end\n{}\n\
         2. Findings (`audit --finding C4` explains one)\n{}\n\
         3. Variants side by side\n{}{}{}",
        scene.name,
        scene.title,
        readings(&audit.readings),
        findings(&audit.findings),
        variants(&audit.variants),
        audit.reference.as_ref().map_or(String::new(), reference),
        sticking(&audit.sticking)
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
        .column("MJS entries", |effect| count(effect.entries))
        .column("largest difference", |effect| or_dash(effect.displacement, short))
        .column("of", |effect| effect.of.clone() + &remark(effect))
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
        .column("number", |(_, measured)| short(measured.number))
        .column("what the listing does that the text does not say", |(finding, _)| finding.title)
        .text()
}

fn variants(rows: &[VariantRow]) -> String {
    let head = "variant;in contact;contact state;force on target;eq. (1), total u;\
                von Mises stress;error in |u|;error in energy;friction needed;pulling";
    aligned(head.split(';'), rows.iter().map(variant))
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

/// Describes the reference solution, which the errors of the variants are against.
fn reference(reference: &ReferenceSummary) -> String {
    format!(
        "  error: against the reference solution (unilateral, {}, friction {}): {} in contact, \
         von Mises stress {}\n",
        reference.model.coupling,
        reference.model.friction,
        reference.in_contact,
        stresses(&reference.bodies)
    )
}

/// Lays out what friction the nodes of the reference solution take to stick, and which would slip.
fn sticking(nodes: &[ContactNode]) -> String {
    if nodes.is_empty() {
        return String::new();
    }
    let needed = Table::of(nodes)
        .column("node", |c| c.node)
        .column("pressure", |c| short(c.pressure))
        .column("shear", |c| short(c.shear))
        .column("friction needed", |c| or_dash(c.friction_needed, short))
        .text();
    let slipping = FRICTION.map(|coefficient| {
        let slips = nodes.iter().filter(|c| c.friction_needed.is_some_and(|f| f > coefficient));
        let slipping = match listed(slips.map(|c| c.node)) {
            nodes if nodes.is_empty() => "none".into(),
            nodes => format!("nodes {nodes}"),
        };
        format!("  at a friction coefficient of {coefficient} {slipping} would slip\n")
    });
    format!(
        "\n4. What friction it takes that the nodes of the reference solution stick\n{needed}{}",
        slipping.concat()
    )
}

pub fn json(audit: &Audit, scene: &Scene) -> String {
    let findings = audit.findings.iter();
    let findings: Vec<serde_json::Value> = findings.map(|(f, m)| f.row(m)).collect();
    line(&json!({
        "scene": scene.name,
        "readings": audit.readings,
        "findings": findings,
        "variants": audit.variants,
        "reference": audit.reference,
        "sticking": audit.sticking,
    }))
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
    let Some(which) = [Which::CCnt, Which::Km].into_iter().find(|w| w.name() == finding.listing)
    else {
        return "  none: it is in what the paper does around the listings\n".into();
    };
    let printed: Vec<&str> = which.text().lines().filter(|line| !line.starts_with('#')).collect();
    let line = |n: &usize| format!("  {} {n:>2}  {}\n", which.name(), printed[n - 1].trim_start());
    finding.lines.iter().map(line).collect()
}
