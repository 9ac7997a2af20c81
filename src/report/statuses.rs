//! The status rules measured, for people, for machines and as a picture.

use super::json::headed;
use super::layout::aligned;
use super::picture::{Axis, Series, Style, chart};
use problem::modelling::StatusRule;
use studies::audit::statuses::{Measurement, Row};

/// Lays out two tables: the wrong statuses by depth, and the operations by size.
pub fn json(measured: &Measurement) -> String {
    headed(measured)
}

pub fn text(measured: &Measurement) -> String {
    format!(
        "Status rules on random scenes ({} a row, seed {})\n\n\
         1. Wrong statuses, missed + false, by depth of the jump\n{}\n\
         2. Operations of one call for each contact node, by size\n{}",
        measured.scenes,
        measured.seed,
        wrong(&measured.by_depth),
        operations(&measured.by_size)
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

fn wrong(rows: &[Row]) -> String {
    let start = ["depth / c_tll", "target", "nodes", "in contact"].map(String::from);
    let rules = StatusRule::ALL.iter().flat_map(|rule| [rule.to_string(), "%".into()]);
    let rows = rows.iter().map(|row| {
        let [nodes, touching] = [row.nodes, row.touching].map(|count| count.to_string());
        let start = [row.depth.to_string(), row.target.into(), nodes, touching];
        let scores = row.rules.iter().flat_map(|score| {
            let share = 100.0 * score.wrong_share(row.nodes);
            [format!("{} + {}", score.missed, score.false_contacts), format!("{share:.1}")]
        });
        start.into_iter().chain(scores).collect()
    });
    aligned(start.into_iter().chain(rules), rows)
}

fn operations(rows: &[Row]) -> String {
    let start = ["target edges", "nodes"].map(String::from);
    let rows = rows.iter().map(|row| {
        let each = |operations: u64| format!("{:.1}", operations as f64 / row.nodes.max(1) as f64);
        let scores = row.rules.iter().map(|score| each(score.operations));
        [row.edges, row.nodes].map(|count| count.to_string()).into_iter().chain(scores).collect()
    });
    aligned(start.into_iter().chain(StatusRule::ALL.iter().map(StatusRule::to_string)), rows)
}
