//! Speed against accuracy, for people, for machines and as a picture.

use std::path::Path;

use super::claims::{over, over_the_range};
use super::json::of_scene;
use super::layout::{Table, listed};
use super::numbers::{note, or_dash};
use super::output::csv as csv_of;
use super::picture::{Axis, Series, Style, chart};
use base::error::Result;
use base::files::write_all;
use engine::estimates::Certainty;
use problem::modelling::Variant;
use problem::scene::Scene;
use studies::audit::claims::{Claim, Elsewhere};
use studies::audit::range::{self, Place};
use studies::trade::{Came, Errors, Order, Reached, Row, Section, Trade, Varied};

/// The heading of `trade.csv`.
pub const COLUMNS: &str = "parameter,variant,setting,own,equations,in_contact,cycle,seconds,runs,\
    peak_bytes,error_displacement,error_energy,error_von_mises,\
    change_displacement,change_energy,change_von_mises,pareto,failure";

/// Returns the content of `trade.json`.
pub fn json(scene: &Scene, trade: &Trade) -> String {
    of_scene(scene, trade)
}

/// Writes `trade.json`, `trade.csv` and the pictures to `folder`; gives back the first.
pub fn write(folder: &Path, scene: &Scene, trade: &Trade) -> Result<String> {
    let json = json(scene, trade);
    let timed = picture(trade).map(|picture| ("trade.svg".into(), picture));
    let pictures: Vec<_> =
        timed.into_iter().chain(trade.sections.iter().flat_map(geometry)).collect();
    let pictures = pictures.iter().map(|(name, picture)| (&**name, &**picture));
    let tables = [("trade.json", &*json), ("trade.csv", &csv(trade))];
    write_all(folder, "trade", &tables.into_iter().chain(pictures).collect::<Vec<_>>())?;
    Ok(json)
}

/// Lays out a line for each trial, its cells being those of [`COLUMNS`].
pub fn csv(trade: &Trade) -> String {
    let rows = trade
        .sections
        .iter()
        .flat_map(|section| section.rows.iter().map(move |row| cells(section, row)));
    csv_of(COLUMNS, rows)
}

fn cells(section: &Section, row: &Row) -> Vec<String> {
    fn text<T: ToString>(value: Option<T>) -> String {
        value.map_or(String::new(), |value| value.to_string())
    }
    let parts = [row.error, row.change].map(|errors| {
        [errors.map(|e| e.displacement), errors.map(|e| e.energy), errors.map(|e| e.von_mises)]
            .map(|error| error.filter(|error| error.is_finite()))
    });
    let start = [
        section.parameter.to_string(),
        row.variant.to_string(),
        row.label.clone(),
        row.own.to_string(),
        row.equations.to_string(),
        text(row.in_contact),
        text(row.cycle),
        text(row.seconds),
        row.runs.to_string(),
        text(row.peak_bytes),
    ];
    let end = [row.pareto.to_string(), row.failure.clone().unwrap_or_default()];
    start.into_iter().chain(parts.concat().into_iter().map(text)).chain(end).collect()
}

/// Lays out a table for each parameter, and its answers.
pub fn text(trade: &Trade) -> String {
    let mut text = format!(
        "Speed against accuracy: scene {}, {} nodes, {} triangles; \
         median of up to {} runs, in turn\n\
         displacement: largest difference of a node's displacement over the largest displacement; energy: \
         energy norm of the difference over that of the whole; von Mises: largest relative difference of a \
         body's largest von Mises stress; moved by: displacement, from the row marked >\n\
         * is on the Pareto front (time, displacement) of its table, > where the scene has the parameter\n",
        trade.scene, trade.nodes, trade.triangles, trade.runs
    );
    for section in &trade.sections {
        text += &format!("\n{}, errors against {}\n", section.parameter, section.against);
        if !section.rows.is_empty() {
            text += &trials(section);
        }
        if !section.orders.is_empty() {
            text += &orders(&section.orders);
        }
        text += &over_the_range(&section.claims);
        for answer in &section.answers {
            text += &format!("  {answer}\n");
        }
    }
    text
}

