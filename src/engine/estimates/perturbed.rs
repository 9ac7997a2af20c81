//! What rounding does to a solution, measured: the run is repeated in double-doubles, where these are
//! offered, and with coordinates, loads and moduli changed at random in their last digits. What that changes,
//! rounding may change too, as every later rounding acts like such a change.
//!
//! A coordinate is changed in the last digit that a coordinate of the scene's size has: a node that lies on
//! an axis is as uncertain as one that does not. Loads that are 0 stay 0.
//!
//! The measurement is of a few runs with the same random numbers every time: no bound, but it does not call
//! unknown what it can try. A decision that three runs on changed inputs miss by chance is still the right
//! one where double-doubles take it too. The audit repeats all that it prints on the same inputs
//! ([`equivalent`]), two of them with another load too: a load is not known to nine digits.
//!
//! Source: D. S. Parker, "Monte Carlo arithmetic", UCLA CSD-970002 (1997); J. Vignes, Math. Comput. Simul. 35
//! (1993) 233-261 (CESTAC).

use std::collections::HashMap;
use std::sync::Arc;

use fastrand::Rng;
use rayon::prelude::*;
use serde::Serialize;

use crate::contact::Status;
use crate::distance::over;
use crate::error::Error;
use crate::linear::{Arithmetic, ScalarName};
use crate::{Request, Solution, Step, check, last_under_each_load, solve};
use numbers::finite;
use problem::model::{Force, Model, NodeId};
use problem::modelling::Variant;

/// The number of runs with changed inputs.
pub const RUNS: usize = 3;

/// The largest change, in units of the last digit.
const ULPS: i32 = 2;

/// The change of the load that means nothing, relative.
const LOAD: f64 = 1e-9;

/// The relative change of a number that shows that rounding decides on it.
const NOTICEABLE: f64 = 1e-6;

/// The part of a quantity's own scale that is as good as 0 beside [`NOTICEABLE`].
const SMALL: f64 = 1e-3;

/// What changes of the input in the last digits did to a solution.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Perturbed {
    /// The number of runs.
    pub runs: u64,
    /// Whether one of them is in double-doubles.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub in_double_doubles: bool,
    /// Why runs ended without a result.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub failures: Vec<String>,
    /// The number of runs whose load took other steps, as where a step finds no equilibrium.
    pub other_steps: u64,
    /// The first change of who is in contact; nothing where there is none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub contact: Option<ContactChange>,
    /// The largest change of a displacement component, over the largest; nothing where no run has a result.
    pub displacement: Option<f64>,
    /// The largest change of a triangle's von Mises stress, over the largest; nothing as before.
    pub stress: Option<f64>,
}

/// A change of the contact state.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ContactChange {
    /// The first node that has another status.
    pub node: NodeId,
    /// When it first has.
    #[serde(flatten)]
    pub when: When,
    /// The most nodes that have another status at one time, in one run.
    pub nodes: usize,
}

/// A time at which who is in contact is compared.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum When {
    /// After a part of the load's path, under `unilateral`.
    Load(f64),
    /// In an iteration, from 1, under the paper's variants.
    Iteration(usize),
}

impl When {
    /// Returns what tells it from the other times of a run.
    fn key(self) -> u64 {
        match self {
            When::Load(load) => load.to_bits(),
            When::Iteration(k) => k as u64,
        }
    }
}

/// Repeats a run with changed inputs; None in exact numbers, which are not rounded.
pub fn perturbed(solution: &Solution) -> Option<Perturbed> {
    if solution.request.arithmetic.scalar.is_exact() {
        return None;
    }
    Some(Perturbed::of_runs(solution, &runs(&solution.request)))
}

/// Runs what [`perturbed_requests`] asks for.
fn runs(request: &Request) -> Vec<Result<Solution, Error>> {
    perturbed_requests(request).par_iter().map(|request| solve(request, &mut |_| ())).collect()
}

/// Returns requests that mean the same: coordinates, loads and moduli differ in their last digits, and in two
/// of them the load by a billionth, less and more.
pub fn equivalent(request: &Request) -> impl Iterator<Item = Request> {
    let factors: [f64; RUNS] = [1.0 - LOAD, 1.0 + LOAD, 1.0];
    (0..).zip(factors).map(|(seed, factor)| changed(request, seed, factor))
}

/// Returns whether a number of an equivalent request shows that rounding decides on it: it differs by more
/// than a millionth, of what is no smaller than a thousandth of the quantity's own `scale`.
pub fn moves(own: Option<f64>, other: Option<f64>, scale: f64) -> bool {
    match [own, other].map(|x| x.and_then(finite)) {
        [Some(a), Some(b)] => (a - b).abs() > NOTICEABLE * a.abs().max(b.abs()).max(SMALL * scale),
        [own, other] => own.is_some() != other.is_some(),
    }
}

impl Perturbed {
    /// Returns whether rounding decides on the solution.
    pub fn decides(&self) -> bool {
        let is_small = |change: Option<f64>| change.is_some_and(|change| change <= NOTICEABLE);
        let same = self.failures.is_empty() && self.other_steps == 0 && self.contact.is_none();
        !(same && is_small(self.displacement) && is_small(self.stress))
    }

    fn of_runs(solution: &Solution, runs: &[Result<Solution, Error>]) -> Self {
        let mut found = Perturbed {
            runs: runs.len() as u64,
            in_double_doubles: runs.len() > RUNS,
            other_steps: 0,
            failures: Vec::new(),
            contact: None,
            displacement: None,
            stress: None,
        };
        for run in runs {
            match run {
                Ok(other) => found.add(solution, other),
                Err(why) => found.failures.push(why.to_string()),
            }
        }
        found
    }

