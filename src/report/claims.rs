//! The register of claims, for people, and as the table of README.md.

use super::layout::{Table, listed};
use super::numbers::{or_dash, short};
use crate::studies::audit::Assumption;
use crate::studies::audit::claims::{Judged, Scope};

/// Lays out the verdicts, what each number is and how to reproduce it, and the assumptions that they
/// rest on.
pub fn text(claims: &[Judged], assumptions: &[Assumption]) -> String {
    let verdicts = Table::of(claims)
        .column("id", |judged| judged.claim.id)
        .column("line", |judged| judged.claim.line)
        .column("verdict", |judged| judged.measured.verdict)
        .column("scope", |judged| judged.scope)
        .column("certainty", |judged| judged.claim.basis)
        .column("number", |judged| or_dash(judged.measured.number, short))
        .column("the paper says that", |judged| judged.claim.says)
        .text();
    let numbers = Table::of(claims.iter().filter(|judged| !judged.claim.at.is_empty()))
        .column("id", |judged| judged.claim.id)
        .column("its number", |judged| judged.claim.number)
        .column("printed by", |judged| command(judged))
        .column("at", |judged| judged.claim.at.join(" over "))
        .text();
    let elsewhere = claims.iter().filter(|judged| !judged.elsewhere.is_empty());
    let range: String =
        elsewhere.map(|judged| format!("  {}: {}\n", judged.claim.id, over(judged))).collect();
    let range = match range.is_empty() {
        true => {
            "  Measured on runs: of this scene only; audit --range tries ducts of other radii.\n"
                .into()
        }
        false => format!("  On ducts of other radii, mm:\n{range}"),
    };
    let assumed = Table::of(assumptions)
        .column("what the paper leaves open", |assumption| assumption.what)
        .column("set to", |assumption| assumption.set_to.clone())
        .text();
    format!("{verdicts}{range}\n{numbers}\n{assumed}")
}

/// Writes the verdicts as a table in Markdown.
pub fn markdown(claims: &[Judged]) -> String {
    let head = "| line | the paper says that | verdict | scope | number | what the number is |\n\
                |---|---|---|---|---|---|\n";
    let row = |judged: &Judged| {
        let scope = match judged.scope {
            Scope::OneScene if !judged.elsewhere.is_empty() => {
                format!("{}; duct of {}", judged.scope, over(judged))
            }
            scope => scope.to_string(),
        };
        format!(
            "| {}: {} | {} | {} | {scope} | {} | {} |\n",
            judged.claim.id,
            judged.claim.line,
            judged.claim.says,
            judged.measured.verdict,
            or_dash(judged.measured.number, rounded),
            judged.claim.number
        )
    };
    head.to_string() + &claims.iter().map(row).collect::<String>()
}

/// Writes a number with three digits, and a whole one as it is.
fn rounded(x: f64) -> String {
    if x.fract() == 0.0 { short(x) } else { format!("{x:.3}") }
}

/// Writes verdict and number on each other duct.
fn over(judged: &Judged) -> String {
    listed(judged.elsewhere.iter().map(|other| {
        let number = or_dash(other.measured.number, rounded);
        format!("{}: {} ({number})", other.duct, other.measured.verdict)
    }))
}

/// Writes the command that prints a claim's number.
fn command(judged: &Judged) -> String {
    format!("plane-contact {}", judged.claim.command.join(" "))
}
