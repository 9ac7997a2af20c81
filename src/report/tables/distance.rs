//! How far a run is from the reference solution and from the equilibrium under friction.

use crate::model::{Cell, Report, Table};
use crate::numbers::{percent, quantity, reason, short};
use crate::pressure;
use engine::error::Error;
use engine::{Assessment, Solution, SolutionDistance};

/// Reports the distance of a run from the reference solution and from the equilibrium under the
/// scene's own friction, or why there is none.
pub fn distance(solution: &Solution, assessment: &Assessment) -> Report {
    let others = [
        ("reference solution", &assessment.reference),
        ("equilibrium under the scene's own friction and geometry", &assessment.equilibrium),
    ];
    let known = others.iter().filter_map(|(what, other)| Some((what, other.as_ref()?)));
    known.fold(Report::default(), |report, (what, other)| {
        report.then(distance_from(solution, what, other))
    })
}

fn distance_from(
    solution: &Solution,
    what: &str,
    other: &Result<SolutionDistance, Error>,
) -> Report {
    let measured = match other {
        Err(why) => return Report::default().heading(format!("No {what} to compare with: {why}")),
        Ok(measured) => measured,
    };
    let units = &solution.request.scene.units;
    let (distance, reference) = (&measured.distance, &measured.reference);
    let title = format!(
        "Distance from the {what} ({}, {} geometry; {} in contact)",
        pressure::name(reference),
        reference.request.contact.geometry,
        reference.in_contact().count()
    );
    let table = Table::from_rows(&distance.bodies)
        .column("body", |body| body.name.clone())
        .column(quantity("largest von Mises stress", &units.stress), |body| body.von_mises_stress)
        .column("there", |body| body.reference)
        .column("difference", |body| Cell::percent(body.relative, 2).because(reason("relative")));
    let relative = match distance.displacement_relative {
        relative if relative.is_finite() => format!(" = {}", percent(relative, 2)),
        _ => String::new(),
    };
    Report::default()
        .table(title, table)
        .note(format!(
            "{}: {}{relative}",
            quantity("largest difference of a displacement", &units.length),
            short(distance.displacement)
        ))
        .note(format!("energy norm of the difference: {}", percent(distance.energy_relative, 2)))
}
