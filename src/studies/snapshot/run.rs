//! A run recorded: its discrete facts, and its numbers, each array with what rounding does to it.

use indexmap::IndexMap;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

use super::difference::first_iteration;
use super::first_difference::first;
use super::numbers::{Numbers, Tolerance};
use super::{Difference, Entry, Options, Quantity, compare, entry};
use base::error::InputError;
use engine::contact::{Sense, Status};
use engine::error::{Error, Result};
use engine::estimates::perturbed_requests;
use engine::{Detail, Elimination, Request, Solution, Step, Stiffness, solve};
use paper::door;
use paper::mirror::Km;
use problem::element::State;
use problem::model::{Body, Dof, Hold, Model, TriangleId};
use problem::modelling::Variant;

/// The most nodes of a scene whose dense matrix, that of `Km`, is assembled once more.
const DENSE: usize = 400;

/// A run: what it was asked for and what came of it.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Run {
    /// What was asked for in place of what the scene says.
    pub options: Options,
    /// The numbers of the end that were asked for, without those of the iterations; all where it is
    /// absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub only: Option<Vec<Quantity>>,
    /// The tolerance of all arrays that give none of their own.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tolerance: Option<Tolerance>,
    /// What is the same or not.
    pub facts: IndexMap<Entry, Value>,
    /// What is the same but for rounding.
    pub numbers: IndexMap<Entry, Numbers>,
    /// The decisions on who is in contact that rounding takes: those that another last digit of the inputs
    /// changes.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub decided_by_rounding: Vec<Decision>,
}

/// A decision on who is in contact that rounding takes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Decision {
    /// The iteration, from 1.
    pub iteration: usize,
    /// The number of the contact node.
    pub node: u64,
    /// What is another one.
    pub condition: String,
}

impl Run {
    fn fact_is(&mut self, of: impl Into<Entry>, fact: impl Serialize) {
        self.facts.insert(of.into(), json!(fact));
    }

    fn numbers_are(&mut self, of: impl Into<Entry>, numbers: Numbers) {
        self.numbers.insert(of.into(), numbers);
    }

    /// Returns the exit status of `solve` on this run, where the run has that fact.
    pub fn exit_status(&self) -> Option<u64> {
        self.fact(Quantity::ExitStatus)?.as_u64()
    }

    /// Returns a fact that was recorded.
    pub fn fact(&self, of: impl Into<Entry>) -> Option<&Value> {
        self.facts.get(&of.into())
    }

    /// Puts its entries in the order of computation.
    pub(super) fn sort(&mut self) {
        self.facts.sort_by_cached_key(|entry, _| entry.place());
        self.numbers.sort_by_cached_key(|entry, _| entry.place());
    }

    /// Leaves out what is not among the numbers `only`, where these are given.
    pub(super) fn keep_only(&mut self, only: Option<Vec<Quantity>>) {
        self.only = only;
        if let Some(kept) = self.kept() {
            self.retain(|entry| kept.contains(&entry));
        }
    }

    /// Returns the entries that the run was asked to record; None where that is all.
    pub(super) fn kept(&self) -> Option<Vec<Entry>> {
        let only = self.only.as_ref()?;
        Some(only.iter().chain(&entry::FACTS).map(|quantity| Entry::from(*quantity)).collect())
    }

    /// Leaves out what was not recorded of an earlier run, and takes the tolerances that it gives.
    pub(super) fn recorded_as(mut self, old: &Run) -> Self {
        self.keep_only(old.only.clone());
        self.tolerance = old.tolerance;
        for (entry, numbers) in &mut self.numbers {
            numbers.tolerance = old.numbers.get(entry).and_then(|numbers| numbers.tolerance);
        }
        self
    }

    /// Leaves out the entries that `keeps` does not keep.
    pub(super) fn retain(&mut self, keeps: impl Fn(Entry) -> bool) {
        self.facts.retain(|entry, _| keeps(*entry));
        self.numbers.retain(|entry, _| keeps(*entry));
    }

