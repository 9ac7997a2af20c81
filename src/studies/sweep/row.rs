//! The row of a case: what came of it, flat, for a data frame.

use serde_json::{Map, Value, json};

use super::document::Document;
use base::error::Result;
use engine::error::Error;
use engine::{Request, Solution, max_displacement, solve, summaries};

/// What came of a case, by column.
pub type Row = Map<String, Value>;

/// Runs a case; what fails is a row too.
pub fn row(document: Result<Document>) -> Row {
    let request = document.and_then(|document| document.request()).map_err(Error::Input);
    let solved = request.and_then(|request: Request| solve(&request, &mut |_| ()));
    match solved {
        Ok(solution) => solution_row(&solution),
        Err(why) => failed(i64::from(why.exit_status()), &why.to_string()),
    }
}

/// Returns the row of a case whose process ended before it had one; `why` says how.
pub fn crashed(status: Option<i32>, why: &str) -> Row {
    failed(status.map_or(-1, i64::from), &format!("the process crashed: {why}"))
}

fn failed(status: i64, why: &str) -> Row {
    let mut row = Row::new();
    row.insert("exit_status".into(), json!(status));
    row.insert("error".into(), json!(why));
    row
}

fn solution_row(solution: &Solution) -> Row {
    let mut row = Row::new();
    let last = solution.last();
    let several = solution.equilibrium.as_ref().is_some_and(|e| e.uniqueness.is_refuted());
    let mut set = |name: &str, value: Value| drop(row.insert(name.into(), value));
    set("exit_status", json!(if several { 4 } else { 0 }));
    let error = several.then_some("the equilibrium is not the only one");
    set("error", json!(error));
    set("iterations", json!(solution.steps.len()));
    set("in_contact", json!(last.in_contact));
    set("cycle", json!(last.cycle.as_ref().map(|cycle| cycle.length)));
    set("max_displacement", json!(max_displacement(&solution.u)));
    set("target_force", json!(solution.target_force()));
    let pressures = solution.contact.iter().filter_map(|node| node.pressure);
    set("max_pressure", json!(pressures.reduce(f64::max)));
    let gaps = solution.contact.iter().map(|node| node.gap);
    set("min_gap", json!(gaps.reduce(f64::min)));
    for body in summaries(solution) {
        set(&format!("max_von_mises_stress {}", body.name), json!(body.max_von_mises_stress));
        set(&format!("max_von_mises_strain {}", body.name), json!(body.max_von_mises_strain));
        set(&format!("max_displacement {}", body.name), json!(body.max_displacement));
    }
    row
}