fn trials(section: &Section) -> String {
    let mark = |is: bool, mark| if is { mark } else { "" };
    let error = |errors: Option<Errors>, of: fn(&Errors) -> f64| match errors.as_ref().map(of) {
        Some(0.0) => "0".into(),
        error => or_dash(error.filter(|error| error.is_finite()), |error| format!("{error:.1e}")),
    };
    let errors = || section.rows.iter().flat_map(|row| [row.error, row.change]).flatten();
    let notes = note("displacement", errors().map(|errors| errors.displacement))
        + &note("von_mises", errors().map(|errors| errors.von_mises));
    let table = Table::of(&section.rows)
        .column("", |row| [mark(row.pareto, "*"), mark(row.own, ">")].concat())
        .column("variant", |row| row.variant)
        .column(section.parameter, |row| row.label.clone())
        .column("equations", |row| row.equations)
        .column("in contact", |row| or_dash(row.in_contact, |n| n.to_string()))
        .column("time, s", |row| or_dash(row.seconds, |s| format!("{s:.4}")))
        .column("peak, MB", |row| or_dash(row.peak_bytes, |b| format!("{:.0}", b as f64 / 1e6)))
        .column("displacement", |row| error(row.error, |e| e.displacement))
        .column("energy", |row| error(row.error, |e| e.energy))
        .column("von Mises", |row| error(row.error, |e| e.von_mises))
        .column("moved by", |row| error(row.change, |e| e.displacement));
    if section.rows.iter().all(|row| row.failure.is_none()) {
        return table.text() + &notes;
    }
    let first_line = |why: &String| why.lines().next().unwrap_or_default().to_string();
    table.column("", |row| row.failure.as_ref().map_or(String::new(), first_line)).text() + &notes
}

fn orders(orders: &[Order]) -> String {
    let decimals = |value: Option<f64>| or_dash(value, |x| format!("{x:.2}"));
    Table::of(orders)
        .column("quantity", |order| order.quantity)
        .column("order", |order| decimals(order.order))
        .column("scatter", |order| decimals(order.scatter))
        .column("left on the finest", |order| {
            or_dash(order.errors.as_ref().and_then(|e| e.last()), |x| format!("{x:.1e}"))
        })
        .text()
}

/// Draws time against error: a series for each parameter, and rings around what is on its front. None where
/// nothing was timed.
pub fn picture(trade: &Trade) -> Option<String> {
    let place = |row: &Row| row.seconds.zip(row.error).map(|(s, e)| [s, e.displacement]);
    let shown = |p: &[f64; 2]| p[1] > 0.0 && p[1].is_finite();
    let of_section = |section: &Section| Series {
        name: section.parameter.to_string(),
        points: section.rows.iter().filter_map(place).filter(shown).collect(),
        style: Style::Dots,
    };
    let rows = trade.sections.iter().flat_map(|section| &section.rows);
    let front = rows.filter(|row| row.pareto).filter_map(place).filter(shown);
    let front = Series {
        name: "Pareto front of its table".into(),
        points: front.collect(),
        style: Style::Rings,
    };
    let timed = trade.sections.iter().filter(|section| section.parameter != Varied::Geometry);
    let series: Vec<Series> = timed.clone().map(of_section).chain([front]).collect();
    if series.iter().all(|series| series.points.is_empty()) {
        return None;
    }
    let axes = ["time, s", "relative error of the displacements"]
        .map(|label| Axis { label, logarithmic: true });
    let references = timed.map(|s| format!("{}: against {}.", s.parameter, s.against));
    let captions: Vec<String> =
        references.chain(["What has no error, the best itself, is not shown.".into()]).collect();
    Some(chart(&format!("Speed against accuracy: {}", trade.scene), axes, &series, &captions))
}

/// Draws what each parameter of the range does, a picture each with its name: the errors of the
/// variants, what c_tol does, and under them the verdicts.
pub fn geometry(section: &Section) -> Vec<(String, String)> {
    let picture = |p: &range::Parameter| (format!("geometry-{p}.svg"), over_parameter(section, *p));
    let parameters = range::Parameter::ALL.iter().filter(|_| !section.claims.is_empty());
    parameters.map(picture).collect()
}