    /// Notes what rounding does to the run, by `others` whose inputs differ in the last digit: the most that
    /// they change of each array while they find the same, and the first decision on who is in contact that
    /// is another one.
    fn measure(&mut self, others: &[Run]) {
        let others: Vec<(&Run, Vec<Difference>)> =
            others.iter().map(|other| (other, compare(self, other).0)).collect();
        let decided = others.iter().filter_map(|(other, differences)| {
            let status = first(self, other, differences)?.status?;
            let condition = match &status.line {
                Some(line) => format!("{}; {line}", status.words),
                None => status.words,
            };
            Some(Decision { iteration: status.iteration, node: status.node, condition })
        });
        self.decided_by_rounding = decided.collect();
        for (entry, numbers) in &mut self.numbers {
            let finds_the_same = |differences: &[Difference]| match entry.iteration {
                Some(k) => {
                    let found = differences.iter().filter(|difference| difference.is_discrete());
                    first_iteration(found).is_none_or(|first| k < first)
                }
                None => !differences.iter().any(Difference::is_of_contact),
            };
            let same = others.iter().filter(|(_, differences)| finds_the_same(differences));
            numbers.measure(same.filter_map(|(other, _)| other.numbers.get(entry)));
        }
    }

    /// Checks what the types of its parts do not tell.
    ///
    /// # Errors
    /// What rounding does is negative.
    pub(super) fn check(&self) -> Result<(), InputError> {
        for (name, numbers) in self.numbers.iter() {
            for (field, value) in [("bound", numbers.bound), ("floor", Some(numbers.floor))] {
                if let Some(value) = value.filter(|value| *value < 0.0) {
                    let what = format!("what rounding does, the {field}, is {value}");
                    let fix = "give a number from 0; null where it was not measured";
                    return Err(InputError::new(format!("numbers.{name}.{field}"), what, fix));
                }
            }
        }
        Ok(())
    }
}

/// Runs a request and records what comes of it, which may be a failure of the published algorithm or
/// that no equilibrium was found, and what rounding does to it, which takes three more runs.
///
/// # Errors
/// The input is at fault.
pub fn record(request: &Request) -> Result<Run> {
    let mut run = unmeasured(request)?;
    if request.arithmetic.scalar.is_exact() {
        // Exact numbers are rounded where they are written alone.
        run.measure(&[run.clone()]);
    } else {
        // A run that fails shows nothing of the numbers of this one.
        let others = perturbed_requests(request);
        let others = others.par_iter().filter_map(|request| unmeasured(request).ok());
        run.measure(&others.collect::<Vec<Run>>());
    }
    Ok(run)
}

/// Does the same, but for what rounding does.
///
/// # Errors
/// The input is at fault.
pub(super) fn unmeasured(request: &Request) -> Result<Run> {
    let model = request.model()?;
    let mut steps: Vec<Step> = Vec::new();
    let solved = solve(request, &mut |step| steps.push(step.clone()));
    let mut run = Run { options: Options::from_request(request), ..Run::default() };
    let stiffness = Stiffness::new(&model, |x| x);
    worksheet(&mut run, request, &model);
    // A solution may leave out steps that were taken back.
    let steps = solved.as_ref().map_or(&steps, |solution| &solution.steps);
    let of = Recorded { request, model: &model, stiffness: &stiffness };
    for step in steps {
        of.iteration(&mut run, step);
    }
    run.fact_is(Quantity::Iterations, steps.len());
    let (status, failure) = match &solved {
        Ok(solution) => (solution.exit_status(), json!(solution.doubt().map(|doubt| doubt.what))),
        Err(why) => (why.exit_status(), failure(why)),
    };
    run.fact_is(Quantity::ExitStatus, status.number());
    run.fact_is(Quantity::Failure, failure);
    if let Some(solution) = Error::found(solved)? {
        end(&mut run, &solution, &stiffness);
    }
    run.sort();
    Ok(run)
}

/// Returns what a failure is, without the numbers of its message, which rounding may change.
fn failure(why: &Error) -> Value {
    match why {
        Error::Listing(failure) => json!({
            "listing": failure.listing,
            "line": failure.line,
            "cause": failure.cause.words(),
        }),
        Error::Singular(matrix) => json!({
            "singular at": format!("node {} {}", matrix.node, matrix.direction),
            "iteration": matrix.iteration,
            "in contact": matrix.in_contact,
        }),
        Error::Equilibrium(_) => json!("no equilibrium was found"),
        Error::Execution(_) | Error::Input(_) => json!(why.to_string()),
    }
}

