//! What several reports write as JSON.

use std::io::{self, Write};

use schemars::JsonSchema;
use serde::Serialize;
use serde_json::ser::{CompactFormatter, Formatter};
use serde_json::{Map, Value};

use super::numbers::{NO_LIMIT, reason};
use paper::mirror::Pairs;
use problem::scene::{Scene, Units};
use studies::snapshot::{FORMAT, VERSION};

/// Writes a document on one line. Floats read back to the same bits; what is not finite is null. The
/// field `nulls`, which an object with nulls has at its end, says of each field that is null
/// anywhere in it why.
pub fn line(document: &impl Serialize) -> String {
    explained(document).to_string() + "\n"
}

/// A document behind what it says of itself.
#[derive(Serialize, JsonSchema)]
pub struct Headed<Head, Own> {
    #[serde(flatten)]
    head: Head,
    #[serde(flatten)]
    own: Own,
}

/// What every document says of itself.
#[derive(Serialize, JsonSchema)]
pub struct Head {
    /// The version of the format.
    format: u32,
    /// The version of the program.
    version: &'static str,
}

/// What a document says of itself and of its scene.
#[derive(Serialize, JsonSchema)]
pub struct SceneHead {
    #[serde(flatten)]
    head: Head,
    /// The names of the scene's units, each empty where the scene names none.
    units: Units,
    /// The SHA-256 of the scene, as a snapshot has it.
    scene_sha256: String,
    /// The SHA-256 of its mesh.
    mesh_sha256: String,
}

/// Returns what a document without a scene says of itself.
const HEAD: Head = Head { format: FORMAT, version: VERSION };

/// Writes a document on one line behind its head.
pub fn headed(own: &impl Serialize) -> String {
    line(&Headed { head: HEAD, own })
}

/// Writes a document on a scene, which a file describes, on one line behind its head.
pub fn of_scene(scene: &Scene, own: &impl Serialize) -> String {
    line(&Headed { head: scene_head(scene), own })
}

/// Writes a document on a scene as [`of_scene`] does, each part of it as it is computed.
///
/// # Errors
/// Something was not written.
pub fn write_of_scene(mut out: impl Write, scene: &Scene, own: &impl Serialize) -> io::Result<()> {
    let mut serializer = serde_json::Serializer::with_formatter(&mut out, Explaining::default());
    Headed { head: scene_head(scene), own }.serialize(&mut serializer)?;
    out.write_all(b"\n")
}

/// Writes without blanks, and at the end of the outermost object the reasons of its nulls.
#[derive(Default)]
struct Explaining {
    /// The field of each object that is open.
    fields: Vec<String>,
    is_field: bool,
    nulls: Map<String, Value>,
}

impl Formatter for Explaining {
    fn begin_object<W: ?Sized + Write>(&mut self, out: &mut W) -> io::Result<()> {
        self.fields.push(String::new());
        out.write_all(b"{")
    }

    fn begin_object_key<W: ?Sized + Write>(&mut self, out: &mut W, first: bool) -> io::Result<()> {
        self.fields.last_mut().expect("an object is open").clear();
        self.is_field = true;
        CompactFormatter.begin_object_key(out, first)
    }

    fn write_string_fragment<W: ?Sized + Write>(
        &mut self,
        out: &mut W,
        text: &str,
    ) -> io::Result<()> {
        if let (true, Some(field)) = (self.is_field, self.fields.last_mut()) {
            field.push_str(text);
        }
        out.write_all(text.as_bytes())
    }

    fn end_object_key<W: ?Sized + Write>(&mut self, _: &mut W) -> io::Result<()> {
        self.is_field = false;
        Ok(())
    }

    fn write_null<W: ?Sized + Write>(&mut self, out: &mut W) -> io::Result<()> {
        let field = self.fields.last().map_or("", String::as_str);
        self.nulls.insert(field.into(), reason(field).into());
        out.write_all(b"null")
    }

    fn end_object<W: ?Sized + Write>(&mut self, out: &mut W) -> io::Result<()> {
        self.fields.pop();
        if self.fields.is_empty() && !self.nulls.is_empty() {
            write!(out, ",\"nulls\":{}", Value::from(std::mem::take(&mut self.nulls)))?;
        }
        out.write_all(b"}")
    }
}

/// Returns what a document on a scene, which a file describes, says of itself.
pub fn head(scene: &Scene) -> Map<String, Value> {
    match serde_json::to_value(scene_head(scene)) {
        Ok(Value::Object(fields)) => fields,
        _ => unreachable!("a head is an object"),
    }
}

fn scene_head(scene: &Scene) -> SceneHead {
    let [scene_sha256, mesh_sha256] = scene.hashes().expect("a file describes it").clone();
    SceneHead { head: HEAD, units: scene.units.clone(), scene_sha256, mesh_sha256 }
}

