//! Sweeps: one scene under many values of its fields and of options, as a list of jobs.
//!
//! ```text
//!  sweep.json --Jobs--> Job: values by pointer, and the key, a hash of all that it reads
//!                        |
//!                        +--run--> Row, what came of it; its file is named by the key
//! ```

pub(crate) mod command;
pub mod table;

use std::collections::HashMap;
use std::path::Path;

use serde::Deserialize;
use serde_json::{Map, Number, Value, json};

use crate::snapshot::{Options, VERSION};
use base::error::{InputError, Result};
use base::files::json::{Kind, read, read_field};
use engine::error::Error;
use engine::{Request, Solution, max_displacement, solve, summaries};
use problem::scene::file::SCENE;
use problem::scene::{SceneBuilder, SceneFile, sha256, sha256_of};

/// Files of sweeps.
const SWEEP: Kind =
    Kind { name: "sweep", fix: "see `plane-contact sweep --help`", has_values: true };

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

/// The jobs of a sweep.
pub struct Jobs {
    scene: SceneFile,
    /// `scene` and `options`, of which each job has a copy with other values.
    base: Value,
    /// The jobs, in order.
    pub list: Vec<Job>,
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
        let mut all = if sweep.list.is_empty() { vec![Map::new()] } else { sweep.list };
        if all.len() > MOST_JOBS {
            return Err(too_many());
        }
        for (pointer, values) in sweep.grid {
            let values = listed(&pointer, values)?;
            if all.len().saturating_mul(values.len()) > MOST_JOBS {
                return Err(too_many());
            }
            let with = |job: &Map<String, Value>, value: &Value| {
                let mut job = job.clone();
                job.insert(pointer.clone(), value.clone());
                job
            };
            all = all.iter().flat_map(|job| values.iter().map(move |v| with(job, v))).collect();
        }
        let mut jobs = Jobs { scene, base, list: Vec::new() };
        let mut meshes = HashMap::new();
        let of = |values| Ok(Job { key: jobs.key(&values, &mut meshes)?, values });
        jobs.list = all.into_iter().map(of).collect::<Result<_>>()?;
        Ok(jobs)
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
        Ok(options.request(&scene))
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
                let row =
                    json!({"exit_status": why.exit_status().number(), "error": why.to_string()});
                row.as_object().expect("it is an object").clone()
            }
        })
    }
}

fn too_many() -> InputError {
    let what = format!("there are more than {MOST_JOBS} jobs");
    InputError::new("grid and list", what, "divide the sweep")
}

/// Returns the values of a pointer in a grid: those of a list, or steps.
fn listed(pointer: &str, values: Value) -> Result<Vec<Value>> {
    let fault = |what, fix| InputError::new(format!("grid {pointer:?}"), what, fix);
    let Steps { from, to, count, log } = match values {
        Value::Array(list) => return Ok(list),
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
    let step = |k| Number::from_f64(value(k)).map(Value::Number);
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
    let mut row = Row::new();
    let last = solution.last();
    let mut set = |name: &str, value: Value| {
        if !value.is_null() {
            row.insert(name.into(), value);
        }
    };
    set("exit_status", json!(solution.exit_status().number()));
    set("error", json!(solution.doubt().map(|doubt| doubt.what)));
    set("iterations", json!(solution.steps.len()));
    set("in_contact", json!(last.in_contact));
    set("cycle", json!(last.cycle.as_ref().map(|cycle| cycle.length)));
    set("max_displacement", json!(max_displacement(&solution.u)));
    set("target_force", json!(solution.target_force()));
    let pressures = solution.contact.iter().filter_map(|node| node.pressure);
    set("max_pressure", json!(pressures.reduce(f64::max)));
    let gaps = solution.contact.iter().map(|node| node.gap);
    set("min_gap", json!(gaps.reduce(f64::min)));
    for body in summaries(solution) {
        set(&format!("max_von_mises_stress {}", body.name), json!(body.max_von_mises_stress));
        set(&format!("max_von_mises_strain {}", body.name), json!(body.max_von_mises_strain));
        set(&format!("max_displacement {}", body.name), json!(body.max_displacement));
    }
    row
}
