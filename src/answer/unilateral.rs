//! The reference solution: no gap in contact, no node that pulls, and none that penetrates.
//!
//! ```text
//!   gap g_i = n_i·(x_i − Σ w_ij x_j)       in contact   g_i = 0, pressure ≥ 0
//!                                          apart        g_i ≥ 0, pressure = 0
//! ```
//!
//! The method is a primal-dual active set: each iteration measures normals, weights and gaps in the
//! current shape, closes the gaps of the set, and takes as the next set the nodes that press or
//! penetrate. It ends when the set repeats and the gaps stay closed while the shape settles. The
//! shape is the current one, or the initial one for small displacements. A node without friction
//! slides along the tangent. A node that sticks follows the target in both components, as eq. (1)
//! asks, and stays at the point of the target that it faced in the initial shape.
//!
//! A set that returns, other than the last, would return without end. From then on one node changes
//! at a time, the last along `cnt` of those that should: that ends for every problem with one
//! solution (K. G. Murty's least-index rule, Opsearch 11 (1974)). Where the set does not restrain
//! the bodies, the node that the load's motion brings to the target first joins it; where no node
//! comes nearer, those with the least gaps join.
//!
//! Source: S. Hüeber, B. I. Wohlmuth, Comput. Methods Appl. Mech. Engrg. 194 (2005) 3147-3166; J.
//! J. Júdice, F. M. Pires, Comput. Oper. Res. 21 (1994) 587-596 (the fall-back).

use std::sync::Arc;

use nalgebra::DVector;

use super::active_set::{Memory, enlarge, first_closed, first_set};
use super::contact::{ContactNode, Pairing, Surfaces, Traction};
use super::elimination::{Constraint, Elimination, Motion, RestrainedAlongNormal};
use super::request::Request;
use super::solution::{self, Cycle, Detail, Solution, Step, max_displacement};
use super::stiffness::Stiffness;
use super::support::{against_load, normal_force, support};
use crate::error::InputError;
use crate::numbers::solve::{SparseCholesky, SparseSymmetric};
use crate::problem::model::{Dof, Model};
use crate::problem::modelling::Friction;

/// The gap over the size of the scene below which it is closed.
const CLOSED: f64 = 5e-13;

/// The size of the scene over its distance from the origin below which gaps have fewer digits than
/// [`CLOSED`] asks for: four units in the last place of a coordinate over [`CLOSED`].
const RESOLVED: f64 = 4.0 * f64::EPSILON / CLOSED;

/// A first set of few nodes presses them far beyond the later contact: of the nodes outside it, the
/// second set takes those that penetrate by more than this part of the deepest penetration.
/// Measured on Hertz's contact of 800 to 100,000 equations: 12 iterations at most, against 14.
const FIRST_GROWTH: f64 = 0.9;

/// The stiffness, over the diagonal, of the springs that show how an unrestrained body moves.
const SOFT: f64 = 1e-8;

/// The number of iterations beyond one for each contact node after which the search ends.
const PATIENCE: usize = 100;

/// A shape and the target that each contact node faces in it.
#[derive(Clone)]
struct Place {
    /// The coordinates of each node, length.
    shape: Vec<[f64; 2]>,
    /// The pairing of each entry of the contact surface.
    pairings: Vec<Option<Pairing>>,
}

/// An iteration: the set of closed nodes and its results.
struct Iteration {
    k: usize,
    /// The place from which it started.
    before: Place,
    /// Whether each entry of the contact surface was closed.
    closed: Vec<bool>,
    /// The constraints that closed them.
    constraints: Vec<Constraint>,
    /// The earlier iterations with this set; None where it is new.
    cycle: Option<Cycle>,
    /// The displacements by degree of freedom, length.
    u: DVector<f64>,
    /// The reaction K u − F: the forces of contact and restraints, force.
    reaction: DVector<f64>,
    /// The relative residual of the solution.
    residual: f64,
    /// The place to which it led.
    after: Place,
    /// The largest gap of a closed node or penetration of another one afterwards, length.
    violation: f64,
}

