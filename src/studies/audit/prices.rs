//! What the printed faults cost, against the solution of the same conditions: the corrected algorithm of
//! `listings/corrected/` with one fault reintroduced at a time, and with all of them, repaired one at a time.

pub mod table;

use std::collections::BTreeSet;
use std::sync::Arc;

use nalgebra::DVector;
use rayon::prelude::*;
use serde::Serialize;

use super::Case;
use super::evidence::Measured;
use base::choices;
use engine::contact::{Sense, Status};
use engine::error::Error;
use engine::estimates::{RUNS, equivalent, moves};
use engine::{Request, Solution, Stiffness, over, solve};
use paper::corrected::{self, Bound, Ending, FAULTS, Fault, STEPS, Worksheet};
use problem::model::{Dof, Model, NodeId, TriangleId};
use problem::modelling::{ContactModel, Coupling, Friction, Variant};

/// The relative error that is rounding, and costs nothing: 2.5e-8 was seen on `scene mesh punch`, where the
/// corrected algorithm and the reference have one solution.
pub const NOTHING: f64 = 1e-6;

/// The scale of the figures: a load that differs by a billionth moves any by as much, the small ones too.
const SCALE: f64 = 10.0;

/// The fault that ties both components of a node in contact.
const STICKING: &str = "K9 (sliding)";

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
        /// sqrt((u − u*)ᵀ K (u − u*)) over sqrt(u*ᵀ K u*), where u* is the solution without friction, which
        /// the corrected algorithm has.
        energy_relative: f64,
        /// The same where u* is the equilibrium under the scene's own friction; nothing where there is none.
        equilibrium_relative: Option<f64>,
        /// The largest von Mises stress of the body in which it differs most from that of u*: the
        /// difference over that of u*.
        von_mises_relative: f64,
    },
    /// It stopped.
    Failure {
        /// The failure, with its line.
        failure: String,
    },
    /// It has no figures, as rounding decides on them.
    Rounding {},
    /// It was not run: it is no fault under the scene's own friction.
    NoFault {},
}

impl Outcome {
    /// Returns what the faults do.
    pub fn weight(&self) -> Weight {
        match self {
            Outcome::Failure { .. } | Outcome::Result { passes_nothing: true, .. } => Weight::Fatal,
            Outcome::Result { .. } if self.is_settled() && self.error() == 0.0 => Weight::Free,
            Outcome::Result { .. } => Weight::Shifts,
            Outcome::Rounding {} => Weight::Rounding,
            Outcome::NoFault {} => Weight::NoFault,
        }
    }

    /// Returns whether the corrected algorithm itself ends thus where it holds: at the solution, with a load
    /// that passes.
    pub fn is_sound(&self) -> bool {
        self.weight() == Weight::Free
    }

    /// Returns the distance from the equilibrium under the scene's own friction, relative.
    pub fn from_equilibrium(&self) -> Option<f64> {
        match self {
            Outcome::Result { equilibrium_relative, .. } => *equilibrium_relative,
            Outcome::Failure { .. } | Outcome::Rounding {} | Outcome::NoFault {} => None,
        }
    }

    fn figures(&self) -> Option<[Option<f64>; 7]> {
        match self {
            Outcome::Result {
                iterations,
                period,
                in_contact,
                transmitted,
                energy_relative,
                equilibrium_relative,
                von_mises_relative,
                ..
            } => Some([
                Some(*iterations as f64),
                period.map(|period| period as f64),
                Some(*in_contact as f64),
                Some(*transmitted),
                Some(*energy_relative),
                *equilibrium_relative,
                Some(*von_mises_relative),
            ]),
            Outcome::Failure { .. } | Outcome::Rounding {} | Outcome::NoFault {} => None,
        }
    }

    /// Returns whether the contact pairs stay in the end.
    pub fn is_settled(&self) -> bool {
        matches!(self, Outcome::Result { period: Some(1), .. })
    }

    /// Returns the error in the energy norm, relative, 0 where it is rounding or no fault; infinite where the
    /// run stopped, and where rounding decides.
    pub fn error(&self) -> f64 {
        match self {
            Outcome::Result { energy_relative: error, .. } if *error <= NOTHING => 0.0,
            Outcome::Result { energy_relative, .. } => *energy_relative,
            Outcome::NoFault {} => 0.0,
            Outcome::Failure { .. } | Outcome::Rounding {} => f64::INFINITY,
        }
    }
}

impl Measured for Outcome {
    fn moves(&self, other: &Self) -> bool {
        match (self.figures(), other.figures()) {
            (Some(own), Some(other)) => {
                own.iter().zip(&other).any(|(own, other)| moves(*own, *other, SCALE))
            }
            (own, other) => own.is_some() != other.is_some(),
        }
    }

