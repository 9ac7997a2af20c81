//! What the printed faults cost, against the solution of the same conditions: the corrected algorithm of
//! `listings/corrected/` with one fault reintroduced at a time, and with all of them, repaired one at a time.

pub mod price_tables;

use std::collections::BTreeSet;
use std::iter;
use std::sync::Arc;

use nalgebra::DVector;
use rayon::prelude::*;
use serde::Serialize;

use super::Case;
use super::evidence::{NoFigures, Outcome, confirmed, flat};
use base::choices;
use engine::contact::{Sense, Status};
use engine::error::Result;
use engine::estimates::{RUNS, equivalent};
use engine::{Request, Solution, Stiffness, distance, over};
use paper::corrected::{Bound, Ending, FAULTS, Fault, Part, STEPS, Worksheet};
use paper::findings::FindingId;
use problem::model::{Dof, Model, NodeId};
use problem::modelling::{ContactModel, Coupling, Friction};

/// The relative error that is rounding, and costs nothing: 2.5e-8 was seen on `scene mesh punch`, where the
/// corrected algorithm and the reference have one solution.
pub const NOTHING: f64 = 1e-6;

/// The scale of the figures: a load that differs by a billionth moves any by as much, the small ones too.
const SCALE: f64 = 10.0;

choices! {
    /// What a fault does to the results on a scene.
    Weight {
        /// The run stops, or contact presses no contact node.
        Fatal = "fatal",
        /// The displacements are others, or do not settle.
        Shifts = "shifts",
        /// Nothing that is not rounding.
        Free = "free",
        /// Inputs that mean the same lead to other results.
        Rounding = "decided by rounding",
        /// It is what the scene's own friction does: no node slides in the equilibrium.
        NoFault = "no fault under the scene's own friction",
    }
}

/// A run of the corrected algorithm, with faults.
#[derive(Clone, Debug, Serialize)]
pub struct Price {
    /// The finding whose fault was reintroduced, or repaired; nothing for the run before the first.
    pub finding: Option<FindingId>,
    /// Its name: all findings that describe the fault, and which of one finding's faults it is.
    pub name: Option<String>,
    /// The fault, in words.
    pub fault: String,
    /// What it does: of a repair, what those do that are left.
    pub weight: Weight,
    /// What came of the run; of a fault that is none here, that it was not made.
    #[serde(flatten, serialize_with = "flat")]
    pub outcome: Outcome<CorrectedRun>,
}

/// The end of a run of the corrected algorithm.
#[derive(Clone, Debug, Serialize)]
pub struct CorrectedRun {
    /// The iterations until the contact pairs came back, or 20.
    pub iterations: usize,
    /// The iterations after which they come back: 1 where they stay, more where they alternate
    /// for ever; nothing where none came back.
    pub period: Option<usize>,
    /// The contact nodes in contact at the end.
    pub in_contact: usize,
    /// Whether contact presses no contact node.
    pub passes_nothing: bool,
    /// The component along the load of the force that reaches the target, over the load; in a direction
    /// in which target nodes are restrained, of what the contact nodes pass on.
    pub transmitted: f64,
    /// The distance from the solution without friction, which the corrected algorithm has, in the energy
    /// norm, relative.
    pub energy_relative: f64,
    /// The same from the equilibrium under the scene's own friction; nothing where there is none.
    pub equilibrium_relative: Option<f64>,
    /// The largest von Mises stress of the body in which it differs most from that of the solution without
    /// friction: the difference over the latter.
    pub von_mises_relative: f64,
}

impl CorrectedRun {
    /// Returns whether the contact pairs stay in the end.
    pub fn is_settled(&self) -> bool {
        self.period == Some(1)
    }

    /// Returns the error in the energy norm, relative, 0 where it is rounding.
    pub fn error(&self) -> f64 {
        if self.energy_relative <= NOTHING { 0.0 } else { self.energy_relative }
    }

    /// Returns the figures, each over the scale of its kind.
    fn figures(&self) -> Vec<Option<f64>> {
        let figures = [
            Some(self.iterations as f64),
            self.period.map(|period| period as f64),
            Some(self.in_contact as f64),
            Some(self.transmitted),
            Some(self.energy_relative),
            self.equilibrium_relative,
            Some(self.von_mises_relative),
        ];
        figures.map(|figure| Some(figure? / SCALE)).into()
    }
}

