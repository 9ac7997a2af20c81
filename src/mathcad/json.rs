//! Values as JSON: a number; a list of rows for an array; a string.

use serde::ser::{Serialize, Serializer};
use serde_json::Value as Json;

use super::value::{Array, Grid, Value};

/// Returns the value that a JSON document spells: a list of lists is an array by rows, and any
/// other list a column.
///
/// # Errors
/// What cannot be a value of a worksheet.
pub fn read(json: &Json) -> Result<Value, String> {
    match json {
        Json::Number(x) => Ok(x.as_f64().unwrap_or(f64::NAN).into()),
        Json::Bool(truth) => Ok(f64::from(u8::from(*truth)).into()),
        Json::String(text) => Ok(Value::Text(text.as_str().into())),
        Json::Array(list) if list.is_empty() => Ok(Array::default().into()),
        Json::Array(list) if list.iter().all(Json::is_array) => rows(list),
        Json::Array(list) => {
            let entries = list.iter().map(read).collect::<Result<Vec<_>, _>>()?;
            Ok(Value::grid(Grid::from_rows(1, entries)))
        }
        Json::Null | Json::Object(_) => {
            Err("expected a number, a string, a list, or a list of rows".into())
        }
    }
}

fn rows(list: &[Json]) -> Result<Value, String> {
    let rows: Vec<&Vec<Json>> = list.iter().filter_map(Json::as_array).collect();
    let cols = rows[0].len();
    if cols == 0 || rows.iter().any(|row| row.len() != cols) {
        return Err("expected rows of one length".into());
    }
    let entries = rows.into_iter().flatten().map(read).collect::<Result<Vec<_>, _>>()?;
    Ok(Value::grid(Grid::from_rows(cols, entries)))
}

/// A value is written as JSON which [`read`] reads, entry by entry.
impl Serialize for Value {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        let (rows, cols) = self.size();
        match self {
            Value::Number(x) => to.serialize_f64(*x),
            Value::Text(text) => to.serialize_str(text),
            Value::Array(_) | Value::Nested(_) => {
                let row = |i| (0..cols).filter_map(|j| self.entry(i, j)).collect::<Vec<_>>();
                to.collect_seq((0..rows).map(row))
            }
        }
    }
}