/// Finds the equilibrium, which is the last step; `watch` is called after each iteration.
///
/// # Errors
/// Contact and restraints do not restrain the bodies, a contact node is restrained along the
/// normal, or the loads pull a body away.
pub(super) fn unilateral(
    request: &Request,
    watch: &mut dyn FnMut(&Step),
) -> Result<Solution, InputError> {
    let model = request.model()?;
    let problem = Problem::new(request, &model)?;
    let mut memory = Memory::default();
    let mut steps: Vec<Step> = Vec::new();
    let mut place = problem.place(&DVector::zeros(model.dofs()));
    let mut set = first_set(&place.pairings, problem.closed);
    let limit = PATIENCE + model.contact.nodes.len();
    while steps.len() < limit {
        let iteration = problem.close(steps.len() + 1, place, set, &mut memory)?;
        let step = problem.step(&iteration);
        watch(&step);
        steps.push(step);
        match problem.next(&iteration, &mut memory) {
            Some(next) => (set, place) = (next, iteration.after),
            None => return Ok(problem.solution(&model, steps, iteration)),
        }
    }
    Err(no_equilibrium(&steps))
}

struct Problem<'a> {
    request: &'a Request,
    model: &'a Model,
    stiffness: Stiffness,
    surfaces: Surfaces,
    /// The gap below which a node is closed, length.
    closed: f64,
    /// The load by degree of freedom, 0 at restrained ones, force.
    load: DVector<f64>,
}

/// The result of an attempt to solve.
enum Solved {
    /// The displacements, length, and the relative residual of a solution.
    Moved { u: DVector<f64>, residual: f64 },
    /// A degree of freedom without restraint, and the motion under the load on soft springs.
    Free { dof: Dof, motion: Option<DVector<f64>> },
}

impl<'a> Problem<'a> {
    fn new(request: &'a Request, model: &'a Model) -> Result<Self, InputError> {
        let surfaces = Surfaces::new(model)?;
        surfaces.check_initial_penetration(model)?;
        Ok(Problem {
            request,
            model,
            stiffness: Stiffness::new(model, |x| x),
            surfaces,
            closed: CLOSED * size(model),
            load: model.free_load(),
        })
    }

    /// Measures contact after displacements `u`.
    fn place(&self, u: &DVector<f64>) -> Place {
        let (shape, contact) = (self.model.shape(u), self.request.contact);
        if contact.measures_current_shape() {
            let pairings = self.surfaces.pairings(contact.coupling, &shape);
            return Place { shape, pairings };
        }
        let mut pairings = self.surfaces.pairings(contact.coupling, &self.model.nodes);
        for pairing in pairings.iter_mut().flatten() {
            // A constraint closes this gap; over a bend it differs from the distance to the face.
            pairing.gap = pairing.opening(|n| self.model.at(n)) + pairing.opening(|n| n.of(u));
        }
        Place { shape, pairings }
    }

    /// Returns the next set; None once set and shape have settled.
    fn next(&self, step: &Iteration, memory: &mut Memory) -> Option<Vec<bool>> {
        let wanted = self.wanted(step);
        if wanted == step.closed {
            return (step.violation > self.closed).then_some(wanted);
        }
        Some(memory.next(&step.closed, wanted))
    }

    /// Returns the set of the nodes that press or penetrate.
    fn wanted(&self, step: &Iteration) -> Vec<bool> {
        let presses = |p: &Pairing| normal_force(self.model, p, &step.reaction) >= 0.0;
        let deep = if step.k == 1 { FIRST_GROWTH * step.violation } else { 0.0 }.max(self.closed);
        let penetrates = |p: &Pairing| p.gap < -deep;
        let faced = step.before.pairings.iter().zip(&step.after.pairings).zip(&step.closed);
        faced
            .map(|((before, after), closed)| match (before, after) {
                (Some(before), Some(_)) if *closed => presses(before),
                (_, after) => after.as_ref().is_some_and(penetrates),
            })
            .collect()
    }

