//! Numbers of a run, each array with what rounding does to it, measured.

use std::fmt;

use output::numbers::Digits;
use serde::{Deserialize, Serialize};

/// The tolerance of numbers of which it is not known what rounding does, relative to the largest of the
/// array.
pub const UNMEASURED: f64 = 1e-9;

/// How many times what rounding was seen to do is no difference: few runs underestimate it.
const MARGIN: f64 = 10.0;

/// The least that rounding does to a number, relative to the largest of its array.
const ROUNDED: f64 = 64.0 * f64::EPSILON;

/// An array of numbers.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Numbers {
    /// The unit, empty where the scene names none.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub unit: String,
    /// What rounding does to the numbers: the most that inputs changed in the last digit were seen to change
    /// of one; null where that was not measured, or changes who is in contact.
    pub bound: Option<f64>,
    /// What rounding does at the least, in files of earlier versions.
    #[serde(default, skip_serializing)]
    pub floor: f64,
    /// The tolerance of a comparison in place of what rounding does, where a user gives one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tolerance: Option<Tolerance>,
    /// The numbers.
    pub values: Values,
}

/// The numbers of an array.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged, expecting = "values are numbers, or rows of a number and its values")]
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

/// A float; in a file null stands for one that is not finite, and reads back as NaN. Two that are not
/// finite are equal.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
#[serde(from = "Option<f64>", into = "Option<f64>")]
pub struct Number(pub f64);

impl PartialEq for Number {
    fn eq(&self, other: &Self) -> bool {
        self.0 == other.0 || !self.0.is_finite() && !other.0.is_finite()
    }
}

impl fmt::LowerExp for Number {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        if self.0.is_finite() {
            fmt::LowerExp::fmt(&self.0, f)
        } else {
            f.write_str("no finite number")
        }
    }
}

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

/// The tolerance of a comparison: whatever it names suffices.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "Parts")]
pub struct Tolerance {
    /// A number, in the unit of what is compared.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub absolute: Option<f64>,
    /// A part of the largest number of the array.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub relative: Option<f64>,
    /// A number of units in the last place of the number itself.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub ulps: Option<f64>,
}

/// What a file says of a tolerance.
#[derive(Deserialize)]
#[serde(
    deny_unknown_fields,
    expecting = "an object with `absolute`, `relative` or `ulps`, or several of them,"
)]
struct Parts {
    absolute: Option<f64>,
    relative: Option<f64>,
    ulps: Option<f64>,
}

impl TryFrom<Parts> for Tolerance {
    type Error = String;

    fn try_from(Parts { absolute, relative, ulps }: Parts) -> Result<Self, String> {
        let all = [("absolute", absolute), ("relative", relative), ("ulps", ulps)];
        let mut given = all.into_iter().filter_map(|(name, value)| Some((name, value?))).peekable();
        let rule = "a tolerance is `absolute`, `relative` or `ulps`, or several of them, each a number from 0";
        if given.peek().is_none() {
            return Err(format!("it is empty: {rule}"));
        }
        match given.find(|(_, value)| *value < 0.0) {
            Some((name, value)) => Err(format!("`{name}` is {value}: {rule}")),
            None => Ok(Tolerance { absolute, relative, ulps }),
        }
    }
}

/// Returns the largest difference that is no difference from `value`, in an array whose largest number is
/// `largest`: by a tolerance, whose parts of a number are no less than what `rounding` does, else that.
pub fn limit(given: Option<Tolerance>, value: f64, largest: f64, rounding: Option<f64>) -> f64 {
    let Some(Tolerance { absolute, relative, ulps }) = given else {
        return rounding.unwrap_or(UNMEASURED * largest);
    };
    let ulp = value.abs().next_up() - value.abs();
    let parts = [relative.map(|part| part * largest), ulps.map(|count| count * ulp)];
    let parts = parts.map(|part| Some(part?.max(rounding.unwrap_or(0.0))));
    parts.into_iter().chain([absolute]).flatten().fold(0.0, f64::max)
}

impl Numbers {
    /// Returns numbers in a list.
    pub fn list(unit: &str, values: impl IntoIterator<Item = f64>) -> Self {
        Numbers::new(unit, Values::List(values.into_iter().map(Number).collect()))
    }

    fn new(unit: &str, values: Values) -> Self {
        Numbers { unit: unit.into(), bound: None, floor: 0.0, tolerance: None, values }
    }

    /// Notes what rounding does to the numbers: the most by which `others`, the same array of runs whose
    /// inputs differ in the last digit, are away from them.
    pub fn measure<'a>(&mut self, others: impl Iterator<Item = &'a Numbers>) {
        let own = self.places();
        let away = |other: &Numbers| {
            let pairs = own.iter().zip(other.places());
            pairs
                .map(|((_, a), (_, b))| (a - b).abs())
                .filter(|x| x.is_finite())
                .fold(0.0, f64::max)
        };
        self.bound = others.map(away).reduce(f64::max);
    }

    /// Returns the largest difference that rounding may make, where that was measured.
    pub fn rounding(&self) -> Option<f64> {
        let measured = self.bound.map(|bound| MARGIN * bound.max(ROUNDED * self.largest()));
        measured.or((self.floor > 0.0).then(|| self.floor.max(UNMEASURED * self.largest())))
    }

    /// Returns the largest difference that rounding may make where that is a thousandth of the numbers or
    /// more.
    pub fn most_of_noise(&self) -> Option<f64> {
        self.rounding().filter(|most| *most > 0.0 && *most >= 1e-3 * self.largest())
    }

    /// Writes a number with the digits that are compared, six at most, by the array's own tolerance, one that is `given` for
    /// all, or what rounding does.
    pub fn written(&self, x: f64, given: Option<Tolerance>) -> String {
        let largest = self.largest();
        let limit = limit(self.tolerance.or(given), x, largest, self.rounding());
        // What is no more than the limit is no other number than 0.
        let x = if x.abs() <= limit { 0.0 } else { x };
        Digits::of(largest, Some(if largest > 0.0 { limit / largest } else { 0.0 })).write(x)
    }

    /// Returns numbers in rows, each of a node's or a triangle's number and its values.
    pub fn rows<const N: usize>(
        unit: &str,
        rows: impl IntoIterator<Item = (usize, [f64; N])>,
    ) -> Self {
        let row = |(label, values): (usize, [f64; N])| Row {
            label: label as f64,
            values: values.map(Number).to_vec(),
        };
        Numbers::new(unit, Values::Rows(rows.into_iter().map(row).collect()))
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

    /// Returns number `k` of a list, from 0; None of rows.
    pub fn listed(&self, k: usize) -> Option<f64> {
        let Values::List(list) = &self.values else { return None };
        list.get(k).map(|x| x.0)
    }

    /// Returns the size of the largest finite number, 0 of none.
    pub fn largest(&self) -> f64 {
        let sizes = self.places().into_iter().map(|(_, x)| x.abs());
        sizes.filter(|size| size.is_finite()).fold(0.0, f64::max)
    }
}
