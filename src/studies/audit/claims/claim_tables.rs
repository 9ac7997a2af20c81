//! The register of claims.

use std::collections::BTreeSet;

use serde::Serialize;

use crate::audit::claims::{Basis, CLAIMS, Claim, Elsewhere, JudgedClaim, UnderReading};
use crate::audit::evidence::MeshError;
use crate::audit::range::Parameter;
use output::layout::listed;
use output::model::{Report, Table};
use output::numbers::{percent, short};
use output::tables::PROBABLY_MORE;
use paper::mirror::{READINGS, Reading};
use problem::scene::Scene;

/// How the estimate of the error of the mesh compares with the error, as golden/tables/mesh_errors.md has it.
pub const ESTIMATES: &str = "Beside a mesh 64 times finer it was below the error in 8 of 10 runs, at the median 0.75 of it \
     (plane-contact guide mesh-errors)";

/// Reports the verdicts.
pub fn report(claims: &[JudgedClaim], by_reading: &[UnderReading]) -> Report {
    let judged = Table::from_rows(claims)
        .column("id", |judged| judged.claim.id.name())
        .column("verdict", |judged| judged.measured.words())
        .column("scope", |judged| judged.scope.to_string())
        .column("certainty", |judged| judged.claim.basis.to_string())
        .column("value", |judged| judged.measured.cell())
        .column("what is judged", |judged| judged.claim.judged);
    let report = Report::default()
        .table(format!("Claims of the paper: {}", counts()), judged)
        .note(
            "The paper's words are translated. What is judged is this audit's wording, and so are the \
             thresholds.",
        )
        .note(format!(
            "A mesh error is {PROBABLY_MORE}, an underestimate where the stress diverges. {ESTIMATES}."
        ));
    let report = if claims.iter().all(|judged| judged.elsewhere.is_empty()) {
        report.note(
            "Measured on runs: of this scene only; audit --range tries other radii, meshes, shapes of \
             the stamp and units of c_tol.",
        )
    } else {
        report
            .note(
                "Over the range of what the paper leaves open, each place on a mesh of `scene mesh strand`; that of the \
                 scene strand is Gmsh's, so figures at its own values differ a little:",
            )
            .then(over_the_range(claims))
    };
    report.then(other_readings(claims, by_reading))
}

/// Reports each claim in full.
pub fn in_full(claims: &[JudgedClaim]) -> Report {
    let entry = |report: Report, judged: &JudgedClaim| {
        let Claim { id, judged: what, .. } = judged.claim;
        let heading = format!("{id}: {what}: {}", judged.measured.verdict);
        report.then(Report::default().heading(heading).deeper(1)).then(entry(judged))
    };
    let heading = "Each claim in full (`audit --claim P12` explains one)";
    claims.iter().fold(Report::default().heading(heading), entry)
}

/// One claim on a scene.
#[derive(Serialize)]
pub struct ClaimOnScene<'a> {
    /// The claim and its verdict.
    #[serde(flatten)]
    pub judged: &'a JudgedClaim,
    /// The verdict where the paper is read otherwise; no claim in it where reading has no part in the
    /// verdict.
    pub by_reading: &'a [UnderReading],
}

/// Reports one claim on a scene.
pub fn explanation(claim: &ClaimOnScene, scene: &Scene, reading: &Reading) -> Report {
    let Claim { id, judged, .. } = claim.judged.claim;
    let report = Report::titled(format!("{id}: {judged}"))
        .line(format!("On scene {} ({}){}", scene.name, scene.title, under(reading)))
        .then(entry(claim.judged));
    let verdicts = claim
        .by_reading
        .iter()
        .flat_map(|under| under.claims.iter().map(|verdict| (&under.reading, &verdict.measured)));
    let verdicts: Vec<_> = verdicts.collect();
    if verdicts.is_empty() {
        return report;
    }
    let table = Table::from_rows(verdicts)
        .column("reading", |(reading, _)| reading.as_str())
        .column("verdict", |(_, measured)| measured.words())
        .column("value", |(_, measured)| measured.cell())
        .column("beside it", |(_, measured)| measured.detail.clone());
    report.table("Under other readings", table)
}

