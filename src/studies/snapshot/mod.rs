//! Regression snapshots: what a scene gives, recorded; verified later by running it again; and where
//! it differs, what went in and differs too, and what differed first.
//!
//! ```text
//!  Scene --input--> Input --+                                 +--> Difference --> First
//!  Request --record--> Run -+--> Snapshot --verify--> compare +
//!                                    ^---- accept             +--> Change
//! ```
//!
//! Discrete facts (who is in contact, the target edge of each node, the number of iterations) stand
//! apart from numbers: facts are the same or not, numbers agree within the bounds on their rounding
//! errors.

mod changes;
pub(crate) mod command;
mod compare;
mod entry;
mod first;
mod input;
mod numbers;
mod record;
pub mod table;
mod verify;
mod words;

use std::collections::HashSet;

use indexmap::IndexMap;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use serde_json::Value;

use base::error::{InputError, Result};
use base::files::{self, json};
use base::suggestion::did_you_mean;
use engine::Decision;
use engine::{Request, check};
use problem::scene::{Scene, Units};

pub use base::files::json::{FORMAT, VERSION};
pub use changes::Change;
pub use compare::{Difference, Kind, compare};
pub use engine::options::Options;
pub use entry::{Entry, FIELDS, Quantity};
pub use first::{First, Status};
pub use input::Input;
pub use numbers::{Number, Numbers, Tolerance, Values, WITHOUT_BOUND};
pub use record::{Bounds, record};
pub use verify::{Presence, Verified, VerifiedRun, accept, difference, verify};

/// What a scene gives, by runs under different options. Lengths, stresses and forces are in the units
/// of the scene.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Snapshot {
    /// The version of the format.
    pub format: u32,
    /// The version of the program that recorded it.
    pub version: String,
    /// The units of the scene by quantity, each empty where the scene names none.
    pub units: Units,
    /// The path of the scene file from the folder of the snapshot, with `/`; absent where the scene has none there.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub scene_file: Option<String>,
    /// The scene and its mesh, whole.
    pub input: Input,
    /// The runs by name.
    pub runs: IndexMap<String, Run>,
}

/// A run: what it was asked for and what came of it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Run {
    /// What was asked for in place of what the scene says.
    pub options: Options,
    /// The numbers of the end that were asked for, without those of the iterations; all where it is
    /// absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub only: Option<Vec<String>>,
    /// What is the same or not.
    pub facts: IndexMap<Entry, Value>,
    /// What is the same within bounds.
    pub numbers: IndexMap<Entry, Numbers>,
    /// The decisions on who is in contact that rounding may have taken.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub decided_by_rounding: Vec<Decision>,
}

impl Run {
    fn new(options: Options) -> Self {
        let (facts, numbers) = (IndexMap::new(), IndexMap::new());
        Run { options, only: None, facts, numbers, decided_by_rounding: Vec::new() }
    }

    /// Brings facts and numbers into the order of computation.
    fn sort(&mut self) {
        self.facts.sort_by_cached_key(|entry, _| entry.place());
        self.numbers.sort_by_cached_key(|entry, _| entry.place());
    }

    /// Returns whether an entry is one that the run was asked to record.
    fn keeps(&self, entry: Entry) -> bool {
        is_kept(&self.only, entry)
    }

    /// Leaves out what is not among the numbers `only`, where these are given.
    fn keep_only(&mut self, only: Option<Vec<String>>) {
        self.facts.retain(|entry, _| is_kept(&only, *entry));
        self.numbers.retain(|entry, _| is_kept(&only, *entry));
        self.only = only;
    }

    /// Checks what the types of its parts do not tell.
    ///
    /// # Errors
    /// A bound is negative; a number that is asked for has no name of one.
    fn check(&self) -> Result<()> {
        for (name, numbers) in self.numbers.iter() {
            for (field, value) in [("bound", numbers.bound), ("floor", Some(numbers.floor))] {
                if let Some(value) = value.filter(|value| *value < 0.0) {
                    let what = format!("the {field} on a rounding error is {value}");
                    let fix = "give a number from 0; null where no bound is known";
                    return Err(InputError::new(format!("numbers.{name}.{field}"), what, fix));
                }
            }
        }
        let known = FIELDS.map(Quantity::name);
        let mut asked = self.only.iter().flatten();
        asked.find(|name| !known.contains(&&***name)).map_or(Ok(()), |name| {
            let meant = did_you_mean(name, known);
            let what = format!("no numbers at the end of a run are named {name:?}");
            Err(InputError::new("only", what, format!("{meant}they are: {}", known.join(", "))))
        })
    }

