//! What rounding may decide under `unilateral` in a contact state: whether an open node touches, a
//! closed one is pressed, one that sticks would slide, and one that slides would stick; and which part
//! of the target a node faces, where that counts.
//!
//! Under node to segment the latter is tried: each node is moved by the bound of its place. Under
//! mortar its integrals are computed again with that bound.
//!
//! Under friction the search for a state may end by a fixed point on the bounds of friction, which finds one
//! of those that there may be, or none: which one is left to rounding. So is the shape to which springs lead.
//!
//! Not looked at are forces on a node that its restraints share without leaving them open.
//!
//! Gaps and forces are computed from displacements that are known within a bound, along the normals
//! of the state, which count as exact. A node that touches without any force may as well be open
//! or closed, and one that neither slips nor reaches its friction may as well do either: such a tie
//! leaves the displacements.

use std::cell::LazyCell;
use std::f64::consts::SQRT_2;
use std::sync::Arc;

use nalgebra::DVector;

use crate::contact::{Pairing, Status, Surfaces};
use crate::solution::{Choice, Start, Unilateral};
use crate::unilateral::FIRST_GROWTH;
use crate::{Decision, Detail, Solution, Step, Stiffness};
use numbers::scalar::{Bounded, Scalar, Unsure};
use problem::model::NodeId;
use problem::modelling::Coupling;

/// The rounding of a coordinate and of what a search computes from it, in units of the coordinate.
const COORDINATE: f64 = 8.0;

/// A force over the largest, and a change of a node's place over the largest displacement, which are
/// beyond rounding: states that errors of this size are in are refused as singular or nearly so.
const FAR: f64 = 1e-6;

/// The change of a node's place from one shape on the way to the next, over the largest displacement, up to
/// which they are looked at together: with a step of the load, or where contact is measured again.
const NEAR: f64 = 1e-5;

/// A contact state, with displacements and loads within bounds on their errors.
pub struct BoundedState<'a> {
    /// The iteration whose ties are judged.
    pub step: &'a Step,
    /// The load by degree of freedom, restrained ones included, without friction, force.
    pub load: DVector<Bounded>,
    /// The displacements before the step of the load, from which slips count, length.
    pub before: &'a DVector<Bounded>,
    /// The displacements by degree of freedom, length.
    pub u: &'a DVector<Bounded>,
}

/// What may be otherwise where nodes stand a little elsewhere.
enum Elsewhere {
    /// Comparisons of integrals, by node.
    Mortar(Vec<(NodeId, Unsure)>),
    /// The part of the target that a node faces, and what it would face.
    Nts(Vec<(NodeId, Option<Pairing>)>),
}

/// Looks at the contact states of a solution.
pub struct StateCheck<'a> {
    solution: &'a Solution,
    stiffness: &'a Stiffness<Bounded>,
    surfaces: Option<Surfaces>,
    /// The largest displacement of any step, length.
    largest: f64,
    /// The triangles at a contact node.
    at_surface: Vec<usize>,
    /// The decisions so far that rounding may have taken.
    pub decisions: Vec<Decision>,
    /// Whether all of them are ties that leave the displacements.
    pub only_ties: bool,
}

impl<'a> StateCheck<'a> {
    /// Judges the ties of the last iteration of `solution` with numbers that carry error bounds.
    pub fn new(solution: &'a Solution, stiffness: &'a Stiffness<Bounded>) -> Self {
        let model = &*solution.model;
        let surfaces = Surfaces::new(model).ok();
        let mut on_surface = vec![false; model.dofs()];
        let dofs = model.contact.nodes.iter().flat_map(|node| node.dofs());
        dofs.for_each(|dof| on_surface[dof.index()] = true);
        let at_surface = stiffness.about(&on_surface);
        let moved = solution.steps.iter().map(|step| step.max_displacement);
        let largest = moved.fold(0.0, f64::max);
        let (decisions, only_ties) = (Vec::new(), true);
        StateCheck { solution, stiffness, surfaces, largest, at_surface, decisions, only_ties }
    }

