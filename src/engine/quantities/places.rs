//! What quantities live on: the places of a solution whose values the table computes.

use super::{BodySummary, IterationRow, NodeFields, SupportForce, TriangleValues};
use crate::reactions::{reactions_of_restraints, share_of_load};
use crate::solution::{Solution, Step};
use numbers::largest::{Largest, largest};
use problem::element::{State, out_of_plane_strain, out_of_plane_stress};
use problem::model::{Body, Model, TriangleId};

/// An iteration of a run.
pub(crate) struct IterationPlace<'a> {
    pub(super) step: &'a Step,
    model: &'a Model,
}

impl IterationPlace<'_> {
    pub(super) fn target_share(&self) -> Option<f64> {
        share_of_load(self.model, self.step.target_force)
    }
}

impl IterationRow {
    /// Returns the results of each iteration of a solution.
    pub fn all(solution: &Solution) -> Vec<Self> {
        let row = |step| IterationRow::compute(&IterationPlace { step, model: &solution.model });
        solution.steps.iter().map(row).collect()
    }
}

/// A body of a solution.
pub(crate) struct BodyPlace<'a> {
    solution: &'a Solution,
    pub(super) body: &'a Body,
    /// Which of its triangles has the largest von Mises stress.
    pub(super) most_stressed: Largest,
}

/// Returns the largest values of each body, in the model's order.
pub fn summaries(solution: &Solution) -> Vec<BodySummary> {
    let row = |body: &Body| {
        let stress = |id: &TriangleId| solution.elements[id.index()].von_mises_stress;
        let most_stressed =
            largest(body.triangles.iter().map(stress)).expect("a body has a triangle");
        BodySummary::compute(&BodyPlace { solution, body, most_stressed })
    };
    solution.model.bodies.iter().map(row).collect()
}

impl BodyPlace<'_> {
    pub(super) fn state(&self, id: TriangleId) -> &State {
        &self.solution.elements[id.index()]
    }

    /// Returns the triangle with the largest von Mises stress.
    pub(super) fn largest(&self) -> TriangleId {
        self.body.triangles[self.most_stressed.first]
    }

    pub(super) fn centre(&self) -> [f64; 2] {
        let corners = self.solution.model.corners(self.largest());
        [0, 1].map(|axis| corners.iter().map(|p| p[axis]).sum::<f64>() / 3.0)
    }

    pub(super) fn max_displacement(&self) -> f64 {
        let displacements = self.body.nodes.iter().map(|node| node.components(&self.solution.u));
        displacements.map(|[x, y]: [f64; 2]| x.hypot(y)).fold(0.0, f64::max)
    }

    pub(super) fn max_von_mises_strain(&self) -> f64 {
        let strains = self.body.triangles.iter().map(|id| self.state(*id).von_mises_strain);
        strains.fold(0.0, f64::max)
    }
}

/// A restraint of the scene, and the sum of its forces, force.
pub(crate) struct SupportPlace<'a> {
    pub(super) name: &'a str,
    /// The number of nodes that it holds.
    pub(super) nodes: usize,
    pub(super) force: [f64; 2],
}

impl SupportForce {
    /// Returns what each restraint of a solution's scene carries.
    pub fn all(solution: &Solution) -> Vec<Self> {
        let model = &*solution.model;
        let (nodes, forces) =
            (model.held_nodes(), reactions_of_restraints(model, &solution.reactions));
        let of_restraint = |(k, name): (usize, &String)| {
            Self::compute(&SupportPlace { name, nodes: nodes[k].len(), force: forces[k] })
        };
        model.restraints.iter().enumerate().map(of_restraint).collect()
    }
}

/// A triangle of a solution.
pub(crate) struct TrianglePlace<'a> {
    model: &'a Model,
    id: TriangleId,
    pub(super) state: &'a State,
    /// The error of the mesh there, where it is estimated.
    pub(super) mesh_error: Option<f64>,
}

impl TrianglePlace<'_> {
    pub(super) fn sigma(&self) -> [f64; 4] {
        let [x, y, xy] = self.state.sigma.into();
        [x, y, xy, out_of_plane_stress(self.model.plane, self.nu(), &self.state.sigma)]
    }

    pub(super) fn epsilon(&self) -> [f64; 4] {
        let [x, y, xy] = self.state.epsilon.into();
        [x, y, xy, out_of_plane_strain(self.model.plane, self.nu(), &self.state.epsilon)]
    }

    fn nu(&self) -> f64 {
        self.model.triangle(self.id).material.nu
    }
}

impl TriangleValues {
    /// Returns the values of each triangle of a solution; `mesh_error` has the error of the mesh in
    /// each, where that is estimated.
    pub fn all(solution: &Solution, mesh_error: Option<&[f64]>) -> Vec<Self> {
        let model = &*solution.model;
        let value = |(id, state): (TriangleId, &State)| {
            let mesh_error = mesh_error.map(|error| error[id.index()]);
            TriangleValues::compute(&TrianglePlace { model, id, state, mesh_error })
        };
        model.triangle_ids().zip(&solution.elements).map(value).collect()
    }
}

impl NodeFields {
    /// Collects the values of each node of a solution, in the order of the model.
    pub fn new(solution: &Solution) -> Self {
        NodeFields::compute(solution)
    }
}