/// Reports for each claim the readings under which its verdict is another one, each with its value; one
/// that makes the verdict true would rescue the claim.
fn other_readings(claims: &[JudgedClaim], by_reading: &[UnderReading]) -> Report {
    let rows = claims.iter().map(|judged| {
        let found = by_reading.iter().filter_map(|UnderReading { reading, claims }| {
            let own = claims.iter().find(|verdict| verdict.id == judged.claim.id)?;
            Some((reading.as_str(), &own.measured))
        });
        (judged, found.collect::<Vec<_>>())
    });
    let table = Table::from_rows(rows)
        .column("claim", |(judged, _)| judged.claim.id.name())
        .column("verdict", |(judged, _)| judged.measured.words())
        .column("readings tried", |(_, found)| found.len())
        .column("another verdict under", |(judged, found)| {
            let others = found.iter().filter(|(_, other)| other.verdict != judged.measured.verdict);
            let words = others.map(|(reading, other)| {
                format!("{reading}: {} ({})", other.words(), other.figure(short))
            });
            words.collect::<Vec<_>>().join("; ")
        });
    let without_run = READINGS.iter().filter(|row| !row.is_option()).map(|row| row.id);
    Report::default().table("Claims by reading", table).note(format!(
        "Tried: each reading that has a run of its own by its other values, and the other variants of the paper \
         as the scene's own; {} have none, see table 1. A blank cell: no reading changes the verdict.",
        listed(without_run)
    ))
}

/// Names a reading that is not the default.
pub fn under(reading: &Reading) -> String {
    if *reading == Reading::default() { String::new() } else { format!(", under {reading}") }
}

/// Reports a claim: its words, what is judged, and what came of it.
fn entry(judged: &JudgedClaim) -> Report {
    let Claim { place, quote, translation, condition, threshold, number, basis, .. } = judged.claim;
    let value = judged.measured.figure(short);
    let errors = &judged.measured.mesh_errors;
    let each = errors.iter().map(|MeshError { run, energy_relative }| {
        format!("{run} {}", energy_relative.map_or("-".into(), percent))
    });
    let errors = (!errors.is_empty()).then(|| {
        format!(
            "mesh error: {}. The verdict is on this mesh: it does not say how far the runs are from the exact solution",
            listed(each)
        )
    });
    let (command, at) = (judged.command.join(" "), judged.at.join(" over "));
    let at = if at.is_empty() { at } else { format!(", at {at}") };
    let printed_by = match basis {
        Basis::Random => Some("measured by a test: plane-contact guide statuses".into()),
        Basis::Nothing => None,
        Basis::Listing | Basis::Runs => Some(format!("printed by: plane-contact {command}{at}")),
    };
    Report::default()
        .note(format!("the paper, {place}: «{quote}»"))
        .note(format!("in English: \"{translation}\""))
        .note(format!("true where: {condition}"))
        .note(format!("threshold: {threshold}"))
        .note(format!("verdict: {}, {basis}; scope: {}", judged.measured.words(), judged.scope))
        .note(format!("value: {value} = {number}"))
        .note(format!("beside it: {}", judged.measured.detail))
        .notes(errors)
        .notes(printed_by)
}

/// Counts the claims, and the sentences of the paper in which they stand.
pub fn counts() -> String {
    let sentences: BTreeSet<&str> = CLAIMS.iter().map(|claim| claim.place).collect();
    format!("{} claims in {} sentences", CLAIMS.len(), sentences.len())
}

/// Reports a line for each claim that was judged over the range, and one for each parameter.
pub fn over_the_range(claims: &[JudgedClaim]) -> Report {
    let judged = claims.iter().filter(|judged| !judged.elsewhere.is_empty());
    judged.fold(Report::default(), |report, judged| {
        let report = report.note(format!("{}: {}", judged.claim.id, judged.claim.judged));
        Parameter::ALL.iter().fold(report, |report, parameter| {
            report.detail(format!("{}: {}", parameter.explained(), over(judged, *parameter)))
        })
    })
}

/// Writes the verdict on a claim at each value of a parameter, with its number.
pub fn over(judged: &JudgedClaim, parameter: Parameter) -> String {
    let places: Vec<&Elsewhere> =
        judged.elsewhere.iter().filter(|other| other.place.parameter == parameter).collect();
    let alike = places.chunk_by(|a, b| a.measured.verdict == b.measured.verdict);
    let words = alike.map(|places| {
        let values = places
            .iter()
            .map(|other| format!("{} ({})", other.place.value, other.measured.figure(short)));
        format!("{} at {}", places[0].measured.words(), listed(values))
    });
    words.collect::<Vec<_>>().join("; ")
}
