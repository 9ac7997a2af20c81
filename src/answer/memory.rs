//! The memory that a run takes, foreseen: what `plan` prints, and what a large run is refused by.

use schemars::JsonSchema;
use serde::Serialize;

use super::condensation::surface_nodes;
use super::published::bytes_of_iterations;
use super::request::Request;
use crate::problem::model::Model;
use crate::problem::modelling::{Coupling, Friction, Geometry, Variant};

/// Peak memory of the process, bytes.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Bytes {
    pub program: f64,
    /// Mesh, worksheet, results and files.
    pub mesh: f64,
    pub matrices: f64,
    pub iterations: f64,
}

/// The program's pages and the allocator's first ones, bytes.
const PROGRAM: f64 = 14.5e6;
/// Bytes of what is written, and of what is freed and not given back at once, of a triangle; and at
/// most. Without contact, and with it.
const FREED: [[f64; 2]; 2] = [[8.5e3, 90e6], [9.5e3, 90e6]];
/// Bytes of a contact node: pairings, constraints, and what is written.
const CONTACT_NODE: f64 = 6000.0;
/// What to do about a path of the load that does not fit.
pub(super) const FEWER_STEPS: &str = "ask for fewer load steps";

/// The part of the bytes of a path that its steps take before they are written.
pub(super) const HELD: f64 = 0.4;

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
    /// Iterations of a step: 2 on the paper's example; of mortar in the current geometry, which measures
    /// contact again until the shape settles, 4 there and 6 to 16 where a block tilts.
    const ITERATIONS: [f64; 2] = [2.0, 12.0];
    let has_path = model.has_contact() && request.contact.friction != Friction::NONE;
    if !has_path || request.variant != Variant::Unilateral {
        return 0.0;
    }
    let steps = (request.contact.load_steps * model.stages.len()) as f64;
    let settles = request.contact.coupling == Coupling::Mortar
        && request.contact.geometry == Geometry::Current;
    bytes_of_path(model, steps, steps * ITERATIONS[usize::from(settles)])
}

/// Returns the same of the path of a run, or of what is held of the equilibrium beside it, whichever is
/// more.
pub(super) fn bytes_of_paths(request: &Request, model: &Model) -> f64 {
    let beside = HELD * bytes_of_own_path(&request.equilibrium(), model);
    bytes_of_own_path(request, model).max(beside)
}

/// Returns the bytes of what the runs side by side do not share. Contact states of wide surfaces are
/// factored whole, each run's for itself. Of narrower ones the bodies are condensed once; but `tied`
/// and `stepped` keep other nodes than the reference solution, and have factors of their own. What
/// these have more than those of the bodies grows with the square of the number of nodes that are kept.
fn bytes_beside(request: &Request, model: &Model) -> f64 {
    /// Bytes of an equation, of wide surfaces on a path of the load.
    const WHOLE: f64 = 2000.0;
    /// Bytes of a pair of kept nodes: of an equilibrium, and of `tied` and `stepped`.
    const KEPT: [f64; 2] = [100.0, 450.0];
    if !model.has_contact() {
        return 0.0;
    }
    let equations = model.free_dofs() as f64;
    let (surfaces, most) = surface_nodes(model);
    let kept = (surfaces as f64).min(2.0 * equations.sqrt());
    let has_path = request.contact.friction != Friction::NONE;
    match request.variant {
        Variant::Printed => 0.0,
        Variant::Unilateral if has_path && surfaces > most => WHOLE * equations,
        Variant::Unilateral => KEPT[0] * kept * kept,
        Variant::Tied | Variant::Stepped => KEPT[1] * kept * kept,
    }
}

impl Bytes {
    /// The bytes of `solve` without dense matrices, of `request` on its `model`: those of its run, or of
    /// the one beside it that takes the most.
    pub fn of(request: &Request, model: &Model) -> Self {
        let own = Bytes::of_run(request, model);
        if !model.has_contact() {
            return own;
        }
        let beside = [request.equilibrium(), request.reference()].map(|request| {
            let bytes = Bytes::of_run(&request, model);
            Bytes { iterations: HELD * bytes.iterations, ..bytes }
        });
        let more = |a: Bytes, b: Bytes| if b.total() > a.total() { b } else { a };
        beside.into_iter().fold(own, more)
    }

    /// The bytes of a run with what `solve` computes of it. Measured on Hertz's contact, Cook's membrane, strips, the paper's example
    /// and stacked blocks of 29,852 to 961,810 equations.
    fn of_run(request: &Request, model: &Model) -> Self {
        let [m, equations, contact] =
            [model.triangles.len(), model.free_dofs(), model.contact.nodes.len()].map(|n| n as f64);
        let has_path = model.has_contact() && request.contact.friction != Friction::NONE;
        // Bytes of an equation, and of one for each time that the mesh doubled from 1024 of them, as
        // factors grow; and those of the matrices of a triangle, where they are kept.
        let (each_equation, doubled, kept) = match request.variant {
            Variant::Printed => (1000.0, 1300.0, 1440.0),
            Variant::Unilateral if has_path => (2000.0, 150.0, 2500.0),
            Variant::Tied if model.has_contact() => (1000.0, 200.0, 1440.0),
            Variant::Stepped if model.has_contact() => (1000.0, 240.0, 1440.0),
            _ => (2200.0, 70.0, 400.0),
        };
        let doublings = (equations / 1024.0).max(1.0).log2();
        let [each, most] = FREED[usize::from(model.has_contact())];
        Bytes {
            program: PROGRAM,
            mesh: (each * m).min(most) + CONTACT_NODE * contact + kept * m,
            matrices: equations * (each_equation + doubled * doublings)
                + bytes_beside(request, model),
            iterations: match request.variant {
                Variant::Unilateral => bytes_of_own_path(request, model),
                _ => bytes_of_iterations(model, request.iterations),
            },
        }
    }

    /// The sum of all parts, bytes.
    pub fn total(&self) -> f64 {
        self.program + self.mesh + self.matrices + self.iterations
    }
}