/// The claim whose number is drawn: what c_tol changes.
const DRAWN: &str = "P10";

fn over_parameter(section: &Section, parameter: range::Parameter) -> String {
    let here = |place: Place| Some(place.value).filter(|_| place.parameter == parameter);
    let error = |row: &Row| Some([here(row.place?)?, row.error?.energy]);
    let of_variant = |variant: &Variant| Series {
        name: variant.to_string(),
        points: section.rows.iter().filter(|r| r.variant == *variant).filter_map(error).collect(),
        style: Style::Dotted,
    };
    let variants = Variant::ALL.iter().map(of_variant).filter(|series| !series.points.is_empty());
    let changes = section.claims.iter().filter(|judged| judged.claim.id == DRAWN).map(|judged| {
        let change = |other: &Elsewhere| Some([here(other.place)?, other.measured.number?]);
        Series {
            name: "change by c_tol".into(),
            points: judged.elsewhere.iter().filter_map(change).collect(),
            style: Style::Dotted,
        }
    });
    let series: Vec<Series> = variants.chain(changes).collect();
    let verdicts = section.claims.iter().map(|judged| {
        let Claim { id, says, .. } = judged.claim;
        format!("{id}, {says}: {}.", over(judged, parameter))
    });
    let meaning = "Of a variant: error in the energy norm against the equilibrium under stick on \
                   the same mesh. Change by c_tol: largest difference of a displacement between \
                   c_tol and a thousandth of it, over the largest displacement.";
    let unknown = section.rows.iter().filter(|row| {
        row.certainty == Some(Certainty::Unknown) && row.place.and_then(here).is_some()
    });
    let unknown = listed(unknown.map(|row| format!("{} under {}", row.label, row.variant)));
    let rounding = match unknown.is_empty() {
        true => "Rounding decides nothing in these numbers.".into(),
        false => format!("Rounding may decide who is in contact at {unknown}."),
    };
    let captions: Vec<String> =
        [format!("{meaning} {rounding}")].into_iter().chain(verdicts).collect();
    let spread = parameter.values().iter().fold(0.0, |most: f64, x| most.max(*x))
        / parameter.values().iter().fold(f64::INFINITY, |least: f64, x| least.min(*x));
    let x = Axis { label: parameter.meaning(), logarithmic: spread > 100.0 };
    let y = Axis { label: "relative error or change", logarithmic: false };
    chart(&format!("What the paper leaves open: {parameter}"), [x, y], &series, &captions)
}

/// Tells what `solve --accuracy` did to reach `accuracy`, a part of the largest displacement.
pub fn reached(reached: &Reached, accuracy: f64) -> String {
    let mut text = format!("\nAccuracy {accuracy:e} asked of the displacements, rounding alone\n");
    for attempt in &reached.attempts {
        let came = match &attempt.came {
            Came::NotRun(why) => format!("not run: {why}"),
            Came::Failed(why) => format!("failed, so up one precision: {why}"),
            Came::Bound(0.0) => "no rounding: taken".into(),
            Came::Bound(bound) if *bound <= accuracy => format!("within {bound:.0e}: taken"),
            Came::Bound(bound) if bound.is_finite() => {
                format!("within {bound:.0e}, so up one precision")
            }
            Came::Bound(_) => {
                "no bound, as where rounding may have decided who is in contact: up one precision"
                    .into()
            }
        };
        let printed = reached.solution.request.variant == Variant::Printed;
        let (scalar, solver) = (attempt.arithmetic.scalar, attempt.arithmetic.solver(printed));
        text += &format!("  {scalar} by {solver}: {came}\n");
    }
    text + &mesh(reached.mesh, accuracy)
}

fn mesh(error: f64, accuracy: f64) -> String {
    if !error.is_finite() {
        return "  What the mesh adds is not known: it is too small to tell.\n".into();
    }
    let verdict = match error > accuracy {
        true => "larger than what was asked, and no precision fixes that: refine the mesh",
        false => "not larger than what was asked",
    };
    format!("  The mesh's own error is about {error:.0e} in the energy norm: {verdict}.\n")
}
