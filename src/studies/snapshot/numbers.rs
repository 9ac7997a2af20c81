//! Numbers of a run, each array with the bound on the rounding error of its numbers.

use std::borrow::Cow;

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::{Deserialize, Serialize};

/// The tolerance of numbers without a bound on their error, relative to the largest of the array.
pub const WITHOUT_BOUND: f64 = 1e-9;

/// An array of numbers.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Numbers {
    /// The unit, empty where the scene names none.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub unit: String,
    /// A bound on the rounding error of each number; null where none is known.
    pub bound: Option<f64>,
    /// The tolerance of a comparison in place of the bounds, where a user gives one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tolerance: Option<Tolerance>,
    pub values: Values,
}

/// The numbers of an array.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum Values {
    /// A number for each place.
    List(Vec<Number>),
    /// Rows, each of the number of a node or a triangle and its values.
    Rows(Vec<Row>),
}

/// A row: the number of a node or a triangle, then its values.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(from = "Vec<Number>", into = "Vec<serde_json::Value>")]
pub struct Row {
    pub label: f64,
    pub values: Vec<Number>,
}

/// A float; in a file null stands for one that is not finite, and reads back as NaN.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(from = "Option<f64>", into = "Option<f64>")]
pub struct Number(pub f64);

impl From<Option<f64>> for Number {
    fn from(x: Option<f64>) -> Self {
        Number(x.unwrap_or(f64::NAN))
    }
}

impl From<Number> for Option<f64> {
    fn from(x: Number) -> Self {
        Some(x.0)
    }
}

impl JsonSchema for Row {
    fn schema_name() -> Cow<'static, str> {
        "Row".into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        json_schema!({
            "type": "array",
            "description": "The number of a node or a triangle, then its values.",
            "prefixItems": [{ "type": "integer", "minimum": 1 }],
            "items": generator.subschema_for::<Number>(),
            "minItems": 2,
        })
    }
}

impl From<Vec<Number>> for Row {
    fn from(numbers: Vec<Number>) -> Self {
        let (label, values) = match numbers.split_first() {
            Some((label, values)) => (label.0, values.to_vec()),
            None => (f64::NAN, Vec::new()),
        };
        Row { label, values }
    }
}

impl From<Row> for Vec<serde_json::Value> {
    fn from(row: Row) -> Self {
        let label = serde_json::Value::from(row.label as u64);
        let values = row.values.into_iter().map(|x| serde_json::Value::from(x.0));
        std::iter::once(label).chain(values).collect()
    }
}

/// The tolerance of a comparison.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Tolerance {
    /// A number, in the unit of what is compared.
    Absolute(f64),
    /// A part of the largest number of the array.
    Relative(f64),
    /// A number of units in the last place of the number itself.
    Ulps(f64),
}

impl Tolerance {
    /// Returns the largest difference that is no difference from `value`, in an array whose largest
    /// number is `largest`.
    pub fn limit(self, value: f64, largest: f64) -> f64 {
        match self {
            Tolerance::Absolute(limit) => limit,
            Tolerance::Relative(part) => part * largest,
            Tolerance::Ulps(count) => count * (value.abs().next_up() - value.abs()),
        }
    }
}

impl Numbers {
    /// Returns numbers in a list.
    pub fn list(unit: &str, values: impl IntoIterator<Item = f64>, bound: Option<f64>) -> Self {
        let values = Values::List(values.into_iter().map(Number).collect());
        Numbers { unit: unit.into(), bound: known(bound), tolerance: None, values }
    }

    /// Returns numbers in rows, each of a node's or a triangle's number and its values.
    pub fn rows<const N: usize>(
        unit: &str,
        rows: impl IntoIterator<Item = (usize, [f64; N])>,
        bound: Option<f64>,
    ) -> Self {
        let row = |(label, values): (usize, [f64; N])| Row {
            label: label as f64,
            values: values.map(Number).to_vec(),
        };
        let values = Values::Rows(rows.into_iter().map(row).collect());
        Numbers { unit: unit.into(), bound: known(bound), tolerance: None, values }
    }

    /// Returns each number with its place: the row's label or the place in the list, from 1, and the
    /// component, from 0.
    pub fn places(&self) -> Vec<((f64, usize), f64)> {
        match &self.values {
            Values::List(list) => {
                list.iter().enumerate().map(|(k, x)| (((k + 1) as f64, 0), x.0)).collect()
            }
            Values::Rows(rows) => rows
                .iter()
                .flat_map(|row| {
                    let label = row.label;
                    row.values.iter().enumerate().map(move |(c, x)| ((label, c), x.0))
                })
                .collect(),
        }
    }

    /// Returns the size of the largest number, 0 of none.
    pub fn largest(&self) -> f64 {
        self.places().iter().fold(0.0, |m: f64, (_, x)| m.max(x.abs()))
    }
}

fn known(bound: Option<f64>) -> Option<f64> {
    bound.filter(|bound| bound.is_finite())
}
