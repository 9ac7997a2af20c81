//! What the printed faults cost, against the solution of the same conditions: the corrected algorithm of
//! `listings/corrected/` with one fault put back at a time, and with all of them, repaired one at a time.

use std::collections::BTreeSet;
use std::sync::Arc;

use nalgebra::DVector;
use rayon::prelude::*;
use serde::Serialize;

use super::Case;
use super::range::{ParameterValue, Range};
use base::choices;
use engine::error::Error;
use engine::{Request, Solution, Stiffness, over, solve};
use paper::corrected::{self, Bound, Ending, FAULTS, Fault, STEPS, iterate};
use problem::model::{Dof, Model, NodeId, TriangleId};
use problem::modelling::{ContactModel, Coupling, Variant};

/// The relative error that is rounding, and costs nothing: 2.5e-8 was seen on `scene mesh punch`, where the
/// corrected algorithm and the reference have one solution.
pub const NOTHING: f64 = 1e-6;

choices! {
    /// What a fault does to the results on a scene.
    Weight {
        /// The run stops, or contact presses no contact node.
        Fatal = "fatal",
        /// The displacements are others, or do not settle.
        Shifts = "shifts",
        /// Nothing that is not rounding.
        Free = "free",
    }
}

/// A run of the corrected algorithm, with faults.
#[derive(Clone, Debug, Serialize)]
pub struct Price {
    /// The finding whose fault was put back, or repaired; nothing for the run before the first.
    pub finding: Option<&'static str>,
    /// Its name: all findings that describe the fault, and which of one finding's faults it is.
    pub name: Option<String>,
    /// The fault, in words.
    pub fault: String,
    /// What it does: of a repair, what those do that are left.
    pub weight: Weight,
    /// What came of the run.
    #[serde(flatten)]
    pub outcome: Outcome,
}

