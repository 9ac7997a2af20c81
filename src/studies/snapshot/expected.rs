//! Numbers that a user expects of a run, each with its origin.

use std::collections::HashMap;

use serde::{Deserialize, Serialize};

use super::Run;
use super::numbers::Tolerance;
use base::error::{InputError, Result};
use base::suggestion::did_you_mean;

/// A number that a user expects.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Expected {
    /// The entry of `numbers` in which it stands.
    pub entry: String,
    /// The number of the node or triangle of its row; in a list its place, from 1.
    pub row: usize,
    /// The component of the row, from 1.
    #[serde(default = "first")]
    pub component: usize,
    /// The number that is expected.
    pub value: f64,
    /// How far the run may be from it.
    pub tolerance: Tolerance,
    /// Where the number comes from.
    pub origin: Origin,
    /// Why it is expected.
    pub reason: String,
}

fn first() -> usize {
    1
}

/// The origin of a number.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub enum Origin {
    /// A formula.
    ClosedForm(String),
    /// Another code.
    OtherCode {
        /// Its name.
        name: String,
        /// Its version.
        version: String,
    },
    /// A value of this program or of the user's own code, of an earlier version.
    EarlierValue {
        /// That version.
        version: String,
    },
}

/// The verdict on a number that is expected.
#[derive(Clone, Debug, PartialEq)]
pub struct Missed {
    /// What the run has in its place; None where it has nothing there.
    pub found: Option<f64>,
    /// The largest difference that would do.
    pub limit: f64,
}

impl Expected {
    /// Checks what is expected of `run`.
    ///
    /// # Errors
    /// The reason is empty, or the run has no numbers of that name.
    pub fn check(&self, run: &Run) -> Result<()> {
        let place = || format!("expected number of {:?}", self.entry);
        if self.reason.trim().is_empty() {
            return Err(InputError::new(place(), "the reason is empty", "say why it is expected"));
        }
        if run.numbers.get(&self.entry).is_none() {
            let fix = did_you_mean(&self.entry, run.numbers.keys().map(String::as_str))
                + "name an entry of `numbers`";
            return Err(InputError::new(place(), "the run has no such numbers", fix));
        }
        Ok(())
    }

    /// Returns how the numbers of its entry miss it; None where they do not.
    pub fn missed(&self, there: &EntryNumbers) -> Option<Missed> {
        let found = there.numbers.get(&(self.row as u64, self.component)).copied();
        let limit = self.tolerance.limit(self.value, there.largest, there.floor);
        let is_near = found.is_some_and(|x| (x - self.value).abs() <= limit);
        (!is_near).then_some(Missed { found, limit })
    }
}

/// The numbers of an entry by row and component, both from 1; none where the run has no such entry.
#[derive(Default)]
pub struct EntryNumbers {
    numbers: HashMap<(u64, usize), f64>,
    largest: f64,
    floor: f64,
}

impl EntryNumbers {
    pub fn new(run: &Run, entry: &str) -> Self {
        let Some(numbers) = run.numbers.get(entry) else { return EntryNumbers::default() };
        let places = numbers.places().into_iter();
        let by_place = places.map(|((row, component), x)| ((row as u64, component + 1), x));
        EntryNumbers {
            numbers: by_place.collect(),
            largest: numbers.largest(),
            floor: numbers.floor,
        }
    }
}
