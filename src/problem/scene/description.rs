//! The description of a mesh: plane problem, materials, restraints, loads, contact surfaces, and
//! the variant to be run. A scene file and code write the same description, by
//! [`SceneBuilder`](super::SceneBuilder).

use std::str::FromStr;

use schemars::JsonSchema;
use serde::de::{self, Deserializer};
use serde::{Deserialize, Serialize, Serializer};

use super::groups::GroupRef;
use super::surface::Surface;
use crate::element::Plane;
use crate::model::Material;
use crate::modelling::{
    ContactModel, Coupling, Friction, Geometry, LOAD_STEPS, StatusRule, Variant,
};

/// The description of a mesh: a scene file, field by field. Lengths, forces and stresses may be in
/// any consistent unit. Fields with their default are not written.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Description {
    /// The title of pages and pictures.
    #[serde(default, skip_serializing_if = "is_default")]
    pub title: String,
    /// In a scene file, the name of a Gmsh file beside it; None where `node` and `elem` are given,
    /// and once the mesh is read.
    #[serde(skip_serializing_if = "is_default")]
    pub mesh: Option<String>,
    /// In a scene file, the paper's node table, with rows of number, x, y, z.
    #[serde(skip_serializing_if = "is_default")]
    pub node: Option<Vec<[f64; 4]>>,
    /// In a scene file, the paper's element table, with Gmsh 2 rows of two tags.
    #[serde(rename = "elem", skip_serializing_if = "is_default")]
    pub elements: Option<Vec<Vec<usize>>>,
    /// The plane problem: plane strain or plane stress.
    #[serde(deserialize_with = "by_name")]
    pub plane: Plane,
    /// The thickness across the plane, length.
    #[serde(default = "default_thickness", skip_serializing_if = "is_default_thickness")]
    pub thickness: f64,
    /// The unit names for tables and pictures; no number is converted.
    #[serde(default, skip_serializing_if = "is_default")]
    pub units: Units,
    /// The materials of the groups of triangles, by the group's name.
    pub materials: Materials,
    /// The displacements that are given, most of them 0.
    #[serde(default, skip_serializing_if = "is_default")]
    pub restraints: Vec<Restraint>,
    /// The pressures, tractions and forces on the mesh.
    #[serde(default, skip_serializing_if = "is_default")]
    pub loads: Vec<Load>,
    /// The two contact surfaces; without them no contact is modelled.
    #[serde(skip_serializing_if = "is_default")]
    pub contact: Option<Contact>,
    /// The number of iterations of the variants that the paper describes.
    #[serde(default = "number::<ITERATIONS>", skip_serializing_if = "is::<ITERATIONS>")]
    pub iterations: usize,
    /// The variant that is run unless the command line names another; `unilateral` where none is given.
    #[serde(default, deserialize_with = "some_by_name", skip_serializing_if = "is_default")]
    #[schemars(with = "Variant")]
    pub variant: Option<Variant>,
    /// Whether nodes that belong to no triangle are dropped; otherwise they are refused.
    #[serde(default, skip_serializing_if = "is_default")]
    pub drop_orphans: bool,
}

impl Description {
    /// Returns the node numbers that restraints, loads and the contact surface name, each with its field.
    pub(super) fn named_nodes(&mut self) -> Vec<(String, &mut usize)> {
        let restraints = self.restraints.iter_mut().enumerate();
        let restraints = restraints
            .filter_map(|(k, it)| Some((format!("restraints[{k}].node"), it.node.as_mut()?)));
        let loads =
            self.loads.iter_mut().enumerate().filter_map(|(k, load)| match &mut load.kind {
                LoadKind::Force { node, .. } => Some((format!("loads[{k}].node"), node)),
                LoadKind::Pressure { .. } | LoadKind::Traction { .. } | LoadKind::Weight { .. } => {
                    None
                }
            });
        let contact = self.contact.as_mut().map(|contact| contact.contact.numbers());
        let contact = contact.into_iter().flatten().map(|n| ("contact.cnt".into(), n));
        restraints.chain(loads).chain(contact).collect()
    }

    /// Returns the variant that is run: a scene of one's own asks for contact as it is, not for the paper's
    /// algorithm.
    pub(super) fn variant(&self) -> Variant {
        self.variant.unwrap_or(Variant::Unilateral)
    }

