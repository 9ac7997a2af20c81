//! The tables that an audit rests on, its JSON, and what explains a finding.

use serde::{Serialize, Serializer};

use crate::audit::claims::claim_tables as claims;
use crate::audit::evidence::{BY_ROUNDING, NoFigures};
use crate::audit::findings::{Evidence, Finding, Repair};
use crate::audit::prices::price_tables as prices;
use crate::audit::readings::Effect;
use crate::audit::variants::{VariantRow, VariantRun};
use crate::audit::{Audit, EquilibriumRow, words};
use engine::Cycle;
use output::layout::listed;
use output::model::{Cell, Report, Table};
use output::numbers::short;
use output::tables::perturbed;
use paper::listings::Which;
use paper::mirror::Reading;
use problem::modelling::Variant;
use problem::scene::Scene;

/// Reports what the verdict and the claims rest on: readings, findings, variants.
pub fn evidence(audit: &Audit) -> Report {
    Report::default()
        .heading("Readings, findings and variants")
        .then(readings(&audit.readings))
        .table("2. Findings (`audit --finding C4` explains one)", findings(&audit.findings))
        .note(prices::AND_FINDINGS)
        .then(variants(audit))
}

/// Reports the readings; why one fails stands under the table, each reason once.
fn readings(effects: &[Effect]) -> Report {
    let mut failures: Vec<&NoFigures> = Vec::new();
    for why in effects.iter().filter_map(|effect| effect.failure.as_ref()) {
        if *why != NoFigures::Rounding && !failures.contains(&why) {
            failures.push(why);
        }
    }
    let remark = |effect: &&Effect| match &effect.failure {
        Some(NoFigures::Rounding) => format!("{}: {BY_ROUNDING}", effect.of),
        Some(why) => {
            let place = failures.iter().position(|known| *known == why).expect("it was collected");
            format!("{}: fails ({})", effect.of, place + 1)
        }
        None if effect.changes() => effect.of.clone(),
        None => format!("{}: nothing depends on it", effect.of),
    };
    let table = Table::from_rows(effects)
        .column("id", |effect| effect.id)
        .column("reading", |effect| effect.reading.clone())
        .column("lines", |effect| effect.lines)
        .column("dy changed", |effect| effect.statuses)
        .column("MJS entries changed", |effect| effect.entries)
        .column("largest difference", |effect| effect.displacement)
        .column("error in energy norm", |effect| effect.equilibrium_error.map(Cell::percent))
        .column("of what", remark);
    Report::default()
        .table(
            "1. Readings: what the other reading changes, at the initial shape and at the end",
            table,
        )
        .note("error in energy norm: from the equilibrium; under R6 from that of its own plane problem")
        .notes(failures.iter().zip(1..).map(|(why, k)| format!("({k}) {}", why.in_short())))
}

fn findings<'a>(findings: &'a [(&Finding, Evidence)]) -> Table<Vec<&'a (&'a Finding, Evidence)>> {
    Table::from_rows(findings)
        .column("id", |(finding, _)| finding.id.name())
        .column("line", |(finding, _)| match finding.listing {
            None => "-".into(),
            Some(which) => format!("{which} {}", listed(finding.lines)),
        })
        .column("verdict", |(_, measured)| measured.verdict.name())
        .column("value", |(_, measured)| measured.cell())
        .column("what the value is", |(finding, _)| finding.number)
        .column("what the listing does that the text does not say", |(finding, _)| finding.title)
}

/// Reports the variants side by side, and the two solutions without the print's
/// mistakes, of which the first is what the errors of the variants are against.
fn variants(audit: &Audit) -> Report {
    let columns = words::columns(&audit.scene).into_iter();
    let more = ["contact state", "eq. (1) left", "error in u", "friction needed", "nodes pulling"];
    let table = Table::new(
        columns.chain(more.map(String::from)),
        audit.variants.iter().map(|row| [words::variant(row), beside(row)].concat()),
    );
    let report = Report::default().table("3. Variants side by side", table).notes(&audit.unsolved);
    if audit.conclusion.coupled.is_none() {
        return report;
    }
    report
        .note(
            "error in u: largest difference of a node's displacement over the largest displacement; in \
             energy norm: that of the difference over that of the whole",
        )
        .then(solution_without_mistakes(
            "error: against the equilibrium under the scene's own friction",
            audit.equilibrium.as_ref(),
        ))
        .then(solution_without_mistakes("the reference solution", audit.reference.as_ref()))
}