impl Price {
    fn new(fault: Option<&Fault>, outcome: Outcome<CorrectedRun>) -> Self {
        let words = fault.map_or("none".into(), Fault::words);
        let (finding, name) = (fault.map(|fault| fault.finding), fault.map(Fault::name));
        Price { finding, name, fault: words, weight: weight(&outcome), outcome }
    }

    /// Returns the error in the energy norm, relative, 0 where it is rounding or no fault; infinite where the
    /// run stopped, and where rounding decides.
    pub fn error(&self) -> f64 {
        error(&self.outcome)
    }
}

/// Returns what the faults of a run do.
fn weight(outcome: &Outcome<CorrectedRun>) -> Weight {
    match outcome {
        Ok(run) if run.passes_nothing => Weight::Fatal,
        Ok(run) if run.is_settled() && run.error() == 0.0 => Weight::Free,
        Ok(_) => Weight::Shifts,
        Err(NoFigures::Fails(_)) => Weight::Fatal,
        Err(NoFigures::Rounding) => Weight::Rounding,
        Err(NoFigures::Refused(_)) => Weight::NoFault,
    }
}

/// Returns the error of a run: [`Price::error`].
fn error(outcome: &Outcome<CorrectedRun>) -> f64 {
    match outcome {
        Ok(run) => run.error(),
        Err(NoFigures::Refused(_)) => 0.0,
        Err(NoFigures::Fails(_) | NoFigures::Rounding) => f64::INFINITY,
    }
}

/// Returns the request for the solution that the corrected algorithm has: without friction, node to segment,
/// in the initial geometry.
pub fn reference(request: &Request) -> Request {
    let reference = request.reference();
    let contact = ContactModel { coupling: Coupling::Nts, ..reference.contact };
    reference.contact(contact)
}

/// Runs the corrected algorithm along the normal, then, where it is at the solution, with each fault
/// reintroduced, in the order of [`FAULTS`]. `watch` is called after each of the [`runs`]: fewer
/// where the corrected algorithm is not at the solution.
///
/// # Errors
/// Those of [`Case::corrected`].
pub fn on(case: &Case, watch: &(dyn Fn() + Sync)) -> Result<Vec<Price>> {
    of_faults(case, &FAULTS.iter().collect::<Vec<_>>(), watch)
}

