//! The first discrete fact in which two runs differ, in the words of the listing.

use serde_json::Value;

use super::Run;
use super::compare::{Difference, Kind};
use super::place::{iteration, of_iteration};
use mathcad::Conjunction;
use mathcad::array::Column;
use paper::listings::Which;
use paper::mirror::{and, is_jumped_after, is_jumped_before, is_near};
use problem::modelling::StatusRule;

/// The place in a run where two runs go different ways.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct Flip {
    /// The iteration, from 1.
    pub iteration: usize,
    /// The number of the contact node; None where the difference has none.
    pub node: Option<u64>,
    /// What differs.
    pub words: String,
    /// The line of `c_cnt` that decides it, as printed; None where none does.
    pub line: Option<String>,
}

/// What a run found at an entry of the contact surface in an iteration.
struct Found {
    ct: u64,
    dy: u64,
    yt: f64,
    before: Option<f64>,
    after: Option<f64>,
    c_tll: f64,
    status: Option<String>,
}

/// Returns the flip in the first of the differences that is one of facts of an iteration.
pub fn flip(old: &Run, new: &Run, differences: &[Difference]) -> Option<Flip> {
    let difference = differences.iter().find(|difference| {
        let decides = |name| ["ct", "dy", "statuses"].contains(&name);
        matches!(difference.kind, Kind::Fact { .. })
            && iteration(&difference.entry).is_some_and(|(_, quantity)| decides(quantity))
    })?;
    let (k, quantity) = iteration(&difference.entry)?;
    let of = |run: &Run, i: usize| found(run, k, i);
    let count = list(old, "cnt").len();
    let same_nodes = list(old, "cnt") == list(new, "cnt");
    let differs = |i: &usize| match (of(old, *i), of(new, *i)) {
        (Some(was), Some(is)) => (was.ct, was.dy, was.status) != (is.ct, is.dy, is.status),
        _ => true,
    };
    let unknown = || Flip {
        iteration: k,
        node: None,
        words: format!("{quantity} of the contact surface"),
        line: None,
    };
    let Some(i) = (0..count).find(differs).filter(|_| same_nodes) else { return Some(unknown()) };
    let node = list(old, "cnt")[i].as_u64();
    let (Some(was), Some(is)) = (of(old, i), of(new, i)) else { return Some(unknown()) };
    let (words, line) = words(&was, &is, [old, new].iter().all(|run| follows_listing(run)));
    let line = line.map(printed);
    Some(Flip { iteration: k, node, words, line })
}

fn list(run: &Run, fact: &str) -> Vec<Value> {
    run.facts.get(fact).and_then(Value::as_array).cloned().unwrap_or_default()
}

fn found(run: &Run, k: usize, i: usize) -> Option<Found> {
    let fact = |quantity: &str| {
        let list = run.facts.get(&of_iteration(k, quantity))?.as_array()?;
        list.get(i).cloned()
    };
    let yt = run.numbers.get(&of_iteration(k, "yt"))?;
    let at = |i: Option<usize>| yt.listed(i?);
    Some(Found {
        ct: fact("ct")?.as_u64()?,
        dy: fact("dy")?.as_u64()?,
        yt: at(Some(i))?,
        before: at(i.checked_sub(1)),
        after: at(Some(i + 1)),
        c_tll: run.numbers.get("c_tll")?.listed(0)?,
        status: fact("statuses").and_then(|status| Some(status.as_str()?.to_string())),
    })
}

/// Returns whether lines 16 to 18 of `c_cnt` decide who is in contact.
fn follows_listing(run: &Run) -> bool {
    run.options.status.is_none_or(StatusRule::is_printed)
        && !run.facts.keys().any(|name| name.ends_with(" statuses"))
}

/// Returns what differs, and the line of `c_cnt` that decides it.
fn words(was: &Found, is: &Found, by_listing: bool) -> (String, Option<usize>) {
    let edge = |ct: u64| if ct == 0 { "none".into() } else { format!("elem {ct}") };
    if was.ct != is.ct {
        let words = format!("its target edge is {}, was {}", edge(is.ct), edge(was.ct));
        return (words, by_listing.then_some(7));
    }
    if let (Some(old), Some(new)) = (&was.status, &is.status) {
        return (
            format!("its status is {new}, was {old}; gap {:.3e}, was {:.3e}", is.yt, was.yt),
            None,
        );
    }
    let line = [16, 17, 18].into_iter().find(|line| was.holds(*line) != is.holds(*line));
    let words = match line.filter(|_| by_listing) {
        Some(16) => {
            let side = |found: &Found, c_tll: &str| {
                let sign = if found.holds(16) { "<" } else { ">=" };
                format!("{:.3e} {sign} {c_tll}", found.yt.abs())
            };
            match was.c_tll == is.c_tll {
                true => format!("|yt| {}, was {:.3e}", side(is, "c_tll"), was.yt.abs()),
                false => {
                    let [old, new] = [was, is].map(|found| format!("c_tll {:e}", found.c_tll));
                    format!("|yt| {}, was {}", side(is, &new), side(was, &old))
                }
            }
        }
        Some(17) => format!(
            "yt[i1] {:.3e} and yt[i1+1] {:.3e}, were {:.3e} and {:.3e}",
            is.yt,
            is.after.unwrap_or(f64::NAN),
            was.yt,
            was.after.unwrap_or(f64::NAN)
        ),
        Some(_) => format!(
            "yt[i1] {:.3e} and yt[i1-1] {:.3e}, were {:.3e} and {:.3e}",
            is.yt,
            is.before.unwrap_or(f64::NAN),
            was.yt,
            was.before.unwrap_or(f64::NAN)
        ),
        None => {
            let word = |dy: u64| if dy == 1 { "in contact" } else { "not in contact" };
            format!("it is {}, was {}", word(is.dy), word(was.dy))
        }
    };
    (words, line.filter(|_| by_listing))
}

impl Found {
    /// Returns whether a line of `c_cnt`, from 16 to 18, takes the node for one in contact.
    fn holds(&self, line: usize) -> bool {
        // The node and those beside it, as rows of `cnt`.
        let yt: Vec<f64> = self.before.into_iter().chain([self.yt]).chain(self.after).collect();
        let i1 = 1 + usize::from(self.before.is_some());
        let (ct, yt) = (Column::filled(yt.len(), self.ct as usize), Column::from_vec(yt));
        let condition = match line {
            16 => is_near(&ct, &yt, self.c_tll, i1).to_vec(),
            17 => is_jumped_after(&ct, &yt, i1).to_vec(),
            _ => is_jumped_before(&ct, &yt, i1).to_vec(),
        };
        and(Conjunction::Guarded, &condition) == Ok(true)
    }
}

/// Returns a line of `c_cnt` as printed, behind its number.
fn printed(line: usize) -> String {
    let text = Which::CCnt.text().lines().filter(|line| !line.starts_with('#'));
    format!("c_cnt line {line}: {}", text.map(str::trim).nth(line - 1).unwrap_or_default())
}
