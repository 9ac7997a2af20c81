//! Speed against accuracy, for people, for machines, and as a picture.

use std::path::Path;

use super::picture::{Axis, Series, Style, chart};
use super::tables::aligned;
use crate::error::InputError;
use crate::files;
use crate::studies::trade::{Order, Reached, Row, Section, Trade};

/// The columns of `trade.csv`.
pub const COLUMNS: [&str; 18] = [
    "knob",
    "variant",
    "rung",
    "own",
    "equations",
    "in_contact",
    "cycle",
    "seconds",
    "runs",
    "peak_bytes",
    "error_displacement",
    "error_energy",
    "error_von_mises",
    "change_displacement",
    "change_energy",
    "change_von_mises",
    "pareto",
    "failure",
];

/// Writes `trade.json`, `trade.csv` and `trade.svg` to `folder`; gives back the first.
///
/// # Errors
/// A file that cannot be written.
pub fn write(folder: &Path, trade: &Trade) -> Result<String, InputError> {
    let json = json(trade);
    files::write(&folder.join("trade.json"), &json)?;
    files::write(&folder.join("trade.csv"), &csv(trade))?;
    files::write(&folder.join("trade.svg"), &picture(trade))?;
    Ok(json)
}

/// All of it as JSON.
pub fn json(trade: &Trade) -> String {
    serde_json::to_string(trade).expect("string keys only") + "\n"
}

/// A row for each trial.
pub fn csv(trade: &Trade) -> String {
    let rows = trade.sections.iter().flat_map(|section| {
        section.rows.iter().map(|row| cells(section, row).map(|cell| quoted(&cell)).join(","))
    });
    let head = COLUMNS.join(",");
    std::iter::once(head).chain(rows).map(|line| line + "\n").collect()
}

fn cells(section: &Section, row: &Row) -> [String; COLUMNS.len()] {
    fn text<T: ToString>(value: Option<T>) -> String {
        value.map_or(String::new(), |value| value.to_string())
    }
    let (error, change) = (row.error, row.change);
    [
        section.knob.to_string(),
        row.variant.to_string(),
        row.label.clone(),
        row.own.to_string(),
        row.equations.to_string(),
        text(row.in_contact),
        text(row.cycle),
        text(row.seconds),
        row.runs.to_string(),
        text(row.peak_bytes),
        text(error.map(|e| e.displacement)),
        text(error.map(|e| e.energy)),
        text(error.map(|e| e.von_mises)),
        text(change.map(|e| e.displacement)),
        text(change.map(|e| e.energy)),
        text(change.map(|e| e.von_mises)),
        row.pareto.to_string(),
        row.failure.clone().unwrap_or_default(),
    ]
}

/// A cell as RFC 4180 has it.
fn quoted(cell: &str) -> String {
    if cell.contains([',', '"', '\n']) {
        format!("\"{}\"", cell.replace('"', "\"\""))
    } else {
        cell.into()
    }
}

/// A table for each knob, and its answers.
pub fn text(trade: &Trade) -> String {
    let mut text = format!(
        "Speed against accuracy: scene {}, {} nodes, {} triangles; median of up to {} runs, in turn\n\
         errors are relative; * is on the Pareto front of its table, > where the scene has the knob\n",
        trade.scene, trade.nodes, trade.triangles, trade.runs
    );
    for section in &trade.sections {
        text += &format!("\n{}, errors against {}\n", section.knob, section.against);
        if !section.rows.is_empty() {
            text += &table(section);
        }
        if !section.orders.is_empty() {
            text += &orders(&section.orders);
        }
        for answer in &section.answers {
            text += &format!("  {answer}\n");
        }
    }
    text
}

fn table(section: &Section) -> String {
    let head = [
        "",
        "variant",
        section.knob.name(),
        "equations",
        "in contact",
        "time, s",
        "peak, MB",
        "displacement",
        "energy",
        "von Mises",
        "moved by",
    ];
    let rows = section.rows.iter().map(cells_for_people);
    let head = head.map(String::from).to_vec();
    aligned(&std::iter::once(head).chain(rows).collect::<Vec<_>>())
}

