//! What the measures share: the shapes that a case meets, and how an experiment on them is summed up.

use super::{Measured, Verdict};
use crate::paper::door::Call;
use crate::paper::mirror::{Failure, Reading};
use crate::problem::model::Model;
use crate::problem::modelling::Variant;
use crate::studies::audit::Case;

/// A shape: coordinates of each node, length.
pub(super) type Shape = [[f64; 2]];

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
    experiment: impl Fn(&Shape) -> Result<Measured, Failure>,
) -> Measured {
    let mut heaviest: Option<Measured> = None;
    for (name, shape) in shapes(case) {
        let mut here =
            experiment(&shape).unwrap_or_else(|failure| Measured::nothing(failure.to_string()));
        here.detail = format!("{name}: {}", here.detail);
        let weight = |m: &Measured| (m.verdict, m.number.abs());
        if heaviest.as_ref().is_none_or(|most| weight(&here) > weight(most)) {
            heaviest = Some(here);
        }
    }
    heaviest.expect("every case has its initial shape")
}

fn shapes(case: &Case) -> Vec<(String, Vec<[f64; 2]>)> {
    let mut shapes = vec![("initial shape".to_string(), case.model().nodes.clone())];
    for variant in Variant::OF_THE_PAPER {
        if let Ok(solution) = case.run(*variant) {
            let shape = solution.model.shape(&solution.u);
            shapes.push((format!("last shape of {variant}"), shape));
        }
    }
    shapes
}

/// What `c_cnt` finds in the first shape, of those that a case comes to, with a node in contact.
pub(super) fn first_in_contact(case: &Case) -> Option<Call> {
    shapes(case).into_iter().find_map(|(_, shape)| {
        let call = c_cnt(case.model(), &shape).ok()?;
        call.statuses.iter().any(|status| status.in_contact).then_some(call)
    })
}

/// `c_cnt` under the default reading.
pub(super) fn c_cnt(model: &Model, shape: &Shape) -> Result<Call, Failure> {
    Call::c_cnt(model, &Reading::default(), shape)
}

/// `Km` of the pairs found in a shape, under the default reading.
pub(super) fn mjs(model: &Model, shape: &Shape) -> Result<nalgebra::DMatrix<f64>, Failure> {
    c_cnt(model, shape)?.km(&Reading::default())
}

/// The entries of the contact surface of which `is` is true, each in `words`.
pub(super) fn contact_nodes(
    model: &Model,
    is: impl Fn(usize) -> bool,
    words: impl Fn(usize) -> String,
) -> Vec<String> {
    let entries = model.contact.nodes.iter().enumerate().filter(|(i, _)| is(*i));
    entries.map(|(i, node)| format!("node {node}: {}", words(i))).collect()
}

/// The number of an entry's target edge in the mesh file, 0 without one: the listing's `ct`.
pub(super) fn ct(model: &Model, call: &Call, i: usize) -> usize {
    call.statuses[i].edge.map_or(0, |edge| model.edge(edge).number)
}

/// 1 where an entry is in contact, else 0: the listing's `dy`.
pub(super) fn dy(call: &Call, i: usize) -> usize {
    usize::from(call.statuses[i].in_contact)
}