    /// Describes a plane problem with no material, thickness 1 and no load, for the contact solution.
    pub fn new(plane: Plane) -> Self {
        Description {
            title: String::new(),
            mesh: None,
            node: None,
            elements: None,
            plane,
            thickness: default_thickness(),
            units: Units::default(),
            materials: Materials::default(),
            restraints: Vec::new(),
            loads: Vec::new(),
            contact: None,
            iterations: ITERATIONS,
            variant: None,
            drop_orphans: false,
        }
    }
}

/// The number of iterations of a scene that sets none, which is the paper's.
const ITERATIONS: usize = 20;

/// Returns the thickness of a scene that sets none, length.
fn default_thickness() -> f64 {
    1.0
}

fn is_default_thickness(thickness: &f64) -> bool {
    *thickness == default_thickness()
}

/// Returns a number that stands where a scene sets none.
fn number<const N: usize>() -> usize {
    N
}

fn is<const N: usize>(number: &usize) -> bool {
    *number == N
}

fn is_default<T: Default + PartialEq>(value: &T) -> bool {
    *value == T::default()
}

/// The unit names that are shown beside numbers.
#[derive(Clone, Debug, Default, Deserialize, Serialize, PartialEq, Eq, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Units {
    /// The unit of lengths and displacements, such as `mm`.
    pub length: String,
    /// The unit of stresses and elastic moduli, such as `MPa`.
    pub stress: String,
    /// The unit of forces (per unit thickness where the thickness is 1), such as `N`.
    pub force: String,
}

/// The materials in their order in the scene file, each with its physical group of triangles.
#[derive(Clone, Debug, Default, PartialEq, JsonSchema)]
pub struct Materials(
    #[schemars(with = "std::collections::BTreeMap<String, Material>")] pub Vec<(GroupRef, Material)>,
);

impl Serialize for Materials {
    /// Writes an object whose keys are the groups' names or tags.
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(self.0.iter().map(|(group, material)| (group.text(), material)))
    }
}

/// Restrained displacements: those of a group's nodes, or of one node.
#[derive(Clone, Debug, Default, Deserialize, Serialize, PartialEq, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Restraint {
    /// A physical group, all of whose nodes are restrained; None where a node is named.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub on: Option<GroupRef>,
    /// A node, by its number in the mesh file.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub node: Option<usize>,
    /// The coordinates of a node, to a millionth of the mesh's size, length.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub at: Option<[f64; 2]>,
    /// The directions along which displacements are given.
    pub fix: Vec<Axis>,
    /// The displacement along each of `fix`, length; 0 where there is none. It grows with the load of the
    /// first stage.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub displacement: Vec<f64>,
}

/// A direction in the plane.
#[derive(Clone, Copy, Debug, Deserialize, Serialize, PartialEq, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Axis {
    /// To the right.
    X,
    /// Upwards.
    Y,
    /// Out of the body, normal to each edge of a group.
    #[serde(rename = "n")]
    Normal,
    /// Along each edge of a group, with the body on the left.
    #[serde(rename = "t")]
    Tangent,
    /// That of a vector of any length.
    Direction([f64; 2]),
}

/// A load, and when it acts.
#[derive(Clone, Debug, Serialize, PartialEq, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Load {
    /// What acts, and where.
    #[serde(flatten)]
    pub kind: LoadKind,
    /// The stage, from 1, in which `unilateral` applies the load, after the loads of the stages
    /// before it; the first where there is none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stage: Option<usize>,
}

/// The kinds of load, each with its fields in a scene file.
#[derive(Clone, Debug, Serialize, PartialEq, JsonSchema)]
#[serde(untagged)]
#[expect(missing_docs, reason = "what is said of each names its fields")]
pub enum LoadKind {
    /// A pressure on a group of edges that pushes into the body, stress.
    Pressure { on: GroupRef, pressure: f64 },
    /// A force per area on a group of edges along x and y, stress.
    Traction { on: GroupRef, traction: [f64; 2] },
    /// A force on a node along x and y, force.
    Force { node: usize, force: [f64; 2] },
    /// The weight of a group of triangles: its density, and the acceleration along x and y.
    Weight { on: GroupRef, rho: f64, g: [f64; 2] },
}

impl LoadKind {
    /// Returns the numbers to which the load is proportional.
    pub fn numbers(&mut self) -> &mut [f64] {
        match self {
            LoadKind::Pressure { pressure, .. } => std::slice::from_mut(pressure),
            LoadKind::Traction { traction, .. } => traction,
            LoadKind::Force { force, .. } => force,
            LoadKind::Weight { g, .. } => g,
        }
    }
}