fn cells_for_people(row: &Row) -> Vec<String> {
    fn shown<T>(value: Option<T>, show: impl Fn(T) -> String) -> String {
        value.map_or("-".into(), show)
    }
    let error =
        |of: Option<f64>| shown(of, |e| if e == 0.0 { "0".into() } else { format!("{e:.1e}") });
    let marks = [if row.pareto { "*" } else { "" }, if row.own { ">" } else { "" }].concat();
    let mut cells = vec![
        marks,
        row.variant.to_string(),
        row.label.clone(),
        row.equations.to_string(),
        shown(row.in_contact, |n| n.to_string()),
        shown(row.seconds, |s| format!("{s:.4}")),
        shown(row.peak_bytes, |b| format!("{:.0}", b as f64 / 1e6)),
        error(row.error.map(|e| e.displacement)),
        error(row.error.map(|e| e.energy)),
        error(row.error.map(|e| e.von_mises)),
        error(row.change.map(|e| e.displacement)),
    ];
    if let Some(failure) = &row.failure {
        cells.push(failure.lines().next().unwrap_or_default().into());
    }
    cells
}

fn orders(orders: &[Order]) -> String {
    let head = ["quantity", "order", "scatter", "left on the finest"].map(String::from).to_vec();
    let rows = orders.iter().map(|order| {
        let shown = |value: Option<f64>| value.map_or("-".into(), |x| format!("{x:.2}"));
        vec![
            order.quantity.into(),
            shown(order.order),
            shown(order.scatter),
            order.left.map_or("-".into(), |x| format!("{x:.1e}")),
        ]
    });
    aligned(&std::iter::once(head).chain(rows).collect::<Vec<_>>())
}

/// Time against error, a series for each knob, rings around what is on its front.
pub fn picture(trade: &Trade) -> String {
    let place = |row: &Row| row.seconds.zip(row.error).map(|(s, e)| [s, e.displacement]);
    let shown = |p: &[f64; 2]| p[1] > 0.0 && p[1].is_finite();
    let mut series: Vec<Series> = trade
        .sections
        .iter()
        .map(|section| Series {
            name: section.knob.to_string(),
            points: section.rows.iter().filter_map(place).filter(shown).collect(),
            style: Style::Dots,
        })
        .collect();
    let rows = trade.sections.iter().flat_map(|section| &section.rows);
    let front = rows.filter(|row| row.pareto).filter_map(place).filter(shown);
    series.push(Series {
        name: "Pareto front of its table".into(),
        points: front.collect(),
        style: Style::Rings,
    });
    let axes = ["time, s", "relative error of the displacements"]
        .map(|label| Axis { label, logarithmic: true });
    let references = trade.sections.iter().map(|s| format!("{}: against {}.", s.knob, s.against));
    let captions: Vec<String> =
        references.chain(["What has no error, the best itself, is not shown.".into()]).collect();
    chart(&format!("Speed against accuracy: {}", trade.scene), axes, &series, &captions)
}

/// What `solve --accuracy` did, in words.
pub fn reached(reached: &Reached, accuracy: f64) -> String {
    let mut text = format!("\nAccuracy {accuracy:e} asked of the displacements, rounding alone\n");
    for attempt in &reached.attempts {
        let kind = if attempt.bound { "bound" } else { "estimate" };
        let came = match attempt.found {
            None => "too large: not run".into(),
            Some(found) if found <= accuracy => format!("run; {kind} {found:.0e}: taken"),
            Some(found) => format!("run; {kind} {found:.0e}: missed, so up one rung"),
        };
        let arithmetic = attempt.arithmetic;
        text += &format!(
            "  {} by {}: {:.0e} predicted, {came}\n",
            arithmetic.scalar,
            arithmetic.solver(),
            attempt.predicted
        );
    }
    if !reached.solution.contact.is_empty() {
        text += "  This holds while rounding does not change who is in contact.\n";
    }
    text + &mesh(reached.mesh, accuracy)
}

fn mesh(error: f64, accuracy: f64) -> String {
    if !error.is_finite() {
        return "  What the mesh adds is not known: it is too small to tell.\n".into();
    }
    let verdict = if error > accuracy {
        "larger than what was asked, and no arithmetic mends that: refine the mesh"
    } else {
        "not larger than what was asked"
    };
    format!("  The mesh's own error is about {error:.0e} in the energy norm: {verdict}.\n")
}
