//! The status rules measured, for people and for machines.

use super::picture::{Axis, Series, Style, chart};
use super::tables::aligned;
use crate::problem::modelling::StatusRule;
use crate::studies::audit::statuses::{Measurement, Row};

/// Two tables: wrong statuses by depth, operations by size.
pub fn text(measured: &Measurement) -> String {
    format!(
        "Status rules on random scenes ({} a row, seed {})\n\n1. Wrong statuses, missed + false, by depth of the jump\n{}\n\
         2. Operations of one call for each contact node, by size\n{}",
        measured.scenes,
        measured.seed,
        wrong(&measured.by_depth),
        operations(&measured.by_size)
    )
}

/// Share of wrong statuses by depth of the jump: a curve a rule and side of the target.
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

/// The measurement as JSON.
pub fn json(measured: &Measurement) -> String {
    serde_json::to_string(measured).expect("string keys only") + "\n"
}

fn wrong(rows: &[Row]) -> String {
    let mut head = ["depth / c_tll", "target", "nodes", "in contact"].map(String::from).to_vec();
    for rule in StatusRule::ALL {
        head.extend([rule.to_string(), "%".into()]);
    }
    let rows = rows.iter().map(|row| {
        let start = [
            row.depth.to_string(),
            row.target.into(),
            row.nodes.to_string(),
            row.touching.to_string(),
        ];
        let scores = row.rules.iter().flat_map(|score| {
            let share = 100.0 * score.wrong_share(row.nodes);
            [format!("{} + {}", score.missed, score.false_contacts), format!("{share:.1}")]
        });
        start.into_iter().chain(scores).collect()
    });
    aligned(&std::iter::once(head).chain(rows).collect::<Vec<_>>())
}

fn operations(rows: &[Row]) -> String {
    let mut head = ["target edges", "nodes"].map(String::from).to_vec();
    head.extend(StatusRule::ALL.iter().map(StatusRule::to_string));
    let rows = rows.iter().map(|row| {
        let each = |operations: u64| format!("{:.1}", operations as f64 / row.nodes.max(1) as f64);
        let scores = row.rules.iter().map(|score| each(score.operations));
        [row.edges.to_string(), row.nodes.to_string()].into_iter().chain(scores).collect()
    });
    aligned(&std::iter::once(head).chain(rows).collect::<Vec<_>>())
}
