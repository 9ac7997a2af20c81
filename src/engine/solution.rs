//! The solution of a request: displacements, stresses, the contact surface, and the steps.

use std::sync::Arc;

use dashu_ratio::RBig;
use nalgebra::DVector;
use serde::Serialize;

use super::contact::{ContactNode, InsideNode, Pairing, ROUNDING_OF_A_FORCE, Status, Watched};
use super::elimination::Constraint;
use super::error::{Cause, NoEquilibrium};
use super::range::inside_out;
use super::request::Request;
use base::choices;
use base::exit::ExitStatus;
use numbers::scalar::Scalar;
use paper::mirror::Pairs;
use problem::element::State;
use problem::model::{Dof, Model, NodeId};

/// The part of the largest displacement from which a gap is open, and from which two equilibria differ.
pub(super) const APART: f64 = 1e-6;

/// A step: one iteration of a published variant, or one of the active set.
#[derive(Clone, Debug, PartialEq)]
pub struct Step {
    /// The number of the step, from 1.
    pub k: usize,
    /// The shape from which the step started: the coordinates of each node, length.
    pub shape: Arc<Vec<[f64; 2]>>,
    /// The status of each entry of the contact surface: that which was imposed. Under the paper's variants a
    /// node whose dy is 1 sticks, any other one is open.
    pub statuses: Vec<Status>,
    /// The constraints on contact nodes, by elimination; empty under `printed`.
    pub constraints: Vec<Constraint>,
    /// The number of entries of the contact surface in contact, of a published variant in the shape from
    /// which the step started.
    pub in_contact: usize,
    /// The largest total displacement |u| of a node, length.
    pub max_displacement: f64,
    /// The earlier steps with this contact state; None where it is new.
    pub cycle: Option<Cycle>,
    /// The force that contact passes from one body to the other, force: along the load where that acts
    /// on one of the two bodies alone, else its size. 0 without contact.
    pub target_force: f64,
    /// The relative residual |A x − b| / (|A| |x| + |b|) of the equations.
    pub solve_residual: f64,
    /// The residual of the contact condition, length: the largest |u_cont − u_targ|, |v_cont − v_targ| of
    /// eq. (1) over nodes in contact, in total displacements; under `unilateral` the largest gap of a closed
    /// node or penetration of another one.
    pub contact_residual: f64,
    /// The same in the displacements solved for: the increment where the load is stepped.
    pub contact_residual_step: f64,
    /// The results that only this kind of variant has.
    pub detail: Detail,
}

/// The results of a step that depend on the kind of variant.
#[derive(Clone, Debug, PartialEq)]
pub enum Detail {
    /// An iteration of a variant that the paper describes: the pairs that `c_cnt` found in the shape at the
    /// start.
    Published(Pairs<f64>),
    /// An iteration of the active set under `unilateral`.
    Unilateral(Unilateral),
}

/// An iteration of the active set.
#[derive(Clone, Debug, PartialEq)]
pub struct Unilateral {
    /// The part of the path of the load that was applied: 1 after the first stage, 2 after the
    /// second.
    pub load: f64,
    /// The pairing of each entry in the shape in which contact was measured.
    pub pairings: Arc<Vec<Option<Pairing>>>,
    /// The largest friction coefficient that a pressed node needs not to slide; nothing where none is
    /// pressed.
    pub friction_needed: Option<f64>,
    /// The friction of sliding nodes, force, on each degree of freedom on which it acts.
    pub friction: Vec<(Dof, f64)>,
    /// The stiffness of the springs that held the nodes to their places in the shape before, over that of
    /// the bodies; 0 where there were none.
    pub springs: f64,
}

impl Unilateral {
    /// Returns the friction of sliding nodes by all `dofs` degrees of freedom, force.
    pub fn friction(&self, dofs: usize) -> DVector<f64> {
        let mut friction = DVector::zeros(dofs);
        self.friction.iter().for_each(|(dof, force)| friction[dof.index()] = *force);
        friction
    }
}

/// The path of the load at the end of which a solution under friction stands.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Path {
    /// The number of equal steps of a stage's load.
    pub steps: usize,
    /// The number of stages.
    pub stages: usize,
    /// The number of steps that were halved because no equilibrium was found.
    pub halved: usize,
    /// How it starts.
    pub start: Start,
    /// The number of steps in which a node came to stick, to slide or to open: when it did is known to the
    /// length of the step only.
    pub changes: usize,
}

