//! Sweeps: one scene under many values of its fields and of options, as a list of jobs.
//!
//! ```text
//!  sweep.json --Jobs--> Job: values by pointer, and the key, a hash of all that it reads
//!                        |
//!                        +--run--> Row, what came of it; its file is named by the key
//! ```

pub(crate) mod command;
pub mod engines;

use std::collections::HashMap;
use std::path::Path;
use std::sync::{Mutex, PoisonError};

use serde::Deserialize;
use serde_json::{Map, Number, Value, json};

use crate::snapshot::{Options, VERSION};
use base::error::{InputError, Result};
use base::files::json::{Kind, read, read_field};
use base::limits;
use engine::error::Error;
use engine::{Request, Solution, max_displacement, solve, summaries};
use problem::scene::file::SCENE;
use problem::scene::{SceneBuilder, SceneFile, sha256, sha256_of};

/// Files of sweeps.
const SWEEP: Kind = Kind { name: "sweep", fix: "see `plane-contact sweep --help`" };

/// The version of the format.
const FORMAT: u32 = 1;

/// The most jobs of a sweep.
const MOST_JOBS: usize = 100_000;

/// The most levels of a pointer; a job's document has fewer.
const DEEPEST: usize = 32;

/// The file of a sweep: a scene, options as a snapshot has them, and the values that take turns, by JSON
/// pointer (RFC 6901) into both: `/scene/contact/c_tll`, `/options/variant`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Sweep {
    format: u32,
    /// The name of an embedded scene, or a path beside the file of the sweep.
    scene: String,
    #[serde(default)]
    options: Map<String, Value>,
    /// Values by pointer; every combination is a job, the last pointer varying fastest.
    #[serde(default)]
    grid: Map<String, Value>,
    /// Jobs by their values; with a grid each of them takes every combination of the grid.
    #[serde(default)]
    list: Vec<Map<String, Value>>,
}

/// Equal steps, or with `log` equal factors, from one number to another.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Steps {
    from: f64,
    to: f64,
    count: usize,
    #[serde(default)]
    log: bool,
}

/// What came of a job, by column.
pub type Row = Map<String, Value>;

/// What takes turns: each time the values of one or several pointers.
type Axis = Vec<Map<String, Value>>;

/// The jobs of a sweep, the product of its axes: each is made when it is asked for.
pub struct Jobs {
    scene: SceneFile,
    /// `scene` and `options`, of which each job has a copy with other values.
    base: Value,
    /// The list, then the pointers of the grid, of which the last varies fastest.
    axes: Vec<Axis>,
    /// How many there are.
    pub count: usize,
    /// The hashes of the meshes that were read, by name.
    meshes: Mutex<HashMap<String, Result<String, String>>>,
}

/// A job of a sweep.
pub struct Job {
    /// What takes turns: values by pointer.
    pub values: Map<String, Value>,
    /// The SHA-256 of all that it reads, and of the program's version: the name of its result.
    pub key: String,
}

impl Jobs {
    /// Lists the jobs of the sweep in a file's text; its scene is in `folder`.
    ///
    /// # Errors
    /// Names the field that is wrong, or says that the scene cannot be read, or that there are too many
    /// jobs.
    pub fn read(text: &[u8], folder: &Path) -> Result<Self> {
        let sweep: Sweep = read(text, &SWEEP)?;
        if sweep.format != FORMAT {
            let what = format!("the sweep is of format {}", sweep.format);
            return Err(InputError::new("field format", what, "this program reads format 1"));
        }
        let scene = SceneFile::read_in(folder, &sweep.scene)?;
        let fields: Value = read(&scene.text, &SCENE).map_err(|error| error.within(&scene.name))?;
        let base = json!({"scene": fields, "options": sweep.options});
        let list = if sweep.list.is_empty() { vec![Map::new()] } else { sweep.list };
        let of_grid = sweep.grid.into_iter().map(|(pointer, values)| axis(&pointer, values));
        let axes = std::iter::once(Ok(list)).chain(of_grid).collect::<Result<Vec<Axis>>>()?;
        let count = axes.iter().map(Vec::len).fold(1, usize::saturating_mul);
        if count > MOST_JOBS {
            return Err(too_many());
        }
        check_size(&axes, count)?;
        check_pointers(&axes)?;
        Ok(Jobs { scene, base, axes, count, meshes: Mutex::default() })
    }

