//! What the printed faults cost, for people and for machines.

use serde::Serialize;

use crate::audit::claims::claim_tables::under;
use crate::audit::evidence::{NoFigures, Outcome};
use crate::audit::prices::{CorrectedRun, NOTHING, Price, Weight, needed};
use output::layout::{counted, first_line, listed};
use output::model::{Cell, Report, Table};
use output::numbers::percent;
use output::picture::{Axis, Series, Style, chart};
use paper::mirror::Reading;
use problem::scene::Scene;

/// How the order of repairs is found, in words.
pub const ORDER: &str = "The order is found from the end: \
    into the corrected algorithm the faults are reintroduced one at a time, each time the one that \
    leaves the least error. The last to be reintroduced is the first to be repaired.";

/// Why a finding and its price may differ.
pub const AND_FINDINGS: &str = "A finding is present, or not triggered, on the shapes that the print itself comes \
    to. Its price is that of the fault in the corrected algorithm, which comes to other shapes: so a finding \
    that is not triggered may cost something, and one that is present nothing.";

/// The document that `audit --prices --json` prints.
#[derive(Serialize)]
pub struct PricesOnScene<'a> {
    /// The reading, of which only what changes the model matters.
    pub reading: Reading,
    /// The corrected algorithm, then a fault reintroduced a row.
    pub prices: &'a [Price],
    /// The corrected algorithm with all faults reintroduced, then a repair a row, with those above it; empty
    /// where that was not asked for.
    pub repairs: &'a [Price],
}

/// Reports the prices within an audit, and the way of repairs with its picture where that was asked for.
pub fn section(
    reading: Reading,
    prices: &Outcome<Vec<Price>>,
    repairs: &[Price],
    scene: &Scene,
) -> Report {
    let report = match prices {
        Ok(prices) => report(&PricesOnScene { reading, prices, repairs }, scene).deeper(1),
        Err(why) => {
            Report::default().heading("What the printed faults cost").line(not_measured(why))
        }
    };
    match repairs {
        [] => report,
        repairs => report.figure("Error by the number of repairs", picture(repairs)),
    }
}

/// Reports the prices: a row for the corrected algorithm and one for each fault; then, where they were
/// asked for, a row for the print and one for each repair.
pub fn report(document: &PricesOnScene, scene: &Scene) -> Report {
    let PricesOnScene { reading, prices, repairs } = document;
    let faults = Table::from_rows(prices.iter())
        .column("finding", |price| price.name.as_deref().unwrap_or("-"))
        .column("fault reintroduced", |price| price.fault.clone());
    let repaired = || {
        Table::from_rows(repairs.iter().enumerate())
            .column("repairs", |(k, _)| Cell::from(*k))
            .column("finding repaired", |(_, price)| price.name.as_deref().unwrap_or("-"))
            .column("its fault", |(_, price)| price.fault.clone())
    };
    let failures = prices.iter().filter_map(|price| match &price.outcome {
        Err(NoFigures::Fails(why)) => {
            Some(format!("{}: {why}", price.name.as_deref().unwrap_or("corrected")))
        }
        Ok(_) | Err(NoFigures::Refused(_) | NoFigures::Rounding) => None,
    });
    let report = Report::titled(format!(
        "What the printed faults cost on {}{}",
        scene.name,
        under(reading)
    ))
    .line(
        "The corrected algorithm (plane-contact guide corrected), and the same with one printed fault reintroduced. It has \
         no friction, and is compared with two solutions on the same mesh: the one that it has itself \
         (without friction, node to segment, in the initial geometry), and the equilibrium under the scene's \
         own friction.",
    )
    .table("Each fault alone", outcomes(faults, |price| price))
    .note(
        "C1 and C2 bring the box of C9 with them. C4 and C5 are lines 17 and 18 of c_cnt without line 16, which is \
         K9 (release).",
    )
    .note(AND_FINDINGS)
    .notes(failures)
    .notes(unsound(prices).map_or_else(|| without_cost(prices), |why| vec![why]));
    if repairs.is_empty() {
        return report.line(format!(
            "audit {} --prices --repairs repairs the print one finding at a time.",
            scene.word
        ));
    }
    report
        .table("From the print, repair by repair", outcomes(repaired(), |(_, price)| *price))
        .line(ORDER)
        .line(way(repairs))
}

/// Adds the columns of what came of a run.
fn outcomes<R>(table: Table<Vec<R>>, price: impl Fn(&R) -> &Price + Copy) -> Table<Vec<R>> {
    let cell = move |row: &R, of: fn(&CorrectedRun) -> Option<Cell>| {
        price(row).outcome.as_ref().ok().and_then(of).unwrap_or("-".into())
    };
    table
        .column("ends", move |row| ends(&price(row).outcome))
        .column("in contact", move |row| cell(row, |run| Some(run.in_contact.into())))
        .column("transmitted load, %", move |row| cell(row, |run| Some(share(run.transmitted))))
        .column("error in energy, %", move |row| cell(row, |run| Some(share(run.energy_relative))))
        .column("error of largest von Mises stress, %", move |row| {
            cell(row, |run| Some(share(run.von_mises_relative)))
        })
        .column("from the equilibrium, %", move |row| {
            cell(row, |run| run.equilibrium_relative.map(share))
        })
}