    /// Returns the largest gap of a closed node or penetration of another one, length.
    fn violation(&self, pairings: &[Option<Pairing>], closed: &[bool]) -> f64 {
        let of_node = |(p, closed): (&Option<Pairing>, &bool)| match p {
            Some(p) if *closed => p.gap.abs(),
            Some(p) => (-p.gap).max(0.0),
            None => 0.0,
        };
        pairings.iter().zip(closed).map(of_node).fold(0.0, f64::max)
    }

    /// Closes the gaps of `set`, or of a larger one where that does not restrain the bodies.
    fn close(
        &self,
        k: usize,
        place: Place,
        mut set: Vec<bool>,
        memory: &mut Memory,
    ) -> Result<Iteration, InputError> {
        let (constraints, u, residual) = loop {
            let constraints = self.constraints(&place.pairings, &set);
            match self.solve(&constraints)? {
                Solved::Moved { u, residual } => break (constraints, u, residual),
                Solved::Free { dof, motion } => {
                    let first = motion.and_then(|u| first_closed(&set, &place.pairings, &u));
                    if let Some(i) = first {
                        set[i] = true;
                    } else if !enlarge(&mut set, &place.pairings) {
                        return Err(self.unrestrained(&place.pairings, dof));
                    }
                }
            }
        };
        let cycle = memory.keep(k, &set);
        let reaction = self.stiffness.times(&u) - &self.model.load;
        let after = self.place(&u);
        let violation = self.violation(&after.pairings, &set);
        Ok(Iteration {
            k,
            before: place,
            closed: set,
            constraints,
            cycle,
            u,
            reaction,
            residual,
            after,
            violation,
        })
    }

    /// Solves for the displacements under `constraints`.
    fn solve(&self, constraints: &[Constraint]) -> Result<Solved, InputError> {
        let t = Elimination::with_normals(&self.model.restrained, constraints)
            .map_err(restrained_along_normal)?;
        let reduced = self.stiffness.reduced(&t);
        let cholesky = match SparseCholesky::new(reduced.clone()) {
            Ok(cholesky) => cholesky,
            Err(singular) => {
                let dof = t.dof(singular.column);
                return Ok(Solved::Free { dof, motion: self.free_motion(&t, &reduced) });
            }
        };
        let f = t.load(&(&self.load - self.stiffness.times(t.shift())));
        let q = cholesky.solve(&f);
        Ok(Solved::Moved { u: t.expand(&q), residual: cholesky.residual(&q, &f) })
    }

    /// Returns the motion that the constraints leave free where only soft springs oppose the load.
    fn free_motion(&self, t: &Elimination, k: &SparseSymmetric) -> Option<DVector<f64>> {
        let diagonal = k.diagonal();
        let springs = (0..k.size()).map(|i| (i, i, SOFT * diagonal[i]));
        let sprung = SparseSymmetric::new(k.size(), k.entries().chain(springs));
        let q = SparseCholesky::new(sprung).ok()?.solve(&t.load(&self.load));
        Some(t.expand(&q) - t.shift())
    }

    fn constraints(&self, pairings: &[Option<Pairing>], set: &[bool]) -> Vec<Constraint> {
        let closed = pairings.iter().zip(set).filter(|(_, closed)| **closed);
        closed.filter_map(|(p, _)| p.as_ref()).map(|p| self.constraint(p)).collect()
    }

    /// Returns the constraint that closes the gap of a pairing.
    fn constraint(&self, pairing: &Pairing) -> Constraint {
        let closing = -pairing.opening(|n| self.model.at(n));
        let motion = match self.request.contact.friction {
            Friction::None => Motion::Along(pairing.normal, closing),
            Friction::Stick => Motion::Both(pairing.normal.map(|n| closing * n)),
        };
        Constraint { node: pairing.node, masters: pairing.masters.clone(), motion }
    }

