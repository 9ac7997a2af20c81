//! What comes of a run, and what is read off it.

use nalgebra::{DVector, SVector};
use serde::Serialize;

use super::elimination::Tie;
use super::pressure::ContactNode;
use crate::numbers::scalar::Scalar;
use crate::numbers::solve::Arithmetic;
use crate::paper::mathcad::array::{Column, Table};
use crate::paper::mirror::{Failure, Km, Pairs, Reading, Schedule, Worksheet};
use crate::problem::element::State;
use crate::problem::modelling::{ContactModel, Variant};

/// One iteration.
#[derive(Clone, Debug)]
pub struct Iteration {
    /// Its number, from 1.
    pub k: usize,
    /// The shape that the iteration started from: R x 4, as `node`.
    pub node_n: Table<f64>,
    /// What `c_cnt` found in it.
    pub pairs: Pairs<f64>,
    /// What bound contact nodes to the target, by elimination; empty under `printed`.
    pub ties: Vec<Tie>,
    /// Number of contact nodes with dy = 1.
    pub in_contact: usize,
    /// Largest |u| of a node, total, length.
    pub max_displacement: f64,
    /// Where this contact state (all of k_cnt) was met before.
    pub cycle: Option<Cycle>,
    /// Eq. (1): largest |u_cont − u_targ|, |v_cont − v_targ| over nodes in contact, total displacements, length. Under `unilateral` the
    /// largest gap of a closed node or penetration of another one in the shape that the iteration leads to.
    pub eq1_residual: f64,
    /// The same on what this iteration solved for: the increment where the load is stepped.
    pub eq1_residual_step: f64,
    /// Sum of the reactions of the target body against the direction of the load applied so far, force; 0 without contact.
    pub target_force: f64,
    /// Relative residual |A x − b| / (|A| |x| + |b|) of the solution.
    pub solve_residual: f64,
}

/// A contact state that came before.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Cycle {
    /// Iterations since the state was last met; 1 = it did not change.
    pub length: usize,
    /// Those iterations: the last that had this state, and those between.
    pub members: Vec<usize>,
}

/// The outcome of a run.
#[derive(Clone, Debug)]
pub struct Outcome {
    /// What was run.
    pub variant: Variant,
    /// What an iteration carried.
    pub schedule: Schedule,
    /// The reading.
    pub reading: Reading,
    /// How contact is modelled beyond what the paper prints.
    pub model: ContactModel,
    /// The paper's arrays.
    pub sheet: Worksheet<f64>,
    /// The iterations.
    pub iterations: Vec<Iteration>,
    /// Displacements of the 2R equations, length.
    pub u: DVector<f64>,
    /// Stresses and strains, by row of `EL`.
    pub elements: Vec<State>,
    /// The contact surface at the end, in the order of `cnt`.
    pub contact: Vec<ContactNode>,
    /// Number of matrices factored: one for each contact state.
    pub factored: usize,
    /// In which numbers and by which solver.
    pub arithmetic: Arithmetic,
    /// `u` in decimal, where the scalar has more digits than an `f64`.
    pub digits: Option<Vec<String>>,
    /// A bound on the largest error of an entry of `u` against the same run without rounding, where the scalar keeps one: it
    /// holds while rounding does not change who is in contact. Length.
    pub error_bound: Option<f64>,
}

/// `Km` without contact and without restraints: 2R x 2R, force/length.
///
/// # Errors
/// An overflow.
pub fn free_stiffness<T: Scalar>(
    sheet: &Worksheet<T>,
    reading: &Reading,
) -> Result<Table<T>, Failure> {
    let free = Worksheet { S: Column::filled(2 * sheet.R(), 0), ..sheet.clone() };
    Km(&free, reading, &Table::filled(sheet.R(), 4, T::zero()))
}

/// node_n = node + U: R x 4, length.
pub fn shape<T: Scalar>(sheet: &Worksheet<T>, u: &DVector<T>) -> Table<T> {
    let mut node_n = sheet.node.clone();
    for n in 1..=sheet.R() {
        node_n[(n, 2)] += u[2 * n - 2];
        node_n[(n, 3)] += u[2 * n - 1];
    }
    node_n
}

/// Largest |u| of a node.
pub fn max_displacement<T: Scalar>(u: &DVector<T>) -> f64 {
    u.as_slice().chunks(2).map(|u| Scalar::hypot(u[0], u[1])).fold(0.0, f64::max)
}

/// Stresses and strains of every triangle.
pub(super) fn states<T: Scalar>(sheet: &Worksheet<T>, u: &DVector<T>) -> Vec<State> {
    (1..=sheet.M())
        .map(|n| {
            let of_element = SVector::<T, 6>::from_fn(|k, _| {
                u[2 * sheet.EL[(n, sheet.ind_1 + k / 2)] - 2 + k % 2]
            });
            State::new(sheet.plane, sheet.E[n], sheet.nu[n], &sheet.B[n], &of_element)
        })
        .collect()
}
