//! Speed against accuracy, for people, for machines and as a picture.

use crate::trade::{AXES, AccurateSolution, Contact, Errors, Order, Rounding, Row, Section, Trade};
use engine::estimates::Certainty;
use output::layout::first_line;
use output::model::{Cell, Report, Table};
use output::numbers::{figure, reason, with_unit};
use output::picture::{Axis, SERIES, Series, Style, chart};
use problem::modelling::Variant;
use problem::scene::Units;

// Each axis has a colour of its own.
const _: () = assert!(AXES.len() <= SERIES);

/// Reports a table for each axis.
pub fn report(trade: &Trade) -> Report {
    let report = Report::titled(format!(
        "Speed against accuracy: scene {}, {} nodes, {} triangles; {}",
        trade.scene,
        trade.nodes,
        trade.triangles,
        match trade.runs {
            1 => "each timed once".into(),
            runs => format!("median of up to {runs} runs, in turn"),
        }
    ))
    .line(
        "displacement: largest difference of a node's displacement over the largest displacement; energy: \
         energy norm of the difference over that of the whole; von Mises: largest relative difference of a \
         body's largest von Mises stress; change: of the displacement, from the row marked >",
    )
    .line(
        "* is on the Pareto front (time, displacement) of its table, > where the scene has the parameter",
    );
    let report = match &trade.no_reference {
        Some(why) => report.line(format!("No error against the equilibrium is known: {why}")),
        None => report,
    };
    trade.sections.iter().fold(report, |report, section| {
        let report =
            report.heading(format!("{}, errors against {}", section.parameter, section.against));
        let report = match section.rows.is_empty() {
            true => report.note("The scene does not have this parameter."),
            false => report.table(format!("Trials of {}", section.parameter), trials(section)),
        };
        let report = match section.rows.iter().any(|row| row.contact.is_some()) {
            true => report.table(
                "Contact on each mesh, without friction and for small displacements",
                contact(&section.rows, &trade.units),
            ),
            false => report,
        };
        match section.orders.is_empty() {
            true => report,
            false => report.table("Order of convergence", orders(&section.orders)),
        }
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
        .column("displacement", |row| row.error.map(displacement))
        .column("energy", |row| row.error.map(|e| error(e.energy, "energy")))
        .column("von Mises", |row| row.error.map(|e| error(e.von_mises, "von_mises")))
        .column("change", |row| row.change.map(displacement));
    // Where rounding in f64 decides who is in contact, the row is of the same run in double-doubles.
    let certainty = |row: &Row| match row.certainty {
        None | Some(Certainty::Certain | Certainty::Unchecked) => "",
        Some(Certainty::InDoubleDouble) => "the last digit of the inputs; the row is of f64x2",
        Some(Certainty::Decided) => "the last digit of the inputs",
    };
    let table = match section.rows.iter().all(|row| certainty(row).is_empty()) {
        true => table,
        false => table.column("decides who is in contact", |row| certainty(row).to_string()),
    };
    if section.rows.iter().all(|row| row.failure.is_none()) {
        return table;
    }
    table.column("failure", |row| {
        row.failure.as_ref().map_or(String::new(), |why| first_line(&why.to_string()).into())
    })
}

fn contact<'a>(rows: &'a [Row], units: &Units) -> Table<Vec<(&'a Row, Contact)>> {
    let number = |x: f64| figure(x, Some(1e-3));
    Table::from_rows(rows.iter().filter_map(|row| Some((row, row.contact?))))
        .column("mesh", |(row, _)| row.label.clone())
        .column(with_unit("contact force,", &units.force), |(_, own)| number(own.force))
        .column("off by", |(_, own)| Cell::percent(own.force_error))
        .column(with_unit("peak pressure,", &units.stress), |(_, own)| number(own.peak_pressure))
        .column("off by", |(_, own)| Cell::percent(own.peak_pressure_error))
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

/// Draws time against error: a series for each axis, and rings around what is on its front. None where
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
    let series: Vec<Series> = trade.sections.iter().map(of_section).chain([front]).collect();
    if series.iter().all(|series| series.points.is_empty()) {
        return None;
    }
    let axes = ["time, s", "relative error of the displacements"]
        .map(|label| Axis { label, logarithmic: true });
    let references =
        trade.sections.iter().map(|s| format!("{}: against {}.", s.parameter, s.against));
    let captions: Vec<String> =
        references.chain(["What has no error, the best itself, is not shown.".into()]).collect();
    Some(chart(&format!("Speed against accuracy: {}", trade.scene), axes, &series, &captions))
}

/// Reports what `solve --accuracy` did to reach `accuracy`, a part of the largest displacement.
pub fn reached(reached: &AccurateSolution, accuracy: f64) -> Report {
    let printed = reached.solution.request.variant == Variant::Printed;
    let attempts = reached.attempts.iter().map(|attempt| {
        let rounding = match &attempt.rounding {
            Rounding::NotRun(why) => format!("not run: {why}"),
            Rounding::Failed(why) => format!("failed, so up one precision: {why}"),
            Rounding::Measured(0.0) => "no rounding: taken".into(),
            Rounding::Measured(error) if *error <= accuracy => {
                format!("measured {error:.0e}: taken")
            }
            Rounding::Measured(error) if error.is_finite() => {
                format!("measured {error:.0e}, so up one precision")
            }
            Rounding::Measured(_) => {
                "rounding unknown, as it decides who is in contact: up one precision".into()
            }
        };
        let (scalar, solver) = (attempt.arithmetic.scalar, attempt.arithmetic.solver(printed));
        format!("{scalar} by {solver}: {rounding}")
    });
    let verdict = match reached.mesh > accuracy {
        true => "larger than what was asked, and no precision fixes that: refine the mesh",
        false => "not larger than what was asked",
    };
    Report::default()
        .heading(format!("Accuracy {accuracy:e} asked of the displacements, rounding alone"))
        .notes(attempts)
        .note(match reached.mesh {
            error if error.is_finite() => {
                format!("The mesh's own error is about {error:.0e} in the energy norm: {verdict}.")
            }
            _ => "What the mesh adds is unknown: it is too small for an estimate.".into(),
        })
}