/// The same with each of some faults reintroduced. The runs of one input share a worksheet, so that what all
/// programs begin with is executed once.
///
/// # Errors
/// Those of [`Case::corrected`].
pub fn of_faults(
    case: &Case,
    faults: &[&'static Fault],
    watch: &(dyn Fn() + Sync),
) -> Result<Vec<Price>> {
    let known = Known::new(case)?;
    let slides = known.slides();
    let on = |model: &Arc<Model>| -> Vec<Outcome<CorrectedRun>> {
        let worksheet = Worksheet::new(model, Bound::Normal);
        let mut outcomes = vec![known.run(&worksheet, &[])];
        watch();
        if weight(&outcomes[0]) == Weight::Free {
            for fault in faults {
                outcomes.push(match fault.part == Some(Part::Sliding) && !slides {
                    true => Err(NoFigures::Refused("no effect, as nothing slides".into())),
                    false => known.run(&worksheet, &[fault.edit]),
                });
                watch();
            }
        }
        outcomes
    };
    let models = || iter::once(&known.exact.model).chain(&known.equivalents);
    let mut others: Vec<_> = models().collect::<Vec<_>>().into_par_iter().map(on).collect();
    let own = others.remove(0);
    // Where an input has no more than the corrected algorithm, it is not at the solution there.
    let ends = others.iter().map(Vec::len).min().unwrap_or(own.len());
    let outcomes = each_confirmed(own.into_iter().take(ends), &others);
    let faults = iter::once(None).chain(faults.iter().map(|fault| Some(*fault)));
    let prices = faults.zip(outcomes).map(|(fault, outcome)| Price::new(fault, outcome));
    let mut prices: Vec<Price> = prices.collect();
    if prices[0].weight != Weight::Free {
        prices.truncate(1);
    }
    Ok(prices)
}

/// Runs the corrected algorithm with all faults reintroduced, then repairs one at a time. The order is
/// found from the end: into the corrected algorithm the faults are reintroduced one at a time, of those
/// that are left the one that leaves the least error, and the first in [`FAULTS`] of those that
/// leave the same; the last one is repaired first. `alone` are the prices [`on`] the case. `watch` is called
/// after each of the [`runs_of_repairs`].
///
/// # Errors
/// Those of [`Case::corrected`].
pub fn repairs(case: &Case, alone: &[Price], watch: &(dyn Fn() + Sync)) -> Result<Vec<Price>> {
    let known = Known::new(case)?;
    let edits = |put_back: &[usize]| -> Vec<&str> {
        let faults = (0..FAULTS.len()).filter(|k| put_back.contains(k));
        faults.map(|k| FAULTS[k].edit).collect()
    };
    // What rounding decides of a fault alone is not nothing, whatever a run has.
    let is_rounded =
        |k: usize| alone.get(1 + k).is_some_and(|price| price.weight == Weight::Rounding);
    let (mut left, mut put_back): (Vec<usize>, _) = ((0..FAULTS.len()).collect(), Vec::new());
    let mut own = vec![known.run(&Worksheet::new(&known.exact.model, Bound::Normal), &[])];
    watch();
    let mut runs = vec![edits(&put_back)];
    while !left.is_empty() {
        let with = |part: &[usize]| -> Vec<Outcome<CorrectedRun>> {
            let worksheet = Worksheet::new(&known.exact.model, Bound::Normal);
            let run = |k: &usize| {
                let outcome = known.run(&worksheet, &edits(&[&put_back[..], &[*k]].concat()));
                watch();
                outcome
            };
            part.iter().map(run).collect()
        };
        // One worksheet for each thread: to begin one takes as long as a run.
        let part = left.len().div_ceil(rayon::current_num_threads());
        let mut outcomes: Vec<_> = left.par_chunks(part).flat_map_iter(with).collect();
        // Rounding is not to decide which comes first.
        let rank = |k: &usize| {
            let least = if is_rounded(left[*k]) { 2.0 } else { 0.0 };
            (error(&outcomes[*k]) / NOTHING).round().max(least)
        };
        let least = (0..left.len()).min_by(|a, b| rank(a).total_cmp(&rank(b)));
        let least = least.expect("a fault is left");
        own.push(outcomes.remove(least));
        put_back.push(left.remove(least));
        runs.push(edits(&put_back));
    }
    let on = |model: &Arc<Model>| -> Vec<Outcome<CorrectedRun>> {
        let worksheet = Worksheet::new(model, Bound::Normal);
        runs.iter().map(|edits| known.run(&worksheet, edits)).collect()
    };
    let others: Vec<_> = known.equivalents.par_iter().map(on).collect();
    // What is left when a fault is repaired is what was there before it was reintroduced.
    let faults = put_back.iter().map(|k| Some(&FAULTS[*k])).chain([None]);
    let prices = faults.zip(each_confirmed(own, &others));
    let mut repaired: Vec<Price> = prices.map(|(fault, run)| Price::new(fault, run)).collect();
    repaired.last_mut().expect("all are reintroduced").fault = "all are reintroduced".into();
    repaired.reverse();
    Ok(repaired)
}

/// The solutions that are known of a scene, whose distances from a run are its price.
struct Known<'c> {
    /// The solution that the corrected algorithm has.
    exact: &'c Solution,
    /// The equilibrium under the scene's own friction; nothing where there is none.
    equilibrium: Option<&'c Solution>,
    /// The models that mean the same.
    equivalents: Vec<Arc<Model>>,
    stiffness: Stiffness,
}

impl<'c> Known<'c> {
    fn new(case: &'c Case) -> Result<Self> {
        let exact = case.corrected()?;
        // Where nothing moves there is no figure that rounding could change.
        let others = equivalent(&exact.request).filter(|_| exact.u.amax() > 0.0);
        let equivalents = others.map(|request| request.model()).collect::<Result<_, _>>()?;
        let stiffness = Stiffness::new(&exact.model, |x| x);
        Ok(Known { exact, equilibrium: case.equilibrium(), equivalents, stiffness })
    }