    fn add(&mut self, solution: &Solution, other: &Solution) {
        let stress =
            |run: &Solution| run.elements.iter().map(|state| state.von_mises_stress).collect();
        let (own, their): (Vec<f64>, Vec<f64>) = (stress(solution), stress(other));
        let apart = own.iter().zip(&their).fold(0.0, |most: f64, (a, b)| most.max((a - b).abs()));
        let most = own.iter().fold(0.0, |most: f64, x| most.max(*x));
        let larger = |old: Option<f64>, new: f64| finite(old.unwrap_or(0.0).max(new));
        self.stress = larger(self.stress, over(apart, most));
        let moved = over((&other.u - &solution.u).amax(), solution.u.amax());
        self.displacement = larger(self.displacement, moved);
        let (ends, others) = (ends(solution), ends(other));
        self.other_steps += u64::from(ends.len() != others.len());
        let others: HashMap<u64, Vec<Status>> =
            others.into_iter().map(|(when, statuses)| (when.key(), statuses)).collect();
        for (when, statuses) in ends {
            // Loads between the steps, where a node closes, are other ones.
            let Some(others) = others.get(&when.key()) else { continue };
            let differ: Vec<usize> =
                (0..statuses.len()).filter(|i| statuses[*i] != others[*i]).collect();
            let Some(first) = differ.first() else { continue };
            let node = solution.model.contact.nodes[*first];
            let change = self.contact.get_or_insert(ContactChange { node, when, nodes: 0 });
            change.nodes = change.nodes.max(differ.len());
        }
    }
}

/// Returns the statuses in each iteration of the paper's variants, and at the end of each load of a path.
fn ends(solution: &Solution) -> Vec<(When, Vec<Status>)> {
    let found = |step: &Step| {
        let when = step.unilateral().map_or(When::Iteration(step.k), |own| When::Load(own.load));
        (when, step.statuses.clone())
    };
    let steps = match solution.request.variant {
        Variant::Unilateral => last_under_each_load(&solution.steps),
        Variant::Printed | Variant::Tied | Variant::Stepped => (0..solution.steps.len()).collect(),
    };
    steps.into_iter().map(|step| found(&solution.steps[step])).collect()
}

/// Whether rounding decides who is in contact.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Certainty {
    /// It was seen to decide nothing.
    Certain,
    /// It decides in the numbers asked for; the run is the one in double-doubles.
    InDoubleDouble,
    /// It decides, in double-doubles too, or these have no result.
    Decided,
    /// Under `unilateral` it was not looked at: [`perturbed`] measures it.
    Unchecked,
}

/// Returns the solution itself where rounding decides nothing in it, else that of the same request in
/// double-doubles, and which of the two it is. Under `unilateral` the solution stays as it is.
pub fn certain(solution: Solution) -> (Solution, Certainty) {
    let request = &solution.request;
    if request.variant == Variant::Unilateral {
        return (solution, Certainty::Unchecked);
    }
    if request.arithmetic.scalar.is_exact() {
        return (solution, Certainty::Certain);
    }
    let mut runs = runs(request);
    let found = Perturbed::of_runs(&solution, &runs);
    if !found.decides() {
        return (solution, Certainty::Certain);
    }
    match runs.pop().filter(|_| found.in_double_doubles) {
        Some(Ok(again)) => (again, Certainty::InDoubleDouble),
        Some(Err(_)) | None => (solution, Certainty::Decided),
    }
}

/// Returns the requests of the runs: with changed inputs, then in double-doubles where these are offered and
/// have more digits.
pub fn perturbed_requests(request: &Request) -> Vec<Request> {
    let own = request.arithmetic;
    let changed = (0..RUNS as u64).map(|seed| changed(request, seed, 1.0));
    // Double-doubles, by their own solver.
    let finer = Arithmetic { scalar: ScalarName::F64x2, solver: None, ..own };
    let finer = request.clone().arithmetic(finer);
    let is_finer = own.scalar.properties().digits < ScalarName::F64x2.properties().digits;
    changed.chain(Some(finer).filter(|finer| is_finer && check(finer).is_ok())).collect()
}

/// Returns a request whose coordinates, loads and moduli differ in their last digits, the loads by a `factor`
/// too.
fn changed(request: &Request, seed: u64, factor: f64) -> Request {
    let last_digit = match request.arithmetic.scalar {
        ScalarName::F32 => f64::from(f32::EPSILON),
        ScalarName::F64 | ScalarName::F64x2 | ScalarName::Exact => f64::EPSILON,
    };
    let mut rng = Rng::with_seed(seed);
    let mut request = request.clone();
    let model: &mut Model = Arc::make_mut(&mut request.scene.model);
    // A whole number of units in the last place, other than none.
    let mut part = || {
        let ulps = rng.i32(1..=ULPS);
        f64::from(if rng.bool() { ulps } else { -ulps }) * last_digit
    };
    let size = model.bounds().larger_side();
    for x in model.nodes.iter_mut().flatten() {
        *x += part() * x.abs().max(size);
    }
    for load in model.stages.iter_mut().flat_map(|stage| stage.iter_mut()) {
        *load *= factor * (1.0 + part());
    }
    model.load = model.load_after(model.stages.len() as f64);
    // A material stays one.
    let mut moduli: HashMap<u64, f64> = HashMap::new();
    for triangle in &mut model.triangles {
        let e = &mut triangle.material.e;
        *e *= *moduli.entry(e.to_bits()).or_insert_with(|| 1.0 + part());
    }
    // The load of the paper's variants.
    for force in &mut model.forces {
        let by = factor * (1.0 + part());
        match force {
            Force::Node(_, force) | Force::Traction(_, force) | Force::Body(_, force) => {
                *force = force.map(|x| by * x);
            }
            Force::Pressure(_, pressure) => *pressure *= by,
        }
    }
    request
}
