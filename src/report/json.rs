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