    /// Returns an iteration as a step of the solution.
    fn step(&self, iteration: &Iteration) -> Step {
        let Iteration { k, before, closed, constraints, cycle, u, reaction, .. } = iteration;
        let support = support(self.model, &self.model.restrained, constraints, reaction);
        Step {
            k: *k,
            shape: before.shape.clone(),
            constraints: constraints.clone(),
            in_contact: closed.iter().filter(|closed| **closed).count(),
            max_displacement: max_displacement(u),
            cycle: cycle.clone(),
            target_force: against_load(self.model, support),
            solve_residual: iteration.residual,
            detail: Detail::Unilateral(solution::Unilateral {
                closed: closed.clone(),
                pairings: before.pairings.clone(),
                violation: iteration.violation,
            }),
        }
    }

    /// Returns the solution, which is the last iteration.
    fn solution(&self, model: &Arc<Model>, steps: Vec<Step>, last: Iteration) -> Solution {
        Solution {
            request: self.request.clone(),
            model: Arc::clone(model),
            contact: self.contact(&last),
            elements: self.stiffness.states(&last.u),
            factored: steps.len(),
            steps,
            u: last.u,
            digits: None,
            error_bound: None,
        }
    }

    /// Returns the contact surface at the end.
    fn contact(&self, last: &Iteration) -> Vec<ContactNode> {
        let current = self.request.contact.measures_current_shape();
        let traction = Traction {
            model: self.model,
            surfaces: &self.surfaces,
            measured_in: if current { &last.after.shape } else { &self.model.nodes },
            pairings: &last.after.pairings,
            in_contact: &last.closed,
            reaction: &last.reaction,
        };
        traction.nodes()
    }

    fn unrestrained(&self, pairings: &[Option<Pairing>], dof: Dof) -> InputError {
        if pairings.iter().all(Option::is_none) {
            let what = "no contact node faces the target, and nothing else restrains the bodies";
            let fix = "name surfaces that face each other; list cnt in order along its surface";
            return InputError::new("contact.cnt, contact.trg", what, fix);
        }
        let (node, direction) = (dof.node(), dof.axis());
        let body = self.model.body_of(node);
        let body = body.map_or(String::new(), |b| format!(" of body {:?}", b.name));
        let what =
            format!("node {node}{body} can move in {direction} with every contact node in contact");
        let fix = "restrain that motion, or let the surfaces stick (\"friction\": \"stick\")";
        InputError::new("restraints, contact.friction", what, fix)
    }
}

/// Returns the error for a run out of patience, with the sets that returned last.
fn no_equilibrium(steps: &[Step]) -> InputError {
    let cycle = steps.iter().filter_map(|step| step.cycle.as_ref()).rfind(|c| c.length > 1);
    let returned = cycle.map_or(String::new(), |cycle| {
        let last = cycle.members[0] + cycle.length - 1;
        format!("; the contact states of iterations {} to {last} return", cycle.members[0])
    });
    let count = steps.len();
    let what = format!("no contact state in equilibrium was found in {count} iterations{returned}");
    let fix = "see whether the loads pull a body off its target, slide it off the target's end or \
               turn it over; restrain its turning where friction would";
    InputError::new("loads, contact", what, fix)
}

/// Returns the larger extent of the model, or what its coordinates can resolve of it, length.
fn size(model: &Model) -> f64 {
    let [width, height] = [0, 1].map(|axis| {
        let values = model.nodes.iter().map(|xy| xy[axis]);
        let (least, most) =
            values.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, m), x| (l.min(x), m.max(x)));
        most - least
    });
    // A gap in the current shape is a difference of coordinates and has no digits below theirs.
    let farthest = model.nodes.as_flattened().iter().map(|x| x.abs());
    width.max(height).max(RESOLVED * farthest.fold(0.0, f64::max))
}

fn restrained_along_normal(restrained: RestrainedAlongNormal) -> InputError {
    let node = restrained.node;
    let what = format!("contact node {node} is restrained along the normal of the contact");
    let fix = "let the body that is restrained there carry the target surface, or restrain the node in \
               the other direction";
    InputError::new("restraints, contact.cnt", what, fix)
}