    /// Returns the exit status of `solve` on this run, where the run has that fact.
    pub fn exit_status(&self) -> Option<u64> {
        self.fact(Quantity::ExitStatus)?.as_u64()
    }

    /// Returns a fact that was recorded.
    pub fn fact(&self, of: impl Into<Entry>) -> Option<&Value> {
        self.facts.get(&of.into())
    }
}

/// Returns whether an entry is recorded where the numbers `only` are asked for.
fn is_kept(only: &Option<Vec<String>>, entry: Entry) -> bool {
    let of_run = |quantity: &Quantity| entry == Entry::from(*quantity);
    let is_among =
        |only: &Vec<String>| FIELDS.iter().any(|q| of_run(q) && only.iter().any(|n| n == q.name()));
    only.as_ref().is_none_or(|only| is_among(only) || entry::FACTS.iter().any(of_run))
}

impl Snapshot {
    /// Runs requests of a scene and records what comes of each.
    ///
    /// # Errors
    /// The input is at fault, or two of the requests are the same.
    pub fn record(
        scene: &Scene,
        requests: &[Request],
        bounds: Bounds,
    ) -> engine::error::Result<Self> {
        let mut names = HashSet::new();
        for request in requests {
            check(request)?;
            let name = Options::from_request(request).name();
            if !names.insert(name.clone()) {
                let what = format!("{name} is asked for twice");
                return Err(InputError::new("variant", what, "name it once").into());
            }
        }
        let recorded: engine::error::Result<Vec<Run>> =
            requests.par_iter().map(|request| record(request, bounds)).collect();
        let runs = recorded?.into_iter().map(|run| (run.options.name(), run)).collect();
        Ok(Snapshot::of_runs(Input::from_scene(scene)?, None, runs))
    }

    /// Returns the snapshot of runs that this program made of an input, read from `scene_file`.
    fn of_runs(input: Input, scene_file: Option<String>, runs: IndexMap<String, Run>) -> Self {
        let (version, units) = (VERSION.into(), input.scene.units.clone());
        Snapshot { format: FORMAT, version, units, scene_file, input, runs }
    }

    /// Returns the scene that was recorded.
    ///
    /// # Errors
    /// It was changed after it was recorded, or is at fault.
    pub fn scene(&self) -> Result<Scene> {
        self.input.build().map_err(|error| error.within("the snapshot"))
    }

    /// Leaves out all numbers but those of the end that `only` names ([`FIELDS`]), and all iterations.
    pub fn keep_only(&mut self, only: &[String]) {
        self.runs.values_mut().for_each(|run| run.keep_only(Some(only.to_vec())));
    }

    /// Reads a snapshot.
    ///
    /// # Errors
    /// Names the field that is wrong or lacking, a number that is out of its range, or a format that this
    /// program does not know.
    pub fn read(text: &[u8]) -> Result<Self> {
        let fix = "give a snapshot as `plane-contact snapshot record` writes it";
        #[derive(Deserialize)]
        struct Head {
            format: Option<u32>,
        }
        let kind = json::Kind { name: "snapshot", fix, has_values: true };
        // What cannot be read is named below.
        let head = files::utf8(text).ok().and_then(|text| serde_json::from_str(text).ok());
        if let Some(Head { format }) = head
            && format != Some(FORMAT)
        {
            let found = format.map_or("names no format".into(), |n| format!("is of format {n}"));
            let what = format!("the snapshot {found}; this program reads format {FORMAT}");
            let error = InputError::new("field format", what, fix);
            return Err(json::instead(text, &kind).unwrap_or(error));
        }
        let snapshot: Self = json::read(text, &kind)?;
        if snapshot.units != snapshot.input.scene.units {
            let what = "the units are not those of the scene in the snapshot";
            let fix = "undo the change; in other units a scene is recorded anew";
            return Err(InputError::new("field units", what, fix));
        }
        for (name, run) in snapshot.runs.iter() {
            run.check().map_err(|error| error.within(&format!("run {name:?}")))?;
        }
        Ok(snapshot)
    }
}
