//! The scene file: JSON as the user writes it, before anything is checked against the mesh.

use std::fmt;
use std::str::FromStr;

use serde::de::{self, Deserializer, MapAccess, SeqAccess, Visitor};
use serde::{Deserialize, Serialize};

use crate::error::InputError;
use crate::problem::element::Plane;
use crate::problem::modelling::{Coupling, Friction, Geometry, StatusRule, Variant};

/// A scene file. Lengths, forces and stresses in any consistent unit.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SceneFile {
    /// A line for people.
    #[serde(default)]
    pub title: String,
    /// A Gmsh file beside the scene; or `node` and `elem`.
    pub mesh: Option<String>,
    /// The paper's node table: rows of number, x, y, z.
    pub node: Option<Vec<[f64; 4]>>,
    /// The paper's element table: Gmsh 2 rows with two tags.
    pub elem: Option<Vec<Vec<usize>>>,
    /// Plane strain or plane stress.
    #[serde(deserialize_with = "by_name")]
    pub plane: Plane,
    /// Thickness across the plane, length.
    #[serde(default = "one")]
    pub thickness: f64,
    /// Unit names for tables and pictures; no number is converted.
    #[serde(default)]
    pub units: Units,
    /// Physical group of triangles (name or tag) -> material.
    pub materials: Materials,
    /// Where displacements are held at zero.
    #[serde(default)]
    pub restraints: Vec<Restraint>,
    /// Pressures, tractions and forces.
    #[serde(default)]
    pub loads: Vec<Load>,
    /// The two contact surfaces; absent: nothing of contact is built.
    pub contact: Option<Contact>,
    /// Number of iterations, 20 in the paper.
    #[serde(default = "twenty")]
    pub iterations: usize,
    /// What is run unless the command line says otherwise.
    #[serde(default, deserialize_with = "by_name")]
    pub variant: Variant,
    /// Drop nodes that belong to no triangle instead of refusing them.
    #[serde(default)]
    pub drop_orphans: bool,
}

fn one() -> f64 {
    1.0
}

fn twenty() -> usize {
    20
}

/// Reads a closed set by the names that it has on the command line.
fn by_name<'de, D: Deserializer<'de>, T: FromStr<Err = String>>(d: D) -> Result<T, D::Error> {
    String::deserialize(d)?.parse().map_err(de::Error::custom)
}

/// Unit names, shown beside numbers.
#[derive(Clone, Debug, Default, Deserialize, Serialize, PartialEq, Eq)]
#[serde(deny_unknown_fields)]
pub struct Units {
    /// Of lengths and displacements, `mm`.
    #[serde(default)]
    pub length: String,
    /// Of stresses and elastic moduli, `MPa`.
    #[serde(default)]
    pub stress: String,
    /// Of forces (per unit thickness where the thickness is 1), `N`.
    #[serde(default)]
    pub force: String,
}

/// An elastic material.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Material {
    /// Elastic modulus, stress.
    #[serde(rename = "E")]
    pub e: f64,
    /// Poisson's ratio.
    pub nu: f64,
}

/// The materials in the order of the file; a group named twice is refused.
#[derive(Clone, Debug)]
pub struct Materials(pub Vec<(GroupRef, Material)>);

/// A displacement held at zero.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Restraint {
    /// A physical group, all of whose nodes are held; or `node`.
    pub on: Option<GroupRef>,
    /// One node.
    pub node: Option<usize>,
    /// The directions held.
    pub fix: Vec<Axis>,
}

/// A direction of the plane.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq)]
#[serde(rename_all = "lowercase")]
pub enum Axis {
    /// Horizontal.
    X,
    /// Vertical.
    Y,
}

/// A load: `on` with `pressure` or `traction`, or `node` with `force`.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Load {
    /// A physical group of edges.
    pub on: Option<GroupRef>,
    /// Pushes into the body, stress.
    pub pressure: Option<f64>,
    /// Force per area, stress.
    pub traction: Option<[f64; 2]>,
    /// One node.
    pub node: Option<usize>,
    /// Force on that node.
    pub force: Option<[f64; 2]>,
}

