//! Share of wrong statuses by depth of the jump: a line a rule, solid where the target lies below the stamp, broken where above.

use super::svg::{Anchor, Paint, Pixel, circle, document, group, line, path, text};
use crate::audit::statuses::{Measurement, Row};
use crate::contact::StatusRule;
use crate::report::xml::Element;

const SIZE: [f64; 2] = [760.0, 440.0];
/// Left, top, right and bottom border of the diagram.
const BOX: [f64; 4] = [80.0, 60.0, 540.0, 370.0];
const TEXT: f64 = 14.0;
const DARK: &str = "#222222";
/// By rule, as in `StatusRule::ALL`: three that colour-blind eyes tell apart.
const COLOURS: [&str; 3] = ["#d55e00", "#0072b2", "#009e73"];
const TARGETS: [(&str, &str); 2] = [("below", ""), ("above", "7 5")];

/// The picture.
pub fn statuses(measured: &Measurement) -> String {
    let curves = StatusRule::ALL.iter().enumerate().map(|(k, rule)| {
        let curves = TARGETS.iter().map(|(target, dash)| curve(measured, k, target, dash));
        let legend =
            text([BOX[2] + 20.0, BOX[1] + 30.0 * k as f64], TEXT, Anchor::Start, rule.name());
        group().fill(COLOURS[k]).with_all(curves).with(legend)
    });
    let content = group().fill(DARK).with(axes(measured)).with_all(curves).with_all(words());
    document(SIZE[0], SIZE[1], "Wrong statuses by depth of the jump", content)
}

fn curve(measured: &Measurement, rule: usize, target: &str, dash: &str) -> Element {
    let rows: Vec<&Row> = measured.by_depth.iter().filter(|row| row.target == target).collect();
    let place =
        |(k, row): (usize, &&Row)| point(k, rows.len(), row.rules[rule].wrong_share(row.nodes));
    let points: Vec<Pixel> = rows.iter().enumerate().map(place).collect();
    let curve = path([points.as_slice()]).stroke(COLOURS[rule], 2.0).set("stroke-dasharray", dash);
    group().with(curve).with_all(points.iter().map(|at| circle(*at, 3.0)))
}

/// The pixel of a share, 0 to 1, at the `k`-th of `count` depths.
fn point(k: usize, count: usize, share: f64) -> Pixel {
    let [left, top, right, bottom] = BOX;
    let along = (k as f64 + 0.5) / count as f64;
    [left + along * (right - left), bottom - share * (bottom - top)]
}

fn axes(measured: &Measurement) -> Element {
    let [left, _, right, bottom] = BOX;
    let depths: Vec<f64> =
        measured.by_depth.iter().filter(|r| r.target == "below").map(|r| r.depth).collect();
    let shares = [0.0, 0.25, 0.5, 0.75, 1.0].map(|share| {
        let y = point(0, 1, share)[1];
        let label = format!("{:.0} %", 100.0 * share);
        group().with(line([left, y], [right, y]).stroke("#cccccc", 1.0)).with(text(
            [left - 30.0, y + 5.0],
            TEXT,
            Anchor::Middle,
            &label,
        ))
    });
    let labels = depths.iter().enumerate().map(|(k, depth)| {
        let x = point(k, depths.len(), 0.0)[0];
        text([x, bottom + 22.0], TEXT, Anchor::Middle, &depth.to_string())
    });
    group().with_all(shares).with_all(labels)
}

fn words() -> [Element; 4] {
    let [left, _, right, bottom] = BOX;
    let legend = |y: f64, words: &str| text([right + 20.0, y], TEXT, Anchor::Start, words);
    [
        text([left, 30.0], 18.0, Anchor::Start, "Contact nodes with a wrong status")
            .set("font-weight", "bold"),
        text(
            [(left + right) / 2.0, bottom + 46.0],
            TEXT,
            Anchor::Middle,
            "depth of the jump / c_tll",
        ),
        legend(BOX[1] + 110.0, "solid: target below"),
        legend(BOX[1] + 134.0, "broken: target above"),
    ]
}