/// What came of a run of the corrected algorithm.
#[derive(Clone, Debug, Serialize)]
#[serde(untagged)]
pub enum Outcome {
    /// It has a result.
    Result {
        /// The iterations until the contact pairs came back, or 20.
        iterations: usize,
        /// The iterations after which they come back: 1 where they stay, more where they alternate
        /// for ever; nothing where none came back.
        period: Option<usize>,
        /// The contact nodes in contact at the end.
        in_contact: usize,
        /// Whether contact presses no contact node.
        passes_nothing: bool,
        /// The component along the load of the force that reaches the target, over the load; in a direction
        /// in which target nodes are restrained, of what the contact nodes pass on.
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

impl Outcome {
    /// Returns what the faults do.
    pub fn weight(&self) -> Weight {
        match self {
            Outcome::Failure { .. } | Outcome::Result { passes_nothing: true, .. } => Weight::Fatal,
            Outcome::Result { .. } if self.is_settled() && self.error() == 0.0 => Weight::Free,
            Outcome::Result { .. } => Weight::Shifts,
        }
    }

    /// Returns whether the contact pairs stay in the end.
    pub fn is_settled(&self) -> bool {
        matches!(self, Outcome::Result { period: Some(1), .. })
    }

    /// Returns the error in the energy norm, relative, 0 where it is rounding; infinite where the run
    /// stopped.
    pub fn error(&self) -> f64 {
        match self {
            Outcome::Result { energy_relative: error, .. } if *error <= NOTHING => 0.0,
            Outcome::Result { energy_relative, .. } => *energy_relative,
            Outcome::Failure { .. } => f64::INFINITY,
        }
    }
}

/// A scene, and the solution with which the runs are compared.
pub struct Compared {
    /// The solution without friction, node to segment, in the initial geometry.
    pub exact: Solution,
    stiffness: Stiffness,
}

impl Compared {
    /// Solves a request's scene without friction, node to segment, in the initial geometry. Of its reading
    /// only what changes the model matters (R6, R8).
    ///
    /// # Errors
    /// The scene has no contact or lists a contact node twice, or there is no such solution.
    pub fn new(request: &Request) -> Result<Self, Error> {
        corrected::check(&request.scene.model)?;
        let reference = request.clone().reference();
        let contact = ContactModel { coupling: Coupling::Nts, ..reference.contact };
        let exact = solve(&reference.contact(contact), &mut |_| ())?;
        let stiffness = Stiffness::new(&exact.model, |x| x);
        Ok(Compared { exact, stiffness })
    }

    /// Runs the corrected algorithm along the normal, then with each fault put back, in the order of
    /// [`FAULTS`]. `watch` is called after each of the [`runs`].
    pub fn prices(&self, watch: &(dyn Fn() + Sync)) -> Vec<Price> {
        let faults = FAULTS.par_iter().map(Some);
        let runs = rayon::iter::once(None).chain(faults).map(|fault| {
            let outcome = self.run(fault.into_iter());
            watch();
            price(fault, outcome)
        });
        runs.collect()
    }

    /// Runs the corrected algorithm with all faults put back, then repairs one at a time. The order is
    /// found from the end: into the corrected algorithm the faults are put back one at a time, of those
    /// that are left the one that leaves the least error, and the first in [`FAULTS`] of those that
    /// leave the same; the last one is repaired first. `watch` is called after each of the
    /// [`runs_of_repairs`].
    pub fn repairs(&self, watch: &(dyn Fn() + Sync)) -> Vec<Price> {
        let run = |put_back: &[usize]| {
            let faults = (0..FAULTS.len()).filter(|k| put_back.contains(k));
            let outcome = self.run(faults.map(|k| &FAULTS[k]));
            watch();
            outcome
        };
        let (mut put_back, mut repaired) = (Vec::new(), Vec::new());
        let mut outcome = run(&put_back);
        while put_back.len() < FAULTS.len() {
            let left: Vec<usize> = (0..FAULTS.len()).filter(|k| !put_back.contains(k)).collect();
            let with = |k: &usize| run(&[&put_back[..], &[*k]].concat());
            let mut outcomes: Vec<Outcome> = left.par_iter().map(with).collect();
            // Rounding is not to decide which comes first.
            let error = |k: &usize| (outcomes[*k].error() / NOTHING).round();
            let least = (0..left.len()).min_by(|a, b| error(a).total_cmp(&error(b)));
            let least = least.expect("a fault is left");
            put_back.push(left[least]);
            let before = std::mem::replace(&mut outcome, outcomes.swap_remove(least));
            repaired.push(price(Some(&FAULTS[left[least]]), before));
        }
        repaired.push(Price { fault: "all are put back".into(), ..price(None, outcome) });
        repaired.reverse();
        repaired
    }

    /// The largest displacement of a run that has a result: a body that nothing holds moves farther.
    fn farthest(&self) -> f64 {
        self.exact.model.bounds().larger_side().max(1e3 * self.exact.u.amax())
    }

    /// Runs the corrected algorithm with faults put back.
    fn run<'a>(&self, faults: impl Iterator<Item = &'a Fault>) -> Outcome {
        let model = &*self.exact.model;
        let edits: Vec<&str> = faults.map(|fault| fault.edit).collect();
        match iterate(model, Bound::Normal, &edits, STEPS) {
            Ok(ending) if ending.u.iter().all(|x| x.abs() <= self.farthest()) => {
                self.result(&ending)
            }
            Ok(_) => {
                let failure = "a body is free to move: it moves by more than the size of the model, and a \
                               thousand times the solution";
                Outcome::Failure { failure: failure.into() }
            }
            Err(failure) => Outcome::Failure { failure: failure.to_string() },
        }
    }

    fn result(&self, ending: &Ending) -> Outcome {
        let Compared { exact, stiffness } = self;
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
        let [own, known] = [&u, &exact.u].map(|u| stiffness.times(u) - &model.load);
        let largest = pressed(model, &known).max(model.load.amax());
        Outcome::Result {
            iterations: ending.iterations,
            period: ending.period,
            in_contact: ending.in_contact.len(),
            passes_nothing: pressed(model, &own) <= NOTHING * largest,
            transmitted: transmitted(model, &own),
            energy_relative: over(error, scale),
            von_mises_relative: changes
                .fold(0.0, |a: f64, b| if b.abs() > a.abs() { b } else { a }),
        }
    }
}

fn price(fault: Option<&Fault>, outcome: Outcome) -> Price {
    let words = fault.map_or("none".into(), Fault::words);
    let weight = outcome.weight();
    let (finding, name) = (fault.map(|fault| fault.finding), fault.map(Fault::name));
    Price { finding, name, fault: words, weight, outcome }
}

/// Returns the prices on a case. `watch` is called after each of the [`runs`].
///
/// # Errors
/// There is no solution with which they are compared: says why.
pub fn on(case: &Case, watch: &(dyn Fn() + Sync)) -> Result<Vec<Price>, String> {
    let compared = Compared::new(&case.request(Variant::Unilateral));
    compared.map(|compared| compared.prices(watch)).map_err(|why| why.to_string())
}

/// The prices at a place of the range of what the paper leaves open.
#[derive(Clone, Debug, Serialize)]
pub struct PricesAt {
    /// The place.
    pub at: ParameterValue,
    /// The prices there, or why there are none.
    pub prices: Result<Vec<Price>, String>,
}

/// Returns the prices at each place of a range but the paper's example as we assume it. `watch` is called
/// after each of the [`runs_over`] the range.
pub fn over_range(places: &Range, watch: &(dyn Fn() + Sync)) -> Vec<PricesAt> {
    others(places).map(|(at, case)| PricesAt { at: *at, prices: on(case, watch) }).collect()
}

/// The runs that [`over_range`] makes at most.
pub fn runs_over(places: &Range) -> usize {
    others(places).count() * runs()
}

fn others(places: &Range) -> impl Iterator<Item = &(ParameterValue, Arc<Case>)> {
    places.iter().filter(|(at, _)| !at.own)
}

/// The runs that [`Compared::prices`] makes.
pub fn runs() -> usize {
    1 + FAULTS.len()
}

/// The runs that [`Compared::repairs`] makes.
pub fn runs_of_repairs() -> usize {
    1 + FAULTS.len() * (FAULTS.len() + 1) / 2
}

/// Returns how many repairs the way from the print to the solution takes; nothing where it does not lead there.
pub fn needed(repairs: &[Price]) -> Option<usize> {
    let last = repairs.iter().rposition(|price| price.weight != Weight::Free);
    let needed = last.map_or(0, |k| k + 1);
    (needed < repairs.len()).then_some(needed)
}

/// Returns the largest component of the forces of contact on a contact node that is free.
fn pressed(model: &Model, forces: &DVector<f64>) -> f64 {
    let free = free_dofs(model, &contact_nodes(model));
    free.into_iter().map(|dof| forces[dof.index()].abs()).fold(0.0, f64::max)
}

fn contact_nodes(model: &Model) -> BTreeSet<NodeId> {
    model.contact.nodes.iter().copied().collect()
}

fn free_dofs(model: &Model, nodes: &BTreeSet<NodeId>) -> Vec<Dof> {
    let dofs = nodes.iter().flat_map(|node| node.dofs());
    dofs.filter(|dof| !model.restrained[dof.index()]).collect()
}

/// Returns the component along the load of the forces of contact on the target, over the load.
fn transmitted(model: &Model, forces: &DVector<f64>) -> f64 {
    let load = model.total_load();
    let target: BTreeSet<NodeId> = model.target_edges().flat_map(|edge| edge.nodes).collect();
    let component = |d: usize| {
        let sum = |nodes: &BTreeSet<NodeId>| {
            let dofs = free_dofs(model, nodes).into_iter().filter(|dof| dof.direction() == d);
            dofs.map(|dof| forces[dof.index()]).sum::<f64>()
        };
        let is_held = target.iter().any(|node| model.restrained[node.dofs()[d].index()]);
        load[d] * if is_held { 0.0 - sum(&contact_nodes(model)) } else { sum(&target) }
    };
    over(component(0) + component(1), load[0] * load[0] + load[1] * load[1])
}