/// The two contact surfaces and the tolerance between them.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Contact {
    /// Contact (stamp) surface: a group of edges, or node numbers in order.
    pub cnt: Surface,
    /// Target surface: a group of edges, or `elem` numbers in order.
    pub trg: Surface,
    /// The text's c_tol, length.
    pub c_tll: f64,
    /// How a contact node is bound to the target.
    #[serde(default, deserialize_with = "by_name")]
    pub coupling: Coupling,
    /// What it may do along the tangent under `unilateral`: 0 or "stick".
    #[serde(default)]
    pub friction: Friction,
    /// The shape in which `unilateral` measures contact.
    #[serde(default, deserialize_with = "by_name")]
    pub geometry: Geometry,
    /// How `tied` and `stepped` decide who is in contact.
    #[serde(default, deserialize_with = "by_name")]
    pub status: StatusRule,
}

/// A physical group, by its name or its tag.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum GroupRef {
    /// By name.
    Name(String),
    /// By tag.
    Tag(usize),
}

/// A contact surface: a group, or the numbers themselves.
#[derive(Clone, Debug)]
pub enum Surface {
    /// A physical group of edges.
    Group(GroupRef),
    /// Node or `elem` numbers, in the order given.
    Numbers(Vec<usize>),
}

impl GroupRef {
    /// The name or tag as plain text.
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

impl<'de> Deserialize<'de> for GroupRef {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        match deserializer.deserialize_any(SurfaceVisitor { lists: false })? {
            Surface::Group(group) => Ok(group),
            Surface::Numbers(_) => unreachable!("the visitor refuses lists"),
        }
    }
}

impl<'de> Deserialize<'de> for Surface {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(SurfaceVisitor { lists: true })
    }
}

/// Reads a group's name or tag and, where `lists`, a list of numbers.
struct SurfaceVisitor {
    lists: bool,
}

impl<'de> Visitor<'de> for SurfaceVisitor {
    type Value = Surface;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("the name or the tag of a physical group")?;
        if self.lists { f.write_str(", or a list of numbers") } else { Ok(()) }
    }

    fn visit_str<E: de::Error>(self, name: &str) -> Result<Surface, E> {
        Ok(Surface::Group(GroupRef::Name(name.into())))
    }

    fn visit_u64<E: de::Error>(self, tag: u64) -> Result<Surface, E> {
        Ok(Surface::Group(GroupRef::Tag(tag as usize)))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut seq: A) -> Result<Surface, A::Error> {
        if !self.lists {
            return Err(de::Error::invalid_type(de::Unexpected::Seq, &self));
        }
        let mut numbers = Vec::new();
        while let Some(number) = seq.next_element()? {
            numbers.push(number);
        }
        Ok(Surface::Numbers(numbers))
    }
}

impl<'de> Deserialize<'de> for Materials {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_map(MaterialsVisitor)
    }
}

struct MaterialsVisitor;

impl<'de> Visitor<'de> for MaterialsVisitor {
    type Value = Materials;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("an object whose keys are physical groups, such as {\"block\": {\"E\": 3e4, \"nu\": 0.2}}")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Materials, A::Error> {
        let mut materials: Vec<(GroupRef, Material)> = Vec::new();
        while let Some(name) = map.next_key::<String>()? {
            let group = GroupRef::Name(name);
            if materials.iter().any(|(other, _)| *other == group) {
                return Err(de::Error::custom(format!("material {group} is given twice")));
            }
            materials.push((group, map.next_value()?));
        }
        Ok(Materials(materials))
    }
}

impl SceneFile {
    /// Parses a scene file.
    ///
    /// # Errors
    /// What is wrong, with the field's path, the line and the column.
    pub fn parse(text: &[u8]) -> Result<Self, InputError> {
        let text = text.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(text);
        let mut deserializer = serde_json::Deserializer::from_slice(text);
        let file = serde_path_to_error::deserialize(&mut deserializer).map_err(|error| {
            let place = match error.path().to_string() {
                path if path == "." || path == "?" => "the scene file".into(),
                path => format!("field {path}"),
            };
            InputError::new(place, error.inner().to_string(), "see the scene format in README.md")
        })?;
        deserializer.end().map_err(|error| {
            InputError::new(
                "the end of the scene file",
                error.to_string(),
                "remove what follows the scene",
            )
        })?;
        Ok(file)
    }
}
