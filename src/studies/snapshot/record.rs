//! A run recorded: its discrete facts, and its numbers, each with the bound on its rounding error.

use nalgebra::DMatrix;
use serde_json::{Value, json};

use super::Run;
use super::numbers::Numbers;
use super::options::Options;
use super::place::{of_iteration, place};
use crate::answer::contact::{ContactNode, Pairing};
use crate::answer::error::{Error, Result};
use crate::answer::estimates::arithmetic::{Rounding, bounded, rounding, stress_bounds};
use crate::answer::{Detail, Elimination, FoundPairs, Request, Solution, Step, Stiffness, solve};
use crate::numbers::scalar::{Bounded, Scalar};
use crate::paper::door;
use crate::paper::mirror::Km;
use crate::problem::element;
use crate::problem::model::{Body, Model, NodeId, TriangleId};
use crate::problem::modelling::Variant;

/// The roundings of a pressure and of an entry of a triangle's matrix, in units of 2^-53.
const ROUNDINGS: f64 = 64.0;

/// Whether the bounds on rounding errors are computed, which takes another run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Bounds {
    Computed,
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
    let mut run = Run::new(Options::of(request));
    let stiffness = request.stiffness(&model);
    worksheet(&mut run, request, &model);
    let rounding = match (&solved, bounds) {
        (Ok(solution), Bounds::Computed) => Some(rounding(solution)),
        _ => None,
    };
    // A solution may leave out steps that were taken back.
    let steps = solved.as_ref().map_or(&steps, |solution| &solution.steps);
    let of = Recorded { request, model: &model, stiffness: &stiffness };
    for (k, step) in steps.iter().enumerate() {
        let bounds = rounding.as_ref().and_then(|rounding| rounding.steps[k]);
        of.iteration(&mut run, step, bounds.map(|b| [b.yt, b.weights, b.u]));
    }
    run.facts.set("iterations", json!(steps.len()));
    let (status, failure) = outcome(&solved);
    run.facts.set("exit status", json!(status));
    run.facts.set("failure", failure);
    let solution = match solved {
        Err(why @ Error::Input(_)) => return Err(why),
        solved => solved.ok(),
    };
    if let Some(solution) = solution {
        end(&mut run, &solution, rounding.as_ref());
        run.decided_by_rounding =
            rounding.and_then(|rounding| rounding.decisions).unwrap_or_default();
    }
    run.facts.sort_by_key(place);
    run.numbers.sort_by_key(place);
    Ok(run)
}

/// Returns the exit status of `solve`, and the failure; null where there is none.
fn outcome(solved: &Result<Solution>) -> (u8, Value) {
    match solved {
        Ok(solution) if is_refuted(solution) => (4, json!("the equilibrium is not the only one")),
        Ok(_) => (0, Value::Null),
        Err(why) => (why.exit_status(), failure(why)),
    }
}

fn is_refuted(solution: &Solution) -> bool {
    solution.equilibrium.as_ref().is_some_and(|found| found.uniqueness.is_refuted())
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
    run.facts.set("cnt", json!(contact));
    run.facts.set("trg", json!(target));
    let restrained = model.all_dofs().filter(|dof| model.is_restrained(*dof));
    let restrained: Vec<String> =
        restrained.map(|dof| format!("{}{}", dof.node(), dof.axis())).collect();
    run.facts.set("restrained", json!(restrained));
    run.numbers.set("c_tll", Numbers::list(&units.length, [model.contact.tolerance], Some(0.0)));
    let load: f64 = model.load.iter().map(|f| f.abs()).sum();
    // An edge's load is computed with a square root and some products.
    let bound = load * ROUNDINGS * f64::EPSILON;
    run.numbers.set("load", Numbers::list(&units.force, model.total_load(), Some(bound)));
}

/// What is recorded.
struct Recorded<'a> {
    request: &'a Request,
    model: &'a Model,
    stiffness: &'a Stiffness,
}

