//! What the printed faults cost: the corrected algorithm of `listings/corrected/`, and the same with one
//! fault put back at a time, against the solution of the same conditions.

use nalgebra::DVector;
use rayon::prelude::*;
use schemars::JsonSchema;
use serde::Serialize;

use engine::error::Error;
use engine::{Request, Solution, Stiffness, over, solve};
use paper::corrected::{self, Bound, Ending, FAULTS, STEPS, iterate};
use problem::model::{Model, TriangleId};
use problem::modelling::{ContactModel, Coupling};
use problem::scene::Scene;

/// A run of the corrected algorithm.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct Price {
    /// The finding whose fault was put back; nothing for the corrected algorithm itself.
    pub finding: Option<&'static str>,
    /// The fault, in words.
    pub fault: String,
    /// The components of displacement that a node in contact shares with its target.
    pub bound: Bound,
    /// What came of the run.
    #[serde(flatten)]
    pub outcome: Outcome,
}

/// What came of a run of the corrected algorithm.
#[derive(Clone, Debug, Serialize, JsonSchema)]
#[serde(untagged)]
pub enum Outcome {
    /// It has a result.
    Result {
        /// The iterations until the contact pairs came back, or 20.
        iterations: usize,
        /// Whether the contact pairs came back.
        is_settled: bool,
        /// The contact nodes in contact at the end.
        in_contact: usize,
        /// The force that contact passes on along the load, over the load.
        transmitted: f64,
        /// sqrt((u − u*)ᵀ K (u − u*)) over sqrt(u*ᵀ K u*), where u* is the solution without friction.
        energy_relative: f64,
        /// The largest von Mises stress of the body in which it differs most from that of u*: the
        /// difference over that of u*.
        von_mises_relative: f64,
    },
    /// It stopped.
    Failure {
        /// The failure, with its line.
        failure: String,
    },
}

/// The runs that [`prices`] makes.
pub fn steps() -> usize {
    FAULTS.len() + 2
}

/// Runs the corrected algorithm on a scene along the normal, with each fault put back, and with both
/// components bound, as eq. (1) says. `watch` is called after each run.
///
/// # Errors
/// The scene has no contact or lists a contact node twice, or there is no solution without friction in
/// the initial geometry with which they are compared.
pub fn prices(scene: &Scene, watch: &(dyn Fn() + Sync)) -> Result<Vec<Price>, Error> {
    corrected::check(&scene.model)?;
    let reference = Request::new(scene).reference();
    let contact = ContactModel { coupling: Coupling::Nts, ..reference.contact };
    let exact = solve(&reference.contact(contact), &mut |_| ())?;
    let stiffness = Stiffness::new(&exact.model, |x| x);
    let none = (None, "none".to_string(), Bound::Normal, &[][..]);
    let faults: Vec<_> = FAULTS.iter().map(|fault| (fault, [fault.edit])).collect();
    let faulty = faults
        .iter()
        .map(|(fault, edits)| (Some(fault.finding), fault.words(), Bound::Normal, &edits[..]));
    let tied = "eq. (1) binds both components: no node in contact slides";
    let both = (Some("K9"), tied.to_string(), Bound::Both, &[][..]);
    let runs: Vec<_> = [none].into_iter().chain(faulty).chain([both]).collect();
    let price = |(finding, fault, bound, edits): (Option<&'static str>, String, Bound, &[&str])| {
        let outcome = match iterate(&exact.model, bound, edits, STEPS) {
            Ok(ending) => result(&exact, &stiffness, &ending),
            Err(failure) => Outcome::Failure { failure: failure.to_string() },
        };
        watch();
        Price { finding, fault, bound, outcome }
    };
    Ok(runs.into_par_iter().map(price).collect())
}

fn result(exact: &Solution, stiffness: &Stiffness, ending: &Ending) -> Outcome {
    let model = &*exact.model;
    let u = DVector::from_column_slice(&ending.u);
    let [error, scale] = [&(&u - &exact.u), &exact.u].map(|u| stiffness.energy_norm(u));
    let states = stiffness.states(&u);
    let change = |triangles: &[TriangleId]| {
        let own = triangles.iter().map(|id| states[id.index()].von_mises_stress);
        let exact = triangles.iter().map(|id| exact.elements[id.index()].von_mises_stress);
        let [own, exact] = [own.fold(0.0, f64::max), exact.fold(0.0, f64::max)];
        over(own - exact, exact)
    };
    let changes = model.bodies.iter().map(|body| change(&body.triangles));
    Outcome::Result {
        iterations: ending.iterations,
        is_settled: ending.is_settled,
        in_contact: ending.in_contact.len(),
        transmitted: transmitted(model, &(stiffness.times(&u) - &model.load)),
        energy_relative: over(error, scale),
        von_mises_relative: changes.fold(0.0, |a: f64, b| if b.abs() > a.abs() { b } else { a }),
    }
}

/// Returns the component along the load of the forces on the contact nodes, over the load.
fn transmitted(model: &Model, forces: &DVector<f64>) -> f64 {
    let [x, y] = model.total_load();
    let along = model.contact.nodes.iter().map(|node| {
        let [fx, fy] = node.components(forces);
        fx * x + fy * y
    });
    over(-along.sum::<f64>(), x * x + y * y)
}
