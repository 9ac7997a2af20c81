//! Speed against accuracy, for people, for machines and as a picture.

use std::path::Path;

use super::claims::{over, over_the_range};
use super::json;
use super::layout::listed;
use super::model::{Cell, Report, Table};
use super::numbers::reason;
use super::picture::{Axis, Series, Style, chart};
use base::error::Result;
use base::files::write_all;
use engine::estimates::Certainty;
use problem::modelling::Variant;
use problem::scene::Scene;
use studies::audit::claims::{Claim, Elsewhere};
use studies::audit::range::{self, ParameterValue};
use studies::trade::{AccurateSolution, Errors, Order, Outcome, Row, Section, Trade, Varied};

/// Returns the content of `trade.json`.
pub fn json(scene: &Scene, trade: &Trade) -> String {
    json::line(Some(scene), trade)
}

/// Writes `trade.json`, `trade.csv` and the pictures to `folder`; gives back the first.
///
/// # Errors
/// A file cannot be written.
pub fn write(folder: &Path, scene: &Scene, trade: &Trade) -> Result<String> {
    let json = json(scene, trade);
    let timed = picture(trade).map(|picture| ("trade.svg".into(), picture));
    let pictures: Vec<_> =
        timed.into_iter().chain(trade.sections.iter().flat_map(geometry)).collect();
    let pictures = pictures.iter().map(|(name, picture)| (&**name, &**picture));
    let tables = [("trade.csv", &*csv(trade)), ("trade.json", &json)];
    write_all(folder, &pictures.chain(tables).collect::<Vec<_>>())?;
    Ok(json)
}

/// Writes a line for each trial.
pub fn csv(trade: &Trade) -> String {
    let sections = trade.sections.iter();
    let rows = sections.flat_map(|section| section.rows.iter().map(move |row| (section, row)));
    Table::from_rows(rows)
        .column("parameter", |(section, _)| section.parameter.to_string())
        .column("variant", |(_, row)| row.variant.to_string())
        .column("setting", |(_, row)| row.label.clone())
        .column("own", |(_, row)| row.own.to_string())
        .column("equations", |(_, row)| row.equations)
        .column("in_contact", |(_, row)| row.in_contact)
        .column("cycle", |(_, row)| row.cycle)
        .column("seconds", |(_, row)| row.seconds)
        .column("runs", |(_, row)| row.runs)
        .column("peak_bytes", |(_, row)| row.peak_bytes)
        .column("error_displacement", |(_, row)| row.error.map(|e| e.displacement))
        .column("error_energy", |(_, row)| row.error.map(|e| e.energy))
        .column("error_von_mises", |(_, row)| row.error.map(|e| e.von_mises))
        .column("change_displacement", |(_, row)| row.change.map(|e| e.displacement))
        .column("change_energy", |(_, row)| row.change.map(|e| e.energy))
        .column("change_von_mises", |(_, row)| row.change.map(|e| e.von_mises))
        .column("pareto", |(_, row)| row.pareto.to_string())
        .column("failure", |(_, row)| row.failure.clone())
        .csv()
}

/// Reports a table for each parameter.
pub fn report(trade: &Trade) -> Report {
    let report = Report::titled(format!(
        "Speed against accuracy: scene {}, {} nodes, {} triangles; \
         median of up to {} runs, in turn",
        trade.scene, trade.nodes, trade.triangles, trade.runs
    ))
    .line(
        "displacement: largest difference of a node's displacement over the largest displacement; energy: \
         energy norm of the difference over that of the whole; von Mises: largest relative difference of a \
         body's largest von Mises stress; change: of the displacement, from the row marked >",
    )
    .line(
        "* is on the Pareto front (time, displacement) of its table, > where the scene has the parameter",
    );
    trade.sections.iter().fold(report, |report, section| {
        let report =
            report.heading(format!("{}, errors against {}", section.parameter, section.against));
        let report = match section.rows.is_empty() {
            true => report.note("The scene does not have this parameter."),
            false => report.table(format!("Trials of {}", section.parameter), trials(section)),
        };
        let report = match section.orders.is_empty() {
            true => report,
            false => report.table("Order of convergence", orders(&section.orders)),
        };
        report.then(over_the_range(&section.claims))
    })
}

