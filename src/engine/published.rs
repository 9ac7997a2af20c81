//! The iterations that the paper describes: `printed`, `tied`, `stepped`.
//!
//! - total load, for k = 1 .. n: c = c_cnt(node_n); solve A(c)·U = F; node_n = node + U.
//! - stepped load: c = c_cnt(node_n); solve A(c)·dU = F/n; U = U + dU; node_n = node + U.
//!
//! A(c) is Km(c) under `printed`, else Tᵀ·K·T on the free equations, where K is Km without contact
//! and without restraints.

use std::sync::Arc;

use nalgebra::DVector;

use super::contact::{ContactNode, NodeEnd, Status, Surfaces, reactions, status_rules};
use super::elimination::{Constraint, sum};
use super::equations::{Equations, Increment};
use super::error::{Error, too_large};
use super::reactions::transmitted_force;
use super::request::Request;
use super::solution::{Cycle, Detail, Solution, Step, max_displacement};
use crate::linear::{Inputs, Precision, cost};
use base::error::InputError;
use base::limits;
use base::plain::six_digits;
use mathcad::array::Table;
use numbers::scalar::Scalar;
use paper::door::{self, NodeToSegment};
use paper::edited::Interpreter;
use paper::listings::Which;
use paper::mirror::{self, Pairs, Schedule, Worksheet};
use problem::model::{Model, NodeId};
use problem::modelling::{Coupling, Variant};

/// Solves a request for one of the variants that the paper describes; `watch` is called after each step.
///
/// # Errors
/// The published algorithm fails as printed, a matrix is singular, or it does not fit in memory.
pub(super) fn published<T: Precision>(
    request: &Request,
    watch: &mut dyn FnMut(&Step),
) -> Result<Solution, Error> {
    let model = request.model()?;
    let number = |x: f64| number_of(request, x);
    // k_cnt holds node numbers as numbers of the scalar.
    if model.nodes.len() as f64 > 2.0 / T::EPSILON {
        let what = format!("{} cannot count the mesh's nodes", request.arithmetic.scalar);
        return Err(InputError::new("scalar", what, "use f64").into());
    }
    let sheet: Worksheet<T> = door::worksheet(&model, number);
    let interpreter = (!request.edited.is_empty())
        .then(|| Interpreter::new(&model, &request.reading, &request.edited));
    let interpreter = interpreter.as_ref();
    let mut run = Iterations {
        equations: Equations::new(request, &model, &sheet, interpreter, &number)?,
        surfaces: match request.bound_by() {
            Some(Coupling::Mortar) => Some(Surfaces::new(&model)?),
            Some(Coupling::Nts) | None => None,
        },
        reached: Increment::none(model.dofs()),
        visited: Vec::new(),
    };
    let mut steps: Vec<Step> = Vec::with_capacity(request.iterations);
    for k in 1..=request.iterations {
        let step = run.iterate(k)?;
        watch(&step);
        steps.push(step);
    }
    let last = steps.last().expect("a request has an iteration");
    let reaction = run.equations.reaction(&run.reached.u).map(T::to_f64);
    Ok(Solution {
        contact: run.contact(last, &reaction)?,
        reactions: run.equations.reactions(&reaction, &run.reached.passed),
        elements: run.equations.stiffness.states(&run.reached.u),
        factored: run.visited.len(),
        digits: T::zero()
            .digits()
            .and_then(|_| run.reached.u.iter().map(|u| u.to_rational()).collect()),
        equilibrium: None,
        overlap: None,
        u: run.reached.u.map(T::to_f64),
        request: request.clone(),
        model: Arc::clone(&model),
        steps,
    })
}

/// Checks what is known of a request in a scalar before it runs.
///
/// # Errors
/// The matrices do not fit in memory, exact numbers do not end within a bearable time, the load vanishes
/// in T, or mortar does not run in it.
pub(super) fn check_published<T: Precision>(
    request: &Request,
    model: &Model,
) -> Result<(), InputError> {
    check_size(request, model)?;
    let scalar = request.arithmetic.scalar;
    if let Some(coupling) = request.bound_by()
        && let Some(why) = scalar.refuses(coupling)
    {
        let what = format!("{coupling} coupling does not run in {scalar}: {why}");
        return Err(InputError::new("scalar", what, "use f64 or f64x2, or coupling nts"));
    }
    check_load(request, model, &model.load_in(|x| number_of::<T>(request, x)))
}

/// Returns what a number of the scene stands for.
fn number_of<T: Scalar>(request: &Request, x: f64) -> T {
    match request.arithmetic.inputs {
        Inputs::Binary => T::from_f64(x),
        Inputs::Decimal => T::from_decimal(x),
    }
}