/// Records what the run starts from.
fn worksheet(run: &mut Run, request: &Request, model: &Model) {
    let units = &request.scene.units;
    let contact: Vec<usize> = model.contact.nodes.iter().map(|node| node.number()).collect();
    let target: Vec<usize> = model.target_edges().map(|edge| edge.number).collect();
    run.fact_is(Quantity::Cnt, contact);
    run.fact_is(Quantity::Trg, target);
    let mut holds: Vec<&Hold> = model.holds.iter().collect();
    holds.sort_by_key(|hold| (hold.dof().is_none(), hold.dof(), hold.restraint));
    let restrained = holds.into_iter().map(|hold| match hold.dof() {
        Some(dof) => format!("{}{}", dof.node(), dof.axis()),
        None => {
            let [x, y] = hold.direction;
            format!("{} along {x}, {y}: {}", hold.node, hold.displacement)
        }
    });
    run.fact_is(Quantity::Restrained, restrained.collect::<Vec<_>>());
    let tolerance = Numbers::list(&units.length, [model.contact.tolerance]);
    run.numbers_are(Quantity::Tolerance, tolerance);
    run.numbers_are(Quantity::Load, Numbers::list(&units.force, model.total_load()));
}

/// The contact pairs of an iteration: the arrays of `c_cnt`, or the constraints that were imposed.
#[derive(Default)]
struct Pairs {
    /// The number of each contact node's target edge; 0 for none.
    ct: Vec<usize>,
    /// The distance of each contact node, length.
    yt: Vec<f64>,
    /// Each node that has mates, with them.
    mates: Vec<String>,
    /// The weights of all these mates.
    weights: Vec<f64>,
}

impl Pairs {
    fn new(step: &Step, model: &Model) -> Self {
        let mut pairs = Pairs::default();
        match &step.detail {
            Detail::Published(own) => {
                pairs.ct.extend_from_slice(own.ct.as_slice());
                pairs.yt.extend_from_slice(own.yt.as_slice());
                for (node, row) in own.written() {
                    pairs.mates.push(format!("{node}: {} {}", row[0], row[2]));
                    pairs.weights.extend([row[1], row[3]]);
                }
            }
            Detail::Unilateral(own) => {
                for pairing in own.pairings.iter() {
                    pairs.ct.push(pairing.as_ref().map_or(0, |p| model.edge(p.edge).number));
                    pairs.yt.push(pairing.as_ref().map_or(0.0, |p| p.gap));
                }
                for constraint in &step.constraints {
                    let masters = constraint.masters.iter().map(|(node, _)| node.to_string());
                    let masters = masters.collect::<Vec<_>>().join(" ");
                    pairs.mates.push(format!("{}: {masters}", constraint.node));
                    pairs.weights.extend(constraint.masters.iter().map(|(_, weight)| weight));
                }
            }
        }
        pairs
    }
}

/// What is recorded.
struct Recorded<'a> {
    request: &'a Request,
    model: &'a Model,
    stiffness: &'a Stiffness,
}

impl Recorded<'_> {
    /// Records an iteration.
    fn iteration(&self, run: &mut Run, step: &Step) {
        let length = &self.request.scene.units.length;
        let of = |quantity| Entry { iteration: Some(step.k), quantity };
        let pairs = Pairs::new(step, self.model);
        run.fact_is(of(Quantity::Ct), pairs.ct);
        run.numbers_are(of(Quantity::Yt), Numbers::list(length, pairs.yt));
        let dy: Vec<u8> = step.closed().map(u8::from).collect();
        run.fact_is(of(Quantity::Dy), dy);
        run.fact_is(of(Quantity::InContact), step.contact_set(self.model));
        run.fact_is(of(Quantity::Mates), pairs.mates);
        run.numbers_are(of(Quantity::Weights), Numbers::list("", pairs.weights));
        let matrix = match &step.cycle {
            // The matrix of a state that came before is the same.
            Some(cycle) => {
                let iteration = Some(cycle.members[0]);
                run.numbers.get(&Entry { iteration, quantity: Quantity::Mjs }).cloned()
            }
            None => self.matrix(step),
        };
        run.numbers.extend(matrix.map(|matrix| (of(Quantity::Mjs), matrix)));
        run.numbers_are(of(Quantity::U), Numbers::list(length, [step.max_displacement]));
        run.fact_is(of(Quantity::Cycle), step.cycle.as_ref().map(|cycle| &cycle.members));
        if let Some(own) = step.unilateral() {
            // Where a node closes divides a step, so that this is a number like others.
            run.numbers_are(of(Quantity::Load), Numbers::list("", [own.load]));
            run.fact_is(
                of(Quantity::Statuses),
                step.statuses.iter().map(recorded).collect::<Vec<_>>(),
            );
        }
    }

    /// Returns the sum of the diagonal and the sum of the sizes of all entries of the matrix that the
    /// iteration solved.
    fn matrix(&self, step: &Step) -> Option<Numbers> {
        let Recorded { request, model, stiffness, .. } = self;
        let entries: Vec<(usize, usize, f64)> = match (&step.detail, request.variant) {
            (Detail::Published(own), Variant::Printed) => {
                (model.nodes.len() <= DENSE).then_some(())?;
                let sheet = door::worksheet(model, |x| x);
                let matrix = Km(&sheet, &request.reading, &own.k_cnt).ok()?;
                let matrix = matrix.into_sparse().dense();
                let places = (0..matrix.nrows()).flat_map(|i| (0..=i).map(move |j| (i, j)));
                let lower = places.map(|(i, j)| (i, j, matrix[(i, j)]));
                lower.filter(|(_, _, value)| *value != 0.0).collect()
            }
            (Detail::Published(_), Variant::Tied | Variant::Stepped | Variant::Unilateral) => {
                let t = Elimination::new(&model.holds, &step.constraints);
                stiffness.reduced(&t).entries().collect()
            }
            (Detail::Unilateral(_), _) => {
                let t = Elimination::closing(&model.holds, 1.0, &step.constraints);
                stiffness.reduced(&t).entries().collect()
            }
        };
        let on_diagonal = entries.iter().filter(|(i, j, _)| i == j);
        let diagonal = on_diagonal.fold(0.0, |sum, (_, _, value)| sum + value);
        let twice = |i, j| if i == j { 1.0 } else { 2.0 };
        let all = entries.iter().fold(0.0, |sum, (i, j, value)| sum + twice(i, j) * value.abs());
        let units = &request.scene.units;
        let unit = match (&units.force[..], &units.length[..]) {
            ("", _) | (_, "") => String::new(),
            (force, length) => format!("{force}/{length}"),
        };
        Some(Numbers::list(&unit, [diagonal, all]))
    }
}

