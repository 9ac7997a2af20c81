//! The scene file: a mesh and its description, as JSON.

use std::fmt;

use schemars::generate::SchemaSettings;
use serde::Deserialize;
use serde::de::{self, Deserializer, MapAccess, SeqAccess, Visitor};
use serde_json::Value;

use super::description::{Description, Materials};
use super::gmsh;
use super::groups::GroupRef;
use super::mesh::Mesh;
use super::surface::Surface;
use crate::model::Material;
use base::error::{InputError, Result};
use base::files::{json, kind_of};
use base::limits;

/// Scene files, of which the mesh is another file.
pub const SCENE: json::Kind =
    json::Kind { name: "scene file", fix: "see `plane-contact guide scenes`" };

/// Parses a scene file, with the source of its mesh still in it.
///
/// # Errors
/// The text is no scene file; the error names the field's path, the line and the column.
pub fn parse(text: &[u8]) -> Result<Description> {
    to_be_chosen(text).map_or_else(|| json::read(text, &SCENE).map_err(absent), Err)
}

/// What a scene file is asked for that no scene has: the starts of the place and of the words of the error that
/// says so, and what to do.
const ABSENT: [[&str; 3]; 5] = [
    ["", "there is no field \"spring", "springs are unsupported; CalculiX has them"],
    ["", "there is no field \"contacts\"", PAIR],
    ["field contact,", "a list where an object is expected", PAIR],
    ["", "there is no field \"gravity\"", WEIGHT],
    ["", "there is no field \"rho\"", WEIGHT],
];

const PAIR: &str = "a scene has one pair of surfaces, each of any number of stretches, and one friction; several pairs are \
     unsupported; CalculiX has them";

const WEIGHT: &str =
    "weight is a load: {\"on\": a group of triangles, \"rho\": density, \"g\": [0, -9810]}";

/// Says of what a scene cannot have that it is not here.
fn absent(error: InputError) -> InputError {
    let is = |[place, what, _]: &&[&str; 3]| {
        error.place.starts_with(place) && error.what.starts_with(what)
    };
    match ABSENT.iter().find(is) {
        Some([_, _, fix]) => InputError { fix: format!("{fix}; {}", error.fix), ..error },
        None => error,
    }
}

/// Takes the mesh out of the fields `mesh`, `node` and `elem` of a scene file; `beside` reads a file
/// in the scene file's folder.
///
/// # Errors
/// The fields name no source, or two; the file cannot be read; a row of a table has another
/// form.
pub fn mesh(
    scene: &mut Description,
    beside: impl Fn(&str) -> Result<Vec<u8>, String>,
) -> Result<Mesh> {
    let name = match (scene.mesh.take(), scene.node.take(), scene.elements.take()) {
        (Some(name), None, None) => name,
        (None, Some(node), Some(elem)) => return Mesh::from_tables(&node, &elem),
        _ => {
            let what = "the scene needs either mesh, or node and elem";
            let fix = "give \"mesh\": \"file.msh\", or the two tables";
            return Err(InputError::new("fields mesh, node, elem", what, fix));
        }
    };
    let file = beside(&name).map_err(|why| {
        let what = format!("the mesh file {name:?} cannot be read: {why}");
        InputError::new(
            "field mesh",
            what,
            "the path is resolved beside the scene file, in its folder or below",
        )
    })?;
    let place = format!("mesh {name:?}");
    let numbers = file.iter().filter(|byte| byte.is_ascii_whitespace()).count();
    limits::MESH.check(numbers, &place)?;
    let mut mesh = gmsh::read(&file).map_err(|error| {
        let mut fix = "save the mesh again from Gmsh";
        let what = if let Some(expected) = &error.expected
            && expected.starts_with("$MeshFormat")
        {
            // A file that is no mesh may hold secrets of who runs the scene.
            fix = "save a mesh from Gmsh: gmsh part.geo -2 makes part.msh of the geometry part.geo";
            let but = kind_of(&file).map_or(String::new(), |found| format!(" but {found}"));
            format!("it is no mesh of Gmsh{but}: expected {expected}")
        } else {
            error.to_string()
        };
        InputError::new(&place, what, fix)
    })?;
    mesh.adapt(scene).map_err(|error| error.within(&place))?;
    Ok(mesh)
}

/// Returns the JSON Schema (draft 2020-12) of a scene file: what has a default may be left out.
pub fn schema() -> String {
    let settings = SchemaSettings::draft2020_12().for_deserialize();
    let mut schema = settings.into_generator().into_root_schema_for::<Description>();
    schema.insert("title".into(), "a scene file".into());
    serde_json::to_string_pretty(&schema).expect("a schema has string keys") + "\n"
}