/// Says how many repairs the way from the print takes, and which are not needed.
fn way(repairs: &[Price]) -> String {
    let Some(needed) = needed(repairs) else {
        return "The repairs do not lead to the solution on this scene.".into();
    };
    let others = not_needed(&repairs[needed + 1..]);
    let needed = counted(needed, "repair", "repairs");
    format!("The solution is reached after {needed}. {others}")
}

/// Names the repairs behind those that lead to the solution.
fn not_needed(repairs: &[Price]) -> String {
    let others: Vec<&str> = repairs.iter().filter_map(|price| price.name.as_deref()).collect();
    match &others[..] {
        [] => "All are needed.".into(),
        others => format!("Not needed here: {}.", listed(others)),
    }
}

/// Draws the error in energy against the number of repairs.
pub fn picture(repairs: &[Price]) -> String {
    let points = repairs.iter().enumerate().map(|(k, price)| [k as f64, 100.0 * price.error()]);
    let points = points.filter(|[_, error]| error.is_finite() && *error > 0.0).collect();
    let name = "error".to_string();
    let x = Axis { label: "repairs", logarithmic: false };
    let y = Axis { label: "error in energy, %", logarithmic: true };
    let named = repairs
        .iter()
        .enumerate()
        .skip(1)
        .map(|(k, price)| format!("{k} {}", price.name.as_deref().unwrap_or("-")));
    let caption = format!("Repairs, in this order: {}. {}", listed(named), way(repairs));
    let series = Series { name, points, style: Style::Dotted };
    chart("From the print to the solution, repair by repair", [x, y], &[series], &[caption])
}

/// Says what each fault costs that costs something, the dearest first.
///
/// # Errors
/// That is not known: says why.
pub fn by_cost(prices: &Outcome<Vec<Price>>) -> Result<Vec<String>, String> {
    let prices = prices.as_ref().map_err(not_measured)?;
    if let Some(why) = unsound(prices) {
        return Err(why);
    }
    let of = |weight| prices.iter().filter(move |price| price.weight == weight);
    let mut shifts: Vec<&Price> = of(Weight::Shifts).collect();
    shifts.sort_by(|a, b| b.error().total_cmp(&a.error()));
    let dear = of(Weight::Fatal).chain(shifts).chain(of(Weight::Rounding)).map(|price| {
        let error = percent(price.error());
        let cost = match price.weight {
            Weight::Shifts if price.outcome.as_ref().is_ok_and(CorrectedRun::is_settled) => error,
            Weight::Shifts => format!("{error}, does not settle"),
            weight => weight.to_string(),
        };
        format!("{cost}: {} ({})", price.fault, price.name.as_deref().unwrap_or("-"))
    });
    Ok(dear.collect())
}

/// Names the faults without effect, and those that are none here.
fn without_cost(prices: &[Price]) -> Vec<String> {
    let rows = [(Weight::Free, ""), (Weight::NoFault, ", as nothing slides")];
    let rows = rows.map(|(weight, why)| (listed(of_weight(prices, weight)), why));
    let rows = rows.into_iter().filter(|(names, _)| !names.is_empty());
    rows.map(|(names, why)| format!("no effect: {names}{why}")).collect()
}

fn not_measured(why: &NoFigures) -> String {
    format!("Not measured here: {}", first_line(&why.to_string()))
}

/// Says why no fault is priced: the corrected algorithm itself is not at the solution, or passes no load on, so
/// that none can be lost. Nothing where the prices are the costs of the faults alone.
pub fn unsound(prices: &[Price]) -> Option<String> {
    let itself = |why: &str| {
        let where_not = "plane-contact guide corrected says where it does not hold";
        format!("The corrected algorithm itself {why} on this scene ({where_not})")
    };
    let why = match &prices[0].outcome {
        Err(NoFigures::Fails(_)) => itself("stops"),
        Err(NoFigures::Rounding) => itself("is decided by rounding"),
        Err(NoFigures::Refused(_)) => return None,
        Ok(run) if run.passes_nothing => {
            "Under the corrected algorithm too no load passes between the bodies".into()
        }
        Ok(run) if !run.energy_relative.is_finite() => {
            "Nothing moves in the solution of this scene".into()
        }
        Ok(run) if !run.is_settled() => itself("does not settle"),
        Ok(run) if run.error() > 0.0 => {
            itself(&format!("is {} from the solution", percent(run.error())))
        }
        Ok(_) => return None,
    };
    Some(format!("{why}: no fault is priced."))
}

/// Returns the names of the faults that have a weight.
pub fn of_weight(prices: &[Price], weight: Weight) -> Vec<&str> {
    let own = prices.iter().filter(|price| price.weight == weight);
    own.filter_map(|price| price.name.as_deref()).collect()
}

/// Says how a run ended.
fn ends(outcome: &Outcome<CorrectedRun>) -> String {
    match outcome {
        Ok(CorrectedRun { iterations, period: Some(1), .. }) => format!("after {iterations}"),
        Ok(CorrectedRun { period: Some(period), .. }) => {
            format!("alternates among {period} contact states")
        }
        Ok(CorrectedRun { iterations, period: None, .. }) => {
            format!("not settled after {iterations}")
        }
        Err(NoFigures::Fails(_)) => "stops".into(),
        Err(why @ (NoFigures::Refused(_) | NoFigures::Rounding)) => why.to_string(),
    }
}

/// Writes a share in per cent, 0 where it is rounding.
fn share(x: f64) -> Cell {
    Cell::decimals(100.0 * if x.abs() <= NOTHING { 0.0 } else { x }, 2)
}
