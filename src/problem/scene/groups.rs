//! Physical groups: the elements that belong to a name or a tag.

use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::fmt;

use schemars::JsonSchema;
use serde::Serialize;

use super::mesh::{ENTITIES, Element, Mesh};
use crate::model::NodeId;
use base::error::{InputError, Result};
use base::suggestion::did_you_mean;

/// A physical group, as a scene file refers to it.
#[derive(Clone, Debug, PartialEq, Eq, Hash, Serialize, JsonSchema)]
#[serde(untagged)]
pub enum GroupRef {
    /// By its name.
    Name(String),
    /// By its tag.
    Tag(usize),
}

impl GroupRef {
    /// Returns the name or the tag as text.
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

/// What Gmsh calls the entities of such elements in a statement.
const STATEMENTS: [&str; 3] = ["Point", "Curve", "Surface"];

/// The most groups that an error lists.
const MOST_LISTED: usize = 20;

/// The physical groups of a mesh.
pub struct Groups<'m> {
    mesh: &'m Mesh,
    /// The places in the mesh of the elements of each group, ascending, by dimension and tag.
    places: BTreeMap<(usize, usize), Vec<u32>>,
    /// The tags of groups with a name, by dimension and name.
    tags: HashMap<(usize, &'m str), usize>,
}

impl<'m> Groups<'m> {
    /// Sorts the elements of `mesh` by their groups.
    pub fn new(mesh: &'m Mesh) -> Self {
        let mut places: BTreeMap<_, Vec<u32>> = BTreeMap::new();
        for (element, place) in mesh.elements.iter().zip(0..) {
            for tag in &element.physical {
                places.entry((element.dim(), *tag)).or_default().push(place);
            }
        }
        let names = mesh.names.iter().map(|group| ((group.dim, &*group.name), group.tag));
        Groups { mesh, places, tags: names.collect() }
    }

    /// Returns the places in the mesh of a group's elements of dimension `dim` (1: edges, 2: triangles),
    /// ascending.
    ///
    /// # Errors
    /// No such group exists in that dimension, or it has no element.
    pub fn places(&self, dim: usize, group: &GroupRef, place: &str) -> Result<&[u32]> {
        let tag = self.tag(dim, group);
        if let Some(places) = tag.and_then(|tag| self.places.get(&(dim, tag))) {
            return Ok(places);
        }
        let kind = ELEMENT_NAMES[dim];
        let what = match tag {
            Some(_) => format!("the physical group {group} has no element among the mesh's {kind}"),
            None => format!("there is no physical group {group} of {kind}"),
        };
        let fix = match tag {
            Some(_) if self.places.is_empty() => {
                "no element has a physical group, though $PhysicalNames names some: in Gmsh set \
                 Mesh.SaveAll = 0, and save the mesh again"
                    .into()
            }
            Some(_) => format!(
                "in Gmsh, add {kind} of the final geometry to the group (a rotation or a cut makes new \
                 ones), and save the mesh again; {}",
                self.known(dim)
            ),
            None => {
                let names = self.mesh.names.iter().filter(|n| n.dim == dim);
                let near = did_you_mean(&group.text(), names.map(|n| n.name.as_str()));
                near + &self.known(dim) + &self.addition(dim, group)
            }
        };
        Err(InputError::new(place, what, fix))
    }

    /// Returns the groups of elements of dimension `dim`, by ascending tag.
    pub fn all(&self, dim: usize) -> Vec<GroupRef> {
        let group = |((_, tag), _): (&(usize, usize), _)| {
            self.mesh.name(dim, *tag).map_or(GroupRef::Tag(*tag), GroupRef::from)
        };
        self.places.range((dim, 0)..(dim + 1, 0)).map(group).collect()
    }

    /// Names the groups of triangles that have none: bodies that are not in the mesh.
    pub fn without_triangles(&self) -> Option<String> {
        let is_empty = |tag: usize| !self.places.contains_key(&(2, tag));
        let empty = self.mesh.names.iter().filter(|name| name.dim == 2 && is_empty(name.tag));
        let empty: Vec<String> = empty.map(|name| format!("{:?}", name.name)).collect();
        (!empty.is_empty()).then(|| {
            format!(
                "The mesh names groups of triangles that have none: {}: their surfaces are not in the mesh, as where Gmsh \
                 failed on them or a Boolean operation removed them",
                empty.join(", ")
            )
        })
    }