impl Recorded<'_> {
    /// Records an iteration; `bounds` are those of yt, of the weights and of the displacements.
    fn iteration(&self, run: &mut Run, step: &Step, bounds: Option<[f64; 3]>) {
        let units = &self.request.scene.units;
        let name = |quantity: &str| of_iteration(step.k, quantity);
        let bound = |k: usize| bounds.map(|bounds| bounds[k]);
        if let Detail::Unilateral(own) = &step.detail {
            // Where a node closes divides a step, so that this is a number like others.
            run.numbers.set(name("load"), Numbers::list("", [own.load], None));
            let statuses: Vec<String> = own.statuses.iter().map(ToString::to_string).collect();
            run.facts.set(name("statuses"), json!(statuses));
        }
        let (faced, distances) = self.faced(step);
        run.facts.set(name("ct"), json!(faced));
        run.numbers.set(name("yt"), Numbers::list(&units.length, distances, bound(0)));
        let dy: Vec<u8> = step.statuses().into_iter().map(u8::from).collect();
        run.facts.set(name("dy"), json!(dy));
        run.facts.set(name("in contact"), json!(step.contact_set(self.model)));
        let (mates, weights) = mates(step);
        run.facts.set(name("mates"), json!(mates));
        run.numbers.set(name("weights"), Numbers::list("", weights, bound(1)));
        let matrix = match &step.cycle {
            // The matrix of a state that came before is the same.
            Some(cycle) => run.numbers.get(&of_iteration(cycle.members[0], "MJS")).cloned(),
            None => self.matrix(step),
        };
        matrix.into_iter().for_each(|matrix| run.numbers.set(name("MJS"), matrix));
        if step.max_displacement.is_some() {
            let largest = Numbers::list(&units.length, step.max_displacement, bound(2));
            run.numbers.set(name("u"), largest);
        }
        run.facts.set(name("cycle"), json!(step.cycle.as_ref().map(|cycle| &cycle.members)));
    }

    /// Returns the number of each contact node's target edge, 0 for none, and its distance from it,
    /// length.
    fn faced(&self, step: &Step) -> (Vec<usize>, Vec<f64>) {
        match &step.detail {
            Detail::Published(own) => {
                (own.pairs.ct.as_slice().to_vec(), own.pairs.yt.as_slice().to_vec())
            }
            Detail::Unilateral(own) => {
                let of = |pairing: &Option<Pairing>| {
                    pairing.as_ref().map_or((0, 0.0), |p| (self.model.edge(p.edge).number, p.gap))
                };
                own.pairings.iter().map(of).unzip()
            }
        }
    }

    /// Returns the sum of the diagonal and the sum of the sizes of all entries of the matrix that the
    /// iteration solved.
    fn matrix(&self, step: &Step) -> Option<Numbers> {
        let Recorded { request, model, stiffness } = self;
        let (mut diagonal, mut all, mut count) = (0.0, 0.0, 0.0);
        let mut add = |i: usize, j: usize, value: f64| {
            let times = if i == j { 1.0 } else { 2.0 };
            diagonal += if i == j { value } else { 0.0 };
            all += times * value.abs();
            count += 1.0;
        };
        match (&step.detail, request.variant) {
            (Detail::Published(own), Variant::Printed) => {
                let matrix = printed(request, model, &own.pairs)?;
                for i in 0..matrix.nrows() {
                    (0..=i)
                        .filter(|&j| matrix[(i, j)] != 0.0)
                        .for_each(|j| add(i, j, matrix[(i, j)]));
                }
            }
            _ => {
                let t = match request.variant {
                    Variant::Unilateral => {
                        Elimination::closing(&model.restrained, &step.constraints)
                    }
                    _ => Elimination::new(&model.restrained, &step.constraints),
                };
                stiffness.reduced(&t).entries().for_each(|(i, j, value)| add(i, j, value));
            }
        }
        let units = &request.scene.units;
        let unit = match (&units.force[..], &units.length[..]) {
            ("", _) | (_, "") => String::new(),
            (force, length) => format!("{force}/{length}"),
        };
        let bound = (count + ROUNDINGS) * f64::EPSILON * all;
        Some(Numbers::list(&unit, [diagonal, all], Some(bound)))
    }
}

/// Returns the mates of each node that has any and their weights: the rows of `k_cnt`, or of the
/// constraints that were imposed.
fn mates(step: &Step) -> (Vec<String>, Vec<f64>) {
    let (mut mates, mut weights) = (Vec::new(), Vec::new());
    match &step.detail {
        Detail::Published(own) => {
            for (node, row) in &own.pairs.mates {
                mates.push(format!("{node}: {} {}", row[0], row[2]));
                weights.extend([row[1], row[3]]);
            }
        }
        Detail::Unilateral(_) => {
            for constraint in &step.constraints {
                let masters: Vec<String> =
                    constraint.masters.iter().map(|(node, _)| node.to_string()).collect();
                mates.push(format!("{}: {}", constraint.node, masters.join(" ")));
                weights.extend(constraint.masters.iter().map(|(_, weight)| weight));
            }
        }
    }
    (mates, weights)
}

/// Returns the matrix of `Km`, where it is no dense matrix of many nodes.
fn printed(request: &Request, model: &Model, pairs: &FoundPairs) -> Option<DMatrix<f64>> {
    /// The most nodes of a scene whose dense matrix is assembled once more.
    const NODES: usize = 400;
    (model.nodes.len() <= NODES).then_some(())?;
    let sheet = door::worksheet(model, |x| x);
    let table = Km(&sheet, &request.reading, &pairs.k_cnt()).ok()?;
    Some(table.into_matrix())
}

