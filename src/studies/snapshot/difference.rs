//! Two runs compared entry by entry: facts are the same or not, numbers agree within a limit.

use std::hash::Hash;

use indexmap::IndexMap;
use serde::Serialize;
use serde_json::Value;

use super::numbers::{Number, Numbers, Tolerance, limit};
use super::{Entry, Quantity, Run};

/// A difference between two runs.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Difference {
    /// What was recorded.
    pub entry: Entry,
    /// What differs.
    #[serde(flatten)]
    pub kind: Kind,
}

/// What differs.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(tag = "kind", rename_all = "kebab-case")]
#[expect(missing_docs, reason = "`was` is the old run's and `is` the new one's")]
pub enum Kind {
    /// The entry is in the old run alone.
    Missing,
    /// The entry is in the new run alone.
    Extra,
    /// A discrete fact is another one.
    Fact { was: Value, is: Value },
    /// The numbers of an array are in another unit.
    Unit { was: String, is: String },
    /// The arrays have other lengths or other rows.
    Shape { was: usize, is: usize, at: Option<f64> },
    /// Numbers differ by more than the limit.
    Numbers(Worst),
}

/// The number that differs most, in multiples of its tolerance.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Worst {
    /// The unit of the old array.
    pub unit: String,
    /// The number of the node or triangle, or the place in the list, from 1.
    pub at: f64,
    /// The component of the row, from 1.
    pub component: usize,
    /// Null where it is no finite number.
    pub was: Number,
    /// Null where it is no finite number.
    pub is: Number,
    /// The largest difference that is none; null where any would do.
    pub limit: Number,
    /// How many numbers of the array differ.
    pub differing: usize,
    /// How many numbers the array has.
    pub of: usize,
    /// Whether `limit` comes from what rounding does, as measured, or from the user's own tolerance.
    pub bounded: bool,
}

impl Difference {
    /// Returns whether it is one of discrete facts, or of what there is at all.
    pub fn is_discrete(&self) -> bool {
        !matches!(self.kind, Kind::Numbers(_))
    }

    /// Returns whether it is one of what was found, other than of the edge that a node has at a corner of
    /// two.
    pub fn is_of_contact(&self) -> bool {
        matches!(self.kind, Kind::Fact { .. })
            && !matches!(self.entry.quantity, Quantity::Ct | Quantity::Mates)
    }

    /// Returns whether both runs have the entry.
    pub fn is_in_both(&self) -> bool {
        !matches!(self.kind, Kind::Missing | Kind::Extra)
    }
}

/// What two sides have under a name.
pub enum Sides<'a, V> {
    /// Both have something: the old one and the new one.
    Both(&'a V, &'a V),
    /// The old side alone has something.
    Missing(&'a V),
    /// The new side alone has something.
    New(&'a V),
}

/// Returns what two sides have under each name, in the order of the old side.
pub fn side_by_side<'a, K: Eq + Hash, V>(
    old: &'a IndexMap<K, V>,
    new: &'a IndexMap<K, V>,
) -> impl Iterator<Item = (&'a K, Sides<'a, V>)> {
    let beside = |(name, was)| match new.get(name) {
        Some(is) => (name, Sides::Both(was, is)),
        None => (name, Sides::Missing(was)),
    };
    let added = new.iter().filter(|(name, _)| !old.contains_key(*name));
    old.iter().map(beside).chain(added.map(|(name, is)| (name, Sides::New(is))))
}

/// Returns the differences of two runs in the order of computation, discrete facts of an iteration in
/// their place among its numbers, and how many facts and numbers were compared. What a run was not
/// asked to record is not compared.
pub fn compare(old: &Run, new: &Run) -> (Vec<Difference>, usize) {
    let kept: Vec<Vec<Entry>> = [old, new].into_iter().filter_map(Run::kept).collect();
    let is_kept = |entry: &Entry| kept.iter().all(|kept| kept.contains(entry));
    let (mut found, mut compared) = (Vec::new(), 0);
    let mut add = |entry: &Entry, kind: Kind| found.push(Difference { entry: *entry, kind });
    for (entry, sides) in side_by_side(&old.facts, &new.facts).filter(|(entry, _)| is_kept(entry)) {
        match sides {
            Sides::Missing(_) => add(entry, Kind::Missing),
            Sides::New(_) => add(entry, Kind::Extra),
            Sides::Both(was, is) => {
                compared += 1;
                if was != is {
                    add(entry, Kind::Fact { was: was.clone(), is: is.clone() });
                }
            }
        }
    }
    for (entry, sides) in
        side_by_side(&old.numbers, &new.numbers).filter(|(entry, _)| is_kept(entry))
    {
        match sides {
            Sides::Missing(_) => add(entry, Kind::Missing),
            Sides::New(_) => add(entry, Kind::Extra),
            Sides::Both(was, is) => {
                compared += was.places().len();
                let kinds = [unit(was, is), numbers(was, is, old.tolerance)];
                kinds.into_iter().flatten().for_each(|kind| add(entry, kind));
            }
        }
    }
    found.sort_by_key(|difference| difference.entry.place());
    (found, compared)
}

/// Returns the units of two arrays where they differ.
fn unit(was: &Numbers, is: &Numbers) -> Option<Kind> {
    (was.unit != is.unit).then(|| Kind::Unit { was: was.unit.clone(), is: is.unit.clone() })
}

/// Returns how two arrays differ; None where they do not. What rounding does is the less of what either run
/// says, so that one file's word alone lets nothing pass; it is that of the new run where the old one does
/// not know.
fn numbers(was: &Numbers, is: &Numbers, given: Option<Tolerance>) -> Option<Kind> {
    if was.values == is.values {
        return None;
    }
    let (old, new) = (was.places(), is.places());
    let elsewhere = old.iter().zip(&new).find(|(a, b)| a.0 != b.0).map(|(a, _)| a.0.0);
    if old.len() != new.len() || elsewhere.is_some() {
        return Some(Kind::Shape { was: old.len(), is: new.len(), at: elsewhere });
    }
    let largest = was.largest();
    let rounding = is.rounding().map(|new| was.rounding().map_or(new, |old| old.min(new)));
    let tolerance = was.tolerance.or(given);
    let bounded = tolerance.is_some() || rounding.is_some();
    let unit = &was.unit;
    let mut worst: Option<(f64, Worst)> = None;
    let mut differing = 0;
    for ((at, was), (_, is)) in old.iter().zip(&new) {
        let (error, limit) = ((was - is).abs(), limit(tolerance, *was, largest, rounding));
        // What is no finite number is within any limit of its kind, and of no other number.
        let is_same = if error.is_finite() { error <= limit } else { Number(*was) == Number(*is) };
        if is_same {
            continue;
        }
        differing += 1;
        let size = if error.is_nan() { f64::INFINITY } else { error };
        if worst.as_ref().is_none_or(|(other, _)| size > *other) {
            let (at, component) = (at.0, at.1 + 1);
            let [was, is, limit] = [*was, *is, limit].map(Number);
            let (differing, of, unit) = (0, old.len(), unit.clone());
            worst =
                Some((size, Worst { unit, at, component, was, is, limit, differing, of, bounded }));
        }
    }
    worst.map(|(_, worst)| Kind::Numbers(Worst { differing, ..worst }))
}

/// Returns the first iteration of which something differs; None where nothing does.
pub fn first_iteration<'d>(differences: impl IntoIterator<Item = &'d Difference>) -> Option<usize> {
    differences.into_iter().filter_map(|d| d.entry.iteration).min()
}