/// How a path starts, before any load.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Start {
    /// Restraints, and the contact nodes that touch the target, hold the bodies.
    Held,
    /// They do, once nodes that overlapped the target closed in a step of their own.
    Closed,
    /// They overlapped, and contact alone holds them: they were moved apart as rigid ones, to where a
    /// vanishing load holds them without friction, or by their only motion.
    Released,
    /// They overlapped, and neither contact nor the load holds them without friction: they were moved apart
    /// as rigid ones, so that all nodes that overlapped touch and none slipped.
    Unslipped,
    /// They overlapped, and the load holds them by friction alone: a first small part of it is a step of its
    /// own, in which no other contact state is in equilibrium.
    Pressed,
    /// Nothing holds the bodies: the first step moves them to where contact does, and how long that step is
    /// changes the result.
    Loose,
    /// Nodes overlap the target, and no equilibrium was found without load in which they do not: they close
    /// with the first step, and how long that is changes the result.
    Overlapping,
}

choices! {
    /// What a node's status turns on.
    Margin {
        /// The gap of an open node, over the largest displacement component.
        Gap = "gap",
        /// The normal force of a node in contact, over the largest one.
        Force = "force",
        /// The friction that a node that sticks has left, over the largest normal force.
        Friction = "friction left",
        /// The slip of a node that slides, over the largest displacement component.
        Slip = "slip",
    }
}

/// How near the status of a node is to another one.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct NearestDecision {
    /// The contact node.
    pub node: NodeId,
    /// What its status turns on.
    pub of: Margin,
    /// Its size, relative.
    pub relative: f64,
}

/// An equilibrium beside the one that was found.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct OtherEquilibrium {
    /// The part of the path at the end of the step that could end in it; whole numbers end stages.
    pub load: f64,
    /// The nodes that stick in it.
    pub stick: Vec<NodeId>,
    /// The nodes that slide in it.
    pub slip: Vec<NodeId>,
    /// Its largest displacement component that differs, length.
    pub change: f64,
}

/// What is known of other equilibria under the same load.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(tag = "kind", rename_all = "kebab-case")]
pub enum Uniqueness {
    /// No other equilibrium exists: the problem is convex and contact holds the bodies.
    Unique,
    /// The bodies can move without work: a rigid motion leaves forces and load in balance.
    Indifferent {
        /// A node that can move.
        node: NodeId,
    },
    /// Whether there is another one is not known: contact is measured in the current geometry, where the
    /// problem is not convex.
    Unknown {
        /// A node that can move without work as long as the normals of contact stay as they are.
        #[serde(skip_serializing_if = "Option::is_none")]
        node: Option<NodeId>,
    },
    /// Other contact states were tried, each in the shape to which its step led.
    Tried {
        /// The number of contact states that were tried, in all steps.
        states: usize,
        /// The number of steps of the load that were looked at: the last one, or all.
        steps: usize,
        /// Whether these are all contact states of the steps that were looked at.
        all: bool,
        /// Whether there were earlier steps, which were not looked at.
        last_only: bool,
        /// Those among them that are in equilibrium too.
        others: Vec<OtherEquilibrium>,
    },
}

impl Uniqueness {
    /// Returns whether another equilibrium is known.
    pub fn is_refuted(&self) -> bool {
        match self {
            Uniqueness::Unique | Uniqueness::Unknown { .. } => false,
            Uniqueness::Indifferent { .. } => true,
            Uniqueness::Tried { others, .. } => !others.is_empty(),
        }
    }

    /// Returns whether it is known that there is no other equilibrium in the steps that were looked at.
    pub fn is_proven(&self) -> bool {
        match self {
            Uniqueness::Unique => true,
            Uniqueness::Indifferent { .. } | Uniqueness::Unknown { .. } => false,
            Uniqueness::Tried { all, others, .. } => *all && others.is_empty(),
        }
    }
}

/// Returns the places of the last iterations under each load of a path.
pub fn last_under_each_load(steps: &[Step]) -> Vec<usize> {
    let load = |step: &Step| step.unilateral().map(|own| own.load);
    let is_last = |i: &usize| steps.get(i + 1).is_none_or(|next| load(next) != load(&steps[*i]));
    (0..steps.len()).filter(is_last).collect()
}

impl Step {
    /// Returns what `unilateral` knows of the step; None under the other variants.
    pub fn unilateral(&self) -> Option<&Unilateral> {
        match &self.detail {
            Detail::Unilateral(own) => Some(own),
            Detail::Published(_) => None,
        }
    }

    /// Returns whether each entry of the contact surface is in contact.
    pub fn closed(&self) -> impl Iterator<Item = bool> {
        self.statuses.iter().map(|status| status.is_closed())
    }

    /// Returns the nodes of `model`'s contact surface in contact.
    pub fn contact_set(&self, model: &Model) -> Vec<NodeId> {
        let nodes = model.contact.nodes.iter().zip(self.closed());
        nodes.filter(|(_, in_contact)| *in_contact).map(|(node, _)| *node).collect()
    }
}

