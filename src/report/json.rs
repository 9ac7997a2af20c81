//! What several reports write as JSON.

use serde::Serialize;
use serde_json::{Value, json};

use crate::paper::mirror::Pairs;

/// Writes a document on one line. Floats read back to the same bits; what is not finite is null.
pub fn line(document: &impl Serialize) -> String {
    serde_json::to_string(document).expect("a document has string keys only") + "\n"
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
