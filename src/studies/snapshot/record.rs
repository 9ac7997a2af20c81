//! A run recorded: its discrete facts, and its numbers, each with the bound on its rounding error.

use serde_json::{Value, json};

use super::Run;
use super::numbers::{Error as Rounded, Numbers};
use super::{Entry, Quantity};
use engine::contact::{ContactNode, Sense, Status};
use engine::error::{Error, Result};
use engine::estimates::arithmetic::{Rounding, bounded, rounding, stress_bounds};
use engine::options::Options;
use engine::{
    Detail, Elimination, Request, Solution, Step, StepBounds, Stiffness, solve, support_constraints,
};
use numbers::scalar::{Bounded, Scalar};
use paper::door;
use paper::mirror::Km;
use problem::element::{self, State};
use problem::model::{Body, Model, TriangleId};
use problem::modelling::Variant;

/// The relative effect of the roundings in a position, a pressure or an entry of a triangle's matrix.
const ROUNDED: f64 = 64.0 * f64::EPSILON;

/// The most nodes of a scene whose dense matrix, that of `Km`, is assembled once more.
const DENSE: usize = 400;

/// Whether the bounds on rounding errors are computed, which takes another run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Bounds {
    /// They are.
    Computed,
    /// They are not.
    LeftOut,
}

/// Runs a request and records what comes of it, which may be a failure of the published algorithm or
/// that no equilibrium was found.
///
/// # Errors
/// The input is at fault.
pub fn record(request: &Request, bounds: Bounds) -> Result<Run> {
    let model = request.model()?;
    let mut steps: Vec<Step> = Vec::new();
    let solved = solve(request, &mut |step| steps.push(step.clone()));
    let mut run = Run::new(Options::from_request(request));
    let stiffness = Stiffness::new(&model, |x| x);
    worksheet(&mut run, request, &model);
    let rounding = match (&solved, bounds) {
        (Ok(solution), Bounds::Computed) => rounding(solution),
        (Err(_), _) | (_, Bounds::LeftOut) => None,
    };
    // A solution may leave out steps that were taken back.
    let steps = solved.as_ref().map_or(&steps, |solution| &solution.steps);
    let displacement = steps.iter().map(|step| step.max_displacement).fold(0.0, f64::max);
    let scale = Scale::new(&model, displacement);
    let of = Recorded { request, model: &model, stiffness: &stiffness, scale };
    for (k, step) in steps.iter().enumerate() {
        let bounds = rounding.as_ref().and_then(|rounding| rounding.steps[k]);
        of.iteration(&mut run, step, bounds);
    }
    run.facts.insert(Quantity::Iterations.into(), json!(steps.len()));
    let (status, failure) = match &solved {
        Ok(solution) => (solution.exit_status(), json!(solution.doubt().map(|doubt| doubt.what))),
        Err(why) => (why.exit_status(), failure(why)),
    };
    run.facts.insert(Quantity::ExitStatus.into(), json!(status.number()));
    run.facts.insert(Quantity::Failure.into(), failure);
    if let Some(solution) = Error::found(solved)? {
        end(&mut run, &solution, &stiffness, rounding.as_ref(), bounds);
        run.decided_by_rounding =
            rounding.and_then(|rounding| rounding.decisions).unwrap_or_default();
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
    run.facts.insert(Quantity::Cnt.into(), json!(contact));
    run.facts.insert(Quantity::Trg.into(), json!(target));
    let restrained = model.all_dofs().filter(|dof| model.is_restrained(*dof));
    let oblique = model.oblique().map(|(_, hold)| {
        let [x, y] = hold.direction;
        format!("{} along {x}, {y}: {}", hold.node, hold.displacement)
    });
    let restrained = restrained.map(|dof| format!("{}{}", dof.node(), dof.axis()));
    let restrained: Vec<String> = restrained.chain(oblique).collect();
    run.facts.insert(Quantity::Restrained.into(), json!(restrained));
    let given = Rounded { bound: Some(0.0), floor: 0.0 };
    run.numbers.insert(
        Quantity::Tolerance.into(),
        Numbers::list(&units.length, [model.contact.tolerance], given),
    );
    let load: f64 = model.load.iter().map(|f| f.abs()).sum();
    // An edge's load is computed with a square root and some products.
    let bound = load * ROUNDED;
    let error = Rounded { bound: Some(bound), floor: bound };
    run.numbers
        .insert(Quantity::Load.into(), Numbers::list(&units.force, model.total_load(), error));
}

/// The sizes of which positions and distances are differences, length.
struct Scale {
    /// The largest coordinate.
    coordinate: f64,
    /// The largest displacement of a node in any iteration.
    displacement: f64,
    /// The shortest edge of the target; infinite where there is none.
    edge: f64,
}

impl Scale {
    fn new(model: &Model, displacement: f64) -> Self {
        let coordinate = model.nodes.iter().flatten().fold(0.0, |m: f64, x| m.max(x.abs()));
        let length = |[a, b]: [[f64; 2]; 2]| (a[0] - b[0]).hypot(a[1] - b[1]);
        let lengths =
            model.target_edges().map(|edge| length(edge.nodes.map(|n| model.coordinates(n))));
        Scale { coordinate, displacement, edge: lengths.fold(f64::INFINITY, f64::min) }
    }

    /// Returns the least error of a displacement, length.
    fn displacement_error(&self) -> f64 {
        ROUNDED * self.displacement
    }

    /// Returns the error of a node's distance from its edge where displacements are known to `moved`.
    fn distance(&self, moved: f64) -> f64 {
        // The node and both ends of its edge are displaced by at most 1.5 errors each.
        6.0 * moved + ROUNDED * self.coordinate
    }
}

/// What is recorded.
struct Recorded<'a> {
    request: &'a Request,
    model: &'a Model,
    stiffness: &'a Stiffness,
    scale: Scale,
}

