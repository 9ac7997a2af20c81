//! A call of `c_cnt`.

use super::{direction, dropped};
use crate::model::{Cell, Report, Table};
use paper::door::Call;
use paper::mirror::Reading;
use problem::model::{EdgeId, Model, NodeId};
use problem::scene::Scene;

/// Reports a call of `c_cnt` at the initial shape: its contact nodes, then the rows of k_cnt that
/// are not zero. In the scene of the paper's fig. 1 each node has its number there.
pub fn pairs(scene: &Scene, model: &Model, reading: &Reading, call: &Call) -> Report {
    let number = |edge: Option<EdgeId>| edge.map_or(0, |edge| model.edge(edge).number);
    let is_figure = scene.name == "fig1";
    let figure = if is_figure { figure_numbers(model) } else { Vec::new() };
    let in_figure = |node: NodeId| {
        let numbered = figure.iter().find(|(other, _)| *other == node);
        numbered.map(|(_, number)| number.clone())
    };
    let mut found = Table::from_rows(call.statuses.iter().enumerate())
        .column("i1", |(k, _)| k + 1)
        .column("cnt", |(_, status)| status.node)
        .column("ct", |(_, status)| number(status.edge))
        .column("yt", |(_, status)| status.distance)
        .column("dy", |(_, status)| u8::from(status.in_contact));
    let written = call.pairs.written().map(|(node, row)| (NodeId::from_number(node), row));
    let written: Vec<(NodeId, [f64; 4])> = written.collect();
    let count = written.len();
    let mut rows = Table::from_rows(written)
        .column("node", |(node, _)| *node)
        .column("tied to", |(_, row)| Cell::decimals(row[0], 0))
        .column("weight", |(_, row)| row[1])
        .column("tied to", |(_, row)| Cell::decimals(row[2], 0))
        .column("weight", |(_, row)| row[3])
        .column("surface", |(node, _)| match model.contact.nodes.contains(node) {
            true => "contact",
            false => "target",
        });
    if is_figure {
        found = found.column("in fig. 1", |(_, status)| in_figure(status.node));
        rows = rows.column("in fig. 1", |(node, _)| in_figure(*node));
    }
    Report::default()
        .notes(scene.adapted().to_vec())
        .notes(dropped(&scene.model))
        .table(format!("Contact nodes (c_tll = {})", model.contact.tolerance), found)
        .notes(direction(model, reading, &model.nodes))
        .table(format!("k_cnt: {count} of {} rows are not zero", model.nodes.len()), rows)
}

/// Returns the numbers that the paper's fig. 1 gives the nodes of two surfaces: 1.1, 1.2, ... along
/// the target, 2.1, 2.2, ... along the stamp, each in the order in which the surface is given.
pub fn figure_numbers(model: &Model) -> Vec<(NodeId, String)> {
    let mut target: Vec<NodeId> = Vec::new();
    for node in model.target_edges().flat_map(|edge| edge.nodes) {
        if !target.contains(&node) {
            target.push(node);
        }
    }
    let numbered = |surface: usize, nodes: &[NodeId]| {
        let nodes = nodes.iter().zip(1..);
        nodes.map(|(node, k)| (*node, format!("{surface}.{k}"))).collect::<Vec<_>>()
    };
    [numbered(1, &target), numbered(2, &model.contact.nodes)].concat()
}
