//! A snapshot and its file: recorded, written, and read by the one reader.

use std::collections::HashSet;
use std::io;
use std::path::Path;

use indexmap::IndexMap;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::numbers::Tolerance;
use super::summary::{self, Summary};
use super::{FORMAT, Input, Options, Quantity, Run, VERSION, record};
use base::error::{InputError, Result};
use base::files::{self, json};
use base::plain::shown;
use engine::{Request, check};
use output::json::pretty;
use problem::scene::{Scene, Units};

/// How a snapshot is made.
const FIX: &str = "give a snapshot as `plane-contact snapshot record` writes it";

/// What a scene gives, by runs under different options. Lengths, stresses and forces are in the units
/// of the scene.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Snapshot {
    /// The version of the format.
    pub format: u32,
    /// The version of the program that recorded it.
    pub version: String,
    /// What a reviewer reads of each run, made of the rest.
    #[serde(default)]
    pub summary: IndexMap<String, Summary>,
    /// The tolerance of all arrays that give none of their own, nor have one of their run.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tolerance: Option<Tolerance>,
    /// The units of the scene by quantity, each empty where the scene names none.
    pub units: Units,
    /// The path of the scene file from the folder of the snapshot, with `/`; absent where the scene has none
    /// there.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub scene_file: Option<String>,
    /// The scene and its mesh, whole.
    pub input: Input,
    /// The runs by name.
    pub runs: IndexMap<String, Run>,
}

impl Snapshot {
    /// Runs requests of a scene and records what comes of each.
    ///
    /// # Errors
    /// The input is at fault, or two of the requests are the same.
    pub fn record(scene: &Scene, requests: &[Request]) -> engine::error::Result<Self> {
        let mut names = HashSet::new();
        for request in requests {
            check(request)?;
            let name = Options::from_request(request).name();
            if !names.insert(name.clone()) {
                let what = format!("{name} is asked for twice");
                return Err(InputError::new("variant", what, "name it once").into());
            }
        }
        let recorded: engine::error::Result<Vec<Run>> = requests.par_iter().map(record).collect();
        let runs = recorded?.into_iter().map(|run| (run.options.name(), run)).collect();
        Ok(Snapshot::of_runs(scene, None, None, runs))
    }

    /// Returns the snapshot of runs that this program made of a scene, read from `scene_file`.
    pub(super) fn of_runs(
        scene: &Scene,
        scene_file: Option<String>,
        tolerance: Option<Tolerance>,
        runs: IndexMap<String, Run>,
    ) -> Self {
        let (version, units, input) =
            (VERSION.into(), scene.units.clone(), Input::from_scene(scene));
        let (format, summary) = (FORMAT, IndexMap::new());
        let snapshot =
            Snapshot { format, version, summary, tolerance, units, scene_file, input, runs };
        snapshot.summarised(scene)
    }

    /// Sums up the runs of a scene anew.
    pub(super) fn summarised(self, scene: &Scene) -> Self {
        let mut own = self.with_tolerances();
        // A file that another program wrote may have them in another order.
        own.runs.values_mut().for_each(Run::sort);
        let of = |(name, run): (&String, &Run)| (name.clone(), summary::of(run, scene));
        Snapshot { summary: own.runs.iter().map(of).collect(), ..self }
    }

    /// Returns whether its summary is that of its runs on its scene, which no hand changed since.
    pub(super) fn is_summed_up(&self, scene: &Scene) -> bool {
        self.clone().summarised(scene).summary == self.summary
    }

    /// Returns the snapshot with its tolerance in each run that gives none.
    pub(super) fn with_tolerances(&self) -> Self {
        let mut own = self.clone();
        own.runs.values_mut().for_each(|run| run.tolerance = run.tolerance.or(self.tolerance));
        own
    }

    /// Returns the scene that was recorded.
    ///
    /// # Errors
    /// It was changed after it was recorded, or is at fault.
    pub fn scene(&self) -> Result<Scene> {
        self.input.build().map_err(|error| error.within("the snapshot"))
    }

    /// Leaves out all numbers but those of the end that `only` names (of [`FIELDS`](super::FIELDS)), and all
    /// iterations; of none nothing.
    pub fn keep_only(&mut self, only: &[Quantity]) {
        let only = (!only.is_empty()).then(|| only.to_vec());
        self.runs.values_mut().for_each(|run| run.keep_only(only.clone()));
    }

    /// Returns the text of its file.
    pub fn text(&self) -> String {
        pretty(self)
    }

    /// Returns the text of its file, which can be read again.
    ///
    /// # Errors
    /// It is too large.
    pub fn readable_text(&self) -> Result<String> {
        let text = self.text();
        let checked = json::check_size(&text, "the snapshot");
        checked.map_err(|error| InputError { fix: "record less by --only u".into(), ..error })?;
        Ok(text)
    }

    /// Reads the snapshot in a file, of which `text` was read.
    ///
    /// # Errors
    /// Those of [`Snapshot::read`], within the file; or it could not be read.
    pub fn of_file(file: &Path, text: &io::Result<Vec<u8>>) -> Result<Self> {
        let place = shown(file);
        let text = text.as_ref().map_err(|why| {
            InputError::new(&place, format!("the snapshot cannot be read: {why}"), FIX)
        })?;
        Snapshot::read(text).map_err(|error| error.within(&place))
    }

    /// Reads a snapshot.
    ///
    /// # Errors
    /// Names the field that is wrong or lacking, a number that is out of its range, or a format that this
    /// program does not know.
    pub fn read(text: &[u8]) -> Result<Self> {
        #[derive(Deserialize)]
        struct Head {
            format: Option<u32>,
        }
        let kind = json::Kind { name: "snapshot", fix: FIX };
        // What cannot be read is named below.
        let head = files::utf8(text).ok().and_then(|text| serde_json::from_str(text).ok());
        if let Some(Head { format }) = head
            && format != Some(FORMAT)
        {
            let found = format.map_or("names no format".into(), |n| format!("is of format {n}"));
            let what = format!("the snapshot {found}; this program reads format {FORMAT}");
            let error = InputError::new("field format", what, FIX);
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
