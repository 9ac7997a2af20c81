//! How far a run is from the reference solution and from the equilibrium under friction.

use crate::model::{Cell, Report, Table};
use crate::numbers::{Digits, figure, percent, quantity, reason};
use crate::pressure;
use engine::{Assessment, BodyDistance, Solution, SolutionDistance};

/// Reports the distance of a run from the reference solution and from the equilibrium under the
/// scene's own friction, or why there is none.
pub fn distance(solution: &Solution, assessment: &Assessment) -> Report {
    let error = super::error_of_mesh(assessment);
    let others = [
        ("reference solution", &assessment.reference),
        ("equilibrium under the scene's own friction and geometry", &assessment.equilibrium),
    ];
    let mut report = Report::default();
    for (what, other) in others {
        report = match other {
            None => report,
            // The run itself.
            Some(Ok(measured)) if measured.reference.u == solution.u => report,
            Some(Err(why)) => report.heading(format!("No {what} to compare with: {why}")),
            Some(Ok(measured)) => report.then(distance_from(solution, what, measured, error)),
        };
    }
    report
}

fn distance_from(
    solution: &Solution,
    what: &str,
    measured: &SolutionDistance,
    error: Option<f64>,
) -> Report {
    let units = &solution.request.scene.units;
    let (distance, reference) = (&measured.distance, &measured.reference);
    let title = format!(
        "Distance from the {what} ({}, {} geometry; {} in contact)",
        pressure::name(reference),
        reference.request.contact.geometry,
        reference.in_contact().count()
    );
    let digits = |body: &BodyDistance| Digits::of(body.von_mises_stress.max(body.reference), error);
    let table = Table::from_rows(&distance.bodies)
        .column("body", |body| body.name.clone())
        .column(quantity("largest von Mises stress", &units.stress), |body| {
            Cell::of_digits(body.von_mises_stress, digits(body))
        })
        .column("reference", |body| Cell::of_digits(body.reference, digits(body)))
        .column("difference", |body| Cell::percent(body.relative).because(reason("relative")));
    let relative = match distance.displacement_relative {
        relative if relative.is_finite() => format!(" = {}", percent(relative)),
        _ => String::new(),
    };
    Report::default()
        .table(title, table)
        .note(format!(
            "{}: {}{relative}",
            quantity("largest difference of a displacement", &units.length),
            figure(distance.displacement, error)
        ))
        .note(format!("energy norm of the difference: {}", percent(distance.energy_relative)))
}