impl Recorded<'_> {
    /// Records an iteration, whose numbers are known within `bounds`.
    fn iteration(&self, run: &mut Run, step: &Step, bounds: Option<StepBounds>) {
        let units = &self.request.scene.units;
        let of = |quantity| Entry { iteration: Some(step.k), quantity };
        let moved = self.scale.displacement_error();
        let distance = self.scale.distance(moved);
        let yt = Rounded { bound: bounds.map(|bounds| bounds.yt), floor: distance };
        let weights = distance / self.scale.edge + ROUNDED;
        let weights = Rounded { bound: bounds.map(|bounds| bounds.weights), floor: weights };
        // The number of each contact node's target edge, 0 for none, and its distance; the mates of each node that has
        // any and their weights: the rows of `k_cnt`, or of the constraints that were imposed.
        let (mut faced, mut distances, mut mates, mut weights_of_mates) =
            (Vec::new(), Vec::new(), Vec::new(), Vec::new());
        match &step.detail {
            Detail::Published(own) => {
                faced.extend_from_slice(own.pairs.ct.as_slice());
                distances.extend_from_slice(own.pairs.yt.as_slice());
                for (node, row) in &own.pairs.masters {
                    mates.push(format!("{node}: {} {}", row[0], row[2]));
                    weights_of_mates.extend([row[1], row[3]]);
                }
            }
            Detail::Unilateral(own) => {
                for pairing in own.pairings.iter() {
                    let edge = pairing.as_ref().map_or(0, |p| self.model.edge(p.edge).number);
                    faced.push(edge);
                    distances.push(pairing.as_ref().map_or(0.0, |p| p.gap));
                }
                for constraint in &step.constraints {
                    let masters = constraint.masters.iter().map(|(node, _)| node.to_string());
                    let masters = masters.collect::<Vec<_>>().join(" ");
                    mates.push(format!("{}: {masters}", constraint.node));
                    weights_of_mates.extend(constraint.masters.iter().map(|(_, weight)| weight));
                }
                // Where a node closes divides a step, so that this is a number like others.
                let load = Rounded { bound: None, floor: ROUNDED };
                run.numbers.insert(of(Quantity::Load), Numbers::list("", [own.load], load));
                let statuses: Vec<&str> = own.statuses.iter().map(recorded).collect();
                run.facts.insert(of(Quantity::Statuses), json!(statuses));
            }
        }
        run.facts.insert(of(Quantity::Ct), json!(faced));
        run.numbers.insert(of(Quantity::Yt), Numbers::list(&units.length, distances, yt));
        let dy: Vec<u8> = step.statuses().into_iter().map(u8::from).collect();
        run.facts.insert(of(Quantity::Dy), json!(dy));
        run.facts.insert(of(Quantity::InContact), json!(step.contact_set(self.model)));
        run.facts.insert(of(Quantity::Mates), json!(mates));
        run.numbers.insert(of(Quantity::Weights), Numbers::list("", weights_of_mates, weights));
        let matrix = match &step.cycle {
            // The matrix of a state that came before is the same.
            Some(cycle) => {
                let iteration = Some(cycle.members[0]);
                run.numbers.get(&Entry { iteration, quantity: Quantity::Mjs }).cloned()
            }
            None => self.matrix(step, weights),
        };
        run.numbers.extend(matrix.map(|matrix| (of(Quantity::Mjs), matrix)));
        let error = Rounded { bound: bounds.map(|bounds| bounds.u), floor: moved };
        let largest = Numbers::list(&units.length, Some(step.max_displacement), error);
        run.numbers.insert(of(Quantity::U), largest);
        run.facts
            .insert(of(Quantity::Cycle), json!(step.cycle.as_ref().map(|cycle| &cycle.members)));
    }

    /// Returns the sum of the diagonal and the sum of the sizes of all entries of the matrix that the
    /// iteration solved, to which `weights` went.
    fn matrix(&self, step: &Step, weights: Rounded) -> Option<Numbers> {
        let Recorded { request, model, stiffness, .. } = self;
        let (mut diagonal, mut all, mut count) = (0.0, 0.0, 0.0);
        let mut add = |i: usize, j: usize, value: f64| {
            let times = if i == j { 1.0 } else { 2.0 };
            diagonal += if i == j { value } else { 0.0 };
            all += times * value.abs();
            count += 1.0;
        };
        match (&step.detail, request.variant) {
            (Detail::Published(own), Variant::Printed) => {
                (model.nodes.len() <= DENSE).then_some(())?;
                let sheet = door::worksheet(model, |x| x);
                let matrix = Km(&sheet, &request.reading, &own.pairs.k_cnt()).ok()?;
                let matrix = matrix.into_sparse().dense();
                for i in 0..matrix.nrows() {
                    (0..=i)
                        .filter(|&j| matrix[(i, j)] != 0.0)
                        .for_each(|j| add(i, j, matrix[(i, j)]));
                }
            }
            (Detail::Published(_), Variant::Tied | Variant::Stepped | Variant::Unilateral) => {
                let t = Elimination::new(model.restraints(), &step.constraints);
                stiffness.reduced(&t).entries().for_each(|(i, j, value)| add(i, j, value));
            }
            (Detail::Unilateral(_), _) => {
                let own = support_constraints(model, 1.0);
                let all = step.constraints.iter().cloned().chain(own).collect::<Vec<_>>();
                let t = Elimination::closing(model.restraints(), &all);
                stiffness.reduced(&t).entries().for_each(|(i, j, value)| add(i, j, value));
            }
        }
        let units = &request.scene.units;
        let unit = match (&units.force[..], &units.length[..]) {
            ("", _) | (_, "") => String::new(),
            (force, length) => format!("{force}/{length}"),
        };
        // An entry is multiplied by at most two weights.
        let within = |weights: f64| (count * f64::EPSILON + ROUNDED + 2.0 * weights) * all;
        let error = Rounded { bound: weights.bound.map(within), floor: within(weights.floor) };
        Some(Numbers::list(&unit, [diagonal, all], error))
    }
}