    fn by_rounding(self) -> Self {
        Outcome::Rounding {}
    }
}

/// Returns the request for the solution that the corrected algorithm has: without friction, node to segment, in the
/// initial geometry.
pub fn reference(request: &Request) -> Request {
    let reference = request.reference();
    let contact = ContactModel { coupling: Coupling::Nts, ..reference.contact };
    reference.contact(contact)
}

/// A scene, and the solutions with which the runs are compared.
pub struct Compared {
    /// The solution without friction, node to segment, in the initial geometry.
    pub exact: Solution,
    /// The equilibrium under the scene's own friction; nothing where there is none.
    pub equilibrium: Option<Solution>,
    /// The models that mean the same.
    equivalents: Vec<Arc<Model>>,
    stiffness: Stiffness,
}

impl Compared {
    /// Solves a case's scene without friction, node to segment, in the initial geometry. Of its reading
    /// only what changes the model matters (R6, R8).
    ///
    /// # Errors
    /// The scene has no contact or lists a contact node twice, or there is no such solution.
    pub fn new(case: &Case) -> Result<Self, Error> {
        let request = case.request(Variant::Unilateral);
        corrected::check(&request.scene.model)?;
        let exact = solve(&reference(&request), &mut |_| ())?;
        let stiffness = Stiffness::new(&exact.model, |x| x);
        // Where nothing moves there is no figure that rounding could change.
        let others = equivalent(&exact.request).filter(|_| exact.u.amax() > 0.0);
        let equivalents = others.map(|request| request.model()).collect::<Result<_, _>>()?;
        Ok(Compared { exact, equilibrium: case.equilibrium().cloned(), equivalents, stiffness })
    }

    /// Runs the corrected algorithm along the normal, then, where it is at the solution, with each fault
    /// reintroduced, in the order of [`FAULTS`]. `watch` is called after each of the [`runs`]: fewer
    /// where the corrected algorithm is not at the solution.
    pub fn prices(&self, watch: &(dyn Fn() + Sync)) -> Vec<Price> {
        self.prices_of(&FAULTS.iter().collect::<Vec<_>>(), watch)
    }

