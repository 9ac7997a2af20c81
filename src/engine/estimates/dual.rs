//! The discretisation error of a displacement: what the mesh takes from one number.
//!
//! The displacement of a point along a direction is the work of a unit force there. Let z be the
//! displacements under that force alone, contact held as it is at the end of the run. Because
//! u − u_h is orthogonal to all that the mesh can do,
//!
//! ```text
//!  u(p) − u_h(p) = a(u − u_h, z) = a(u − u_h, z − z_h) = ∫ (σ − σ_h)(u)ᵀ D⁻¹ (σ − σ_h)(z) dV
//!  estimate      = SAFETY · | ∫ (σ* − σ_h)(u)ᵀ D⁻¹ (σ* − σ_h)(z) dV |
//! ```
//!
//! with the recovered stresses σ* (`recovery.rs`) for the true ones. Under friction, and where
//! contact changes with the mesh, the equality holds nearly only.
//!
//! Source: R. Becker, R. Rannacher, "An optimal control approach to a posteriori error estimation
//! in finite element methods", Acta Numerica 10 (2001) 1-102.

use nalgebra::DVector;

use super::discretisation::{Discretisation, SAFETY, compliance};
use super::factors::StateFactors;
use super::recovery::Stress;
use crate::Solution;
use problem::element::{self, State};
use problem::model::{Model, NodeId, TriangleId};

/// The bodies at the end of a run, to which one more force is applied.
pub struct Dual<'a> {
    model: &'a Model,
    /// σ* − σ_h at the corners of each triangle, stress; None where a triangle's is unknown.
    errors: Option<Vec<[Stress; 3]>>,
    mesh: &'a Discretisation,
    state: StateFactors,
}

impl<'a> Dual<'a> {
    /// Takes the bodies at the end of a run; `mesh` is its estimate.
    pub fn new(solution: &'a Solution, state: StateFactors, mesh: &'a Discretisation) -> Self {
        let errors = stress_errors(mesh, &solution.elements);
        Dual { model: &solution.model, errors, mesh, state }
    }

    /// Returns the estimated error of the displacement in whose place and direction `force`, by
    /// degree of freedom, is a unit force, length; infinite where the error of a triangle is
    /// unknown.
    pub fn error(&self, force: &DVector<f64>) -> f64 {
        let z = self.state.stiffness.states(&self.state.under(self.model, force));
        let of_z = stress_errors(&self.mesh.of_other(self.model, &z), &z);
        let Some((of_u, of_z)) = self.errors.as_ref().zip(of_z) else { return f64::INFINITY };
        let pairs = self.model.triangle_ids().zip(of_u.iter().zip(&of_z));
        let error = SAFETY * pairs.map(|(id, (u, z))| self.work(id, u, z)).sum::<f64>().abs();
        if error.is_nan() { f64::INFINITY } else { error }
    }

    /// Returns ∫ aᵀ D⁻¹ b dV over a triangle of stresses that are linear between its corners,
    /// force·length.
    fn work(&self, id: TriangleId, a: &[Stress; 3], b: &[Stress; 3]) -> f64 {
        let material = self.model.triangle(id).material;
        let c = compliance(self.model.plane, material.nu);
        let volume = element::area(&self.model.corners(id)) * self.model.thickness;
        let (whole_a, whole_b): (Stress, Stress) = (a.iter().sum(), b.iter().sum());
        // Exact for a quadratic: ∫ N_i N_j = A (1 + [i = j]) / 12.
        let corners = a.iter().zip(b).map(|(a, b)| a.dot(&(c * b))).sum::<f64>();
        volume / material.e * (corners + whole_a.dot(&(c * whole_b))) / 12.0
    }

    /// Returns the estimated error of the largest displacement |u| of a node, length.
    pub fn error_of_largest(&self, u: &DVector<f64>) -> f64 {
        let size = |node: NodeId| {
            let [x, y] = node.components(u);
            x.hypot(y)
        };
        // Of several the first.
        let largest = self.model.node_ids().rev().max_by(|a, b| size(*a).total_cmp(&size(*b)));
        let Some(node) = largest.filter(|node| size(*node) != 0.0) else { return 0.0 };
        let mut force = DVector::zeros(u.len());
        for (dof, component) in node.dofs().into_iter().zip(node.components(u)) {
            force[dof.index()] = component / size(node);
        }
        self.error(&force)
    }
}

/// Returns σ* − σ_h at the corners of each triangle, stress; None where a triangle's is unknown.
fn stress_errors(errors: &Discretisation, elements: &[State]) -> Option<Vec<[Stress; 3]>> {
    let of = |(corners, state): (&[Stress; 3], &State)| corners.map(|s| s - state.sigma);
    let known = errors.unrecovered.is_empty();
    known.then(|| errors.recovered.iter().zip(elements).map(of).collect())
}
