//! Regression snapshots: what a scene gives, recorded; verified later by running it again; and where
//! it differs, what differed first and why.
//!
//! ```text
//!  Scene --input--> Input --+
//!  Request --record--> Run -+--> Snapshot --verify--> compare --> Difference --explain--> cause
//!                                    ^---- accept (a new value, with its reason) <---+
//! ```
//!
//! Discrete facts (who is in contact, the target edge of each node, the number of iterations) stand
//! apart from numbers: facts are the same or not, numbers agree within the bounds on their rounding
//! errors.

mod accept;
mod compare;
mod entries;
mod expected;
mod explain;
mod facts;
mod flip;
mod input;
mod numbers;
mod options;
mod place;
mod record;
mod verify;

use rayon::prelude::*;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_json::Value;

use crate::answer::{Request, error as answer};
use crate::error::{InputError, Result};
use crate::files::json;
use crate::paper::decisions::Decision;
use crate::problem::scene::{Scene, Units};

pub use accept::{Acceptance, Chosen, accept};
pub use compare::{Difference, Kind, compare};
pub use entries::Entries;
pub use expected::{Expected, Origin};
pub use explain::{Cause, Class, Explanation, Side, explain};
pub use flip::Flip;
pub use input::Input;
pub use numbers::{Numbers, Tolerance, Values, WITHOUT_BOUND};
pub use options::Options;
pub use record::{Bounds, record};
pub use verify::{Verified, VerifiedRun, difference, verify};

/// The version of the format.
pub const FORMAT: u32 = 1;

/// The version of this program.
pub const VERSION: &str = env!("CARGO_PKG_VERSION");

/// What a scene gives, by runs under different options. Lengths, stresses and forces are in the units
/// of the scene.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Snapshot {
    /// The version of the format.
    pub format: u32,
    /// The version of the program that recorded it.
    pub version: String,
    /// The units of the scene by quantity, each empty where the scene names none.
    pub units: Units,
    /// The scene and its mesh, whole.
    pub input: Input,
    /// The runs by name.
    pub runs: Entries<Run>,
    /// What was accepted since, in order.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub log: Vec<Acceptance>,
}

/// A run: what it was asked for and what came of it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Run {
    /// What was asked for in place of what the scene says.
    pub options: Options,
    /// What is the same or not.
    #[schemars(schema_with = "facts::schema")]
    pub facts: Entries<Value>,
    /// What is the same within bounds.
    #[schemars(extend("propertyNames" = place::names()))]
    pub numbers: Entries<Numbers>,
    /// Numbers that a user expects, with their origin.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub expected: Vec<Expected>,
    /// The decisions on who is in contact that rounding may have taken.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub decided_by_rounding: Vec<Decision>,
}

impl Run {
    fn new(options: Options) -> Self {
        let (facts, numbers) = (Entries::default(), Entries::default());
        Run { options, facts, numbers, expected: Vec::new(), decided_by_rounding: Vec::new() }
    }

    /// Returns the exit status of `solve` on this run, where the run has that fact.
    pub fn exit_status(&self) -> Option<u64> {
        self.facts.get("exit status")?.as_u64()
    }
}

impl Snapshot {
    /// Runs requests of a scene and records what comes of each.
    ///
    /// # Errors
    /// The input is at fault, or two of the requests are the same.
    pub fn record(scene: &Scene, requests: &[Request], bounds: Bounds) -> answer::Result<Self> {
        let recorded: answer::Result<Vec<Run>> =
            requests.par_iter().map(|request| record(request, bounds)).collect();
        let mut runs = Entries::default();
        for run in recorded? {
            let name = run.options.name();
            if runs.get(&name).is_some() {
                let what = format!("{name} is asked for twice");
                return Err(InputError::new("--variant", what, "name it once").into());
            }
            runs.set(name, run);
        }
        let (version, units) = (VERSION.into(), scene.units.clone());
        let input = Input::of(scene)?;
        Ok(Snapshot { format: FORMAT, version, units, input, runs, log: Vec::new() })
    }

    /// Reads a snapshot.
    ///
    /// # Errors
    /// Names the field that is wrong or lacking, or a format that this program does not know.
    pub fn read(text: &[u8]) -> Result<Self> {
        let fix = "give a snapshot as `plane-contact record` writes it";
        #[derive(Deserialize)]
        struct Head {
            format: Option<u32>,
        }
        let head = json::utf8(text).ok().and_then(|text| serde_json::from_str(text).ok());
        if let Some(Head { format }) = head
            && format != Some(FORMAT)
        {
            let found = format.map_or("names no format".into(), |n| format!("is of format {n}"));
            let what = format!("the snapshot {found}; this program reads format {FORMAT}");
            return Err(InputError::new("field format", what, fix));
        }
        json::read(text, &json::Kind { name: "snapshot", fix, has_values: true })
    }
}