    /// Returns all jobs, in order.
    ///
    /// # Errors
    /// Those of [`Self::job`].
    pub fn all(&self) -> Result<Vec<Job>> {
        (0..self.count).map(|k| self.job(k)).collect()
    }

    /// Returns a job by its number, which is below the count; the last axis varies fastest.
    ///
    /// # Errors
    /// A pointer leads nowhere.
    pub fn job(&self, number: usize) -> Result<Job> {
        let (mut rest, mut turns) = (number, Vec::new());
        for axis in self.axes.iter().rev() {
            turns.push(axis[rest % axis.len()].clone());
            rest /= axis.len();
        }
        let values: Map<String, Value> = turns.into_iter().rev().flatten().collect();
        let key =
            self.key(&values, &mut self.meshes.lock().unwrap_or_else(PoisonError::into_inner))?;
        Ok(Job { values, key })
    }

    /// Returns the document that a job stands for.
    fn document(&self, values: &Map<String, Value>) -> Result<Value> {
        let mut document = self.base.clone();
        for (pointer, value) in values {
            let is_inside = ["/scene/", "/options/"].iter().any(|part| pointer.starts_with(part));
            let is_set = is_inside && set(&mut document, pointer, value).is_some();
            is_set.then_some(()).ok_or_else(|| {
                let what = format!("the pointer {pointer:?} leads into no part of a job");
                let fix = "point into /scene or /options, such as /scene/contact/c_tll";
                InputError::new("grid and list", what, fix)
            })?;
        }
        Ok(document)
    }

    /// Returns the key of the job with these values; `meshes` are the hashes that are known, by name.
    fn key(
        &self,
        values: &Map<String, Value>,
        meshes: &mut HashMap<String, Result<String, String>>,
    ) -> Result<String> {
        let document = self.document(values)?;
        let hash =
            |name: &str| sha256_of(&*self.scene.beside(name)?).map_err(|why| why.to_string());
        let mesh = document["scene"]["mesh"].as_str();
        let mesh = mesh.map(|name| meshes.entry(name.into()).or_insert_with(|| hash(name)).clone());
        Ok(sha256(&json!([VERSION, document, mesh])))
    }

    /// Returns what a job asks for.
    ///
    /// # Errors
    /// The scene or the options are at fault.
    pub fn request(&self, job: &Job) -> Result<Request> {
        let document = self.document(&job.values)?;
        let text = document["scene"].to_string();
        let beside = |name: &str| self.scene.beside(name);
        let scene = SceneBuilder::read(&self.scene.name, text.as_bytes(), beside)?.build()?;
        let options: Options = read_field(&document["options"], &SWEEP, "options")?;
        options.request(&scene)
    }

    /// Runs a job; what fails is a row too.
    ///
    /// # Errors
    /// The mesh was changed since the jobs were listed.
    pub fn run(&self, job: &Job) -> Result<Row> {
        let request = self.request(job).map_err(Error::Input);
        let solved = request.and_then(|request| solve(&request, &mut |_| ()));
        if self.key(&job.values, &mut HashMap::new())? != job.key {
            let what = "a mesh was changed while the sweep ran";
            return Err(InputError::new("field mesh", what, "run the sweep again"));
        }
        Ok(match solved {
            Ok(solution) => row(&solution),
            Err(why) => {
                known(json!({"exit_status": why.exit_status().number(), "error": why.to_string()}))
            }
        })
    }
}

/// Checks that the values of all jobs, of which there are so many, fit in memory.
fn check_size(axes: &[Axis], count: usize) -> Result<()> {
    // Each value is one of as many jobs as there are combinations of the others.
    let bytes = axes.iter().filter(|axis| !axis.is_empty()).map(|axis| {
        let own: usize = axis.iter().map(|turn| json!(turn).to_string().len()).sum();
        own.saturating_mul(count / axis.len())
    });
    limits::JOBS.check(bytes.fold(0, usize::saturating_add), "grid and list")
}

/// Checks that no pointer of a job leads to a part of what another one sets: the later one would undo the
/// earlier.
fn check_pointers(axes: &[Axis]) -> Result<()> {
    // All turns of an axis of the grid have one pointer.
    let of_grid = || axes[1..].iter().filter_map(|axis| axis.first()).flat_map(Map::keys);
    for job in &axes[0] {
        let all = job.keys().chain(of_grid()).map(|own| (unescaped(own) + "/", own));
        let mut all: Vec<(String, &String)> = all.collect();
        all.sort();
        if let Some(pair) = all.windows(2).find(|pair| pair[1].0.starts_with(&pair[0].0)) {
            let [outer, inner] = [0, 1].map(|k| pair[k].1);
            let what = format!("the pointer {inner:?} leads into what {outer:?} sets");
            let fix = "leave one of them out, or set the whole by one pointer";
            return Err(InputError::new("grid and list", what, fix));
        }
    }
    Ok(())
}

