//! The status rules measured, for people, for machines and as a picture.

use super::json;
use super::model::{Cell, Report, Table};
use super::picture::{Axis, Series, Style, chart};
use problem::modelling::StatusRule;
use studies::audit::statuses::{Measurement, Row};

/// Returns the measurement as JSON.
pub fn json(measured: &Measurement) -> String {
    json::line(None, measured)
}

/// Reports two tables: the wrong statuses by depth, and the operations by size.
pub fn report(measured: &Measurement) -> Report {
    Report::titled(format!(
        "Status rules on random scenes ({} a row, seed {})",
        measured.scenes, measured.seed
    ))
    .table("1. Wrong statuses, missed + false, by depth of the jump", wrong(&measured.by_depth))
    .table(
        "2. Operations of one call for each contact node, by size",
        operations(&measured.by_size),
    )
}

/// Draws the share of wrong statuses by depth: a curve for each rule and side of the target.
pub fn picture(measured: &Measurement) -> String {
    let curves = StatusRule::ALL.iter().enumerate().flat_map(|(k, rule)| {
        ["below", "above"].map(|target| {
            let rows = measured.by_depth.iter().filter(|row| row.target == target);
            let point = |row: &Row| [row.depth, 100.0 * row.rules[k].wrong_share(row.nodes)];
            let name = format!("{rule}, target {target}");
            Series { name, points: rows.map(point).collect(), style: Style::Dotted }
        })
    });
    let x = Axis { label: "depth of the jump / c_tll", logarithmic: true };
    let y = Axis { label: "contact nodes with a wrong status, %", logarithmic: false };
    chart("Wrong statuses by depth of the jump", [x, y], &curves.collect::<Vec<_>>(), &[])
}

fn wrong(rows: &[Row]) -> Table<Vec<&Row>> {
    let table = Table::from_rows(rows)
        .column("depth / c_tll", |row| Cell::plain(row.depth))
        .column("target", |row| row.target)
        .column("nodes", |row| row.nodes)
        .column("in contact", |row| row.touching);
    StatusRule::ALL.iter().enumerate().fold(table, |table, (k, rule)| {
        table
            .column(rule, |row| {
                format!("{} + {}", row.rules[k].missed, row.rules[k].false_contacts)
            })
            .column("%", |row| Cell::decimals(100.0 * row.rules[k].wrong_share(row.nodes), 1))
    })
}

fn operations(rows: &[Row]) -> Table<Vec<&Row>> {
    let table = Table::from_rows(rows)
        .column("target edges", |row| row.edges)
        .column("nodes", |row| row.nodes);
    StatusRule::ALL.iter().enumerate().fold(table, |table, (k, rule)| {
        table.column(rule, |row| {
            Cell::decimals(row.rules[k].operations as f64 / row.nodes.max(1) as f64, 1)
        })
    })
}
