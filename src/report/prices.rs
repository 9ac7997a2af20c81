//! What the printed faults cost, for people and for machines.

use schemars::JsonSchema;
use serde::Serialize;

use super::json;
use super::layout::{counted, listed};
use super::model::{Cell, Report, Table};
use super::numbers::percent;
use super::picture::{Axis, Series, Style, chart};
use problem::scene::Scene;
use studies::audit::prices::{NOTHING, Outcome, Price};

/// The document that `audit --prices --json` prints.
#[derive(Serialize, JsonSchema)]
pub struct Document<'a> {
    /// The corrected algorithm, then a fault put back a row.
    pub prices: &'a [Price],
    /// The corrected algorithm with all faults put back, then a repair a row, with those above it; empty
    /// where that was not asked for.
    pub repairs: &'a [Price],
}

/// Returns the prices as JSON.
pub fn json(document: &Document, scene: &Scene) -> String {
    json::line(Some(scene), document)
}

/// Reports the prices: a row for the corrected algorithm and one for each fault; then, where they were
/// asked for, a row for the print and one for each repair.
pub fn report(document: &Document, scene: &Scene) -> Report {
    let Document { prices, repairs } = document;
    let faults = Table::from_rows(prices.iter())
        .column("finding", |price| price.finding.unwrap_or("-"))
        .column("fault put back", |price| price.fault.clone());
    let repaired = || {
        Table::from_rows(repairs.iter().enumerate())
            .column("repairs", |(k, _)| Cell::from(*k))
            .column("finding repaired", |(_, price)| price.finding.unwrap_or("-"))
            .column("its fault", |(_, price)| price.fault.clone())
    };
    let failures = prices.iter().filter_map(|price| match &price.outcome {
        Outcome::Failure { failure } => {
            Some(format!("{}: {failure}", price.finding.unwrap_or("corrected")))
        }
        Outcome::Result { .. } => None,
    });
    let free = prices.iter().filter(|price| price.outcome.error() == 0.0);
    let free: Vec<&str> = free.filter_map(|price| price.finding).collect();
    let report = Report::titled(format!("What the printed faults cost on {}", scene.name))
        .line(
            "The corrected algorithm (listings/corrected/), and the same with one printed fault put \
             back. Errors are against the solution without friction, node to segment, in the \
             initial geometry, on the same mesh.",
        )
        .table("1. Each fault alone", outcomes(faults, |price| &price.outcome))
        .notes(failures)
        .line(summary(&prices[0].outcome, &free));
    if repairs.is_empty() {
        return report.line(format!(
            "audit {} --prices --repairs repairs the print one finding at a time.",
            scene.name
        ));
    }
    report
        .table(
            "2. From the print, repair by repair",
            outcomes(repaired(), |(_, price)| &price.outcome),
        )
        .line(
            "The order is found from the end: into the corrected algorithm the faults are put back one at \
             a time, each time the one that leaves the least error. The last to be put back is the first \
             to be repaired.",
        )
        .line(way(repairs))
}

/// Adds the columns of what came of a run.
fn outcomes<R>(table: Table<Vec<R>>, outcome: impl Fn(&R) -> &Outcome + Copy) -> Table<Vec<R>> {
    let share = move |row: &R, k: usize| {
        let shares = shares(outcome(row));
        shares.map_or(Cell::from("-"), |shares| Cell::decimals(100.0 * rounded(shares[k]), 2))
    };
    table
        .column("ends", move |row| ends(outcome(row)))
        .column("in contact", move |row| match outcome(row) {
            Outcome::Result { in_contact, .. } => Cell::from(*in_contact),
            Outcome::Failure { .. } => Cell::from("-"),
        })
        .column("transmitted load, %", move |row| share(row, 0))
        .column("error in energy, %", move |row| share(row, 1))
        .column("error of largest von Mises stress, %", move |row| share(row, 2))
}

/// Says how many repairs the way from the print takes, and which are not needed.
fn way(repairs: &[Price]) -> String {
    let needed = repairs.iter().rposition(|price| price.outcome.error() != 0.0);
    let needed = needed.map_or(0, |k| k + 1);
    if needed == repairs.len() {
        return "The repairs do not lead to the solution on this scene.".into();
    }
    let others: Vec<&str> =
        repairs[needed + 1..].iter().filter_map(|price| price.finding).collect();
    let others = match &others[..] {
        [] => "All are needed.".into(),
        others => format!("Not needed here: {}.", listed(others)),
    };
    let needed = counted(needed, "repair", "repairs");
    format!("The solution is reached after {needed}. {others}")
}

/// Draws the error in energy against the number of repairs.
pub fn picture(repairs: &[Price]) -> String {
    let points =
        repairs.iter().enumerate().map(|(k, price)| [k as f64, 100.0 * price.outcome.error()]);
    let points = points.filter(|[_, error]| error.is_finite() && *error > 0.0).collect();
    let name = "error".to_string();
    let x = Axis { label: "repairs", logarithmic: false };
    let y = Axis { label: "error in energy, %", logarithmic: true };
    let named = repairs
        .iter()
        .enumerate()
        .skip(1)
        .map(|(k, price)| format!("{k} {}", price.finding.unwrap_or("-")));
    let caption = format!("Repairs, in this order: {}. {}", listed(named), way(repairs));
    let series = Series { name, points, style: Style::Dotted };
    chart("From the print to the solution, repair by repair", [x, y], &[series], &[caption])
}

/// Says whether the corrected algorithm holds on the scene, and which faults cost nothing.
fn summary(corrected: &Outcome, free: &[&str]) -> String {
    let where_not = "listings/corrected/README.md says where it does not hold";
    match corrected {
        Outcome::Failure { .. } => {
            format!("The corrected algorithm itself stops on this scene ({where_not}).")
        }
        Outcome::Result { period: None | Some(2..), .. } => {
            format!("The corrected algorithm itself does not settle on this scene ({where_not}).")
        }
        Outcome::Result { energy_relative, .. } if *energy_relative > NOTHING => format!(
            "The corrected algorithm itself is {} from the solution on this scene ({where_not}): no \
             row is the cost of a fault alone.",
            percent(*energy_relative, 1)
        ),
        Outcome::Result { .. } if free.is_empty() => {
            "Every fault costs something on this scene.".into()
        }
        Outcome::Result { .. } => format!("Without effect on this scene: {}.", listed(free)),
    }
}

/// Says how a run ended.
fn ends(outcome: &Outcome) -> String {
    match outcome {
        Outcome::Result { iterations, period: Some(1), .. } => format!("after {iterations}"),
        Outcome::Result { period: Some(period), .. } => {
            format!("alternates among {period} contact states")
        }
        Outcome::Result { iterations, period: None, .. } => {
            format!("not settled after {iterations}")
        }
        Outcome::Failure { .. } => "stops".into(),
    }
}

/// Returns the transmitted load, the error in energy and that of the von Mises stress, relative.
fn shares(outcome: &Outcome) -> Option<[f64; 3]> {
    match outcome {
        Outcome::Result { transmitted, energy_relative, von_mises_relative, .. } => {
            Some([*transmitted, *energy_relative, *von_mises_relative])
        }
        Outcome::Failure { .. } => None,
    }
}

/// Returns a share, 0 where it is rounding.
fn rounded(x: f64) -> f64 {
    if x.abs() <= NOTHING { 0.0 } else { x }
}
