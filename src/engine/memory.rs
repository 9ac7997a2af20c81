//! The memory that a run takes, foreseen: what `plan` prints, and what a large run is refused by.

use serde::Serialize;

use super::published::bytes_of_iterations;
use super::request::Request;
use problem::model::Model;
use problem::modelling::{Coupling, Friction, Geometry, Variant};

/// Peak memory of the process, bytes.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Bytes {
    /// The program and its libraries.
    pub program: f64,
    /// Mesh, worksheet, results and files.
    pub mesh: f64,
    /// The matrices and their factors.
    pub matrices: f64,
    /// What the solution keeps of its iterations.
    pub iterations: f64,
}

/// Bytes of the program and of what small scenes take.
const PROGRAM: f64 = 30e6;
/// Bytes of an equation: mesh, worksheet, results and files; the factors of the bodies, which the runs
/// beside share; what those have of their own; and LU factors of `Km`.
const MESH: f64 = 1000.0;
const FACTORS: f64 = 2100.0;
const BESIDE: f64 = 1800.0;
const LU: f64 = 6500.0;
/// What to do about a path of the load that does not fit.
pub(super) const FEWER_STEPS: &str = "ask for fewer load steps";

/// The part of the bytes of a path that its steps take before they are written.
pub(super) const UNWRITTEN: f64 = 0.4;

/// Returns the bytes of `steps` steps of the path of the load with `iterations` in all until the result is
/// written, those of the path of half as many included; measured on 13 to 1,111 nodes and up to 230,000
/// iterations, with a third more for addresses that the allocator keeps.
pub(super) fn bytes_of_path(model: &Model, steps: f64, iterations: f64) -> f64 {
    const NODE_OF_STEP: f64 = 130.0;
    const EACH: f64 = 5000.0;
    const CONTACT_NODE: f64 = 330.0;
    let [nodes, contact] = [model.nodes.len(), model.contact.nodes.len()].map(|n| n as f64);
    steps * NODE_OF_STEP * nodes + iterations * (EACH + CONTACT_NODE * contact)
}

/// Returns the bytes of the path of the load that a run follows; 0 without friction, where there is none.
fn bytes_of_own_path(request: &Request, model: &Model) -> f64 {
    let has_path = model.has_contact() && request.contact.friction != Friction::NONE;
    if !has_path || request.variant != Variant::Unilateral {
        return 0.0;
    }
    let steps = (request.contact.load_steps * model.stages.len()) as f64;
    // Of a step: 2 on the paper's example; of mortar in the current geometry, which measures contact
    // again until the shape settles, 4 there and 6 to 16 where a block tilts.
    let iterations = match (request.contact.coupling, request.contact.geometry) {
        (Coupling::Mortar, Geometry::Current) => 12.0,
        (Coupling::Mortar, Geometry::Initial) | (Coupling::Nts, _) => 2.0,
    };
    bytes_of_path(model, steps, steps * iterations)
}

/// Returns the same of the path of a run, or of what is held of the equilibrium beside it, whichever is
/// more.
pub(super) fn bytes_of_paths(request: &Request, model: &Model) -> f64 {
    let beside = UNWRITTEN * bytes_of_own_path(&request.equilibrium(), model);
    bytes_of_own_path(request, model).max(beside)
}

impl Bytes {
    /// An upper estimate of the bytes of `solve` without dense matrices, of `request` on its `model`: up to
    /// twice of what was measured on Hertz's contact, Cook's membrane, stacked blocks and the paper's
    /// example, of 2,153 to 961,810 equations.
    pub fn estimate(request: &Request, model: &Model) -> Self {
        let equations = model.free_dofs() as f64;
        let is_frictionless = request.contact.friction == Friction::NONE;
        let own = match request.variant {
            Variant::Printed => LU,
            Variant::Unilateral if is_frictionless => 0.0,
            Variant::Tied | Variant::Stepped | Variant::Unilateral if model.has_contact() => BESIDE,
            Variant::Tied | Variant::Stepped | Variant::Unilateral => 0.0,
        };
        Bytes {
            program: PROGRAM,
            mesh: MESH * equations,
            matrices: (FACTORS + own) * equations,
            iterations: match request.variant {
                Variant::Unilateral => bytes_of_paths(request, model),
                Variant::Printed | Variant::Tied | Variant::Stepped => {
                    let own = bytes_of_iterations(model, request.iterations);
                    own.max(bytes_of_paths(request, model))
                }
            },
        }
    }

    /// The sum of all parts, bytes.
    pub fn total(&self) -> f64 {
        self.program + self.mesh + self.matrices + self.iterations
    }
}