    /// Returns the states on the way in groups of shapes that are nearly the same, each of consecutive ones.
    pub fn groups<'s>(&self, way: &'s [Step]) -> Vec<&'s [Step]> {
        let is_near = |a: &Step, b: &Step| self.farthest(a, b) <= NEAR * self.largest;
        way.chunk_by(is_near).collect()
    }

    /// Returns whether the states of a group are far from other decisions, beyond what rounding does in any
    /// state that is solved at all: its bound need not be known. The nodes that the first iteration closes
    /// are decided otherwise, and looked at.
    pub fn are_far(&self, group: &[Step]) -> Vec<bool> {
        // What a node faces wherever it stands about the last shape, it faces about the others.
        let all_face_surely = LazyCell::new(|| {
            let [.., last] = group else { return true };
            let spread = group.iter().map(|step| self.farthest(step, last)).fold(0.0, f64::max);
            self.faces_surely(last, FAR * self.largest + SQRT_2 * spread)
        });
        let is_far = |step: &Step| {
            let Detail::Unilateral(detail) = &step.detail else { return true };
            let rests_on_shared = self.has_friction() && detail.undetermined.contains(&true);
            let by_forces = step.k > 1 && detail.margin > FAR && !rests_on_shared;
            by_forces && (*all_face_surely || self.faces_surely(step, FAR * self.largest))
        };
        group.iter().map(is_far).collect()
    }

    /// Returns the largest change of a coordinate of either surface from the shape of one state to that of
    /// another, length.
    fn farthest(&self, one: &Step, other: &Step) -> f64 {
        match &self.surfaces {
            Some(surfaces) if !Arc::ptr_eq(&one.shape, &other.shape) => {
                surfaces.farthest([&one.shape, &other.shape])
            }
            _ => 0.0,
        }
    }

    /// Returns whether friction depends on the normal forces.
    fn has_friction(&self) -> bool {
        let coefficient = self.solution.request.contact.friction.coefficient();
        coefficient > 0.0 && coefficient.is_finite()
    }

    /// Returns whether every node faces the same part of the target also where it stands up to `radius`
    /// elsewhere, length.
    fn faces_surely(&self, step: &Step, radius: f64) -> bool {
        let Some(surfaces) = &self.surfaces else { return true };
        if !self.solution.request.contact.geometry.is_current() {
            // The last state is measured in the same shape.
            return true;
        }
        match self.elsewhere(surfaces, &step.shape, radius) {
            Elsewhere::Mortar(unsure) => unsure.is_empty(),
            Elsewhere::Nts(other) => other.is_empty(),
        }
    }

    /// Returns what nodes that stand up to `radius` from their places in a shape face otherwise.
    fn elsewhere(&self, surfaces: &Surfaces, shape: &[[f64; 2]], radius: f64) -> Elsewhere {
        match self.solution.request.contact.coupling {
            Coupling::Nts => Elsewhere::Nts(surfaces.pairings_nearby(shape, radius)),
            Coupling::Mortar => {
                let within = |x: f64| Bounded::new(x, radius);
                let shape: Vec<_> = shape.iter().map(|place| place.map(within)).collect();
                Elsewhere::Mortar(surfaces.mortar(&shape).unsure)
            }
        }
    }

    /// Looks at how the contact states were found: by the active set alone, or in other ways too.
    pub fn check_searches(&mut self) {
        let solution = self.solution;
        let Some(&node) = solution.model.contact.nodes.first() else { return };
        let path = solution.equilibrium.as_ref().and_then(|found| found.path.as_ref());
        if self.has_friction() && path.is_some_and(|path| path.halved > 0) {
            let condition = "whether a step of the load finds an equilibrium, or is halved";
            self.decide(node, 1, condition);
        }
        if self.has_friction() && path.is_some_and(|path| path.start == Start::Overlapping) {
            self.decide(node, 1, "whether nodes that overlap the target close without load");
        }
        let first = |wanted: fn(&Unilateral) -> bool| {
            solution.steps.iter().find(|step| step.unilateral().is_some_and(wanted))
        };
        if let Some(step) = first(|detail| detail.springs > 0.0) {
            self.decide(node, step.k, "to which shape springs lead");
        }
        if let Some(step) =
            first(|detail| detail.choice != Choice::Asked).filter(|_| self.has_friction())
        {
            self.decide(node, step.k, "which of the contact states in equilibrium is found");
        }
    }

    /// Keeps that rounding may decide at a node, by a margin that is not known.
    fn decide(&mut self, node: NodeId, iteration: usize, condition: &str) {
        self.only_ties = false;
        let condition = condition.into();
        self.decisions.push(Decision { iteration, node, condition, margin: None, bound: None });
    }

    /// Looks at a contact state.
    pub fn check(&mut self, state: &BoundedState) {
        let Detail::Unilateral(detail) = &state.step.detail else { return };
        if detail.springs > 0.0 {
            // Their forces are not among those of the bodies.
            return;
        }
        let friction = detail.friction(state.u.len()).map(Bounded::from_f64);
        let force = self.stiffness.times_of(self.at_surface.iter().copied(), state.u);
        let reaction = force - (&state.load + friction);
        for (i, pairing) in detail.pairings.iter().enumerate() {
            match (detail.statuses[i], pairing) {
                (_, None) => (),
                (Status::Open, Some(pairing)) => self.check_open(state, pairing, detail.violation),
                (_, Some(pairing)) if detail.undetermined[i] && self.has_friction() => {
                    let condition = "its friction rests on a force that its restraints share";
                    self.decide(pairing.node, state.step.k, condition);
                }
                (status, Some(pairing)) => self.check_closed(state, status, pairing, &reaction),
            }
        }
        self.check_parts(state, detail);
    }

    /// Looks at a node that is open, where `violation` is the deepest penetration of one, length.
    fn check_open(&mut self, state: &BoundedState, pairing: &Pairing, violation: f64) {
        let gap = self.gap(pairing, state.u);
        let deep = FIRST_GROWTH * violation;
        if state.step.k == 1 && deep > gap.error() {
            let beyond = gap + Bounded::from_f64(deep);
            let condition = format!("gap > -{FIRST_GROWTH} of the deepest penetration");
            self.add_if_unsure(state, pairing, condition, beyond, false);
        } else {
            self.add_if_unsure(state, pairing, "touches without force: gap > 0", gap, true);
        }
    }

    /// Looks at a node in contact.
    fn check_closed(
        &mut self,
        state: &BoundedState,
        status: Status,
        pairing: &Pairing,
        reaction: &DVector<Bounded>,
    ) {
        let [nx, ny] = pairing.normal.map(Bounded::from_f64);
        let [rx, ry] = pairing.node.components(reaction);
        let zero = Bounded::from_f64(0.0);
        let (pressed, shear) = match self.solution.model.restraints_of(pairing.node) {
            [false, false] => (nx * rx + ny * ry, nx * ry - ny * rx),
            // Across the restraint the node's force is its own; otherwise restraints hide it.
            [true, false] if pairing.normal[0] == 0.0 => (ry / ny, zero),
            [false, true] if pairing.normal[1] == 0.0 => (rx / nx, zero),
            _ => return,
        };
        let no_shear = shear.to_f64().abs() <= shear.error();
        if is_unsure(pressed) && no_shear {
            let condition = "touches without force: force >= 0";
            return self.add_if_unsure(state, pairing, condition, pressed, true);
        }
        self.add_if_unsure(state, pairing, "force >= 0", pressed, false);
        let coefficient = self.solution.request.contact.friction.coefficient();
        match status {
            Status::Stick if coefficient.is_finite() => {
                let limit = Bounded::from_f64(coefficient) * pressed - Scalar::abs(shear);
                self.add_if_unsure(state, pairing, "friction * force >= |shear|", limit, false);
            }
            Status::Slip(sense) if sense.sign() != 0.0 => {
                let [sx, sy] = pairing.map(Bounded::from_f64).motion(|node| {
                    let [[ux, uy], [bx, by]] = [state.u, state.before].map(|u| node.components(u));
                    [ux - bx, uy - by]
                });
                let slip = nx * sy - ny * sx;
                self.add_if_unsure(state, pairing, "slips without slip: slip > 0", slip, true);
            }
            Status::Open | Status::Stick | Status::Slip(_) => (),
        }
    }

    /// Keeps a decision of which rounding may have taken the sign of `x`.
    fn add_if_unsure(
        &mut self,
        state: &BoundedState,
        pairing: &Pairing,
        condition: impl Into<String>,
        x: Bounded,
        is_tie: bool,
    ) {
        // On the way such a tie changes nothing: a path is divided where a node closes, without force.
        let counts = !is_tie || state.step.k == self.solution.last().k;
        if counts && is_unsure(x) {
            let by = Unsure { margin: x.to_f64().abs(), bound: x.error() };
            self.only_ties &= is_tie;
            self.decisions.push(Decision::unsure(state.step.k, pairing.node, condition.into(), by));
        }
    }

    /// Returns the gap of a pairing under displacements, length.
    fn gap(&self, pairing: &Pairing, u: &DVector<Bounded>) -> Bounded {
        let pairing = pairing.map(Bounded::from_f64);
        let model = &self.solution.model;
        pairing.opening(|node| node.components(u))
            + pairing.opening(|node| model.coordinates(node).map(Bounded::from_f64))
    }

    /// Looks at which part of the target a node faces: of a node in contact, or of one that would touch
    /// the other part.
    fn check_parts(&mut self, state: &BoundedState, detail: &Unilateral) {
        let Some(surfaces) = &self.surfaces else { return };
        let (model, contact) = (&*self.solution.model, &self.solution.request.contact);
        let is_current = contact.geometry.is_current();
        let measured_in = if is_current { &*state.step.shape } else { &model.nodes };
        let largest = measured_in.iter().flatten().fold(0.0, |m: f64, x| m.max(x.abs()));
        let of_u = state.u.iter().map(|u| 2.0 * u.error()).fold(0.0, f64::max);
        let radius = if is_current { of_u } else { 0.0 } + COORDINATE * f64::EPSILON * largest;
        if !radius.is_finite() {
            // Nothing is known of the displacements.
            return;
        }
        let k = state.step.k;
        let entry = |node: NodeId| model.contact.nodes.iter().position(|other| *other == node);
        let counts = |(node, other): &(NodeId, Option<Pairing>)| {
            entry(*node).is_some_and(|entry| detail.statuses[entry].is_closed())
                || other.as_ref().is_some_and(|other| {
                    let gap = self.gap(other, state.u);
                    gap.to_f64() <= gap.error()
                })
        };
        let by_integral =
            |(node, by)| Decision::unsure(k, node, "a comparison of mortar's integrals".into(), by);
        let by_place = |node| Decision {
            iteration: k,
            node,
            condition: "which part of the target it faces".into(),
            margin: None,
            bound: Some(radius),
        };
        let found: Vec<Decision> = match self.elsewhere(surfaces, measured_in, radius) {
            Elsewhere::Mortar(unsure) => unsure.into_iter().map(by_integral).collect(),
            Elsewhere::Nts(other) => {
                let mut nodes: Vec<NodeId> =
                    other.iter().filter(|it| counts(it)).map(|it| it.0).collect();
                nodes.dedup();
                nodes.into_iter().map(by_place).collect()
            }
        };
        self.only_ties &= found.is_empty();
        self.decisions.extend(found);
    }
}

/// Returns whether the sign of a number is left to rounding.
fn is_unsure(x: Bounded) -> bool {
    x.to_f64().abs() <= x.error() && x.error() > 0.0
}
