//! The file of a sweep: what is run, and which values take turns.

use std::path::Path;

use serde::{Deserialize, Serialize};
use serde_json::{Map, Number, Value};

use super::document::{Document, SWEEP};
use base::error::{InputError, Result};
use base::files::json;
use problem::scene::SceneFile;

/// The version of the format.
const FORMAT: u32 = 1;

/// The most cases of a sweep.
const MOST_CASES: usize = 10_000_000;

/// A sweep: a scene or a generator, options, and the values that take turns, by JSON pointer
/// (RFC 6901) into the document of a case: `/scene/contact/c_tll`, `/options/variant`,
/// `/generate/n`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Sweep {
    /// The version of the format.
    pub format: u32,
    /// The name of an embedded scene, or a path beside the file of the sweep.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub scene: Option<String>,
    /// The generator in place of a scene: its `kind`, and its parameters by the names of their
    /// options.
    #[serde(default, skip_serializing_if = "Map::is_empty")]
    pub generate: Map<String, Value>,
    /// Options of every case, as a snapshot has them.
    #[serde(default, skip_serializing_if = "Map::is_empty")]
    pub options: Map<String, Value>,
    /// Values by pointer; every combination is a case, the last pointer varying fastest.
    #[serde(default, skip_serializing_if = "Map::is_empty")]
    pub grid: Map<String, Value>,
    /// Cases by their values; with a grid each of them takes every combination of the grid.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub list: Vec<Map<String, Value>>,
}

/// The values of a pointer in a grid: a list, or equal steps from one number to another.
pub enum Values {
    List(Vec<Value>),
    Steps(Steps),
}

/// Equal steps, or with `log` equal factors, from one number to another.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Steps {
    from: f64,
    to: f64,
    count: usize,
    #[serde(default)]
    log: bool,
}

impl Values {
    /// Returns the values that stand in a file; None where these are none. A list is not copied.
    fn from_json(values: Value) -> Option<Self> {
        match values {
            Value::Array(list) => Some(Values::List(list)),
            steps => serde_json::from_value(steps).ok().map(Values::Steps),
        }
    }

    fn count(&self) -> usize {
        match self {
            Values::List(list) => list.len(),
            Values::Steps(steps) => steps.count,
        }
    }

    /// Returns the values.
    ///
    /// # Errors
    /// A step is no finite number.
    fn list(self) -> Result<Vec<Value>, &'static str> {
        let Steps { from, to, count, log } = match self {
            Values::List(list) => return Ok(list),
            Values::Steps(steps) => steps,
        };
        if log && (from == 0.0 || to == 0.0 || from.signum() != to.signum()) {
            return Err("equal factors need two ends of one sign, none of which is 0");
        }
        let place = |k: usize| if count < 2 { 0.0 } else { k as f64 / (count - 1) as f64 };
        let value = |k: usize| match (log, place(k)) {
            (_, 0.0) => from,
            (_, 1.0) => to,
            (false, t) => from + t * (to - from),
            (true, t) => from * (to / from).powf(t),
        };
        // No number of JSON stands for what is not finite: it would be null, which is the default.
        let step = |k| Number::from_f64(value(k)).map(Value::Number);
        (0..count).map(step).collect::<Option<_>>().ok_or("the steps are no finite numbers")
    }
}

/// The cases of a sweep, each made where it is asked for.
pub struct Cases {
    base: Document,
    grid: Vec<(String, Vec<Value>)>,
    list: Vec<Map<String, Value>>,
}

impl Sweep {
    /// Reads the file of a sweep.
    ///
    /// # Errors
    /// Names the field that is wrong.
    pub fn read(text: &[u8]) -> Result<Self> {
        let sweep: Self = json::read(text, &SWEEP)?;
        if sweep.format != FORMAT {
            let what = format!("the sweep is of format {}", sweep.format);
            return Err(InputError::new("field format", what, "this program reads format 1"));
        }
        Ok(sweep)
    }

    /// Returns the cases; files are beside `folder`.
    ///
    /// # Errors
    /// The scene cannot be read, the values of a pointer are no values, or there are too many cases.
    pub fn cases(self, folder: &Path) -> Result<Cases> {
        let scene =
            self.scene.as_deref().map(|name| SceneFile::read_in(folder, name)).transpose()?;
        let base = Document::new(scene, &self.generate, &self.options)?;
        self.grid.keys().chain(self.list.iter().flat_map(Map::keys)).try_for_each(check_pointer)?;
        let list = if self.list.is_empty() { vec![Map::new()] } else { self.list };
        let mut grid: Vec<(String, Values)> = Vec::new();
        for (pointer, values) in self.grid {
            let values = Values::from_json(values).ok_or_else(|| {
                let what = "the values are neither a list nor steps";
                let fix = "give a list, or {\"from\": 1, \"to\": 2, \"count\": 5}";
                InputError::new(grid_field(&pointer), what, fix)
            })?;
            grid.push((pointer, values));
        }
        // Counted before the values are listed.
        let sizes = grid.iter().map(|(_, values)| values.count().max(1));
        if sizes.fold(list.len(), usize::saturating_mul) > MOST_CASES {
            let what = format!("there are more than {MOST_CASES} cases");
            return Err(InputError::new("grid and list", what, "divide the sweep"));
        }
        let listed = |(pointer, values): (String, Values)| {
            let fix =
                "give steps such as {\"from\": 1e-4, \"to\": 1e-2, \"count\": 5, \"log\": true}";
            let values = values.list();
            let values = values.map_err(|what| InputError::new(grid_field(&pointer), what, fix))?;
            Ok((pointer, values))
        };
        let grid = grid.into_iter().map(listed).collect::<Result<_>>()?;
        Ok(Cases { base, grid, list })
    }
}

fn grid_field(pointer: &str) -> String {
    format!("grid {pointer:?}")
}

/// Checks that a pointer leads into one of the parts of a case's document.
fn check_pointer(pointer: &String) -> Result<()> {
    let parts = ["/scene/", "/options/", "/generate/"];
    if parts.iter().any(|part| pointer.starts_with(part)) {
        return Ok(());
    }
    let what = format!("the pointer {pointer:?} leads into no part of a case");
    let fix = "begin it with /scene/, /options/ or /generate/, such as /scene/contact/c_tll";
    Err(InputError::new("grid and list", what, fix))
}

impl Cases {
    /// Returns the number of cases.
    pub fn len(&self) -> usize {
        self.grid.iter().map(|(_, values)| values.len()).product::<usize>() * self.list.len()
    }

    /// Returns whether there is no case.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Returns what takes turns in case `k`, from 0: values by pointer.
    pub fn values(&self, k: usize) -> Map<String, Value> {
        let mut rest = k;
        let mut of_grid = Vec::new();
        for (pointer, values) in self.grid.iter().rev() {
            of_grid.push((pointer.clone(), values[rest % values.len()].clone()));
            rest /= values.len();
        }
        let mut values = self.list[rest].clone();
        values.extend(of_grid.into_iter().rev());
        values
    }

    /// Returns the document of case `k`, from 0.
    ///
    /// # Errors
    /// A pointer leads nowhere.
    pub fn document(&self, k: usize) -> Result<Document> {
        self.base.with(&self.values(k))
    }
}