    /// Returns a group's elements of dimension `dim` (1: edges, 2: triangles), in mesh order.
    ///
    /// # Errors
    /// Those of [`Self::places`].
    pub fn members(
        &self,
        dim: usize,
        group: &GroupRef,
        place: &str,
    ) -> Result<impl Iterator<Item = &'m Element> + use<'_, 'm>> {
        let places = self.places(dim, group, place)?;
        Ok(places.iter().map(|place| &self.mesh.elements[*place as usize]))
    }

    /// Returns the nodes of a group, ascending: a group of edges, else of points, else of triangles.
    pub fn nodes(&self, group: &GroupRef, place: &str) -> Result<BTreeSet<NodeId>> {
        let has_elements = |dim: &usize| {
            self.tag(*dim, group).is_some_and(|tag| self.places.contains_key(&(*dim, tag)))
        };
        let dim = [1, 0, 2].into_iter().find(has_elements).unwrap_or(1);
        let members = self.members(dim, group, place)?;
        Ok(members.flat_map(|it| it.nodes.iter().map(|n| NodeId::from_number(*n))).collect())
    }

    /// Returns the tag of a group of elements of dimension `dim`. A name may be a tag as text.
    fn tag(&self, dim: usize, group: &GroupRef) -> Option<usize> {
        let used = |tag: &usize| self.places.contains_key(&(dim, *tag));
        match group {
            GroupRef::Tag(tag) => Some(*tag).filter(used),
            GroupRef::Name(name) => {
                let named = self.tags.get(&(dim, &**name)).copied();
                named.or_else(|| name.parse().ok().filter(used))
            }
        }
    }

    /// Says how Gmsh adds a group of the entities whose elements are in none; nothing where all are.
    pub(super) fn addition(&self, dim: usize, group: &GroupRef) -> String {
        let elements = self.mesh.elements.iter().filter(|element| element.dim() == dim);
        let free: Vec<usize> = elements
            .filter(|element| element.physical.is_empty())
            .map(|element| element.geometric)
            .collect();
        if free.iter().all(|entity| *entity == 0) {
            return match free.len() {
                0 => String::new(),
                count => format!(
                    "; {count} {} are in none, and in no {} of Gmsh: in meshio give them a tag in \
                     cell_data[\"gmsh:physical\"], and the tag its name in field_data, and save the mesh again",
                    ELEMENT_NAMES[dim], ENTITIES[dim]
                ),
            };
        }
        let free: BTreeSet<usize> = free.into_iter().collect();
        let more = if free.len() > MOST_LISTED { ", ..." } else { "" };
        let tags: Vec<String> = free.iter().take(MOST_LISTED).map(usize::to_string).collect();
        format!(
            "; {} of {}{} {} are in none: in Gmsh add those that belong to it, as in Physical {}({group}) = \
             {{{}}}; and save the mesh again",
            ELEMENT_NAMES[dim],
            ENTITIES[dim],
            if free.len() == 1 { "" } else { "s" },
            tags.join(", ") + more,
            STATEMENTS[dim],
            free.first().expect("there are some")
        )
    }

    /// Returns the groups that exist, in the words of an error.
    fn known(&self, dim: usize) -> String {
        let kind = ELEMENT_NAMES[dim];
        let tags = self.places.range((dim, 0)..(dim + 1, 0)).map(|((_, tag), _)| *tag);
        let named = |tag: usize| {
            self.mesh.name(dim, tag).map_or(tag.to_string(), |name| format!("{name:?} ({tag})"))
        };
        let names: Vec<String> = tags.clone().take(MOST_LISTED).map(named).collect();
        match tags.count() - names.len() {
            _ if names.is_empty() => format!("the mesh has no physical group of {kind}"),
            0 => format!("the mesh's groups of {kind} are {}", names.join(", ")),
            more => format!("the mesh's groups of {kind} are {} and {more} more", names.join(", ")),
        }
    }
}