    /// The same with each of some faults reintroduced. The runs of one input share a worksheet, so that what all
    /// programs begin with is executed once.
    pub fn prices_of(&self, faults: &[&'static Fault], watch: &(dyn Fn() + Sync)) -> Vec<Price> {
        let slides = self.slides();
        let on = |model: &&Model| -> Vec<Outcome> {
            let worksheet = Worksheet::new(model, Bound::Normal);
            let mut outcomes = vec![self.run(&worksheet, &[])];
            watch();
            if outcomes[0].is_sound() {
                for fault in faults {
                    outcomes.push(match fault.name() == STICKING && !slides {
                        true => Outcome::NoFault {},
                        false => self.run(&worksheet, &[fault.edit]),
                    });
                    watch();
                }
            }
            outcomes
        };
        let equivalents = self.equivalents.iter().map(|model| &**model);
        let models: Vec<&Model> = std::iter::once(&*self.exact.model).chain(equivalents).collect();
        let mut others: Vec<_> = models.par_iter().map(on).collect();
        let own = others.remove(0);
        // Where an input has no more than the corrected algorithm, it is not at the solution there.
        let ends = others.iter().map(Vec::len).min().unwrap_or(own.len());
        let outcomes = repeated(own.into_iter().take(ends), &others);
        let faults = std::iter::once(None).chain(faults.iter().map(|fault| Some(*fault)));
        let prices = faults.zip(outcomes).map(|(fault, outcome)| self.price(fault, outcome));
        let mut prices: Vec<Price> = prices.collect();
        if !prices[0].outcome.is_sound() {
            prices.truncate(1);
        }
        prices
    }

    /// Runs the corrected algorithm with all faults reintroduced, then repairs one at a time. The order is
    /// found from the end: into the corrected algorithm the faults are reintroduced one at a time, of those
    /// that are left the one that leaves the least error, and the first in [`FAULTS`] of those that
    /// leave the same; the last one is repaired first. `alone` are the [`Self::prices`]. `watch` is called after each of the
    /// [`runs_of_repairs`].
    pub fn repairs(&self, alone: &[Price], watch: &(dyn Fn() + Sync)) -> Vec<Price> {
        let edits = |put_back: &[usize]| -> Vec<&str> {
            let faults = (0..FAULTS.len()).filter(|k| put_back.contains(k));
            faults.map(|k| FAULTS[k].edit).collect()
        };
        // What rounding decides of a fault alone is not nothing, whatever a run has.
        let is_rounded = |k: usize| {
            alone.get(1 + k).is_some_and(|price| matches!(price.outcome, Outcome::Rounding {}))
        };
        let (mut left, mut put_back): (Vec<usize>, _) = ((0..FAULTS.len()).collect(), Vec::new());
        let mut own = vec![self.run(&Worksheet::new(&self.exact.model, Bound::Normal), &[])];
        watch();
        let mut runs = vec![edits(&put_back)];
        while !left.is_empty() {
            let with = |part: &[usize]| -> Vec<Outcome> {
                let worksheet = Worksheet::new(&self.exact.model, Bound::Normal);
                let run = |k: &usize| {
                    let outcome = self.run(&worksheet, &edits(&[&put_back[..], &[*k]].concat()));
                    watch();
                    outcome
                };
                part.iter().map(run).collect()
            };
            // One worksheet for each thread: to begin one takes as long as a run.
            let part = left.len().div_ceil(rayon::current_num_threads());
            let mut outcomes: Vec<Outcome> = left.par_chunks(part).flat_map_iter(with).collect();
            // Rounding is not to decide which comes first.
            let error = |k: &usize| {
                let least = if is_rounded(left[*k]) { 2.0 } else { 0.0 };
                (outcomes[*k].error() / NOTHING).round().max(least)
            };
            let least = (0..left.len()).min_by(|a, b| error(a).total_cmp(&error(b)));
            let least = least.expect("a fault is left");
            own.push(outcomes.remove(least));
            put_back.push(left.remove(least));
            runs.push(edits(&put_back));
        }
        let on = |model: &Arc<Model>| -> Vec<Outcome> {
            let worksheet = Worksheet::new(model, Bound::Normal);
            runs.iter().map(|edits| self.run(&worksheet, edits)).collect()
        };
        let others: Vec<_> = self.equivalents.par_iter().map(on).collect();
        let outcomes = repeated(own, &others);
        // What is left when a fault is repaired is what was there before it was reintroduced.
        let faults = put_back.iter().map(|k| Some(&FAULTS[*k])).chain([None]);
        let prices = faults.zip(outcomes).map(|(fault, outcome)| self.price(fault, outcome));
        let mut repaired: Vec<Price> = prices.collect();
        repaired.last_mut().expect("all are reintroduced").fault = "all are reintroduced".into();
        repaired.reverse();
        repaired
    }

    fn price(&self, fault: Option<&Fault>, outcome: Outcome) -> Price {
        let words = fault.map_or("none".into(), Fault::words);
        let (finding, name) = (fault.map(|fault| fault.finding), fault.map(Fault::name));
        Price { finding, name, fault: words, weight: outcome.weight(), outcome }
    }

    /// Returns whether a node slides on the way to the equilibrium under the scene's own friction; without
    /// one, whether any may.
    fn slides(&self) -> bool {
        let Some(equilibrium) = &self.equilibrium else {
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
    fn run(&self, worksheet: &Worksheet, edits: &[&str]) -> Outcome {
        match worksheet.iterate(edits, STEPS) {
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
        let Compared { exact, equilibrium, stiffness, .. } = self;
        let model = &*exact.model;
        let u = DVector::from_column_slice(&ending.u);
        let distance = |from: &DVector<f64>| {
            over(stiffness.energy_norm(&(&u - from)), stiffness.energy_norm(from))
        };
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
            energy_relative: distance(&exact.u),
            equilibrium_relative: equilibrium.as_ref().map(|other| distance(&other.u)),
            von_mises_relative: changes
                .fold(0.0, |a: f64, b| if b.abs() > a.abs() { b } else { a }),
        }
    }
}

/// Returns the prices on a case. `watch` is called after each of the [`runs`].
///
/// # Errors
/// There is no solution with which they are compared: says why.
pub fn on(case: &Case, watch: &(dyn Fn() + Sync)) -> Result<Vec<Price>, String> {
    Compared::new(case).map(|compared| compared.prices(watch)).map_err(|why| why.to_string())
}

/// The runs that [`Compared::prices`] makes at most.
pub fn runs() -> usize {
    (1 + FAULTS.len()) * (1 + RUNS)
}

/// The runs that [`Compared::repairs`] makes.
pub fn runs_of_repairs() -> usize {
    1 + FAULTS.len() * (FAULTS.len() + 1) / 2
}

/// Leaves out the figures of the runs whose repetitions on the inputs that mean the same, a row of them for each
/// input, lead to others.
fn repeated(
    own: impl IntoIterator<Item = Outcome>,
    others: &[Vec<Outcome>],
) -> impl Iterator<Item = Outcome> {
    let own = own.into_iter().enumerate();
    own.map(|(k, own)| own.repeated(others.iter().map(|other| other[k].clone())))
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
