//! Where two runs first differ, and the first status of a contact node that does, with the line of the
//! listing that decides it.

use serde::Serialize;
use serde_json::Value;

use super::difference::{Difference, Kind};
use super::{Decision, Entry, Quantity, Run};
use mathcad::Conjunction;
use mathcad::array::Column;
use paper::listings::Which;
use paper::mirror::{and, is_jumped_after, is_jumped_before, is_near};
use problem::modelling::StatusRule;

/// The first difference of two runs in the order of computation.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct First {
    /// The entry that differs: `iteration 2 yt`, `u`.
    pub entry: Entry,
    /// The number of the node where it differs, of numbers where it differs most; None where the entry
    /// is none of nodes.
    pub node: Option<u64>,
    /// The first target edge or status of a contact node that differs; None where all are the same.
    pub status: Option<Status>,
}

/// A target edge or a status of a contact node that differs.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Status {
    /// The iteration, from 1.
    pub iteration: usize,
    /// The number of the contact node.
    pub node: u64,
    /// What differs.
    pub words: String,
    /// The line of `c_cnt` that decides it, as printed; None where none does.
    pub line: Option<String>,
    /// The first decision up to that iteration that rounding takes in either run, as recorded.
    pub rounding: Option<String>,
}

/// Returns where two runs first differ; None where no `differences` of what both have are known.
pub fn first(old: &Run, new: &Run, differences: &[Difference]) -> Option<First> {
    let first = differences.iter().find(|difference| difference.is_in_both())?;
    let of_status = differences.iter().find(|difference| {
        matches!(difference.kind, Kind::Fact { .. })
            && matches!(difference.entry.quantity, Quantity::Ct | Quantity::Dy | Quantity::Statuses)
    });
    let status = of_status.and_then(|difference| status(old, new, difference));
    Some(First { entry: first.entry, node: node(old, first), status })
}

/// Returns the node where an entry differs.
fn node(run: &Run, difference: &Difference) -> Option<u64> {
    let Entry { iteration, quantity } = difference.entry;
    match (&difference.kind, quantity) {
        (Kind::Fact { was, is }, Quantity::Ct | Quantity::Dy | Quantity::Statuses) => {
            let (was, is) = (was.as_array()?, is.as_array()?);
            contact_node(run, was.iter().zip(is).position(|(was, is)| was != is)?)
        }
        (Kind::Numbers(worst), Quantity::Yt) => contact_node(run, worst.at as usize - 1),
        (
            Kind::Numbers(worst),
            Quantity::U | Quantity::Reactions | Quantity::Gap | Quantity::Pressure,
        ) if iteration.is_none() => Some(worst.at as u64),
        _ => None,
    }
}

/// Returns the number of the node at a place of the contact surface, from 0.
fn contact_node(run: &Run, i: usize) -> Option<u64> {
    run.fact(Quantity::Cnt)?.get(i)?.as_u64()
}

/// Returns the target edge or the status that differs; None where the contact surfaces do.
fn status(old: &Run, new: &Run, difference: &Difference) -> Option<Status> {
    let k = difference.entry.iteration?;
    let (cnt, other) = (old.fact(Quantity::Cnt)?.as_array()?, new.fact(Quantity::Cnt)?.as_array()?);
    let pairs = (0..cnt.len()).map(|i| Some((i, found(old, k, i)?, found(new, k, i)?)));
    let differs = |(_, was, is): &(usize, Found, Found)| {
        (was.ct, was.dy, &was.status) != (is.ct, is.dy, &is.status)
    };
    let (i, was, is) = pairs.flatten().find(differs).filter(|_| cnt == other)?;
    // Lines 16 to 18 of `c_cnt` decide who is in contact, unless another rule does.
    let is_listing = [old, new].iter().all(|run| {
        run.options.status.is_none_or(StatusRule::is_printed)
            && !run.facts.keys().any(|entry| entry.quantity == Quantity::Statuses)
    });
    let line = match was.ct == is.ct {
        _ if !is_listing => None,
        true => [16, 17, 18].into_iter().find(|line| was.holds(*line) != is.holds(*line)),
        false => Some(7),
    };
    let printed = |line: usize| {
        let text = Which::CCnt.text().lines().filter(|line| !line.starts_with('#'));
        format!("c_cnt line {line}: {}", text.map(str::trim).nth(line - 1).unwrap_or_default())
    };
    let decisions = old.decided_by_rounding.iter().chain(&new.decided_by_rounding);
    let rounding = decisions.filter(|d| d.iteration <= k).min_by_key(|d| d.iteration);
    let said =
        |d: &Decision| format!("iteration {}, node {}: {}", d.iteration, d.node, d.condition);
    Some(Status {
        iteration: k,
        node: cnt[i].as_u64()?,
        words: words(&was, &is, line),
        line: line.map(printed),
        rounding: rounding.map(said),
    })
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

fn found(run: &Run, k: usize, i: usize) -> Option<Found> {
    let of = |quantity| Entry { iteration: Some(k), quantity };
    let fact = |quantity| run.fact(of(quantity))?.get(i);
    let yt = run.numbers.get(&of(Quantity::Yt))?;
    Some(Found {
        ct: fact(Quantity::Ct)?.as_u64()?,
        dy: fact(Quantity::Dy)?.as_u64()?,
        yt: yt.listed(i)?,
        before: i.checked_sub(1).and_then(|i| yt.listed(i)),
        after: yt.listed(i + 1),
        c_tll: run.numbers.get(&Entry::from(Quantity::Tolerance))?.listed(0)?,
        status: fact(Quantity::Statuses).and_then(Value::as_str).map(String::from),
    })
}

/// Says what differs, and what the condition of the line compares.
fn words(was: &Found, is: &Found, line: Option<usize>) -> String {
    if was.ct != is.ct {
        return format!("its target edge is elem {}, was {} (0: none)", is.ct, was.ct);
    }
    if let (Some(old), Some(new)) = (&was.status, &is.status) {
        return format!("its status is {new}, was {old}; gap {:.3e}, was {:.3e}", is.yt, was.yt);
    }
    let said = |dy: u64| if dy == 1 { "in contact" } else { "not in contact" };
    let decided = format!("it is {}, was {}", said(is.dy), said(was.dy));
    let compared = |found: &Found| match line? {
        16 => Some(format!("|yt[i1]| {:.3e}, c_tll {:.3e}", found.yt.abs(), found.c_tll)),
        17 => Some(format!("yt[i1] {:.3e}, yt[i1+1] {:.3e}", found.yt, found.after?)),
        _ => Some(format!("yt[i1] {:.3e}, yt[i1-1] {:.3e}", found.yt, found.before?)),
    };
    match (compared(is), compared(was)) {
        (Some(is), Some(was)) => format!("{decided}: {is}; was {was}"),
        _ => decided,
    }
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
