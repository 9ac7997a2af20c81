//! What is measured on a case, or why there is nothing; and whether the inputs that mean the same
//! ([`Case::equivalents`](super::Case::equivalents)) show it too.

use std::fmt;

use serde::{Serialize, Serializer};

use super::variants::mesh_error;
use base::error::InputError;
use engine::Solution;
use engine::error::Error;
use engine::estimates::moves;
use output::layout::first_line;
use output::model::Cell;
use output::numbers::{Digits, short};
use paper::mirror::Failure;
use problem::modelling::Variant;

/// What is said in place of a figure that inputs of the same meaning change.
pub const BY_ROUNDING: &str = "decided by rounding";

/// What of a share is rounding: a millionth of a thousandth, by which [`moves`] tells no two shares apart.
const NOISE: f64 = 1e-9;

/// Returns a share; 0 where it is rounding.
pub fn beyond_noise(share: f64) -> f64 {
    if share.abs() <= NOISE { 0.0 } else { share }
}

/// What was measured; or why there are no figures.
pub type Outcome<T> = Result<T, NoFigures>;

/// Returns an outcome where `others`, measured on inputs that mean the same, have the same `figures`, each
/// over the scale of its kind.
///
/// # Errors
/// Those of the outcome; rounding decides.
pub fn confirmed<T>(
    own: Outcome<T>,
    others: impl IntoIterator<Item = Outcome<T>>,
    figures: fn(&T) -> Vec<Option<f64>>,
) -> Outcome<T> {
    let figures = |outcome: &Outcome<T>| outcome.as_ref().ok().map(figures);
    let of_own = figures(&own);
    let is_same = |other: &Outcome<T>| match (&of_own, figures(other)) {
        (Some(own), Some(other)) => !differ(own, &other),
        (own, other) => own.is_none() && other.is_none(),
    };
    if others.into_iter().all(|other| is_same(&other)) { own } else { Err(NoFigures::Rounding) }
}

/// Returns whether two inputs that mean the same lead to other figures, each over the scale of its kind.
pub fn differ(own: &[Option<f64>], other: &[Option<f64>]) -> bool {
    own.len() != other.len() || own.iter().zip(other).any(|(own, other)| moves(*own, *other, 1.0))
}

/// Writes an outcome into the fields around it: what was measured, or the `failure`.
///
/// # Errors
/// Those of the serializer.
pub fn flat<T: Serialize, S: Serializer>(
    outcome: &Outcome<T>,
    serializer: S,
) -> Result<S::Ok, S::Error> {
    match outcome {
        Ok(measured) => measured.serialize(serializer),
        Err(failure) => serializer.collect_map([("failure", failure)]),
    }
}

/// A verdict, the number that it names, and what else is to be said.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Evidence<V> {
    /// The verdict.
    pub verdict: V,
    /// The number that is named; None where none is, and where rounding decides on it.
    pub number: Option<f64>,
    /// Whether inputs that mean the same lead to another verdict or number.
    pub by_rounding: bool,
    /// The least and the largest number on the inputs that mean the same, where rounding decides on it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub range: Option<[f64; 2]>,
    /// The variant that was measured, where it is one of the paper's.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub variant: Option<Variant>,
    /// What is to be said beside the number; of the verdict `true only if` the condition.
    pub detail: String,
    /// The error of the mesh in each run that was measured.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub mesh_errors: Vec<MeshError>,
}

/// The error of the mesh in a run.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct MeshError {
    /// Which run: a variant, or what distinguishes it.
    pub run: String,
    /// The estimate of the error in the energy norm, relative; nothing where there is none.
    pub energy_relative: Option<f64>,
}

impl<V: Default> Evidence<V> {
    /// Collects what was found.
    pub fn new(verdict: V, number: impl Into<Option<f64>>, detail: impl Into<String>) -> Self {
        Evidence { verdict, number: number.into(), detail: detail.into(), ..Evidence::default() }
    }

    /// Adds the errors of the mesh in the runs that were measured.
    #[must_use]
    pub fn on<'a>(mut self, runs: impl IntoIterator<Item = (&'a str, &'a Solution)>) -> Self {
        let error = |(run, solution): (&str, &Solution)| MeshError {
            run: run.into(),
            energy_relative: mesh_error(solution),
        };
        self.mesh_errors = runs.into_iter().map(error).collect();
        self
    }

    /// Writes the number; where there is none, a dash, or that rounding decides on it.
    pub fn figure(&self, write: fn(f64) -> String) -> String {
        match (self.number, self.range) {
            (Some(number), _) => write(number),
            (None, Some([least, most])) => {
                format!("{BY_ROUNDING}, {} to {}", write(least), write(most))
            }
            (None, None) if self.by_rounding => BY_ROUNDING.into(),
            (None, None) => "-".into(),
        }
    }

    /// Returns the number as a cell of a table; where rounding decides on it, that.
    pub fn cell(&self) -> Cell {
        match self.number {
            Some(number) => Cell::of_digits(number, Digits::of(number, None)),
            None if self.by_rounding => self.figure(short).into(),
            None => Cell::Missing(None),
        }
    }

    /// Leaves the number out where one of `others`, measured on inputs that mean the same, has another
    /// verdict or number.
    #[must_use]
    pub fn confirmed_by(self, others: &[Self]) -> Self
    where
        V: PartialEq,
    {
        let is_same = |other: &Self| {
            self.verdict == other.verdict && !differ(&[self.number], &[other.number])
        };
        if others.iter().all(is_same) {
            return self;
        }
        Evidence { number: None, by_rounding: true, ..self }
    }
}

/// Why a run has no figures.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum NoFigures {
    /// It fails, or its listing does: says why.
    Fails(String),
    /// The scene or its input is none that it takes: says why.
    Refused(String),
    /// Inputs that mean the same lead to other figures.
    Rounding,
}

impl NoFigures {
    /// Returns why a run fails, or is refused; nothing where rounding decides.
    pub fn failure(&self) -> Option<&str> {
        match self {
            NoFigures::Fails(why) | NoFigures::Refused(why) => Some(why),
            NoFigures::Rounding => None,
        }
    }

    /// Returns the reason in one line, without what it has in common with others.
    pub fn in_short(&self) -> &str {
        let why = self.failure().unwrap_or(BY_ROUNDING);
        first_line(why).trim_start_matches("the published algorithm fails as printed: ")
    }
}

impl From<&Error> for NoFigures {
    fn from(why: &Error) -> Self {
        let words = why.to_string();
        match why {
            Error::Input(_) => NoFigures::Refused(words),
            Error::Listing(_)
            | Error::Execution(_)
            | Error::Singular(_)
            | Error::Equilibrium(_) => NoFigures::Fails(words),
        }
    }
}

impl From<Error> for NoFigures {
    fn from(why: Error) -> Self {
        (&why).into()
    }
}

impl From<String> for NoFigures {
    fn from(why: String) -> Self {
        NoFigures::Fails(why)
    }
}

impl From<&str> for NoFigures {
    fn from(why: &str) -> Self {
        NoFigures::Fails(why.into())
    }
}

impl From<Failure> for NoFigures {
    fn from(why: Failure) -> Self {
        NoFigures::Fails(why.to_string())
    }
}

impl From<InputError> for NoFigures {
    fn from(why: InputError) -> Self {
        NoFigures::Refused(why.to_string())
    }
}

impl fmt::Display for NoFigures {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(self.failure().unwrap_or(BY_ROUNDING))
    }
}

impl Serialize for NoFigures {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}
