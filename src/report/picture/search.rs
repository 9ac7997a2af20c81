//! The contact search of a small scene: the boxes of lines 5 to 7 of `c_cnt`, and Y of its line 10,
//! with heights drawn larger than lengths, for gaps are small.

use std::collections::BTreeSet;

use super::page::{MARGIN, Page};
use super::svg::{Anchor, Coloured, DARK, Pixel, circle, group, line, path, rect, segments, text};
use super::view::Bounds;
use crate::numbers::Decimal;
use base::xml::Element;
use paper::door::{Call, ContactStatus};
use paper::mirror::Reading;
use problem::model::Model;

/// A scene of more nodes has neither numbers nor boxes in its pictures.
pub const MOST_NODES: usize = 40;

/// The height of the panel at most, pixels.
const HEIGHT: f64 = 360.0;

/// Colours that the colour-blind tell apart, as those of the charts.
const BOX: &str = "#0072b2";
const ARROW: &str = "#d55e00";
const TARGET_EDGE: &str = "#c1272d";

/// What `c_cnt` looks at in the initial shape.
pub struct Search {
    /// The corners of the box of each target edge, length.
    boxes: Vec<[[f64; 2]; 2]>,
    statuses: Vec<ContactStatus>,
}

impl Search {
    /// Returns the search of a small model with contact; None where it is large, or `c_cnt` fails.
    pub fn from_model(model: &Model) -> Option<Self> {
        model.target().filter(|_| model.nodes.len() <= MOST_NODES)?;
        let call = Call::c_cnt(model, &Reading::default(), &model.nodes).ok()?;
        let c_tll = model.contact.tolerance;
        let boxes = model.target_edges().map(|edge| {
            let [a, b] = edge.nodes.map(|node| model.nodes[node.index()]);
            [a.map(|x| x - c_tll), b.map(|x| x + c_tll)]
        });
        Some(Search { boxes: boxes.collect(), statuses: call.statuses })
    }
}

/// Writes the number of each point that is a corner of a triangle beside it.
pub fn numbers(triangles: &[[usize; 3]], pixels: &[Pixel]) -> Element {
    let number = |k: &usize| {
        let [x, y] = pixels[*k];
        text([x + 5.0, y - 5.0], Anchor::Start, &(k + 1).to_string())
    };
    let corners: BTreeSet<usize> = triangles.iter().flatten().copied().collect();
    group().fill(DARK).with_all(corners.iter().map(number))
}

/// Puts a panel of the search on a page, with what its signs are; `edges` are those of the target, as
/// indices of `points`.
pub fn panel(page: &mut Page, points: &[[f64; 2]], edges: &[[usize; 2]], search: &Search) {
    let arrows = search.statuses.iter().flat_map(|status| {
        let [x, y] = points[status.node.index()];
        [[x, y], [x, y + status.distance]]
    });
    let ends = edges.iter().flatten().map(|k| points[*k]);
    let drawn: Vec<[f64; 2]> =
        search.boxes.iter().flatten().copied().chain(ends).chain(arrows).collect();
    let bounds = Bounds::around(&drawn);
    let [width, height] = bounds.size();
    if !(width > 0.0 && height > 0.0) {
        return;
    }
    let scale = (page.inner() / width).min(HEIGHT / height);
    let times = Decimal::round_at_most(HEIGHT / height / scale).value().max(1.0);
    let heights = match times {
        1.0 => String::new(),
        times => format!(", heights drawn {times} times as large as lengths"),
    };
    page.paragraph(&format!(
        "c_cnt in the initial shape{heights}: the boxes of lines 5 to 7, the arrow Y of line 10 \
         from each node to the line of its target edge; filled nodes are in contact."
    ));
    let bottom = page.y + 24.0 + height * scale * times;
    let at = |[x, y]: [f64; 2]| {
        [MARGIN + (x - bounds.low[0]) * scale, bottom - (y - bounds.low[1]) * scale * times]
    };
    let boxes = search.boxes.iter().map(|[a, b]| {
        let [a, b] = [at(*a), at(*b)];
        let size = [(b[0] - a[0]).abs(), (b[1] - a[1]).abs()];
        rect([a[0].min(b[0]), a[1].min(b[1])], size).fill("none")
    });
    page.put(group().stroke(BOX, 1.0).set("stroke-dasharray", "5 3").with_all(boxes));
    let pixels: Vec<Pixel> = points.iter().map(|point| at(*point)).collect();
    page.put(segments(edges, &pixels).stroke(TARGET_EDGE, 2.5));
    let ends: Vec<usize> = edges.iter().flatten().copied().collect();
    for (k, pixel) in pixels.iter().enumerate().filter(|(k, _)| ends.contains(k)) {
        page.put(text([pixel[0] + 5.0, pixel[1] + 16.0], Anchor::Start, &(k + 1).to_string()));
    }
    for status in &search.statuses {
        let [x, y] = points[status.node.index()];
        if status.edge.is_some() {
            page.put(arrow(at([x, y]), at([x, y + status.distance])));
        }
        let fill = if status.in_contact { DARK } else { "#ffffff" };
        let [px, py] = at([x, y]);
        page.put(circle([px, py], 4.0).fill(fill).stroke(DARK, 1.5));
        page.put(text([px + 7.0, py - 7.0], Anchor::Start, &status.node.to_string()));
    }
    page.y = bottom + 24.0;
}

/// Draws an arrow up or down; its head is no longer than the arrow.
fn arrow(from: Pixel, to: Pixel) -> Element {
    let length = to[1] - from[1];
    let head = length.signum() * length.abs().min(6.0);
    let tip = [[to[0] - 3.0, to[1] - head], to, [to[0] + 3.0, to[1] - head]];
    group().stroke(ARROW, 1.5).with(line(from, to)).with(path([&tip[..]]))
}