/// Returns a pointer whose names stand as they are, but for a slash in them.
fn unescaped(pointer: &str) -> String {
    pointer.replace("~1", "\u{1}").replace("~0", "~")
}

fn too_many() -> InputError {
    let what = format!("there are more than {MOST_JOBS} jobs");
    InputError::new("grid and list", what, "divide the sweep")
}

/// Returns the axis of a pointer of the grid: its values are a list, or steps.
fn axis(pointer: &str, values: Value) -> Result<Axis> {
    let turn = |value: Value| Map::from_iter([(pointer.to_string(), value)]);
    let fault = |what, fix| InputError::new(format!("grid {pointer:?}"), what, fix);
    let Steps { from, to, count, log } = match values {
        Value::Array(list) => return Ok(list.into_iter().map(turn).collect()),
        steps => serde_json::from_value(steps).map_err(|_| {
            let what = "the values are neither a list nor steps";
            fault(what, "give a list, or {\"from\": 1, \"to\": 2, \"count\": 5}")
        })?,
    };
    let fix = "give steps such as {\"from\": 1e-4, \"to\": 1e-2, \"count\": 5, \"log\": true}";
    if log && (from == 0.0 || to == 0.0 || from.signum() != to.signum()) {
        let what = "equal factors need two ends of one sign, none of which is 0";
        return Err(fault(what, fix));
    }
    if count > MOST_JOBS {
        return Err(too_many());
    }
    let value = |k: usize| match (log, if count < 2 { 0.0 } else { k as f64 / (count - 1) as f64 })
    {
        (_, 0.0) => from,
        (_, 1.0) => to,
        (false, t) => from + t * (to - from),
        (true, t) => from * (to / from).powf(t),
    };
    // No number of JSON stands for what is not finite: it would be null, which is the default.
    let step = |k| Number::from_f64(value(k)).map(Value::Number).map(turn);
    let steps = (0..count).map(step).collect::<Option<_>>();
    steps.ok_or_else(|| fault("the steps are no finite numbers", fix))
}

/// Sets the value that a pointer names; of an object a new field too. None where it leads nowhere.
fn set(document: &mut Value, pointer: &str, value: &Value) -> Option<()> {
    if pointer.split('/').count() > DEEPEST {
        return None;
    }
    if let Some(there) = document.pointer_mut(pointer) {
        *there = value.clone();
        return Some(());
    }
    let (parent, name) = pointer.rsplit_once('/')?;
    let parent = document.pointer_mut(parent)?.as_object_mut()?;
    parent.insert(name.replace("~1", "/").replace("~0", "~"), value.clone());
    Some(())
}

/// Returns what a solution says, flat, for a data frame; what has no value is left out.
fn row(solution: &Solution) -> Row {
    let last = solution.last();
    let pressures = solution.contact.iter().filter_map(|node| node.pressure);
    let gaps = solution.contact.iter().map(|node| node.gap);
    let mut row = json!({
        "exit_status": solution.exit_status().number(),
        "error": solution.doubt().map(|doubt| doubt.what),
        "iterations": solution.steps.len(),
        "in_contact": last.in_contact,
        "cycle": last.cycle.as_ref().map(|cycle| cycle.length),
        "max_displacement": max_displacement(&solution.u),
        "target_force": solution.target_force(),
        "max_pressure": pressures.reduce(f64::max),
        "min_gap": gaps.reduce(f64::min),
    });
    for body in summaries(solution) {
        row[format!("max_von_mises_stress {}", body.name)] = json!(body.max_von_mises_stress);
        row[format!("max_von_mises_strain {}", body.name)] = json!(body.max_von_mises_strain);
        row[format!("max_displacement {}", body.name)] = json!(body.max_displacement);
    }
    known(row)
}

/// Returns the fields of an object that have a value.
fn known(object: Value) -> Row {
    let fields = object.as_object().into_iter().flatten().filter(|(_, value)| !value.is_null());
    fields.map(|(name, value)| (name.clone(), value.clone())).collect()
}
