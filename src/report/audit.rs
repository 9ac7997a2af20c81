//! The audit for people and for machines.

use serde_json::json;

use super::tables::{aligned, short};
use crate::answer::contact::ContactNode;
use crate::answer::{BodySummary, Cycle};
use crate::paper::listings::Which;
use crate::problem::modelling::Variant;
use crate::problem::scene::Scene;
use crate::studies::audit::findings::{Finding, Measured};
use crate::studies::audit::readings::Effect;
use crate::studies::audit::variants::{End, VariantRow};
use crate::studies::audit::{Audit, ReferenceSummary};

/// The tables.
pub fn text(audit: &Audit, scene: &Scene) -> String {
    format!(
        "Audit of scene {} ({})\n\n1. Readings: what the other reading changes, at the initial shape and at the end\n{}\n\
         2. Findings (`audit --finding C4` explains one)\n{}\n3. Variants side by side\n{}{}{}",
        scene.name,
        scene.title,
        readings(&audit.readings),
        findings(&audit.findings),
        variants(&audit.variants),
        audit.reference.as_ref().map_or(String::new(), converged),
        sticking(&audit.sticking)
    )
}

fn readings(effects: &[Effect]) -> String {
    let head = ["id", "reading", "lines", "dy changed", "MJS entries", "largest difference", "of"];
    let mut notes: Vec<String> = Vec::new();
    let rows: Vec<Vec<String>> = effects
        .iter()
        .map(|effect| {
            let remark = match (&effect.failure, effect.changes()) {
                (Some(why), _) => {
                    let note = first_line(why).to_string();
                    let known = notes.iter().position(|n| *n == note);
                    let at = known.unwrap_or_else(|| {
                        notes.push(note);
                        notes.len() - 1
                    });
                    format!(": fails ({})", at + 1)
                }
                (None, true) => String::new(),
                (None, false) => ": nothing depends on it".into(),
            };
            vec![
                effect.id.into(),
                effect.reading.clone(),
                effect.lines.into(),
                effect.statuses.map_or("-".into(), |n| n.to_string()),
                effect.entries.map_or("-".into(), |n| n.to_string()),
                effect.displacement.map_or("-".into(), short),
                effect.of.clone() + &remark,
            ]
        })
        .collect();
    let notes = notes.iter().enumerate().map(|(k, note)| format!("  ({}) {note}\n", k + 1));
    table(&head, rows.into_iter()) + &notes.collect::<String>()
}

fn first_line(text: &str) -> &str {
    text.lines()
        .next()
        .unwrap_or("")
        .trim_start_matches("the published algorithm fails as printed: ")
}

fn findings(findings: &[(&Finding, Measured)]) -> String {
    let head =
        ["id", "line", "verdict", "number", "what the listing does that the text does not say"];
    let rows = findings.iter().map(|(finding, measured)| {
        vec![
            finding.id.into(),
            place(finding),
            measured.verdict.name().into(),
            short(measured.number),
            finding.title.into(),
        ]
    });
    table(&head, rows)
}

/// `c_cnt 17, 18`.
fn place(finding: &Finding) -> String {
    let lines: Vec<String> = finding.lines.iter().map(usize::to_string).collect();
    format!("{} {}", finding.listing, lines.join(", ")).trim_end().into()
}

fn variants(rows: &[VariantRow]) -> String {
    let head = [
        "variant",
        "in contact",
        "contact state",
        "force on target",
        "eq. (1), total u",
        "von Mises stress",
        "off in |u|",
        "off in energy",
        "friction needed",
        "pulling",
    ];
    let rows = rows.iter().map(|row| match &row.end {
        End::Failure { failure } => vec![row.variant.to_string(), first_line(failure).into()],
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
            let stresses: Vec<String> = bodies
                .iter()
                .map(|b| format!("{} {}", b.name, short(b.max_von_mises_stress)))
                .collect();
            vec![
                row.variant.to_string(),
                in_contact.last().map_or(String::new(), usize::to_string),
                match row.variant {
                    Variant::Unilateral => "in equilibrium".into(),
                    _ => state(cycle),
                },
                format!("{:.1} %", 100.0 * target_share),
                short(*eq1_residual),
                stresses.join(", "),
                distance
                    .as_ref()
                    .map_or("-".into(), |d| format!("{:.2} %", 100.0 * d.displacement_relative)),
                distance
                    .as_ref()
                    .map_or("-".into(), |d| format!("{:.2} %", 100.0 * d.energy_relative)),
                friction_needed.map_or("-".into(), short),
                pulling.len().to_string(),
            ]
        }
    });
    table(&head, rows)
}