/// Checks that no load vanished or is too small for all digits of the scalar: zero displacements
/// would look like a result.
fn check_load<T: Scalar>(
    request: &Request,
    model: &Model,
    load: &DVector<T>,
) -> Result<(), InputError> {
    // A load in range is rounded by half of it.
    let rounded_by = 8.0 * T::EPSILON;
    let lost = |(x, y): &(&f64, &T)| {
        let near = T::from_f64(**x).to_f64();
        let rounded = near.is_finite() && (near - **x).abs() > rounded_by * x.abs();
        rounded || **x != 0.0 && y.to_f64() == 0.0
    };
    let Some((x, _)) = model.load.iter().zip(load.iter()).find(lost) else { return Ok(()) };
    let (scalar, x) = (request.arithmetic.scalar, six_digits(*x));
    let what = format!("the force {x} is too small to represent in {scalar}");
    Err(InputError::new("loads", what, "choose other units, or f64"))
}

/// Checks that dense matrices are small, iterations are few, and exact numbers end within a bearable time.
fn check_size(request: &Request, model: &Model) -> Result<(), InputError> {
    // An edited `Km` is interpreted into a dense matrix, of which a sparse one is made.
    if request.is_dense() || request.is_edited(Which::Km) {
        limits::DENSE.check(model.dofs(), "the mesh")?;
    }
    limits::check_steps(request.iterations, model.nodes.len(), "iterations")?;
    if !request.arithmetic.scalar.is_exact() {
        return Ok(());
    }
    cost::check(model.free_dofs(), request.reading.r5.follows_the_shape(), request.iterations)
}

/// The state of a run that an iteration needs of those before it.
struct Iterations<'a, T> {
    /// The equations of every iteration.
    equations: Equations<'a, T>,
    /// The surfaces of a coupling that has weights of its own; None where they are those of `c_cnt`.
    surfaces: Option<Surfaces>,
    /// The sum of the increments so far, or the last one where each has the whole load.
    reached: Increment<T>,
    /// The contact states visited, each with its solution and the last iteration that visited it.
    /// The load of an iteration is always the same, so a state that returns has the same matrix and
    /// the same solution, and its matrix is not factored again.
    visited: Vec<Visited<T>>,
}

/// A contact state, which is all of k_cnt and the weights of the constraints, and its solution.
struct Visited<T> {
    /// The rows of k_cnt in which something is written.
    k_cnt: Vec<(usize, [T; 4])>,
    constraints: Vec<Constraint<T>>,
    /// The last iteration that visited it.
    k: usize,
    solved: Increment<T>,
}

/// The contact state that an iteration found before it solved any equation.
struct FoundState<T> {
    node_n: Table<T>,
    pairs: Pairs<T>,
    constraints: Vec<Constraint<T>>,
    /// Eq. (1) as it is measured: on the target edge of each node in contact.
    measured: Vec<Constraint<T>>,
}

