//! Contact that `c_cnt` does not find because of the direction of a target edge (findings C1 and C14):
//!
//! ```text
//!   runs towards +x: found from x1 - c_tll to x2 + c_tll       runs towards -x: from x2 + c_tll to x1 - c_tll
//!   1 ----------> 2                                            2 <---------- 1
//! ```

use paper::door::Call;
use paper::mirror::Reading;
use problem::model::Model;

/// Returns, where `c_cnt` finds no node in contact in a shape and would with the target's edges turned
/// round, the cause and what to do, in words; None elsewhere. `shape` has the coordinates of each node,
/// length.
pub fn hidden(model: &Model, reading: &Reading, shape: &[[f64; 2]]) -> Option<String> {
    let found = |model: &Model| Call::c_cnt(model, reading, shape).ok().map(|call| call.statuses);
    let own = found(model)?;
    if own.iter().any(|status| status.in_contact) {
        return None;
    }
    let turned = found(&turned(model))?;
    let (own, turned) = own.iter().zip(&turned).find(|(_, turned)| turned.in_contact)?;
    let edge = model.edge(turned.edge?);
    let [a, b] = edge.nodes.map(|node| shape[node.index()]);
    let towards = if b[0] < a[0] { "-x" } else { "-y" };
    let ct = own.edge.map_or(0, |edge| model.edge(edge).number);
    Some(format!(
        "ct of node {} is {ct}, though it touches target edge {}, because the edge runs towards {towards}, \
         where the box of lines 5 and 6 of c_cnt shrinks (finding C1); turn the target's edges round: in \
         Gmsh, reverse their curve",
        own.node, edge.number
    ))
}

/// Returns the model with every target edge turned round.
pub fn turned(model: &Model) -> Model {
    let mut turned = model.clone();
    for edge in &model.contact.target {
        turned.edges[edge.index()].nodes.reverse();
    }
    turned
}
