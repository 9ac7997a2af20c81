//! What the printed faults cost, for people and for machines.

use schemars::JsonSchema;
use serde::Serialize;

use super::json;
use super::layout::listed;
use super::model::{Cell, Report, Table};
use super::numbers::percent;
use problem::scene::Scene;
use studies::audit::prices::{Outcome, Price};

/// The error below which a fault costs nothing: rounding.
const NOTHING: f64 = 1e-9;

/// The document that `audit --prices --json` prints.
#[derive(Serialize, JsonSchema)]
pub struct Document<'a> {
    /// The corrected algorithm, then a fault a row.
    prices: &'a [Price],
}

/// Returns the prices as JSON.
pub fn json(prices: &[Price], scene: &Scene) -> String {
    json::line(Some(scene), &Document { prices })
}

/// Reports the prices: a row for the corrected algorithm and one for each fault.
pub fn report(prices: &[Price], scene: &Scene) -> Report {
    let share = |price: &Price, k: usize| {
        let shares = shares(&price.outcome);
        shares.map_or(Cell::from("-"), |shares| Cell::decimals(100.0 * rounded(shares[k]), 2))
    };
    let table = Table::from_rows(prices.iter())
        .column("finding", |price| price.finding.unwrap_or("-"))
        .column("fault put back", |price| price.fault.clone())
        .column("ends", |price| ends(&price.outcome))
        .column("in contact", |price| match &price.outcome {
            Outcome::Result { in_contact, .. } => Cell::from(*in_contact),
            Outcome::Failure { .. } => Cell::from("-"),
        })
        .column("transmitted load, %", |price| share(price, 0))
        .column("error in energy, %", |price| share(price, 1))
        .column("error of largest von Mises stress, %", |price| share(price, 2));
    let failures = prices.iter().filter_map(|price| match &price.outcome {
        Outcome::Failure { failure } => {
            Some(format!("{}: {failure}", price.finding.unwrap_or("corrected")))
        }
        Outcome::Result { .. } => None,
    });
    let free: Vec<&str> = prices
        .iter()
        .filter(|price| shares(&price.outcome).is_some_and(|[_, error, _]| error.abs() <= NOTHING))
        .filter_map(|price| price.finding)
        .collect();
    Report::titled(format!("What the printed faults cost on {}", scene.name))
        .line(
            "The corrected algorithm (listings/corrected/), and the same with one printed fault put \
             back. Errors are against the solution without friction, node to segment, in the \
             initial geometry, on the same mesh.",
        )
        .table("Prices", table)
        .notes(failures)
        .line(summary(&prices[0].outcome, &free))
}

/// Says whether the corrected algorithm holds on the scene, and which faults cost nothing.
fn summary(corrected: &Outcome, free: &[&str]) -> String {
    let where_not = "listings/corrected/README.md says where it does not hold";
    match corrected {
        Outcome::Failure { .. } => {
            format!("The corrected algorithm itself stops on this scene ({where_not}).")
        }
        Outcome::Result { is_settled: false, .. } => {
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
        Outcome::Result { iterations, is_settled: true, .. } => format!("after {iterations}"),
        Outcome::Result { iterations, is_settled: false, .. } => {
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