impl<T: Precision> Iterations<'_, T> {
    fn iterate(&mut self, k: usize) -> Result<Step, Error> {
        let found = self.search()?;
        let k_cnt: Vec<(usize, [T; 4])> = found.pairs.written().collect();
        let is_found = |visited: &Visited<T>| {
            visited.k_cnt == k_cnt && visited.constraints == found.constraints
        };
        let before = self.visited.iter().position(is_found);
        let (cycle, solved) = match before.map(|at| self.visited.swap_remove(at)) {
            Some(visited) => {
                let cycle = Cycle { length: k - visited.k, members: (visited.k..k).collect() };
                (Some(cycle), visited.solved)
            }
            None => (None, self.equations.solve(&found.pairs, &found.constraints, k)?),
        };
        // `c_cnt` would fail on what it did not bring about.
        if !solved.u.iter().all(|u| Scalar::is_finite(*u)) {
            return Err(too_large().into());
        }
        self.advance(&solved);
        let step = self.step(k, &found, cycle, &solved);
        self.visited.push(Visited { k_cnt, constraints: found.constraints, k, solved });
        Ok(step)
    }

    /// Finds the contact state in the current shape.
    fn search(&self) -> Result<FoundState<T>, Error> {
        let Equations { request, model, sheet, interpreter, .. } = self.equations;
        let node_n = door::displaced_nodes(sheet, &self.reached.u);
        let reading = &request.reading;
        if !model.has_contact() {
            // Without contact `c_cnt` is not called.
            let pairs = Pairs::none(sheet.R());
            return Ok(FoundState { node_n, pairs, constraints: Vec::new(), measured: Vec::new() });
        }
        let edited = interpreter.and_then(|edited| edited.c_cnt(&node_n));
        let pairs = if let Some(pairs) = edited {
            pairs?
        } else if request.decides_by_listing() {
            mirror::c_cnt(sheet, reading, &node_n)?
        } else {
            let found =
                status_rules::statuses(request.contact.status, model, sheet, reading, &node_n)?;
            door::pairs(model, sheet, reading, &node_n, &found)?
        };
        let mut constraints = bound(door::linked(sheet, &pairs));
        self.bind_by_mortar(&mut constraints, &node_n);
        // What has weights of its own is measured by them, as an edited c_cnt is.
        let measured = if self.surfaces.is_some() || request.is_edited(Which::CCnt) {
            constraints.clone()
        } else {
            bound(door::on_edges(sheet, &pairs, reading, &node_n)?)
        };
        Ok(FoundState { node_n, pairs, constraints, measured })
    }

    /// Gives eq. (1) the weights of mortar, where that is the coupling, for the nodes in contact whose
    /// edges cover the target.
    fn bind_by_mortar(&self, constraints: &mut [Constraint<T>], node_n: &Table<T>) {
        let Some(surfaces) = &self.surfaces else { return };
        let Equations { request, sheet, .. } = self.equations;
        let shape = door::shape(mirror::weights_from(sheet, &request.reading, node_n));
        for pairing in surfaces.mortar(&shape).into_iter().flatten() {
            for bound in constraints.iter_mut().filter(|bound| bound.node == pairing.node) {
                bound.masters.clone_from(&pairing.masters);
            }
        }
    }

    /// Advances from one shape to the next.
    fn advance(&mut self, solved: &Increment<T>) {
        match self.equations.request.schedule() {
            Schedule::Total => self.reached = solved.clone(),
            Schedule::Stepped => self.reached.add(solved),
        }
    }

    fn step(
        &self,
        k: usize,
        found: &FoundState<T>,
        cycle: Option<Cycle>,
        solved: &Increment<T>,
    ) -> Step {
        let FoundState { node_n, pairs, constraints, measured } = found;
        let bound: &[Constraint<T>] = match self.equations.request.variant {
            Variant::Printed => &[],
            Variant::Tied | Variant::Stepped | Variant::Unilateral => constraints,
        };
        let status = |dy: &usize| if *dy == 1 { Status::Stick } else { Status::Open };
        Step {
            k,
            shape: Arc::new(numbers(&door::shape(node_n))),
            statuses: pairs.dy.iter().map(status).collect(),
            constraints: bound.iter().map(|bound| bound.map(T::to_f64)).collect(),
            in_contact: pairs.dy.iter().sum(),
            max_displacement: max_displacement(&self.reached.u),
            cycle,
            target_force: transmitted_force(
                self.equations.model,
                self.reached.support.map(T::to_f64),
            ),
            solve_residual: solved.residual,
            contact_residual: eq1_residual(measured, &self.reached.u),
            contact_residual_step: eq1_residual(measured, &solved.u),
            detail: Detail::Published(pairs.map(T::to_f64)),
        }
    }

    /// Returns the contact surface at the end.
    fn contact(
        &self,
        last: &Step,
        reaction: &DVector<f64>,
    ) -> Result<Vec<ContactNode>, InputError> {
        let surfaces = Surfaces::new(self.equations.model)?;
        let shape =
            numbers(&door::shape(&door::displaced_nodes(self.equations.sheet, &self.reached.u)));
        let pairings = surfaces.pairings(Coupling::Nts, &shape);
        let eliminated = self.equations.request.variant != Variant::Printed;
        let (model, u) = (self.equations.model, self.reached.u.map(T::to_f64));
        let forces = reactions(model, &pairings, reaction, eliminated);
        Ok(surfaces.nodes_at_end((model, &u), (&shape, &pairings), |i, pairing| NodeEnd {
            gap: pairing.gap,
            in_contact: last.statuses[i].is_closed(),
            status: None,
            force: forces[i],
        }))
    }
}

/// Returns the constraints that bind nodes by eq. (1).
fn bound<T: Scalar>(nodes: Vec<NodeToSegment<T>>) -> Vec<Constraint<T>> {
    nodes.into_iter().map(Into::into).collect()
}

/// Returns the coordinates of each node as `f64`, length.
fn numbers<T: Scalar>(shape: &[[T; 2]]) -> Vec<[f64; 2]> {
    shape.iter().map(|place| place.map(T::to_f64)).collect()
}

/// Returns the largest component of u_cont − u_targ over contact nodes, length; u_targ is
/// interpolated between their master nodes.
fn eq1_residual<T: Scalar>(bound: &[Constraint<T>], u: &DVector<T>) -> f64 {
    let mut largest = T::zero();
    for Constraint { node, masters, .. } in bound {
        for direction in [0, 1] {
            let component = |node: &NodeId| node.components(u)[direction];
            let target = sum(masters.iter().map(|(master, k)| *k * component(master)));
            largest = largest.max((component(node) - target).abs());
        }
    }
    largest.to_f64()
}
