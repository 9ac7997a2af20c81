//! Physical groups: the elements that belong to a name or a tag.

use std::collections::BTreeSet;
use std::fmt;

use schemars::JsonSchema;
use serde::Serialize;

use super::mesh::{Element, Mesh};
use crate::error::{InputError, Result};
use crate::suggestion::did_you_mean;

#[derive(Clone, Debug, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(untagged)]
pub enum GroupRef {
    Name(String),
    Tag(usize),
}

impl GroupRef {
    pub fn text(&self) -> String {
        match self {
            GroupRef::Name(name) => name.clone(),
            GroupRef::Tag(tag) => tag.to_string(),
        }
    }
}

impl fmt::Display for GroupRef {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            GroupRef::Name(name) => write!(f, "{name:?}"),
            GroupRef::Tag(tag) => write!(f, "{tag}"),
        }
    }
}

impl From<&str> for GroupRef {
    fn from(name: &str) -> Self {
        GroupRef::Name(name.into())
    }
}

impl From<String> for GroupRef {
    fn from(name: String) -> Self {
        GroupRef::Name(name)
    }
}

impl From<usize> for GroupRef {
    fn from(tag: usize) -> Self {
        GroupRef::Tag(tag)
    }
}

const ELEMENT_NAMES: [&str; 3] = ["points", "edges", "triangles"];

/// Returns the group's elements of dimension `dim` (1: edges, 2: triangles), in mesh order.
/// Errors: no such group exists in that dimension, or it has no element.
pub fn members<'m>(
    mesh: &'m Mesh,
    dim: usize,
    group: &GroupRef,
    place: &str,
) -> Result<Vec<&'m Element>> {
    let what = ELEMENT_NAMES[dim];
    let typed = group.text();
    let names = mesh.names.iter().filter(|n| n.dim == dim).map(|n| n.name.as_str());
    let fix = did_you_mean(&typed, names) + &known(mesh, dim);
    let error = |what: String| InputError::new(place, what, fix.clone());
    let tag = tag(mesh, dim, group)
        .ok_or_else(|| error(format!("there is no physical group {group} of {what}")))?;
    let members: Vec<_> = mesh.of_dimension(dim).filter(|e| e.physical.contains(&tag)).collect();
    if members.is_empty() {
        return Err(error(format!(
            "the physical group {group} has no element among the mesh's {what}"
        )));
    }
    Ok(members)
}

/// Returns the nodes of a group, ascending: a group of edges, else of points, else of triangles.
pub fn nodes(mesh: &Mesh, group: &GroupRef, place: &str) -> Result<Vec<usize>> {
    let dim = [1, 0, 2].into_iter().find(|&dim| {
        tag(mesh, dim, group)
            .is_some_and(|tag| mesh.of_dimension(dim).any(|e| e.physical.contains(&tag)))
    });
    let members = members(mesh, dim.unwrap_or(1), group, place)?;
    let nodes: BTreeSet<usize> = members.iter().flat_map(|e| e.nodes.iter().copied()).collect();
    Ok(nodes.into_iter().collect())
}

/// Returns the tag of a group with elements of dimension `dim`. A name may be a tag as text.
fn tag(mesh: &Mesh, dim: usize, group: &GroupRef) -> Option<usize> {
    let used = |tag: &usize| mesh.of_dimension(dim).any(|e| e.physical.contains(tag));
    match group {
        GroupRef::Tag(tag) => Some(*tag).filter(used),
        GroupRef::Name(name) => {
            let named = mesh.names.iter().find(|n| n.dim == dim && n.name == *name);
            named.map(|n| n.tag).or_else(|| name.parse().ok().filter(used))
        }
    }
}

/// Returns the groups that exist, in the words of an error.
fn known(mesh: &Mesh, dim: usize) -> String {
    let tags: BTreeSet<usize> =
        mesh.of_dimension(dim).flat_map(|e| e.physical.iter().copied()).collect();
    let names: Vec<String> = tags
        .iter()
        .map(|tag| match mesh.names.iter().find(|n| n.dim == dim && n.tag == *tag) {
            Some(name) => format!("{:?} ({tag})", name.name),
            None => tag.to_string(),
        })
        .collect();
    match names.as_slice() {
        [] => format!("the mesh has no physical group of {}", ELEMENT_NAMES[dim]),
        names => format!("the mesh's groups of {} are {}", ELEMENT_NAMES[dim], names.join(", ")),
    }
}
