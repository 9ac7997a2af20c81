//! The scene file: a mesh and its description, as JSON.

use std::collections::HashMap;
use std::fmt;

use serde::Deserialize;
use serde::de::{self, Deserializer, IgnoredAny, MapAccess, SeqAccess, Visitor};
use serde_json::Value;
use serde_json::de::SliceRead;

use super::description::{Description, Material, Materials};
use super::groups::GroupRef;
use super::surface::Surface;
use crate::error::{InputError, Result};
use crate::plain::plain;
use crate::suggestion::did_you_mean;

/// Parses a scene file, with the source of its mesh still in it.
/// Errors: the text is no scene file; the error names the field's path, the line and the column.
pub fn parse(text: &[u8]) -> Result<Description> {
    let text = text.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(text);
    let mut deserializer = serde_json::Deserializer::from_slice(text);
    let _: Objects = read(&mut deserializer)?;
    let mut deserializer = serde_json::Deserializer::from_slice(text);
    let scene: Description = read(&mut deserializer)?;
    deserializer.end().map_err(|error| {
        let fix = "remove what follows the scene";
        InputError::new("the end of the scene file", error.to_string(), fix)
    })?;
    Ok(scene)
}

/// The fields that are objects; serde would take a list in the order of their fields.
#[derive(Deserialize)]
struct Objects {
    #[serde(default, rename = "units")]
    _units: Object,
    #[serde(default, rename = "contact")]
    _contact: Option<Object>,
    #[serde(default, rename = "materials")]
    _materials: HashMap<String, Object>,
    #[serde(default, rename = "restraints")]
    _restraints: Vec<Object>,
    #[serde(default, rename = "loads")]
    _loads: Vec<Object>,
}

type Object = HashMap<String, IgnoredAny>;

/// Reads what a scene file holds.
/// Errors: it is malformed; the error names the field's path, the line and the column.
fn read<'de, T: Deserialize<'de>>(
    from: &mut serde_json::Deserializer<SliceRead<'de>>,
) -> Result<T> {
    serde_path_to_error::deserialize(from).map_err(|error| {
        let place = match error.path().to_string() {
            path if path == "." || path == "?" => "the scene file".into(),
            path => format!("field {path}"),
        };
        let what = plain(error.inner());
        let fix = meant(&what) + "see the scene format in README.md";
        InputError::new(place, what, fix)
    })
}

/// Returns the name that an unknown one was meant to be: serde's words name it first, then those that
/// it expected, each in backticks.
fn meant(what: &str) -> String {
    let mut names = what.split('`').skip(1).step_by(2);
    match names.next().filter(|_| what.starts_with("unknown ")) {
        Some(typed) => did_you_mean(typed, names),
        None => String::new(),
    }
}

/// Returns the text of a scene file with `description` and the mesh file `mesh` beside it: a line
/// for each field and, in a list of several, for each item. Fields with their default are left out.
pub fn write(description: &Description, mesh: &str) -> String {
    let with_mesh = Description { mesh: Some(mesh.into()), ..description.clone() };
    let fields = serde_json::to_value(with_mesh).expect("a description's keys are strings");
    let fields = fields.as_object().expect("a description is an object").iter();
    let fields: Vec<_> =
        fields.map(|(key, value)| format!("  \"{key}\": {}", lines(value))).collect();
    format!("{{\n{}\n}}\n", fields.join(",\n"))
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

/// Reads an object of materials; a group that is named twice is refused.
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
            if materials.iter().any(|(other, _)| *other == group) {
                return Err(de::Error::custom(format!("material {group} is given twice")));
            }
            materials.push((group, map.next_value()?));
        }
        Ok(Materials(materials))
    }
}