/// Returns the cells of a variant behind those of every table of runs; none of one that failed.
fn beside(row: &VariantRow) -> Vec<Cell> {
    let Ok(VariantRun {
        transmits_nothing,
        eq1_residual,
        cycle,
        distance,
        friction_needed,
        pulling,
        ..
    }) = &row.outcome
    else {
        return Vec::new();
    };
    let state = match (row.variant, cycle) {
        (Variant::Unilateral, _) => "in equilibrium".to_string(),
        (_, None) => "new in the last iteration".into(),
        (_, Some(Cycle { length: 1, .. })) => "settled".into(),
        (_, Some(cycle)) => format!("does not settle, cycle of {}", cycle.length),
    };
    let nothing = if *transmits_nothing { ", nothing transmitted" } else { "" };
    vec![
        (state + nothing).into(),
        (*eq1_residual).into(),
        distance.as_ref().map(|from| Cell::percent(from.displacement_relative)).into(),
        (*friction_needed).into(),
        pulling.len().into(),
    ]
}

/// Reports a solution that others are compared with, and what rounding does to it.
fn solution_without_mistakes(what: &str, other: Option<&EquilibriumRow>) -> Report {
    let Some(EquilibriumRow { model, in_contact, bodies, overlap, mesh_error, rounding, .. }) =
        other
    else {
        return Report::default().note(format!("{what}: there is none"));
    };
    Report::default()
        .note(format!(
            "{what} (unilateral, {}, friction {}, {} geometry): {in_contact} in contact, largest von Mises \
             stress {}",
            model.coupling,
            model.friction,
            model.geometry,
            words::stresses(bodies, *mesh_error)
        ))
        .details(overlap)
        .details(rounding.iter().flat_map(perturbed))
}

/// A finding on a scene.
#[derive(Serialize)]
pub struct FindingRow<'a> {
    /// The finding.
    #[serde(flatten)]
    pub finding: &'a Finding,
    /// What the scene shows of it.
    #[serde(flatten)]
    pub measured: &'a Evidence,
}

/// Writes the findings of an audit, a row each.
pub(super) fn rows<S: Serializer>(
    findings: &[(&'static Finding, Evidence)],
    serializer: S,
) -> Result<S::Ok, S::Error> {
    serializer
        .collect_seq(findings.iter().map(|(finding, measured)| FindingRow { finding, measured }))
}

/// Writes the name of a finding's listing, `-` for none.
pub(super) fn name_of_listing<S: Serializer>(
    listing: &Option<Which>,
    serializer: S,
) -> Result<S::Ok, S::Error> {
    serializer.serialize_str(listing.map_or("-", Which::name))
}

/// Writes the name of a scene.
pub(super) fn name<S: Serializer>(scene: &Scene, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_str(&scene.name)
}

/// Explains a finding: its lines, the values on `scene`, why it matters, what a repair would be.
pub fn explanation(
    finding: &Finding,
    measured: &Evidence,
    scene: &Scene,
    reading: &Reading,
) -> Report {
    let value = measured.figure(short);
    let quotation = match finding.listing {
        None => Report::default().note("none: it is in what the paper does around the listings"),
        Some(which) => {
            let lines = which.text().lines().filter(|line| !line.starts_with('#'));
            let printed: Vec<&str> = lines.map(str::trim_start).collect();
            let line = |n: &usize| format!("{} {n:>2}  {}\n", which.name(), printed[n - 1]);
            Report::default().code(finding.lines.iter().map(line).collect::<String>())
        }
    };
    let repair = match &finding.edit {
        Repair::Edit { text } => {
            let lines = text.lines().filter(|line| !line.starts_with('#'));
            let lines: String = lines.map(|line| format!("{line}\n")).collect();
            let order = "In the order of execution, under the numbers of the printed lines that are replaced:";
            Report::default()
                .heading("The repair as an edit of the listing")
                .line(order)
                .code(lines)
        }
        Repair::None { reason } => {
            Report::default().heading("No edit of a listing repairs it").note(*reason)
        }
    };
    Report::titled(format!("{}: {}", finding.id, finding.title))
        .heading("Listing")
        .then(quotation)
        .heading(format!(
            "On scene {}{}: {} ({value}: {})",
            scene.name,
            claims::under(reading),
            measured.verdict.name(),
            finding.number
        ))
        .note(&measured.detail)
        .heading("Why it matters")
        .note(finding.why)
        .heading("A repair")
        .note(finding.repair)
        .then(repair)
}
