//! How surfaces are listed: the order of the contact surface, and the direction of the target's edges.
//!
//! Under `unilateral` the contact surface has an order of its own, whatever the order in which it is listed.
//! The nodes are followed along the edges of the body's outline between them, with the body on the
//! left. A closed outline starts at its lowest node; of several pieces, as two feet of a body, that
//! with the lowest first node comes first.
//!
//! Contact that `c_cnt` does not find because of the direction of a target edge (findings C1 and C14):
//!
//! ```text
//!   runs towards +x: found from x1 - c_tll to x2 + c_tll       runs towards -x: from x2 + c_tll to x1 - c_tll
//!   1 ----------> 2                                            2 <---------- 1
//! ```

use std::collections::{HashMap, HashSet};

use base::error::InputError;
use paper::door::Call;
use paper::mirror::Reading;
use problem::model::{Model, NodeId, Triangle, unordered};

/// Returns the nodes of the contact surface in order along it, each once. A surface of one node,
/// which bounds no contact edge, is that node.
///
/// # Errors
/// A node is joined to no other node by an edge of the outline, or to more than two.
pub fn along(model: &Model) -> Result<Vec<NodeId>, InputError> {
    let listed: HashSet<NodeId> = model.contact.nodes.iter().copied().collect();
    if listed.len() < 2 {
        return Ok(listed.into_iter().collect());
    }
    let (mut next, mut before) = (HashMap::new(), HashSet::new());
    let is_own = |side: &[NodeId; 2]| {
        side.iter().all(|n| listed.contains(n)) && model.sides.boundary(*side).is_some()
    };
    for [a, b] in model.triangles.iter().flat_map(Triangle::sides).filter(is_own) {
        if next.insert(a, b).is_some() || !before.insert(b) {
            let what = format!("the edges between the listed nodes branch at node {a} or {b}");
            return Err(InputError::new("contact.cnt", what, "name one side of the outline"));
        }
    }
    let alone = |n: &&NodeId| !next.contains_key(*n) && !before.contains(*n);
    if let Some(node) = listed.iter().filter(alone).min() {
        let what = format!("no edge of the outline joins node {node} to another listed node");
        let fix = "list all nodes along the contact surface; those between two listed nodes may be \
                   missing";
        return Err(InputError::new("contact.cnt", what, fix));
    }
    let mut starts: Vec<NodeId> = listed.iter().filter(|n| !before.contains(*n)).copied().collect();
    if starts.is_empty() {
        starts.extend(listed.iter().min());
    }
    starts.sort_unstable();
    let mut nodes: Vec<NodeId> = Vec::new();
    for start in starts {
        nodes.push(start);
        let following = std::iter::successors(next.get(&start), |n| next.get(*n)).copied();
        nodes.extend(following.take_while(|n| *n != start));
    }
    if nodes.len() == listed.len() {
        return Ok(nodes);
    }
    let found: HashSet<NodeId> = nodes.into_iter().collect();
    let left = listed.difference(&found).min().expect("not all were found");
    let what = format!("the listed nodes make more than one outline; node {left} is on another");
    Err(InputError::new(
        "contact.cnt",
        what,
        "name one outline, or parts of it that are not closed",
    ))
}

/// Returns what the list of the contact surface has that no walk along it would have; None where it
/// follows the surface, in either direction.
pub fn oddity(model: &Model) -> Option<String> {
    let listed = &model.contact.nodes;
    let mut known = HashSet::new();
    if let Some(twice) = listed.iter().find(|node| !known.insert(**node)) {
        return Some(format!("node {twice} is listed more than once"));
    }
    let along = match along(model) {
        Ok(along) => along,
        Err(error) => return Some(error.what),
    };
    let pairs = |nodes: &[NodeId]| -> Vec<[NodeId; 2]> {
        nodes.windows(2).map(|pair| unordered([pair[0], pair[1]])).collect()
    };
    let beside: HashSet<_> = pairs(listed).into_iter().collect();
    let is_apart =
        |pair: &[NodeId; 2]| model.sides.boundary(*pair).is_some() && !beside.contains(pair);
    let [a, b] = pairs(&along).into_iter().find(is_apart)?;
    Some(format!("nodes {a} and {b} share an edge and are listed apart"))
}

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

/// Returns the model with every target edge reversed.
pub fn turned(model: &Model) -> Model {
    let mut turned = model.clone();
    for edge in &model.contact.target {
        turned.edges[edge.index()].nodes.reverse();
    }
    turned
}