/// The return of an earlier contact state.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Cycle {
    /// The number of steps since the state last occurred; 1 means that it did not change.
    pub length: usize,
    /// Those steps: the last that had this state, and those between.
    pub members: Vec<usize>,
}

/// The solution of a request.
#[derive(Clone, Debug, PartialEq)]
pub struct Solution {
    /// The request that was solved.
    pub request: Request,
    /// The model under the requested reading.
    pub model: Arc<Model>,
    /// The steps of the run, at least one.
    pub steps: Vec<Step>,
    /// The displacements by degree of freedom, length.
    pub u: DVector<f64>,
    /// The force of the restraints on each degree of freedom, 0 where nothing holds its node, force.
    pub reactions: DVector<f64>,
    /// The stresses and strains of each triangle.
    pub elements: Vec<State>,
    /// The contact surface at the end: the nodes that face the target, in order.
    pub contact: Vec<ContactNode>,
    /// The number of matrices that were factored, one for each contact state.
    pub factored: usize,
    /// All significant digits of `u`, where the scalar has more than an `f64`.
    pub digits: Option<Vec<RBig>>,
    /// Where bodies lie in each other though no group of contact keeps them apart, under `unilateral`; None
    /// where they do not, and where triangles are turned inside out.
    pub overlap: Option<Overlap>,
    /// What `unilateral` knows beside its solution; None under the other variants.
    pub equilibrium: Option<Equilibrium>,
}

/// Nodes of outlines that lie inside another body.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Overlap {
    /// How many they are.
    pub nodes: usize,
    /// The deepest.
    pub node: NodeId,
    /// Its distance from the outline of the other body, length.
    pub depth: f64,
    /// The height of the arcs over the edges there, length; 0 where they are straight.
    pub facet_height: f64,
}

impl Overlap {
    /// Returns what there is among nodes inside a body, the deepest first, that contact does not watch, as they
    /// are in none of its groups or beyond the end of the other one. What was found is then an equilibrium of
    /// bodies that pass through each other there.
    pub(super) fn of(inside: &[InsideNode]) -> Option<Self> {
        let unwatched: Vec<_> =
            inside.iter().filter(|inside| inside.watched == Watched::Not).collect();
        let InsideNode { node, depth, height: facet_height, .. } = **unwatched.first()?;
        Some(Overlap { nodes: unwatched.len(), node, depth, facet_height })
    }
}

/// What `unilateral` knows of the equilibrium that it found.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Equilibrium {
    /// The path of the load; None without friction, where it has no effect.
    pub path: Option<Path>,
    /// What is known of other equilibria.
    pub uniqueness: Uniqueness,
    /// The decision of its contact state that is nearest to another one; None where none is known.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub nearest: Option<NearestDecision>,
    /// Under node to segment, which watches contact nodes alone, the target node that lies deepest
    /// inside the contact surface, and its depth, length; None where none lies deeper than a
    /// thousandth of the model's size.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub unseen: Option<(NodeId, f64)>,
    /// The contact node that lies deepest inside the target's body in the shape reached though it faces an
    /// edge of the target, and its distance from the body's outline, length; None where none lies deeper than
    /// a thousandth of the model's size.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub inside: Option<(NodeId, f64)>,
    /// The height of the arcs over the edges of curved surfaces in contact, and how far the gaps there differ
    /// before any load, from each other and overlaps from none, length; with no node in contact, that of all
    /// that face the target, and the smallest gap left. None where the height is a small part of this.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub facets: Option<[f64; 2]>,
    /// The largest change of a displacement component when contact was last measured in the shape
    /// reached, length; 0 in the initial geometry.
    pub shape_change: f64,
    /// The largest force of the springs on which it was found, over the largest of the loads and of those
    /// of contact; None where it was found without springs.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub springs: Option<f64>,
}

impl Solution {
    /// Returns a solution of the same model with other displacements, by degree of freedom, length, and the
    /// states of each triangle. The digits of its own displacements are not kept; the contact surface, the
    /// reactions and the steps stay those of this solution.
    #[must_use]
    pub fn with_fields(&self, u: DVector<f64>, elements: Vec<State>) -> Self {
        Solution { u, elements, digits: None, ..self.clone() }
    }

    /// Returns the displacements by degree of freedom with all their digits, length.
    pub fn exact_displacements(&self) -> Vec<RBig> {
        let value = |u: &f64| RBig::try_from(*u).expect("displacements are finite");
        self.digits.clone().unwrap_or_else(|| self.u.iter().map(value).collect())
    }