/// Records the end of a run: displacements, stresses, reactions and the contact surface.
fn end(
    run: &mut Run,
    solution: &Solution,
    stiffness: &Stiffness,
    rounding: Option<&Rounding>,
    bounds: Bounds,
) {
    let (model, units) = (&*solution.model, &solution.request.scene.units);
    let bound = rounding.and_then(|rounding| rounding.displacement);
    let scale = Scale::new(model, solution.u.amax());
    let moved = scale.displacement_error();
    let errors = match bounds {
        Bounds::LeftOut => None,
        Bounds::Computed => {
            let stiffness = bounded(model);
            let of = |moved: f64| errors(solution, &stiffness, &scale, moved);
            Some((bound.map(of), of(moved)))
        }
    };
    let error = |of: fn(&Errors) -> f64| match &errors {
        None => Rounded::default(),
        Some((bound, floor)) => Rounded { bound: bound.as_ref().map(of), floor: of(floor) },
    };
    let mut set = |of: Quantity, numbers: Numbers| run.numbers.insert(of.into(), numbers);
    let u = (1..).zip(solution.displacements());
    set(Quantity::U, Numbers::rows(&units.length, u, error(|errors| errors.displacement)));
    let stresses = solution.elements.iter().map(|state| <[f64; 3]>::from(state.sigma));
    let stresses = (1..).zip(stresses);
    set(Quantity::Stress, Numbers::rows(&units.stress, stresses, error(|errors| errors.stress)));
    let von_mises = largest(solution, |state| state.von_mises_stress);
    let von_mises = Numbers::list(&units.stress, von_mises, error(|errors| errors.von_mises));
    set(Quantity::VonMisesStress, von_mises);
    let strains = largest(solution, |state| state.von_mises_strain);
    let strains = Numbers::list("", strains, error(|errors| errors.strain));
    set(Quantity::VonMisesStrain, strains);
    let held = model.held_directions();
    let restrained = model.node_ids().filter(|node| held[node.index()] > 0);
    let force = stiffness.times(&solution.u) - &model.load;
    let reactions = restrained.map(|node| {
        let (of_node, axes) = (node.components(&force), model.restraints_of(node));
        // Of a node that is held along another direction both components count.
        let is_oblique = axes.iter().filter(|held| **held).count() < held[node.index()];
        (node.number(), [0, 1].map(|d| if axes[d] || is_oblique { of_node[d] } else { 0.0 }))
    });
    set(Quantity::Reactions, Numbers::rows(&units.force, reactions, error(|errors| errors.force)));
    let nodes = || solution.contact.iter();
    let gaps = nodes().map(|c| (c.node.number(), [c.gap]));
    set(Quantity::Gap, Numbers::rows(&units.length, gaps, error(|errors| errors.gap)));
    let known = nodes().filter_map(|c| Some((c.node.number(), [c.pressure?])));
    set(Quantity::Pressure, Numbers::rows(&units.stress, known, error(|errors| errors.pressure)));
}

