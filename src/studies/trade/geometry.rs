//! The parameter *geometry*: what the paper leaves open of its example, one thing at a time.

use std::sync::Arc;

use rayon::prelude::*;

use super::Varied;
use super::errors::Errors;
use super::rows::{Row, Section};
use super::trials::CARRYING;
use crate::audit::Case;
use crate::audit::claims::{Basis, CLAIMS, Claim, judge};
use crate::audit::range::{ParameterValue, Range, is_example, range};
use base::error::Result;
use engine::Request;
use engine::estimates::certain;
use problem::modelling::Variant;

/// Returns the places that are measured on the scene of `request`: none where it is not the paper's
/// example.
///
/// # Errors
/// Those of [`range`].
pub fn places(request: &Request) -> Result<Range> {
    if is_example(&request.scene) { range(request.reading) } else { Ok(Vec::new()) }
}

/// Measures every variant that carries load across, and judges every claim that rests on runs, on a
/// case and at each of `places`; `watch` is called after each.
pub fn geometry(case: &Case, places: &Range, watch: &(impl Fn(&str) + Sync)) -> Section {
    let on_runs = |claim: &&Claim| claim.basis == Basis::Runs && !places.is_empty();
    let on_runs: Vec<Claim> = CLAIMS.iter().filter(on_runs).cloned().collect();
    let of_place = |(place, case): &(ParameterValue, Arc<Case>)| {
        case.prepare();
        let rows: Vec<Row> = CARRYING.iter().map(|variant| row(*place, case, *variant)).collect();
        watch(&label(*place));
        rows
    };
    let rows: Vec<Row> = places.par_iter().flat_map_iter(of_place).collect();
    let claims = judge(&on_runs, case, places);
    let parameter = Varied::Geometry;
    Section { parameter, against: parameter.against(), rows, orders: Vec::new(), claims }
}

fn label(ParameterValue { parameter, value, .. }: ParameterValue) -> String {
    format!("{parameter} {value}")
}

fn row(place: ParameterValue, case: &Arc<Case>, variant: Variant) -> Row {
    let run = case.run(variant).map(|run| certain(run.clone()));
    let solution = run.as_ref().ok().map(|(solution, _)| solution);
    let last = solution.map(|solution| solution.last());
    let truth = case.equilibrium();
    let failure = match (&run, truth) {
        (Err(why), _) => Some(why.to_string()),
        (Ok(_), None) => Some("there is no equilibrium to measure it against".into()),
        _ => None,
    };
    Row {
        label: label(place),
        place: Some(place),
        variant,
        equations: case.model().dofs(),
        in_contact: last.map(|last| last.in_contact),
        cycle: last.and_then(|last| last.cycle.as_ref()).map(|cycle| cycle.length),
        seconds: None,
        runs: 1,
        peak_bytes: None,
        error: solution.zip(truth).map(|(own, truth)| Errors::new(own, truth)),
        change: None,
        certainty: run.as_ref().ok().map(|(_, certainty)| *certainty),
        own: place.own,
        pareto: false,
        failure,
    }
}