    /// Returns whether other equilibria than the one that was found are known.
    pub fn has_others(&self) -> bool {
        self.equilibrium.as_ref().is_some_and(|found| found.uniqueness.is_refuted())
    }

    /// Returns whether displacements turn a triangle inside out, so that they are no equilibrium's; what the
    /// paper's variants end with is judged elsewhere.
    pub fn is_inside_out(&self) -> bool {
        let shape = || self.model.shape(&self.u);
        self.equilibrium.is_some() && inside_out(&self.model, &shape()).next().is_some()
    }

    /// Returns why it is not the equilibrium of the scene: triangles are turned inside out, bodies lie in
    /// each other, or other equilibria are known; None where none of these is so.
    pub fn doubt(&self) -> Option<NoEquilibrium> {
        let (cause, what) = if self.is_inside_out() {
            (Cause::OutOfRange, "triangles are turned inside out by the displacements")
        } else if self.overlap.is_some() && self.model.has_contact() {
            (Cause::NotFound, "bodies lie in each other outside the groups of contact")
        } else if self.overlap.is_some() {
            (Cause::NotFound, "bodies lie in each other, and the scene has no contact")
        } else if self.has_others() {
            (Cause::Several, "the equilibrium is not the only one")
        } else {
            return None;
        };
        Some(NoEquilibrium { cause, what: what.into() })
    }

    /// Returns the exit status of the process, which is one of its own where it is not the equilibrium of the
    /// scene.
    pub fn exit_status(&self) -> ExitStatus {
        if self.doubt().is_some() { ExitStatus::Equilibrium } else { ExitStatus::Done }
    }

    /// Returns the last step.
    pub fn last(&self) -> &Step {
        self.steps.last().expect("a run has a step")
    }

    /// Returns the force that contact passes on at the end ([`Step::target_force`]).
    pub fn target_force(&self) -> f64 {
        self.last().target_force
    }

    /// Returns whether contact passes no load on at the end, beyond rounding, though the scene has contact,
    /// and a load or a displaced node: an audit result under `printed`, which couples nothing (finding K1).
    /// Under `unilateral` no contact node is pressed: contact may act across the load, or between parts of
    /// one body.
    pub fn transmits_nothing(&self) -> bool {
        let [fx, fy] = self.model.total_load();
        let load = if self.equilibrium.is_some() { self.model.load.amax() } else { fx.hypot(fy) };
        let least = ROUNDING_OF_A_FORCE * load;
        let is_loaded = self.model.target().is_some() && (load > 0.0 || self.is_displaced());
        is_loaded
            && match &self.equilibrium {
                None => self.target_force().abs() <= least,
                Some(_) => self
                    .in_contact()
                    .all(|node| node.force.is_some_and(|force| force.abs() <= least)),
            }
    }

    /// Returns whether a restraint displaces a node.
    pub fn is_displaced(&self) -> bool {
        self.model.holds.displace()
    }

    /// Returns whether no node is in contact at the end, though the scene has contact.
    pub fn touches_nothing(&self) -> bool {
        self.model.target().is_some() && self.in_contact().next().is_none()
    }

    /// Returns the contact nodes in contact at the end.
    pub fn in_contact(&self) -> impl Iterator<Item = &ContactNode> {
        self.contact.iter().filter(|node| node.in_contact)
    }

    /// Returns the sum of the normal forces of the nodes in contact, force.
    pub fn pressed(&self) -> f64 {
        self.in_contact().filter_map(|node| node.force).sum()
    }

    /// Returns whether a contact node is apart from the target, by more than a millionth of the largest
    /// displacement.
    pub fn is_apart(&self, contact: &ContactNode) -> bool {
        contact.gap > APART * max_displacement(&self.u)
    }

    /// Returns the displacement of each node, length.
    pub fn displacements(&self) -> Vec<[f64; 2]> {
        self.by_node(&self.u)
    }

    /// Returns the components at each node of a vector by degree of freedom.
    pub fn by_node(&self, of: &DVector<f64>) -> Vec<[f64; 2]> {
        self.model.node_ids().map(|node| node.components(of)).collect()
    }
}

/// Returns the largest |u| of a node, length.
pub fn max_displacement<T: Scalar>(u: &DVector<T>) -> f64 {
    /// More than |u| over the larger of |u_x| and |u_y|.
    const ROOM: f64 = 1.5;
    u.as_slice().chunks(2).fold(0.0, |largest: f64, u| {
        let longer = Scalar::abs(u[0]).to_f64().max(Scalar::abs(u[1]).to_f64());
        if ROOM * longer < largest { largest } else { largest.max(Scalar::hypot(u[0], u[1])) }
    })
}