/// Returns a document with the reasons of its nulls.
fn explained(document: &impl Serialize) -> Value {
    let mut document = serde_json::to_value(document).expect("a document has string keys only");
    let documents = match &mut document {
        Value::Array(documents) => documents.as_mut_slice(),
        document => std::slice::from_mut(document),
    };
    for document in documents {
        let mut nulls = Map::new();
        explain(document, "", &mut nulls);
        if let (Value::Object(fields), false) = (document, nulls.is_empty()) {
            fields.insert("nulls".into(), nulls.into());
        }
    }
    document
}

/// Writes a document of a run over several lines, with the reasons of its nulls.
pub fn pretty_explained(document: &impl Serialize) -> String {
    several_lines(&explained(document))
}

/// Writes a document over several lines, so that a comparison of two shows what changed: a line for
/// each field and for each item of a list of lists or shallow objects. A list of scalars stands on one line.
pub fn pretty(document: &impl Serialize) -> String {
    several_lines(&serde_json::to_value(document).expect("a document has string keys"))
}

fn several_lines(document: &Value) -> String {
    let mut text = String::new();
    indented(document, 0, &mut text);
    text + "\n"
}

fn indented(value: &Value, depth: usize, text: &mut String) {
    let is_scalar = |value: &Value| depth_of(value) == 0;
    let (items, [open, close]): (Vec<(String, &Value)>, _) = match value {
        Value::Object(fields) if !fields.is_empty() => {
            let named = |(name, value)| (format!("{}: ", Value::from(name)), value);
            (fields.iter().map(|(name, value)| named((name.as_str(), value))).collect(), ["{", "}"])
        }
        Value::Array(items) if !items.iter().all(is_scalar) => {
            (items.iter().map(|item| (String::new(), item)).collect(), ["[", "]"])
        }
        _ => return text.push_str(&value.to_string()),
    };
    text.push_str(open);
    for (k, (name, item)) in items.iter().enumerate() {
        let comma = if k == 0 { "" } else { "," };
        text.extend([comma, "\n", &"  ".repeat(depth + 1), name]);
        match value.is_array() && depth_of(item) <= 2 {
            true => text.push_str(&item.to_string()),
            false => indented(item, depth + 1, text),
        }
    }
    text.extend(["\n", &"  ".repeat(depth), close]);
}

/// Returns how deep lists and objects stand in each other: 0 for a scalar.
fn depth_of(value: &Value) -> usize {
    match value {
        Value::Array(items) => 1 + items.iter().map(depth_of).max().unwrap_or(0),
        Value::Object(fields) => 1 + fields.values().map(depth_of).max().unwrap_or(0),
        _ => 0,
    }
}

/// Returns whether a field of an object is null because what it bounds has no limit.
fn has_no_limit(fields: &Map<String, Value>, field: &str) -> bool {
    match field {
        "displacement_mesh" => fields.contains_key("displacement_no_limit"),
        "mesh" => fields.get("no_limit").is_some_and(|point| point["is_largest"] == true),
        _ => false,
    }
}

/// Collects the names of the fields that are null in `value`, which stands in `field`, each with its
/// reason.
fn explain(value: &Value, field: &str, nulls: &mut Map<String, Value>) {
    match value {
        Value::Null => drop(nulls.insert(field.into(), reason(field).into())),
        Value::Array(values) => values.iter().for_each(|value| explain(value, field, nulls)),
        Value::Object(fields) => {
            for (field, value) in fields {
                match value {
                    Value::Null if has_no_limit(fields, field) => {
                        nulls.insert(field.into(), NO_LIMIT.into());
                    }
                    value => explain(value, field, nulls),
                }
            }
        }
        _ => (),
    }
}

/// What one call of `c_cnt` found.
#[derive(Serialize, JsonSchema)]
pub struct Found {
    /// The `elem` number of each contact node's target edge, 0 = none.
    ct: Vec<usize>,
    /// The vertical distance of each contact node from its target line, length.
    yt: Vec<f64>,
    /// Whether each contact node is in contact: 1 or 0.
    dy: Vec<usize>,
    /// By node: mate, weight, mate, weight.
    k_cnt: Vec<[f64; 4]>,
}

impl From<&Pairs<f64>> for Found {
    fn from(pairs: &Pairs<f64>) -> Self {
        let row = |n| [1, 2, 3, 4].map(|j| pairs.k_cnt[(n, j)]);
        Found {
            ct: pairs.ct.as_slice().to_vec(),
            yt: pairs.yt.as_slice().to_vec(),
            dy: pairs.dy.as_slice().to_vec(),
            k_cnt: (1..=pairs.k_cnt.rows()).map(row).collect(),
        }
    }
}
