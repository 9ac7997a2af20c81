//! What a run will build and what it leaves out, before any of it is done.
//!
//! ```text
//!  scene --+--> bodies, equations, contact candidates      counted
//!          +--> symmetry, what nothing moves               recognised
//! ```

mod bodies;
mod candidates;

use serde::Serialize;

pub use bodies::{BodyPlan, Idle};
pub use candidates::MARGIN;

use candidates::Candidates;

use crate::Request;
use crate::linear::{ScalarName, Solver};
use base::choices;
use base::error::Result;
use problem::modelling::{ContactModel, Coupling, Friction, StatusRule, Variant};
use problem::scene::symmetry::{half, line_of};

choices! {
    /// How the matrices of a run are kept.
    Storage {
        /// Every entry is kept.
        Dense = "dense",
        /// Only the entries that are not 0 are kept.
        Sparse = "sparse",
    }
}

/// What a run will take.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Plan {
    /// The name of the scene.
    pub scene: String,
    /// The variant that would run.
    pub variant: Variant,
    /// The number of nodes.
    pub nodes: usize,
    /// The number of triangles.
    pub triangles: usize,
    /// Its bodies.
    pub bodies: Vec<BodyPlan>,
    /// The sum of the loads along x and y, force.
    pub load: [f64; 2],
    /// The largest nominal strain of a body: the loads on it, without their signs, over width or height,
    /// thickness and elastic modulus; nothing without a load.
    pub nominal_strain: Option<f64>,
    /// The numbers of its equations.
    pub equations: Equations,
    /// The contact; nothing where the scene has none.
    pub contact: Option<ContactPlan>,
    /// The numbers in which it would run.
    pub scalar: ScalarName,
    /// The solver that would be used.
    pub solver: Solver,
    /// How the matrix would be stored.
    pub storage: Storage,
    /// Nodes of the mesh file that belong to no triangle and were dropped.
    pub orphans: usize,
    /// Half of the scene, where it is its own mirror image about a vertical line.
    pub half: Option<HalfPlan>,
}

/// The numbers of equations of a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct Equations {
    /// Number of all equations, 2R.
    pub all: usize,
    /// Number of restrained equations.
    pub restrained: usize,
    /// Free equations, before constraints take out those of nodes in contact.
    pub free: usize,
    /// Of those in the matrix: all where `Km` is built as printed, 1 on the diagonal of a
    /// restrained one.
    pub solved: usize,
    /// Free equations of bodies that nothing moves.
    pub idle: usize,
}

/// Half of a symmetric scene.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct HalfPlan {
    /// Where the line of symmetry stands: x, length.
    pub at: f64,
    /// The number of its nodes.
    pub nodes: usize,
}

/// How contact is modelled, and who can come into contact.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ContactPlan {
    /// How a node is bound to the target; `printed`: by `Km` as printed.
    pub coupling: Coupling,
    /// What it may do along the tangent, under `unilateral`.
    pub friction: Friction,
    /// How `tied` and `stepped` decide who is in contact.
    pub status: StatusRule,
    /// Which contact nodes can come to which target edges.
    pub candidates: Candidates,
}

impl Plan {
    /// The plan of `request`. Neither a matrix is built nor an equation solved.
    ///
    /// # Errors
    /// A Poisson's ratio that R6 does not allow; a solver that the scalar does not have.
    pub fn new(request: &Request) -> Result<Self> {
        let Request { ref scene, variant, arithmetic, .. } = *request;
        arithmetic.check()?;
        let model = &*request.model()?;
        let bodies = bodies::plan(model, variant);
        let solver = request.solver();
        let (all, free) = (model.dofs(), model.free_dofs());
        let idle = bodies.iter().filter(|body| body.idle.is_some()).map(|body| body.free).sum();
        let solved = if variant == Variant::Printed { all } else { free };
        let equations = Equations { all, restrained: all - free, free, solved, idle };
        let ContactModel { coupling, friction, status, .. } = request.contact;
        let plan = |candidates| ContactPlan { coupling, friction, status, candidates };
        let contact = Candidates::find(model).map(plan);
        Ok(Plan {
            scene: scene.name.clone(),
            variant,
            nodes: model.nodes.len(),
            triangles: model.triangles.len(),
            load: model.total_load(),
            nominal_strain: bodies::nominal_strain(model),
            bodies,
            equations,
            contact,
            scalar: arithmetic.scalar,
            solver,
            storage: if request.is_dense() { Storage::Dense } else { Storage::Sparse },
            orphans: model.dropped.len(),
            half: half(scene).map(|half| HalfPlan { at: line_of(model), nodes: half.nodes.len() }),
        })
    }

    /// Whether half of the scene has the same solution. Under the other variants it has not: the
    /// print's search goes along the surface in one direction, and leads on a symmetric scene to an
    /// answer that is not symmetric.
    pub fn half_would_do(&self) -> bool {
        self.half.is_some() && (self.contact.is_none() || self.variant == Variant::Unilateral)
    }
}
