//! What several reports write as JSON.

use std::collections::BTreeMap;

use serde::Serialize;
use serde_json::{Value, json};

use super::numbers::reason;
use base::files::json::{FORMAT, VERSION};
use base::plain::controls_a_terminal;
use paper::door::Call;
use problem::scene::{Scene, Units};

/// A document that a command prints or writes: what it says of itself, and its own value.
#[derive(Serialize)]
struct Document<'a, Own> {
    /// The version of the format.
    format: u32,
    /// The version of the program.
    version: &'static str,
    /// The names of the units of the scene that it is on, each empty where the scene names none; absent
    /// without one.
    #[serde(skip_serializing_if = "Option::is_none")]
    units: Option<&'a Units>,
    /// The SHA-256 of the scene, as a snapshot has it; absent for half a scene, which no file describes.
    #[serde(skip_serializing_if = "Option::is_none")]
    scene_sha256: Option<&'a str>,
    /// The SHA-256 of its mesh.
    #[serde(skip_serializing_if = "Option::is_none")]
    mesh_sha256: Option<&'a str>,
    #[serde(flatten)]
    own: &'a Own,
}

impl<'a, Own> Document<'a, Own> {
    fn new(scene: Option<&'a Scene>, own: &'a Own) -> Self {
        let [scene_sha256, mesh_sha256] = [0, 1].map(|k| scene.map(|of| &*of.hashes()[k]));
        let units = scene.map(|scene| &scene.units);
        Document { format: FORMAT, version: VERSION, units, scene_sha256, mesh_sha256, own }
    }
}

/// Returns a document around a command's own value, with the scene that it is on, and why fields are null.
pub fn document(scene: Option<&Scene>, own: &impl Serialize) -> Value {
    let mut document = value(&Document::new(scene, own));
    let mut nulls = BTreeMap::new();
    explain(&document, "", &mut nulls);
    if !nulls.is_empty() {
        document["nulls"] = value(&nulls);
    }
    document
}

/// Writes such a document on one line. Floats read back to the same bits; what is not finite is null.
pub fn line(scene: Option<&Scene>, own: &impl Serialize) -> String {
    visible(document(scene, own).to_string()) + "\n"
}

/// Writes such a document, which has no nulls, as its values come: a number of an array takes no more than
/// its digits.
pub fn streamed(own: &impl Serialize) -> String {
    let document = serde_json::to_string(&Document::new(None, own));
    visible(document.expect("a document has string keys only")) + "\n"
}

/// Returns JSON with escapes for characters of its texts that control a terminal.
fn visible(json: String) -> String {
    if !json.contains(controls_a_terminal) {
        return json;
    }
    let shown = |c: char| match controls_a_terminal(c) {
        true => format!("\\u{:04x}", c as u32),
        false => c.into(),
    };
    json.chars().map(shown).collect()
}

fn value(document: &impl Serialize) -> Value {
    serde_json::to_value(document).expect("a document has string keys only")
}

/// Writes a document over several lines, so that a comparison of two shows what changed: a line for
/// each field and for each item of a list of shallow objects, and one for each ten numbers of a list. Another
/// list of scalars stands on one line.
pub fn pretty(document: &impl Serialize) -> String {
    visible(indented(&value(document), 0)) + "\n"
}

fn indented(value: &Value, depth: usize) -> String {
    let is_short = |items: &[Value]| items.len() <= TEN || items.iter().any(Value::is_string);
    let (lines, open, close) = match value {
        Value::Object(fields) if !fields.is_empty() => {
            let line = |(name, value): (&String, &Value)| {
                format!("{}: {}", Value::from(name.as_str()), indented(value, depth + 1))
            };
            (fields.iter().map(line).collect::<Vec<_>>(), "{", "}")
        }
        Value::Array(items) if depth_of(value) > 1 || !is_short(items) => {
            let line = |item: &Value| match depth_of(item) {
                0..=2 => item.to_string(),
                _ => indented(item, depth + 1),
            };
            (tens(items).unwrap_or_else(|| items.iter().map(line).collect()), "[", "]")
        }
        _ => return value.to_string(),
    };
    let [inner, outer] = [depth + 1, depth].map(|depth| "  ".repeat(depth));
    format!("{open}\n{inner}{}\n{outer}{close}", lines.join(&format!(",\n{inner}")))
}

/// The numbers of a line.
const TEN: usize = 10;

/// Fills lines with the items of a list of numbers, or of rows of these; None of another list.
fn tens(items: &[Value]) -> Option<Vec<String>> {
    let is_number = |value: &Value| value.is_number() || value.is_null();
    let mut lines: Vec<String> = Vec::new();
    let mut room = 0;
    for item in items {
        let numbers = match item {
            Value::Array(row) if row.iter().all(is_number) => row.len(),
            item => is_number(item).then_some(1)?,
        };
        match lines.last_mut() {
            Some(line) if numbers <= room => *line += &format!(",{item}"),
            _ => {
                lines.push(item.to_string());
                room = TEN;
            }
        }
        room = room.saturating_sub(numbers);
    }
    Some(lines)
}

/// Returns how deep lists and objects stand in each other: 0 for a scalar.
fn depth_of(value: &Value) -> usize {
    match value {
        Value::Array(items) => 1 + items.iter().map(depth_of).max().unwrap_or(0),
        Value::Object(fields) => 1 + fields.values().map(depth_of).max().unwrap_or(0),
        _ => 0,
    }
}

/// Collects the names of the fields that are null in a value, each with its reason.
fn explain(value: &Value, field: &str, nulls: &mut BTreeMap<String, &'static str>) {
    match value {
        Value::Null => drop(nulls.insert(field.into(), reason(field))),
        Value::Array(values) => values.iter().for_each(|value| explain(value, field, nulls)),
        Value::Object(fields) => {
            fields.iter().for_each(|(field, value)| explain(value, field, nulls));
        }
        Value::Bool(_) | Value::Number(_) | Value::String(_) => {}
    }
}

/// Returns what one call of `c_cnt` found: of each contact node its number, the `elem` number of its target
/// edge (0 = none), the vertical distance from its target line, length, and whether it is in contact, 1 or 0;
/// by node mate, weight, mate, weight.
pub fn found(Call { sheet, pairs, .. }: &Call) -> Value {
    json!({
        "cnt": sheet.cnt.as_slice(),
        "ct": pairs.ct.as_slice(),
        "yt": pairs.yt.as_slice(),
        "dy": pairs.dy.as_slice(),
        "k_cnt": (1..=pairs.k_cnt.rows()).map(|node| pairs.row(node)).collect::<Vec<_>>(),
    })
}
