//! The two contact surfaces, in the order in which the listing visits them.

use std::collections::HashMap;
use std::fmt::Display;
use std::hash::Hash;

use schemars::JsonSchema;
use serde::Serialize;

use super::groups::{GroupRef, Groups};
use super::mesh::{Element, Mesh};
use crate::model::{NodeId, unordered};
use base::error::{InputError, Result};

/// A contact surface, as a scene file describes it.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
#[serde(untagged)]
pub enum Surface {
    /// The edges of a physical group.
    Group(GroupRef),
    /// Node or `elem` numbers, in their order in the list.
    Numbers(Vec<usize>),
}

impl Surface {
    /// Returns the numbers of a list; none of a group.
    pub(super) fn numbers(&mut self) -> &mut [usize] {
        match self {
            Surface::Group(_) => &mut [],
            Surface::Numbers(numbers) => numbers,
        }
    }
}

impl<G: Into<GroupRef>> From<G> for Surface {
    fn from(group: G) -> Self {
        Surface::Group(group.into())
    }
}

impl From<Vec<usize>> for Surface {
    fn from(numbers: Vec<usize>) -> Self {
        Surface::Numbers(numbers)
    }
}

/// Returns the nodes of the contact surface `cnt`, in order along it. A list is taken as it
/// is; a group's edges are followed as a chain from its first end.
///
/// # Errors
/// A group is no single chain or has an edge twice, or a number is no node.
pub fn contact_nodes(mesh: &Mesh, groups: &Groups, surface: &Surface) -> Result<Vec<NodeId>> {
    let place = "contact.cnt";
    match surface {
        Surface::Group(group) => {
            let edges: Vec<&Element> = groups.members(1, group, place)?.collect();
            no_edge_twice(&edges, place)?;
            chain(&edges.iter().map(|edge| edge.ids()).collect::<Vec<_>>()).map_err(|why| {
                let what = format!("group {group}: {why}");
                InputError::new(place, what, "give the node numbers as a list, in order")
            })
        }
        Surface::Numbers(numbers) => {
            not_empty(numbers, place)?;
            numbers.iter().map(|&n| mesh.node(n, place)).collect()
        }
    }
}

/// Returns the target edges `trg`: a list as it is, a group in mesh order.
///
/// # Errors
/// A number is no edge, or an edge is there twice.
pub fn target_edges<'m>(
    mesh: &'m Mesh,
    groups: &Groups<'m>,
    surface: &Surface,
) -> Result<Vec<&'m Element>> {
    let place = "contact.trg";
    let edges: Vec<&Element> = match surface {
        Surface::Group(group) => groups.members(1, group, place)?.collect(),
        Surface::Numbers(numbers) => {
            not_empty(numbers, place)?;
            numbers.iter().map(|number| edge(mesh, *number, place)).collect::<Result<_>>()?
        }
    };
    no_edge_twice(&edges, place)?;
    Ok(edges)
}

/// Returns the edge with the `elem` number `number`.
fn edge<'a>(mesh: &'a Mesh, number: usize, place: &str) -> Result<&'a Element> {
    let found = mesh.elements.binary_search_by_key(&number, |element| element.number);
    let edge = found.ok().map(|at| &mesh.elements[at]).filter(|element| element.dim() == 1);
    edge.ok_or_else(|| {
        let what = format!("elem {number} is no edge of the mesh");
        InputError::new(place, what, "name elem rows of type 1")
    })
}

/// Checks that no two edges have the same nodes.
fn no_edge_twice(edges: &[&Element], place: &str) -> Result<()> {
    let mut first = HashMap::new();
    for edge in edges {
        let [a, b] = edge.ids();
        if let Some(other) = first.insert(unordered([a, b]), edge.number) {
            let what = match other == edge.number {
                true => format!("edge {other} is named twice"),
                false => format!("edges {other} and {} both join nodes {a} and {b}", edge.number),
            };
            return Err(InputError::new(place, what, "keep one"));
        }
    }
    Ok(())
}

fn not_empty(numbers: &[usize], place: &str) -> Result<()> {
    if numbers.is_empty() {
        let fix = "name at least one, or leave out contact";
        return Err(InputError::new(place, "the list is empty", fix));
    }
    Ok(())
}

/// Follows `edges` as one chain from its first end, or a closed one from its first node.
///
/// # Errors
/// The edges branch, or are more than one chain.
pub fn chain<N: Copy + Display + Eq + Hash>(edges: &[[N; 2]]) -> Result<Vec<N>, String> {
    let mut at: HashMap<N, Vec<usize>> = HashMap::new();
    for (k, edge) in edges.iter().enumerate() {
        edge.iter().for_each(|n| at.entry(*n).or_default().push(k));
    }
    if let Some(node) = edges.iter().flatten().find(|n| at[n].len() > 2) {
        return Err(format!("the chain of edges branches at node {node}"));
    }
    let start = edges.iter().flatten().copied().find(|n| at[n].len() == 1).unwrap_or(edges[0][0]);
    let mut visited = vec![false; edges.len()];
    let mut nodes = vec![start];
    let mut here = start;
    while let Some(&k) = at[&here].iter().find(|&&k| !visited[k]) {
        visited[k] = true;
        here = if edges[k][0] == here { edges[k][1] } else { edges[k][0] };
        if here != start {
            nodes.push(here);
        }
    }
    match visited.iter().position(|visited| !visited) {
        None => Ok(nodes),
        Some(k) => Err(format!(
            "the edges make more than one chain: the one from node {start} ends at node {here}, \
             and edge {} - {} is left",
            edges[k][0], edges[k][1]
        )),
    }
}