/// Returns the largest value of each body, by triangle.
fn largest(solution: &Solution, value: fn(&State) -> f64) -> Vec<f64> {
    let of = |id: &TriangleId| value(&solution.elements[id.index()]);
    let of_body = |body: &Body| body.triangles.iter().map(of).fold(0.0, f64::max);
    solution.model.bodies.iter().map(of_body).collect()
}

/// The largest error of any number of each array of a solution.
struct Errors {
    displacement: f64,
    stress: f64,
    von_mises: f64,
    strain: f64,
    force: f64,
    gap: f64,
    pressure: f64,
}

/// Returns what is left of errors of the displacements, of size `displacement`, in the other numbers of a solution.
fn errors(
    solution: &Solution,
    stiffness: &Stiffness<Bounded>,
    scale: &Scale,
    displacement: f64,
) -> Errors {
    let model = &*solution.model;
    let u = solution.u.map(|u| Bounded::new(u, displacement));
    let stresses = stiffness.stresses(&u);
    let force = stiffness.times(&u) - model.load_in(Bounded::from_f64);
    let force = force.iter().map(|f| f.error()).fold(0.0, f64::max);
    let von_mises = stress_bounds(solution, stiffness, Some(displacement));
    // A strain is at most the sum of the sizes of its components.
    let strain = |id: TriangleId| {
        let b = element::B(&model.corners(id)).abs().sum();
        b * (displacement + ROUNDED * solution.u.amax())
    };
    // The normal turns by at most the displacement of both ends over the length of the edge.
    let turned = 4.0 * displacement / scale.edge + ROUNDED;
    let pressure = |c: &ContactNode| {
        let (own, pressure) = (c.force?, c.pressure?);
        let per_force = if own == 0.0 { 0.0 } else { (pressure / own).abs() };
        Some(1.5 * force * per_force + turned * (pressure.abs() + c.shear.unwrap_or(0.0).abs()))
    };
    Errors {
        displacement,
        stress: stresses.iter().flat_map(|s| s.iter().map(|s| s.error())).fold(0.0, f64::max),
        von_mises: von_mises.into_iter().fold(0.0, f64::max),
        strain: model.triangle_ids().map(strain).fold(0.0, f64::max),
        force,
        gap: scale.distance(displacement),
        pressure: solution.contact.iter().filter_map(pressure).fold(0.0, f64::max),
    }
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
