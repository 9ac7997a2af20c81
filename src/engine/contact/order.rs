//! The order of the contact surface under `unilateral`, whatever the order in which it is listed.
//!
//! The nodes are followed along the edges of the body's outline between them, with the body on the
//! left. A closed outline starts at its lowest node; of several pieces, as two feet of a body, that
//! with the lowest first node comes first.

use std::collections::{HashMap, HashSet};

use base::error::InputError;
use problem::model::{Model, NodeId};

const PLACE: &str = "contact.cnt";

/// Returns the nodes of the contact surface in order along it, each once. A surface of one node,
/// which bounds no contact edge, is that node.
/// Errors: a node is joined to no other one by an edge of the outline, or to more than two.
pub fn along(model: &Model) -> Result<Vec<NodeId>, InputError> {
    let listed: HashSet<NodeId> = model.contact.nodes.iter().copied().collect();
    if listed.len() < 2 {
        return Ok(listed.into_iter().collect());
    }
    let (mut next, mut before) = (HashMap::new(), HashSet::new());
    for triangle in &model.triangles {
        for k in 0..3 {
            let pair = [triangle.nodes[k], triangle.nodes[(k + 1) % 3]];
            if !pair.iter().all(|n| listed.contains(n)) || model.sides.boundary(pair).is_none() {
                continue;
            }
            let [a, b] = pair;
            if next.insert(a, b).is_some() || !before.insert(b) {
                let what = format!("the edges between the listed nodes branch at node {a} or {b}");
                return Err(InputError::new(PLACE, what, "name one side of the outline"));
            }
        }
    }
    let alone = |n: &&NodeId| !next.contains_key(*n) && !before.contains(*n);
    if let Some(node) = listed.iter().filter(alone).min() {
        let what = format!("no edge of the outline joins node {node} to another listed node");
        let fix = "list all nodes along the contact surface; those between two listed nodes may be \
                   missing";
        return Err(InputError::new(PLACE, what, fix));
    }
    let mut starts: Vec<NodeId> = listed.iter().filter(|n| !before.contains(*n)).copied().collect();
    starts.sort_unstable();
    let mut nodes: Vec<NodeId> = Vec::new();
    for start in starts {
        nodes.push(start);
        nodes.extend(follow(&next, start, start));
    }
    if nodes.is_empty() {
        let start = *listed.iter().min().expect("there are two nodes");
        nodes.push(start);
        nodes.extend(follow(&next, start, start));
    }
    if nodes.len() == listed.len() {
        return Ok(nodes);
    }
    let found: HashSet<NodeId> = nodes.into_iter().collect();
    let left = listed.difference(&found).min().expect("not all were found");
    let what = format!("the listed nodes make more than one outline; node {left} is on another");
    Err(InputError::new(PLACE, what, "name one outline, or parts of it that are not closed"))
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
    let beside: HashSet<_> = listed.windows(2).map(sorted).collect();
    let is_edge = |pair: &&[NodeId]| model.sides.boundary([pair[0], pair[1]]).is_some();
    let mut apart = along.windows(2).filter(is_edge).filter(|pair| !beside.contains(&sorted(pair)));
    let [a, b] = sorted(apart.next()?);
    Some(format!("nodes {a} and {b} share an edge and are listed apart"))
}

/// Returns a pair of nodes, the lower one first.
fn sorted(pair: &[NodeId]) -> [NodeId; 2] {
    [pair[0].min(pair[1]), pair[0].max(pair[1])]
}

/// Returns the nodes after `start` as far as `end` or the end of the chain.
fn follow(
    next: &HashMap<NodeId, NodeId>,
    start: NodeId,
    end: NodeId,
) -> impl Iterator<Item = NodeId> {
    std::iter::successors(next.get(&start), |n| next.get(*n))
        .copied()
        .take_while(move |n| *n != end)
}