fn trials(section: &Section) -> Table<Vec<&Row>> {
    let mark = |is: bool, mark| if is { mark } else { "" };
    let error = |error: f64, field| match error {
        0.0 => Cell::plain(0.0),
        error => Cell::scientific(error, 1).because(reason(field)),
    };
    let displacement = |e: Errors| error(e.displacement, "displacement");
    let table = Table::from_rows(&section.rows)
        .column("", |row| [mark(row.pareto, "*"), mark(row.own, ">")].concat())
        .column("variant", |row| row.variant.to_string())
        .column(section.parameter, |row| row.label.clone())
        .column("equations", |row| row.equations)
        .column("in contact", |row| row.in_contact)
        .column("time, s", |row| row.seconds.map(|seconds| Cell::decimals(seconds, 4)))
        .column("peak, MB", |row| row.peak_bytes.map(|b| Cell::decimals(b as f64 / 1e6, 0)));
    let table = table
        .column("displacement", |row| row.error.map(displacement))
        .column("energy", |row| row.error.map(|e| error(e.energy, "energy")))
        .column("von Mises", |row| row.error.map(|e| error(e.von_mises, "von_mises")))
        .column("change", |row| row.change.map(displacement));
    // Where rounding in f64 may decide who is in contact, the row is of the same run in double-doubles.
    let certainty = |row: &Row| match row.certainty {
        None | Some(Certainty::Certain | Certainty::Unchecked) => "",
        Some(Certainty::InDoubleDouble) => "in f64, not in f64x2, of which the row is",
        Some(Certainty::Unknown) => "unknown",
    };
    let table = match section.rows.iter().all(|row| certainty(row).is_empty()) {
        true => table,
        false => {
            table.column("rounding decides who is in contact", |row| certainty(row).to_string())
        }
    };
    if section.rows.iter().all(|row| row.failure.is_none()) {
        return table;
    }
    table.column("failure", |row| {
        row.failure.as_ref().and_then(|why| why.lines().next()).unwrap_or_default().to_string()
    })
}

fn orders(orders: &[Order]) -> Table<Vec<&Order>> {
    Table::from_rows(orders)
        .column("quantity", |order| order.quantity)
        .column("order", |order| order.order.map(|order| Cell::decimals(order, 2)))
        .column("scatter", |order| order.scatter.map(|scatter| Cell::decimals(scatter, 2)))
        .column("left on the finest", |order| {
            let finest = order.errors.as_ref()?.last()?;
            Some(Cell::scientific(*finest, 1))
        })
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
    let here = |place: ParameterValue| Some(place.value).filter(|_| place.parameter == parameter);
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
        let Claim { id, judged: what, .. } = judged.claim;
        format!("{id}, {what}: {}.", over(judged, parameter))
    });
    let meaning = "Of a variant: error in the energy norm against the equilibrium under stick on \
                   the same mesh. Change by c_tol: largest difference of a displacement between \
                   c_tol and a thousandth of it, over the largest displacement.";
    let unknown = section.rows.iter().filter(|row| {
        row.certainty == Some(Certainty::Unknown) && row.place.and_then(here).is_some()
    });
    let unknown = listed(unknown.map(|row| format!("{} under {}", row.label, row.variant)));
    let rounding = match unknown.is_empty() {
        true => "Rounding decides nothing in the runs of the paper's variants.".into(),
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

/// Reports what `solve --accuracy` did to reach `accuracy`, a part of the largest displacement.
pub fn reached(reached: &AccurateSolution, accuracy: f64) -> Report {
    let printed = reached.solution.request.variant == Variant::Printed;
    let attempts = reached.attempts.iter().map(|attempt| {
        let outcome = match &attempt.outcome {
            Outcome::NotRun(why) => format!("not run: {why}"),
            Outcome::Failed(why) => format!("failed, so up one precision: {why}"),
            Outcome::Bound(0.0) => "no rounding: taken".into(),
            Outcome::Bound(bound) if *bound <= accuracy => format!("within {bound:.0e}: taken"),
            Outcome::Bound(bound) if bound.is_finite() => {
                format!("within {bound:.0e}, so up one precision")
            }
            Outcome::Bound(_) => {
                "no bound, as where rounding may have decided who is in contact: up one precision"
                    .into()
            }
        };
        let (scalar, solver) = (attempt.arithmetic.scalar, attempt.arithmetic.solver(printed));
        format!("{scalar} by {solver}: {outcome}")
    });
    Report::default()
        .heading(format!("Accuracy {accuracy:e} asked of the displacements, rounding alone"))
        .notes(attempts)
        .note(error_of_mesh(reached.mesh, accuracy))
}

fn error_of_mesh(error: f64, accuracy: f64) -> String {
    if !error.is_finite() {
        return "What the mesh adds is unknown: it is too small for an estimate.".into();
    }
    let verdict = match error > accuracy {
        true => "larger than what was asked, and no precision fixes that: refine the mesh",
        false => "not larger than what was asked",
    };
    format!("The mesh's own error is about {error:.0e} in the energy norm: {verdict}.")
}
