//! What the measures share: the shapes that a case leads to, how an experiment on them is summed
//! up, and the contact surfaces seen from outside the listing.

use super::Evidence;
use crate::audit::Case;
use crate::audit::evidence::Outcome;
use base::plain::six_digits;
use numbers::square::SparseSquare;
use output::numbers::with_unit;
use paper::door::{self, Call, ContactStatus};
use paper::mirror::Failure;
use problem::element::area;
use problem::model::{EdgeId, Model, TriangleId};
use problem::modelling::Variant;

/// A shape: coordinates of each node, length.
pub(super) type Shape = [[f64; 2]];

/// A list in a detail names this many at most.
const SHOWN: usize = 6;

/// What counts as a difference, over the largest entry: sums in another order differ by less.
pub(in crate::audit) const ROUNDING: f64 = 1e-9;

/// The number of `found`, each in words; the finding holds where there is one.
pub(super) fn count(found: impl IntoIterator<Item = String>) -> Evidence {
    let found: Vec<String> = found.into_iter().collect();
    let mut detail = found[..found.len().min(SHOWN)].join("; ");
    if found.len() > SHOWN {
        detail += &format!("; and {} more", found.len() - SHOWN);
    }
    let detail = if found.is_empty() { "there is none".into() } else { detail };
    Evidence::present_if(!found.is_empty(), found.len() as f64, detail)
}

/// Counts the entries of the contact surface of which `words` has something to say.
pub(super) fn count_nodes(model: &Model, words: impl Fn(usize) -> Option<String>) -> Evidence {
    let nodes = model.contact.nodes.iter().enumerate();
    count(nodes.filter_map(|(i, node)| Some(format!("node {node} {}", words(i)?))))
}

/// An experiment at the initial shape and at the last shape of each variant that runs: the heaviest
/// verdict, and of equal ones the largest number. A shape at which a listing fails shows nothing.
pub(super) fn at_shapes(
    case: &Case,
    experiment: impl Fn(&Shape) -> Result<Evidence, Failure>,
) -> Outcome<Evidence> {
    let mut heaviest: Option<Evidence> = None;
    for (name, shape) in shapes(case) {
        let nothing = |failure: Failure| Evidence::present_if(false, 0.0, failure.to_string());
        let mut here = experiment(&shape).unwrap_or_else(nothing);
        here.detail = format!("{name} {}", here.detail);
        let weight = |m: &Evidence| (m.verdict, m.number.map(f64::abs));
        if heaviest.as_ref().is_none_or(|most| weight(&here) > weight(most)) {
            heaviest = Some(here);
        }
    }
    Ok(heaviest.expect("every case has its initial shape"))
}

/// The same on what `c_cnt` finds in each shape.
pub(super) fn at_calls(
    case: &Case,
    experiment: impl Fn(&Shape, &Call) -> Evidence,
) -> Outcome<Evidence> {
    at_shapes(case, |shape| Ok(experiment(shape, &c_cnt(case, case.model(), shape)?)))
}

fn shapes(case: &Case) -> Vec<(String, Vec<[f64; 2]>)> {
    let mut shapes = vec![("in the initial shape".to_string(), case.model().nodes.clone())];
    for variant in Variant::OF_THE_PAPER {
        if let Ok(solution) = case.run(*variant) {
            let shape = solution.model.shape(&solution.u);
            shapes.push((format!("in the last shape of {variant}"), shape));
        }
    }
    shapes
}

/// What `c_cnt` finds in the first shape, of those that a case comes to, with a node in contact.
pub(super) fn first_in_contact(case: &Case) -> Result<Call, &'static str> {
    let shapes = shapes(case).into_iter();
    // A shape at which `c_cnt` fails has no pairs.
    let mut calls = shapes.filter_map(|(_, shape)| c_cnt(case, case.model(), &shape).ok());
    calls.find(|call| call.statuses.iter().any(|status| status.in_contact)).ok_or("no contact")
}

/// `c_cnt` on a model, the case's own or one that differs from it, under the reading of the case.
pub(super) fn c_cnt(case: &Case, model: &Model, shape: &Shape) -> Result<Call, Failure> {
    Call::c_cnt(model, case.reading(), shape)
}

/// `Km` of the pairs found in a shape.
pub(super) fn mjs(case: &Case, model: &Model, shape: &Shape) -> Result<SparseSquare, Failure> {
    Ok(door::holding_dropped(model, c_cnt(case, model, shape)?.km(case.reading())?))
}

/// Says where a node lies that is so far below an edge: `lies 0.3 mm above edge 1`.
pub(super) fn place(case: &Case, edge: EdgeId, below: f64) -> String {
    let (edge, side) =
        (case.model().edge(edge).number, if below < 0.0 { "above" } else { "below" });
    let length = with_unit(&six_digits(below.abs()), &case.scene.units.length);
    if below == 0.0 {
        format!("lies on edge {edge}")
    } else {
        format!("lies {length} {side} edge {edge}")
    }
}

/// Says what `c_cnt` has of a node: `lies 0.3 mm above edge 1 and is in contact`.
pub(super) fn said(case: &Case, own: &ContactStatus) -> String {
    let place = own.edge.map_or("has no edge".into(), |edge| place(case, edge, own.distance));
    format!("{place} and is {}in contact", if own.in_contact { "" } else { "not " })
}

/// The coordinates of the ends of an edge in a shape, length.
pub(super) fn ends(model: &Model, shape: &Shape, edge: EdgeId) -> [[f64; 2]; 2] {
    model.edge(edge).nodes.map(|node| shape[node.index()])
}

/// Vertical distance from `point` up to the line through `ends`; nothing where that is vertical.
pub(super) fn rise([a, b]: [[f64; 2]; 2], point: [f64; 2]) -> Option<f64> {
    let slope = (b[1] - a[1]) / (b[0] - a[0]);
    (b[0] != a[0]).then(|| a[1] + slope * (point[0] - a[0]) - point[1])
}

/// Whether entry `i` of the contact surface lies inside a triangle of the target, not on a side.
pub(super) fn inside_target(model: &Model, shape: &Shape, i: usize) -> bool {
    let point = shape[model.contact.nodes[i].index()];
    let inside = |id: &TriangleId| {
        let [a, b, c] = model.triangle(*id).nodes.map(|node| shape[node.index()]);
        [[a, b], [b, c], [c, a]].iter().all(|[p, q]| area(&[*p, *q, point]) > 0.0)
    };
    model.target().is_some_and(|target| target.triangles.iter().any(inside))
}

/// The sign of `yt` inside the target at an edge: +1 where the target lies below it, −1 where
/// above. Nothing for a vertical edge, or one that bounds no triangle.
pub(super) fn inner_sign(model: &Model, shape: &Shape, edge: EdgeId) -> Option<f64> {
    let third = model.sides.beside(model.edge(edge).nodes).first()?.third;
    rise(ends(model, shape, edge), shape[third.index()]).map(f64::signum)
}

/// The unit normal of a target edge that points away from the target.
pub(super) fn away(model: &Model, shape: &Shape, edge: EdgeId) -> Option<[f64; 2]> {
    let [a, b] = ends(model, shape, edge);
    let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
    let scale = inner_sign(model, shape, edge)? * dx.signum() / dx.hypot(dy);
    Some([-dy * scale, dx * scale])
}
