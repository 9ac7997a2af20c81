//! What the measures share: the shapes that a case meets, and how an experiment on them is summed up.

use super::{Measured, Verdict};
use crate::answer::contact::{self};
use crate::paper::mathcad::array::Table;
use crate::paper::mirror::{Failure, Km, Pairs, Reading, Worksheet};
use crate::problem::modelling::Variant;
use crate::studies::audit::Case;

/// A list in a detail names this many at most.
const SHOWN: usize = 6;

/// What counts as a difference, relative to the largest entry: sums in another order differ by less.
pub(super) const ROUNDING: f64 = 1e-9;

impl Measured {
    /// A measure of the verdict `holds` or `does not arise`.
    pub(super) fn holds_if(holds: bool, number: f64, detail: impl Into<String>) -> Self {
        let verdict = if holds { Verdict::Holds } else { Verdict::DoesNotArise };
        Measured { verdict, number, detail: detail.into() }
    }

    /// Nothing to count.
    pub(super) fn nothing(why: impl Into<String>) -> Self {
        Measured::holds_if(false, 0.0, why)
    }

    /// The number of `found`, each in words; it holds where there is one.
    pub(super) fn count(found: &[String]) -> Self {
        let more = found.len().saturating_sub(SHOWN);
        let mut detail = found.iter().take(SHOWN).cloned().collect::<Vec<_>>().join("; ");
        if more > 0 {
            detail += &format!("; and {more} more");
        }
        let detail = if found.is_empty() { "none".into() } else { detail };
        Measured::holds_if(!found.is_empty(), found.len() as f64, detail)
    }
}

/// An experiment at the initial shape and at the last shape of each variant that runs: the heaviest verdict, and of equal
/// ones the largest number. A shape at which a listing fails shows nothing.
pub(super) fn at_shapes(
    case: &Case,
    experiment: impl Fn(&Table<f64>) -> Result<Measured, Failure>,
) -> Measured {
    let mut heaviest: Option<Measured> = None;
    for (name, node_n) in shapes(case) {
        let mut here =
            experiment(&node_n).unwrap_or_else(|failure| Measured::nothing(failure.to_string()));
        here.detail = format!("{name}: {}", here.detail);
        let weight = |m: &Measured| (m.verdict, m.number.abs());
        if heaviest.as_ref().is_none_or(|most| weight(&here) > weight(most)) {
            heaviest = Some(here);
        }
    }
    heaviest.expect("every case has its initial shape")
}

fn shapes(case: &Case) -> Vec<(String, Table<f64>)> {
    let mut shapes = vec![("initial shape".to_string(), case.sheet.node.clone())];
    for variant in Variant::OF_THE_PAPER {
        if let Ok(outcome) = case.run(*variant) {
            let node_n = contact::shape(&case.sheet, &outcome.u);
            shapes.push((format!("last shape of {variant}"), node_n));
        }
    }
    shapes
}

/// The first shape, of those that a case meets, with a node in contact, and its pairs.
pub(super) fn first_in_contact(case: &Case) -> Option<(Table<f64>, Pairs<f64>)> {
    shapes(case).into_iter().find_map(|(_, node_n)| {
        let pairs = c_cnt(&case.sheet, &node_n).ok()?;
        let in_contact = pairs.dy.iter().any(|dy| *dy == 1);
        in_contact.then_some((node_n, pairs))
    })
}

/// `c_cnt` under the default reading.
pub(super) fn c_cnt(sheet: &Worksheet<f64>, node_n: &Table<f64>) -> Result<Pairs<f64>, Failure> {
    crate::paper::mirror::c_cnt(sheet, &Reading::default(), node_n)
}

/// `Km` of the pairs found in `node_n`, under the default reading.
pub(super) fn mjs(sheet: &Worksheet<f64>, node_n: &Table<f64>) -> Result<Table<f64>, Failure> {
    Km(sheet, &Reading::default(), &c_cnt(sheet, node_n)?.k_cnt)
}

/// The contact nodes (by i1) of which `is` is true, each in `words`.
pub(super) fn contact_nodes(
    sheet: &Worksheet<f64>,
    is: impl Fn(usize) -> bool,
    words: impl Fn(usize) -> String,
) -> Vec<String> {
    (1..=sheet.cnt.rows())
        .filter(|&i1| is(i1))
        .map(|i1| format!("node {}: {}", sheet.cnt[i1], words(i1)))
        .collect()
}
