//! The register of claims.

use super::layout::listed;
use super::model::{Report, Table};
use super::numbers::{or_dash, short};
use studies::audit::Assumption;
use studies::audit::claims::{Elsewhere, JudgedClaim};
use studies::audit::range::Parameter;

/// Reports the verdicts, what each value is and how to reproduce it, and the assumptions that they
/// rest on.
pub fn report(claims: &[JudgedClaim], assumptions: &[Assumption]) -> Report {
    let judged = Table::from_rows(claims)
        .column("id", |judged| judged.claim.id)
        .column("line", |judged| judged.claim.line)
        .column("verdict", |judged| judged.measured.words())
        .column("scope", |judged| judged.scope.to_string())
        .column("certainty", |judged| judged.claim.basis.to_string())
        .column("value", |judged| judged.measured.number)
        .column("the paper says that", |judged| judged.claim.says);
    let values = Table::from_rows(claims.iter().filter(|judged| !judged.claim.at.is_empty()))
        .column("id", |judged| judged.claim.id)
        .column("what the value is", |judged| judged.claim.number)
        .column("printed by", |judged| format!("plane-contact {}", judged.claim.command.join(" ")))
        .column("JSON pointer", |judged| judged.claim.at.join(" over "));
    let assumptions = Table::from_rows(assumptions)
        .column("what the paper leaves open", |assumption| assumption.what)
        .column("set to", |assumption| assumption.set_to.clone());
    let report = Report::default().table("Claims of the paper, and what they assume", judged);
    let report = if claims.iter().all(|judged| judged.elsewhere.is_empty()) {
        report.note(
            "Measured on runs: of this scene only; audit --range tries other radii, meshes, shapes of \
             the stamp and units of c_tol.",
        )
    } else {
        report.note("Over the range of what the paper leaves open:").then(over_the_range(claims))
    };
    report.table("Values of the claims", values).table("Assumptions", assumptions)
}

/// Returns the verdicts with their values.
pub fn verdicts(claims: &[JudgedClaim]) -> Table<Vec<&JudgedClaim>> {
    Table::from_rows(claims)
        .column("line", |judged| format!("{}: {}", judged.claim.id, judged.claim.line))
        .column("the paper says that", |judged| judged.claim.says)
        .column("verdict", |judged| judged.measured.words())
        .column("scope", |judged| judged.scope.to_string())
        .column("value", |judged| or_dash(judged.measured.number, rounded))
        .column("what the value is", |judged| judged.claim.number)
}

/// Returns the verdicts that are not the same over the whole range.
pub fn range(claims: &[JudgedClaim]) -> Table<Vec<(&JudgedClaim, Parameter)>> {
    let changes = claims.iter().filter(|judged| {
        judged.elsewhere.windows(2).any(|w| w[0].measured.verdict != w[1].measured.verdict)
    });
    Table::from_rows(changes.flat_map(|judged| Parameter::ALL.iter().map(move |p| (judged, *p))))
        .column("claim", |(judged, _)| judged.claim.id)
        .column("what is varied", |(_, parameter)| parameter.meaning())
        .column("verdict at its values, with the value of the claim", |(judged, parameter)| {
            over(judged, *parameter)
        })
}

/// Writes a number with three digits, and a whole one as it is.
fn rounded(x: f64) -> String {
    if x.fract() == 0.0 { short(x) } else { format!("{x:.3}") }
}

/// Reports a line for each claim that was judged over the range, and one for each parameter.
pub fn over_the_range(claims: &[JudgedClaim]) -> Report {
    let judged = claims.iter().filter(|judged| !judged.elsewhere.is_empty());
    judged.fold(Report::default(), |report, judged| {
        let report = report.note(format!("{}: {}", judged.claim.id, judged.claim.says));
        Parameter::ALL.iter().fold(report, |report, parameter| {
            report.detail(format!("{}: {}", parameter.meaning(), over(judged, *parameter)))
        })
    })
}

/// Writes the verdict on a claim at each value of a parameter, with its number.
pub fn over(judged: &JudgedClaim, parameter: Parameter) -> String {
    let places: Vec<&Elsewhere> =
        judged.elsewhere.iter().filter(|other| other.place.parameter == parameter).collect();
    let alike = places.chunk_by(|a, b| a.measured.verdict == b.measured.verdict);
    let words = alike.map(|places| {
        let values = places.iter().map(|other| {
            format!("{} ({})", other.place.value, or_dash(other.measured.number, rounded))
        });
        format!("{} at {}", places[0].measured.words(), listed(values))
    });
    words.collect::<Vec<_>>().join("; ")
}