    /// Returns whether a node slides on the way to the equilibrium under the scene's own friction; without
    /// one, whether any may.
    fn slides(&self) -> bool {
        let Some(equilibrium) = self.equilibrium else {
            return self.exact.request.scene.contact.friction != Friction::STICK;
        };
        let is_frictionless = equilibrium.request.contact.friction == Friction::NONE;
        // With friction a node on a line of symmetry, which restrains it, is free, and does not slide.
        let slips = |status: &Status| match status {
            Status::Slip(Sense::Free) => is_frictionless,
            Status::Slip(Sense::Forward | Sense::Backward) => true,
            Status::Open | Status::Stick => false,
        };
        let mut states = equilibrium.steps.iter().filter_map(|step| step.unilateral());
        states.any(|state| state.statuses.iter().any(slips))
    }

    /// The largest displacement of a run that has a result: a body that nothing holds moves farther.
    fn farthest(&self) -> f64 {
        self.exact.model.bounds().larger_side().max(1e3 * self.exact.u.amax())
    }

    /// Runs the corrected algorithm with faults reintroduced.
    fn run(&self, worksheet: &Worksheet, edits: &[&str]) -> Outcome<CorrectedRun> {
        let ending = worksheet.iterate(edits, STEPS).map_err(|why| why.to_string())?;
        let farthest = self.farthest();
        if !ending.u.iter().all(|x| x.abs() <= farthest) {
            return Err("a body is free to move: it moves by more than the size of the model, and a thousand \
                        times the solution"
                .into());
        }
        Ok(self.beside(&ending))
    }

    /// Returns a run with its distances from the solutions.
    fn beside(&self, ending: &Ending) -> CorrectedRun {
        let model = &*self.exact.model;
        let u = DVector::from_column_slice(&ending.u);
        let [own, exact] = [&u, &self.exact.u].map(|u| self.stiffness.times(u) - &model.load);
        let largest = pressed(model, &exact).max(model.load.amax());
        let states = self.stiffness.states(&u);
        let run = self.exact.with_fields(u, states);
        let from_exact = distance(&run, self.exact);
        let stresses = from_exact.bodies.iter().map(|body| body.relative);
        CorrectedRun {
            iterations: ending.iterations,
            period: ending.period,
            in_contact: ending.in_contact.len(),
            passes_nothing: pressed(model, &own) <= NOTHING * largest,
            transmitted: transmitted(model, &own),
            energy_relative: from_exact.energy_relative,
            equilibrium_relative: self.equilibrium.map(|own| distance(&run, own).energy_relative),
            von_mises_relative: stresses
                .fold(0.0, |a: f64, b| if b.abs() > a.abs() { b } else { a }),
        }
    }
}

/// The runs that [`on`] makes at most.
pub fn runs() -> usize {
    (1 + FAULTS.len()) * (1 + RUNS)
}

/// The runs that [`repairs`] makes.
pub fn runs_of_repairs() -> usize {
    1 + FAULTS.len() * (FAULTS.len() + 1) / 2
}

/// Leaves out the figures of the runs whose repetitions on the inputs that mean the same, a row of them for
/// each input, lead to others.
fn each_confirmed(
    own: impl IntoIterator<Item = Outcome<CorrectedRun>>,
    others: &[Vec<Outcome<CorrectedRun>>],
) -> impl Iterator<Item = Outcome<CorrectedRun>> {
    own.into_iter().enumerate().map(|(k, own)| {
        confirmed(own, others.iter().map(|other| other[k].clone()), CorrectedRun::figures)
    })
}

/// Returns how many repairs the way from the print to the solution takes; nothing where it does not lead
/// there.
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
    dofs.filter(|dof| !model.is_restrained(*dof)).collect()
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
        let is_held = target.iter().any(|node| model.is_restrained(node.dofs()[d]));
        load[d] * if is_held { 0.0 - sum(&contact_nodes(model)) } else { sum(&target) }
    };
    over(component(0) + component(1), load[0] * load[0] + load[1] * load[1])
}