/// Records the end of a run: displacements, stresses, reactions and the contact surface.
fn end(run: &mut Run, solution: &Solution, stiffness: &Stiffness) {
    let (model, units) = (&*solution.model, &solution.request.scene.units);
    let u = (1..).zip(solution.displacements());
    run.numbers_are(Quantity::U, Numbers::rows(&units.length, u));
    let stresses = solution.elements.iter().map(|state| <[f64; 3]>::from(state.sigma));
    let stresses = (1..).zip(stresses);
    run.numbers_are(Quantity::Stress, Numbers::rows(&units.stress, stresses));
    let von_mises = largest(solution, |state| state.von_mises_stress);
    let von_mises = Numbers::list(&units.stress, von_mises);
    run.numbers_are(Quantity::VonMisesStress, von_mises);
    let strains = largest(solution, |state| state.von_mises_strain);
    let strains = Numbers::list("", strains);
    run.numbers_are(Quantity::VonMisesStrain, strains);
    let restrained = model.node_ids().filter(|node| !model.holds.of(*node).is_empty());
    let force = stiffness.times(&solution.u) - &model.load;
    let along = |dof: Dof| if model.holds.takes(dof) { force[dof.index()] } else { 0.0 };
    let reactions = restrained.map(|node| (node.number(), node.dofs().map(along)));
    run.numbers_are(Quantity::Reactions, Numbers::rows(&units.force, reactions));
    let nodes = || solution.contact.iter();
    let gaps = nodes().map(|c| (c.node.number(), [c.gap]));
    run.numbers_are(Quantity::Gap, Numbers::rows(&units.length, gaps));
    if let Some(passed) = engine::resultant(solution) {
        run.numbers_are(Quantity::ContactForce, Numbers::list(&units.force, passed.force));
    }
    let known = nodes().filter_map(|c| Some((c.node.number(), [c.pressure?])));
    run.numbers_are(Quantity::Pressure, Numbers::rows(&units.stress, known));
}

/// Returns the largest value of each body, by triangle.
fn largest(solution: &Solution, value: fn(&State) -> f64) -> Vec<f64> {
    let of = |id: &TriangleId| value(&solution.elements[id.index()]);
    let of_body = |body: &Body| body.triangles.iter().map(of).fold(0.0, f64::max);
    solution.model.bodies.iter().map(of_body).collect()
}

/// Returns the word for a status in a snapshot, with the sense in which a node slides.
fn recorded(status: &Status) -> &'static str {
    match status {
        Status::Open => "open",
        Status::Stick => "stick",
        Status::Slip(Sense::Forward) => "slip +",
        Status::Slip(Sense::Backward) => "slip -",
        Status::Slip(Sense::Free) => "slip",
    }
}