/// Returns the text of a scene file with `description` and the mesh file `mesh` beside it: a line
/// for each field and, in a list of several, for each item. Fields with their default are left out.
pub fn write(description: &Description, mesh: &str) -> String {
    let with_mesh = Description { mesh: Some(mesh.into()), ..description.clone() };
    let fields = serde_json::to_value(with_mesh).expect("a description's keys are strings");
    text_of(&fields)
}

/// Writes a scene with a line for each field and, in a list of several, for each item.
pub(super) fn text_of(scene: &Value) -> String {
    let fields = scene.as_object().expect("a scene is an object").iter();
    let fields: Vec<_> =
        fields.map(|(key, value)| format!("  \"{key}\": {}", lines(value))).collect();
    format!("{{\n{}\n}}\n", fields.join(",\n"))
}

/// The fields that a first scene leaves to its author, each with what to give.
const OPEN: [(&str, &str); 4] = [
    ("E", "E: the elastic modulus, a stress"),
    ("nu", "nu: Poisson's ratio"),
    ("pressure", "pressure: a stress that pushes into the body"),
    ("friction", "friction: 0, a coefficient such as 0.3, or \"stick\""),
];

/// The bytes of a scene file beyond which nothing is looked for in it: a first scene has no tables.
const MOST: usize = 1 << 20;

/// Names the fields that are still to be chosen, which are null; None where there are none, or the text is no
/// JSON.
fn to_be_chosen(text: &[u8]) -> Option<InputError> {
    let has_null = |text: &&[u8]| text.windows(4).any(|word| word == b"null");
    let text = Some(text).filter(|text| text.len() <= MOST).filter(has_null)?;
    let mut scene: Value = serde_json::from_slice(text).ok()?;
    let mut open: Vec<(String, String)> = Vec::new();
    of_null(&mut scene, "", "", &mut |place, name, _| {
        if OPEN.iter().any(|(field, _)| *field == name) {
            open.push((place.into(), name.into()));
        }
    });
    let is_open = |name: &&str| open.iter().any(|(_, field)| field == *name);
    let fix = OPEN.iter().filter(|(name, _)| is_open(name)).map(|(_, words)| *words);
    let fix = format!("give each a value in place of null; {}", fix.collect::<Vec<_>>().join("; "));
    let places = open.iter().map(|(place, _)| place.as_str()).collect::<Vec<_>>().join(", ");
    let what = "the scene leaves values to be chosen: they are null";
    (!open.is_empty()).then(|| InputError::new(places, what, fix))
}

/// Calls `found` with the place and the name of each field that is null, and with the field.
pub(super) fn of_null(
    value: &mut Value,
    place: &str,
    name: &str,
    found: &mut dyn FnMut(&str, &str, &mut Value),
) {
    match value {
        Value::Null => found(place, name, value),
        Value::Object(fields) => fields.iter_mut().for_each(|(name, value)| {
            let dot = if place.is_empty() { "" } else { "." };
            of_null(value, &format!("{place}{dot}{name}"), name, found);
        }),
        Value::Array(items) => items.iter_mut().enumerate().for_each(|(k, value)| {
            of_null(value, &format!("{place}[{k}]"), name, found);
        }),
        Value::Bool(_) | Value::Number(_) | Value::String(_) => {}
    }
}

/// Writes a value on one line, but a list of several items with a line for each.
fn lines(value: &Value) -> String {
    match value.as_array() {
        Some(list) if list.len() > 1 => {
            let items: Vec<String> = list.iter().map(|item| format!("    {item}")).collect();
            format!("[\n{}\n  ]", items.join(",\n"))
        }
        _ => value.to_string(),
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

/// Reads a group's name or tag and, where `lists` is set, a list of numbers.
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
        Ok(Surface::Group(GroupRef::from(name)))
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

/// Reads an object of materials.
struct MaterialsVisitor;

impl<'de> Visitor<'de> for MaterialsVisitor {
    type Value = Materials;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(
            "an object whose keys are physical groups, such as \
             {\"block\": {\"E\": 3e4, \"nu\": 0.2}}",
        )
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Materials, A::Error> {
        let mut materials: Vec<(GroupRef, Material)> = Vec::new();
        while let Some(name) = map.next_key::<String>()? {
            let group = GroupRef::Name(name);
            materials.push((group, map.next_value()?));
        }
        Ok(Materials(materials))
    }
}
