//! The register of claims, for people, and as the table of README.md.

use super::layout::{Table, listed};
use super::numbers::{or_dash, short};
use studies::audit::Assumption;
use studies::audit::claims::{Elsewhere, Judged};
use studies::audit::range::Parameter;

/// Lays out the verdicts, what each number is and how to reproduce it, and the assumptions that they
/// rest on.
pub fn text(claims: &[Judged], assumptions: &[Assumption]) -> String {
    let verdicts = Table::of(claims)
        .column("id", |judged| judged.claim.id)
        .column("line", |judged| judged.claim.line)
        .column("verdict", |judged| judged.measured.verdict)
        .column("scope", |judged| judged.scope)
        .column("certainty", |judged| judged.claim.basis)
        .column("value", |judged| or_dash(judged.measured.number, short))
        .column("the paper says that", |judged| judged.claim.says)
        .text();
    let numbers = Table::of(claims.iter().filter(|judged| !judged.claim.at.is_empty()))
        .column("id", |judged| judged.claim.id)
        .column("what the value is", |judged| judged.claim.number)
        .column("printed by", |judged| command(judged))
        .column("JSON pointer", |judged| judged.claim.at.join(" over "))
        .text();
    let range = over_the_range(claims);
    let range = match range.is_empty() {
        true => {
            "  Measured on runs: of this scene only; audit --range tries other radii, meshes, shapes \
             of the stamp and units of c_tol.\n"
                .into()
        }
        false => format!("  Over the range of what the paper leaves open:\n{range}"),
    };
    let assumed = Table::of(assumptions)
        .column("what the paper leaves open", |assumption| assumption.what)
        .column("set to", |assumption| assumption.set_to.clone())
        .text();
    format!("{verdicts}{range}\n{numbers}\n{assumed}")
}

/// Writes the verdicts as a table in Markdown.
pub fn markdown(claims: &[Judged]) -> String {
    let head = "| line | the paper says that | verdict | scope | value | what the value is |\n\
                |---|---|---|---|---|---|\n";
    let row = |judged: &Judged| {
        format!(
            "| {}: {} | {} | {} | {} | {} | {} |\n",
            judged.claim.id,
            judged.claim.line,
            judged.claim.says,
            judged.measured.verdict,
            judged.scope,
            or_dash(judged.measured.number, rounded),
            judged.claim.number
        )
    };
    head.to_string() + &claims.iter().map(row).collect::<String>()
}

/// Writes the verdicts that are not the same over the whole range as rows of a table in Markdown.
pub fn range_markdown(claims: &[Judged]) -> String {
    let changes = claims.iter().filter(|judged| {
        judged.elsewhere.windows(2).any(|w| w[0].measured.verdict != w[1].measured.verdict)
    });
    let rows = changes.flat_map(|judged| {
        let row = |parameter: &Parameter| {
            let (id, meaning) = (judged.claim.id, parameter.meaning());
            format!("| {id} | {meaning} | {} |\n", over(judged, *parameter))
        };
        Parameter::ALL.iter().map(row)
    });
    "| claim | what is varied | verdict at its values, with the value of the claim |\n|---|---|---|\n"
        .to_string()
        + &rows.collect::<String>()
}

/// Writes a number with three digits, and a whole one as it is.
fn rounded(x: f64) -> String {
    if x.fract() == 0.0 { short(x) } else { format!("{x:.3}") }
}

/// Writes, for each claim that was judged over the range, a line a parameter.
pub fn over_the_range(claims: &[Judged]) -> String {
    let judged = claims.iter().filter(|judged| !judged.elsewhere.is_empty());
    let lines = judged.flat_map(|judged| {
        let says = format!("  {}: {}\n", judged.claim.id, judged.claim.says);
        let over = |parameter: &Parameter| {
            format!("    {}: {}\n", parameter.meaning(), over(judged, *parameter))
        };
        [says].into_iter().chain(Parameter::ALL.iter().map(over))
    });
    lines.collect()
}

/// Writes the verdict on a claim at each value of a parameter, with its number.
pub fn over(judged: &Judged, parameter: Parameter) -> String {
    let places: Vec<&Elsewhere> =
        judged.elsewhere.iter().filter(|other| other.place.parameter == parameter).collect();
    let alike = places.chunk_by(|a, b| a.measured.verdict == b.measured.verdict);
    let words = alike.map(|places| {
        let at = places.iter().map(|other| {
            format!("{} ({})", other.place.value, or_dash(other.measured.number, rounded))
        });
        format!("{} at {}", places[0].measured.verdict, listed(at))
    });
    words.collect::<Vec<_>>().join("; ")
}

/// Writes the command that prints a claim's number.
fn command(judged: &Judged) -> String {
    format!("plane-contact {}", judged.claim.command.join(" "))
}