/// Records the end of a run: displacements, stresses, reactions and the contact surface.
fn end(run: &mut Run, solution: &Solution, rounding: Option<&Rounding>) {
    let (model, units) = (&*solution.model, &solution.request.scene.units);
    let bound = rounding.map(|rounding| rounding.displacement).filter(|bound| bound.is_finite());
    let u = solution.displacements();
    run.numbers.set("u", Numbers::rows(&units.length, (1..).zip(u), bound));
    let within = bound.map(|bound| (bounded(model), solution.u.map(|u| Bounded::new(u, bound))));
    let stress_bound = within.as_ref().map(|(stiffness, u)| {
        let stresses = stiffness.stresses(u);
        stresses.iter().flat_map(|s| s.iter().map(|s| s.error())).fold(0.0, f64::max)
    });
    let stresses = solution.elements.iter().map(|state| <[f64; 3]>::from(state.sigma));
    run.numbers.set("stress", Numbers::rows(&units.stress, (1..).zip(stresses), stress_bound));
    largest(run, solution, bound);
    let force = solution.stiffness().times(&solution.u) - &model.load;
    let force_bound = within.as_ref().map(|(stiffness, u)| {
        let force = stiffness.times(u) - model.load_in(Bounded::from_f64);
        force.iter().map(|f| f.error()).fold(0.0, f64::max)
    });
    let restrained = model.node_ids().filter(|node| model.restraints_of(*node) != [false; 2]);
    let reaction = |node: NodeId| {
        let (of_node, restrained) = (node.of(&force), model.restraints_of(node));
        (node.number(), [0, 1].map(|d| if restrained[d] { of_node[d] } else { 0.0 }))
    };
    run.numbers
        .set("reactions", Numbers::rows(&units.force, restrained.map(reaction), force_bound));
    surface(run, solution, bound, force_bound);
}

/// Records the largest von Mises stress and strain of each body; displacements are known to `bound`.
fn largest(run: &mut Run, solution: &Solution, bound: Option<f64>) {
    let (model, unit) = (&*solution.model, &solution.request.scene.units.stress);
    let most = |of: &dyn Fn(TriangleId) -> f64| {
        let of_body = |body: &Body| body.triangles.iter().map(|id| of(*id)).fold(0.0, f64::max);
        model.bodies.iter().map(of_body).collect::<Vec<_>>()
    };
    let state = |id: TriangleId| &solution.elements[id.index()];
    let stress_bound = bound.map(|bound| {
        stress_bounds(solution, &bounded(model), bound).into_iter().fold(0.0, f64::max)
    });
    let stresses = most(&|id| state(id).von_mises_stress);
    run.numbers.set("largest von Mises stress", Numbers::list(unit, stresses, stress_bound));
    // The value of a strain is at most the sum of the sizes of its components.
    let strain_bound = bound.map(|bound| {
        let of_triangle = |id: TriangleId| {
            let b = element::B(&model.corners(id)).abs().sum();
            b * (bound + ROUNDINGS * f64::EPSILON * solution.u.amax())
        };
        model.triangle_ids().map(of_triangle).fold(0.0, f64::max)
    });
    let strains = most(&|id| state(id).von_mises_strain);
    run.numbers.set("largest von Mises strain", Numbers::list("", strains, strain_bound));
}

/// Records gap and pressure of the contact nodes. Displacements are known to `bound`, forces to
/// `force_bound`.
fn surface(run: &mut Run, solution: &Solution, bound: Option<f64>, force_bound: Option<f64>) {
    let (model, units) = (&*solution.model, &solution.request.scene.units);
    let edges = || model.target_edges();
    let length = |[a, b]: [[f64; 2]; 2]| (a[0] - b[0]).hypot(a[1] - b[1]);
    let shortest =
        edges().map(|e| length(e.nodes.map(|n| model.at(n)))).fold(f64::INFINITY, f64::min);
    let size = model.nodes.iter().flatten().fold(0.0, |m: f64, x| m.max(x.abs()));
    let rounded = ROUNDINGS * f64::EPSILON;
    // The node and both ends of its edge are displaced by at most 1.5 bounds each.
    let gaps = bound.map(|bound| 6.0 * bound + rounded * size);
    let nodes = || solution.contact.iter();
    run.numbers.set(
        "gap",
        Numbers::rows(&units.length, nodes().map(|c| (c.node.number(), [c.gap])), gaps),
    );
    // The normal turns by at most the displacement of both ends over the length of the edge.
    let pressures = bound.zip(force_bound).map(|(bound, force_bound)| {
        let turned = 4.0 * bound / shortest + rounded;
        let of = |force: f64, pressure: f64| {
            let per_force = if force == 0.0 { 0.0 } else { (pressure / force).abs() };
            1.5 * force_bound * per_force
        };
        let shear = |c: &ContactNode| c.shear.unwrap_or(0.0).abs();
        nodes()
            .filter_map(|c| Some((c, c.force?, c.pressure?)))
            .map(|(c, force, pressure)| of(force, pressure) + turned * (pressure.abs() + shear(c)))
            .fold(0.0, f64::max)
    });
    let known = nodes().filter_map(|c| Some((c.node.number(), [c.pressure?])));
    run.numbers.set("pressure", Numbers::rows(&units.stress, known, pressures));
}