/// What the variants are off from.
fn converged(converged: &ReferenceSummary) -> String {
    let of_body = |b: &BodySummary| format!("{} {}", b.name, short(b.max_von_mises_stress));
    let bodies: Vec<String> = converged.bodies.iter().map(of_body).collect();
    format!(
        "  off: beside the converged answer (unilateral, {}, friction {}): {} in contact, von Mises stress {}\n",
        converged.model.coupling,
        converged.model.friction,
        converged.in_contact,
        bodies.join(", ")
    )
}

/// Friction coefficients at which slipping nodes are counted.
const FRICTION: [f64; 4] = [0.1, 0.2, 0.4, 0.8];

/// What friction it takes that the nodes of the converged answer stick, and where they would have slipped.
fn sticking(nodes: &[ContactNode]) -> String {
    if nodes.is_empty() {
        return String::new();
    }
    let head = ["node", "pressure", "shear", "friction needed"];
    let rows = nodes.iter().map(|c| {
        let needed = c.friction_needed.map_or("-".into(), short);
        vec![c.node.to_string(), short(c.pressure), short(c.shear), needed]
    });
    let slipping = FRICTION.map(|coefficient| {
        let slips = nodes.iter().filter(|c| c.friction_needed.is_some_and(|f| f > coefficient));
        let slips: Vec<String> = slips.map(|c| c.node.to_string()).collect();
        match slips.as_slice() {
            [] => format!("  at a friction coefficient of {coefficient} none would slip\n"),
            some => format!(
                "  at a friction coefficient of {coefficient} nodes {} would slip\n",
                some.join(", ")
            ),
        }
    });
    format!(
        "\n4. What friction it takes that the nodes of the converged answer stick\n{}{}",
        table(&head, rows),
        slipping.concat()
    )
}

fn state(cycle: &Option<Cycle>) -> String {
    match cycle {
        None => "new in the last iteration".into(),
        Some(Cycle { length: 1, .. }) => "settled".into(),
        Some(cycle) => format!("cycle of {}", cycle.length),
    }
}

fn table(head: &[&str], rows: impl Iterator<Item = Vec<String>>) -> String {
    let head = head.iter().map(|cell| cell.to_string()).collect();
    aligned(&std::iter::once(head).chain(rows).collect::<Vec<_>>())
}

/// The audit as JSON.
pub fn json(audit: &Audit, scene: &Scene) -> String {
    let findings = audit.findings.iter().map(|(finding, measured)| finding.row(measured));
    let findings: Vec<serde_json::Value> = findings.collect();
    let document = json!({
        "scene": scene.name, "readings": audit.readings, "findings": findings, "variants": audit.variants,
        "converged": audit.reference,
        "sticking": audit.sticking,
    });
    document.to_string() + "\n"
}

/// One finding explained: the listing's lines, the values on `scene`, why it matters, what a repair would be.
pub fn explain(finding: &Finding, measured: &Measured, scene: &Scene) -> String {
    format!(
        "{}: {}\n\nListing\n{}\nOn scene {}: {} ({} {})\n  {}\n\nWhy it matters\n  {}\n\nA repair\n  {}\n",
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

/// The finding's lines as printed.
fn quoted(finding: &Finding) -> String {
    let Some(which) = [Which::CCnt, Which::Km].into_iter().find(|w| w.name() == finding.listing)
    else {
        return "  none: it is in what the paper does around the listings\n".into();
    };
    let printed: Vec<&str> = which.text().lines().filter(|line| !line.starts_with('#')).collect();
    let line = |n: &usize| format!("  {} {n:>2}  {}\n", which.name(), printed[n - 1].trim_start());
    finding.lines.iter().map(line).collect()
}