impl Load {
    /// Multiplies the load by `factor`; returns whether all its numbers are finite then.
    pub fn scale(&mut self, factor: f64) -> bool {
        let numbers = self.kind.numbers();
        numbers.iter_mut().for_each(|x| *x *= factor);
        numbers.iter().all(|x| x.is_finite())
    }
}

impl<'de> Deserialize<'de> for Load {
    /// Reads all fields that any kind has, so that errors name the field, then finds the kind.
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        #[derive(Deserialize)]
        #[serde(deny_unknown_fields)]
        struct Fields {
            on: Option<GroupRef>,
            pressure: Option<f64>,
            traction: Option<[f64; 2]>,
            node: Option<usize>,
            force: Option<[f64; 2]>,
            rho: Option<f64>,
            g: Option<[f64; 2]>,
            stage: Option<usize>,
        }
        let Fields { on, pressure, traction, node, force, rho, g, stage } =
            Fields::deserialize(deserializer)?;
        let kind = match (on, pressure, traction, node, force, rho.zip(g)) {
            (Some(on), Some(pressure), None, None, None, None) => {
                LoadKind::Pressure { on, pressure }
            }
            (Some(on), None, Some(traction), None, None, None) => {
                LoadKind::Traction { on, traction }
            }
            (None, None, None, Some(node), Some(force), None) => LoadKind::Force { node, force },
            (Some(on), None, None, None, None, Some((rho, g))) => LoadKind::Weight { on, rho, g },
            _ => {
                return Err(de::Error::custom(
                    "a load has either on and pressure, on and traction, node and force, or on, rho and g",
                ));
            }
        };
        Ok(Load { kind, stage })
    }
}

/// The two contact surfaces, the tolerance between them, and how contact is modelled.
#[derive(Clone, Debug, Deserialize, Serialize, PartialEq, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Contact {
    /// The contact (stamp) surface: a group of edges, or node numbers in order.
    #[serde(rename = "cnt")]
    pub contact: Surface,
    /// The target surface: a group of edges, or numbers of edges in order.
    #[serde(rename = "trg")]
    pub target: Surface,
    /// The tolerance of the contact search, the text's c_tol, length.
    #[serde(rename = "c_tll")]
    pub tolerance: f64,
    /// The method that binds a contact node to the target; where none is given, that of `c_cnt` if a variant
    /// of the paper is named, else mortar.
    #[serde(default, deserialize_with = "some_by_name", skip_serializing_if = "is_default")]
    #[schemars(with = "Coupling")]
    pub coupling: Option<Coupling>,
    /// The friction between the surfaces under `unilateral`: a coefficient, or "stick". A scene file has to
    /// say it; in code nothing slides where it is not set.
    #[serde(default, skip_serializing_if = "is_default")]
    #[schemars(with = "Friction")]
    pub friction: Option<Friction>,
    /// The shape in which `unilateral` measures contact.
    #[serde(default, deserialize_with = "by_name", skip_serializing_if = "is_default")]
    pub geometry: Geometry,
    /// The number of equal steps in which `unilateral` applies the load of a stage.
    #[serde(default = "number::<LOAD_STEPS>", skip_serializing_if = "is::<LOAD_STEPS>")]
    pub load_steps: usize,
    /// The rule by which `tied` and `stepped` decide which nodes are in contact.
    #[serde(default, deserialize_with = "by_name", skip_serializing_if = "is_default")]
    pub status: StatusRule,
}

impl Contact {
    /// Describes contact of two surfaces within `tolerance`, length, with nothing said of how it is modelled.
    pub fn new(contact: impl Into<Surface>, target: impl Into<Surface>, tolerance: f64) -> Self {
        Contact {
            contact: contact.into(),
            target: target.into(),
            tolerance,
            coupling: None,
            friction: None,
            geometry: Geometry::default(),
            load_steps: LOAD_STEPS,
            status: StatusRule::default(),
        }
    }

    /// Returns how contact is modelled.
    pub(super) fn model(&self) -> ContactModel {
        ContactModel {
            coupling: self.coupling.unwrap_or_default(),
            friction: self.friction.unwrap_or_default(),
            geometry: self.geometry,
            load_steps: self.load_steps,
            status: self.status,
        }
    }
}

fn some_by_name<'de, D: Deserializer<'de>, T: FromStr<Err = String>>(
    d: D,
) -> Result<Option<T>, D::Error> {
    by_name(d).map(Some)
}

/// Reads a choice of a closed set by its name on the command line.
fn by_name<'de, D: Deserializer<'de>, T: FromStr<Err = String>>(d: D) -> Result<T, D::Error> {
    String::deserialize(d)?.parse().map_err(de::Error::custom)
}
