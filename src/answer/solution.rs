//! What comes of a request: displacements, stresses, the contact surface, and the steps that led
//! there.

use std::sync::Arc;

use dashu_ratio::RBig;
use nalgebra::DVector;
use serde::{Deserialize, Serialize};

use super::contact::{ContactNode, Pairing};
use super::elimination::Constraint;
use super::request::Request;
use crate::numbers::scalar::Scalar;
use crate::paper::mirror::Pairs;
use crate::problem::element::State;
use crate::problem::model::{Model, NodeId};

/// A step: one iteration of a published variant, or one of the active set.
#[derive(Clone, Debug)]
pub struct Step {
    /// Its number, from 1.
    pub k: usize,
    /// The shape that it started from: coordinates of each node, length.
    pub shape: Vec<[f64; 2]>,
    /// What bound contact nodes to the target, by elimination; empty under `printed`.
    pub constraints: Vec<Constraint>,
    /// Number of entries of the contact surface in contact.
    pub in_contact: usize,
    /// Largest |u| of a node, total, length.
    pub max_displacement: f64,
    /// Where this contact state came before.
    pub cycle: Option<Cycle>,
    /// Sum of the reactions of the target body against the direction of the load applied so far,
    /// force; 0 without contact.
    pub target_force: f64,
    /// Relative residual |A x − b| / (|A| |x| + |b|) of the solution.
    pub solve_residual: f64,
    /// What the variant itself knows of the step.
    pub detail: Detail,
}

/// What a step of each kind of variant knows.
#[derive(Clone, Debug)]
pub enum Detail {
    /// An iteration of a variant that the paper describes.
    Published(Published),
    /// An iteration of the active set under `unilateral`.
    Unilateral(Unilateral),
}

/// An iteration of a variant that the paper describes.
#[derive(Clone, Debug)]
pub struct Published {
    /// What `c_cnt` found in the shape that the iteration started from, in its own arrays.
    pub pairs: Pairs<f64>,
    /// Eq. (1): largest |u_cont − u_targ|, |v_cont − v_targ| over nodes in contact, total
    /// displacements, length.
    pub eq1_residual: f64,
    /// The same on what this iteration solved for: the increment where the load is stepped.
    pub eq1_residual_step: f64,
}

/// An iteration of the active set.
#[derive(Clone, Debug)]
pub struct Unilateral {
    /// Whether each entry of the contact surface was closed.
    pub closed: Vec<bool>,
    /// What each entry faced in the shape that the iteration started from.
    pub pairings: Vec<Option<Pairing>>,
    /// The largest gap of a closed node or penetration of another one in the shape that the
    /// iteration led to, length.
    pub violation: f64,
}

impl Step {
    /// Whether each entry of the contact surface is in contact.
    pub fn statuses(&self) -> Vec<bool> {
        match &self.detail {
            Detail::Published(step) => step.pairs.dy.iter().map(|dy| *dy == 1).collect(),
            Detail::Unilateral(step) => step.closed.clone(),
        }
    }

    /// What is left of the contact condition, length: of eq. (1) on total displacements, or of the
    /// gaps.
    pub fn contact_residual(&self) -> f64 {
        match &self.detail {
            Detail::Published(step) => step.eq1_residual,
            Detail::Unilateral(step) => step.violation,
        }
    }

    /// The same on what this step solved for.
    pub fn contact_residual_step(&self) -> f64 {
        match &self.detail {
            Detail::Published(step) => step.eq1_residual_step,
            Detail::Unilateral(step) => step.violation,
        }
    }

    /// The nodes of `model`'s contact surface in contact.
    pub fn contact_set(&self, model: &Model) -> Vec<NodeId> {
        let nodes = model.contact.nodes.iter().zip(self.statuses());
        nodes.filter(|(_, in_contact)| *in_contact).map(|(node, _)| *node).collect()
    }
}

/// A contact state that came before.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Cycle {
    /// Steps since the state came last; 1 = it did not change.
    pub length: usize,
    /// Those steps: the last that had this state, and those between.
    pub members: Vec<usize>,
}

/// What comes of a request.
#[derive(Clone, Debug)]
pub struct Solution {
    /// What was asked for.
    pub request: Request,
    /// The model under the reading that was asked for.
    pub model: Arc<Model>,
    /// The steps, at least one.
    pub steps: Vec<Step>,
    /// Displacements by degree of freedom, length.
    pub u: DVector<f64>,
    /// Stresses and strains, by triangle.
    pub elements: Vec<State>,
    /// The contact surface at the end, in order: the nodes that face the target.
    pub contact: Vec<ContactNode>,
    /// Number of matrices factored: one for each contact state.
    pub factored: usize,
    /// `u` with all digits that are worth having, where the scalar has more than an `f64`.
    pub digits: Option<Vec<RBig>>,
    /// A bound on the largest error of an entry of `u` against the same run without rounding, where
    /// the scalar keeps one: it holds while rounding does not change who is in contact. Length.
    pub error_bound: Option<f64>,
}

impl Solution {
    /// The last step.
    pub fn last(&self) -> &Step {
        self.steps.last().expect("a run has a step")
    }

    /// The contact nodes in contact at the end.
    pub fn in_contact(&self) -> impl Iterator<Item = &ContactNode> {
        self.contact.iter().filter(|node| node.in_contact)
    }

    /// Displacement of each node, length.
    pub fn displacements(&self) -> Vec<[f64; 2]> {
        self.model.node_ids().map(|node| node.of(&self.u)).collect()
    }
}

/// Largest |u| of a node.
pub fn max_displacement<T: Scalar>(u: &DVector<T>) -> f64 {
    u.as_slice().chunks(2).map(|u| Scalar::hypot(u[0], u[1])).fold(0.0, f64::max)
}
