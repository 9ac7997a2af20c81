//! What several reports write as JSON.

use serde::Serialize;
use serde_json::{Map, Value, json};

use super::numbers::reason;
use crate::paper::mirror::Pairs;

/// Writes a document on one line. Floats read back to the same bits; what is not finite is null. The
/// field `nulls`, which an object with nulls has at its end, says of each field that is null
/// anywhere in it why.
pub fn line(document: &impl Serialize) -> String {
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
    document.to_string() + "\n"
}

/// Writes a document over several lines, so that a comparison of two shows what changed: a line for
/// each field and for each item of a list of lists or objects. A list of scalars stands on one line.
pub fn pretty(document: &impl Serialize) -> String {
    let mut text = String::new();
    indented(&serde_json::to_value(document).expect("a document has string keys"), 0, &mut text);
    text + "\n"
}

fn indented(value: &Value, depth: usize, text: &mut String) {
    let is_scalar = |value: &Value| !(value.is_array() || value.is_object());
    let (items, [open, close]): (Vec<(String, &Value)>, _) = match value {
        Value::Object(fields) if !fields.is_empty() => {
            let named = |(name, value)| (format!("{}: ", Value::from(name)), value);
            (fields.iter().map(|(name, value)| named((name.as_str(), value))).collect(), ["{", "}"])
        }
        // A row of a table has lists in it at most.
        Value::Array(items) if !items.iter().all(is_scalar) && !is_scalar(&items[0]) => {
            (items.iter().map(|item| (String::new(), item)).collect(), ["[", "]"])
        }
        _ => return text.push_str(&value.to_string()),
    };
    text.push_str(open);
    for (k, (name, item)) in items.iter().enumerate() {
        let comma = if k == 0 { "" } else { "," };
        text.extend([comma, "\n", &"  ".repeat(depth + 1), name]);
        indented(item, depth + 1, text);
    }
    text.extend(["\n", &"  ".repeat(depth), close]);
}

/// Collects the names of the fields that are null in `value`, which stands in `field`, each with its
/// reason.
fn explain(value: &Value, field: &str, nulls: &mut Map<String, Value>) {
    match value {
        Value::Null => drop(nulls.insert(field.into(), reason(field).into())),
        Value::Array(values) => values.iter().for_each(|value| explain(value, field, nulls)),
        Value::Object(fields) => {
            fields.iter().for_each(|(field, value)| explain(value, field, nulls));
        }
        _ => (),
    }
}

/// Writes what one call of `c_cnt` found.
pub fn pairs(pairs: &Pairs<f64>) -> String {
    line(&pairs_value(pairs))
}

/// Returns `ct`, `yt`, `dy` by contact node and `k_cnt` by node.
pub fn pairs_value(pairs: &Pairs<f64>) -> Value {
    let k_cnt: Vec<Vec<f64>> =
        (1..=pairs.k_cnt.rows()).map(|n| pairs.k_cnt.row(n).copied().collect()).collect();
    json!({
        "ct": pairs.ct.as_slice(),
        "yt": pairs.yt.as_slice(),
        "dy": pairs.dy.as_slice(),
        "k_cnt": k_cnt,
    })
}
