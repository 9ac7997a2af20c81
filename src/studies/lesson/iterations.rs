//! The iterations of a scene, as a lesson plays them, and the reference solution beside them.

use std::collections::HashSet;
use std::sync::Arc;

use nalgebra::DVector;

use crate::audit::prices::reference;
use engine::{Request, Solution, Stiffness, over, solve};
use paper::corrected::STEPS;
use problem::model::{Model, NodeId};
use problem::modelling::{ContactModel, Coupling, StatusRule, Variant};
use problem::scene::Scene;

/// The most nodes of a scene whose iterations the page makes itself, in some tenths of a second.
pub(super) const MOST_SOLVED: usize = 100;

/// What a page needs to show the iterations of a scene.
pub struct Iterations {
    /// The displacements of the reference solution, without friction, node to segment, in the initial geometry, by degree
    /// of freedom, length; None where there is none.
    pub reference: Option<DVector<f64>>,
    /// The iterations of each variant of the paper; None where the page makes them.
    pub recorded: Option<Vec<Recorded>>,
}

/// The iterations of a variant.
pub struct Recorded {
    /// The variant.
    pub variant: Variant,
    /// The state after each iteration; empty where the run failed.
    pub states: Vec<State>,
    /// Why the run failed.
    pub failure: Option<String>,
}

/// The state after an iteration.
pub struct State {
    /// The contact nodes that the iteration found in contact, each once.
    pub in_contact: Vec<NodeId>,
    /// The displacements, by degree of freedom, length.
    pub u: DVector<f64>,
    /// The energy norm of the difference from the reference solution over that solution's; None without one.
    pub error: Option<f64>,
}

impl Iterations {
    /// Returns the iterations of a scene whose model a run may have changed.
    pub fn new(scene: &Scene, model: &Arc<Model>) -> Self {
        let mut scene = scene.clone();
        scene.model = Arc::clone(model);
        let reference = scene.model.has_contact().then(|| reference(&Request::new(&scene)));
        // Where there is none the page says what it takes: contact that holds the scene, and a load.
        let reference = reference.and_then(|request| solve(&request, &mut |_| ()).ok());
        let reference = reference.map(|solution| solution.u);
        let is_recorded = scene.model.nodes.len() > MOST_SOLVED;
        let recorded = is_recorded.then(|| {
            let recorded = |v: &Variant| recorded(&scene, *v, reference.as_ref());
            Variant::OF_THE_PAPER.iter().map(recorded).collect()
        });
        Iterations { reference, recorded }
    }
}

/// Returns the iterations of a variant of the paper with the print's own contact model.
pub fn recorded(scene: &Scene, variant: Variant, reference: Option<&DVector<f64>>) -> Recorded {
    let (coupling, status) = (Coupling::Nts, StatusRule::Signs);
    let contact = ContactModel { coupling, status, ..scene.contact };
    let mut request = Request::new(scene).variant(variant).contact(contact);
    request.iterations = STEPS;
    match solve(&request, &mut |_| ()) {
        Ok(solution) => Recorded { variant, states: states(&solution, reference), failure: None },
        Err(why) => Recorded { variant, states: vec![], failure: Some(why.to_string()) },
    }
}

/// Returns the states of a run: an iteration's displacements are those from which the next starts.
fn states(solution: &Solution, reference: Option<&DVector<f64>>) -> Vec<State> {
    let Solution { model, steps, .. } = solution;
    let stiffness = Stiffness::new(model, |x| x);
    let from = |shape: &[[f64; 2]]| {
        let moved = shape.iter().zip(&model.nodes);
        DVector::from_vec(moved.flat_map(|(x, at)| [0, 1].map(|d| x[d] - at[d])).collect())
    };
    let after = steps.iter().skip(1).map(|next| from(&next.shape));
    let error = |u: &DVector<f64>, truth: &DVector<f64>| {
        over(stiffness.energy_norm(&(u - truth)), stiffness.energy_norm(truth))
    };
    let state = |(step, u): (&engine::Step, DVector<f64>)| {
        let mut in_contact = step.contact_set(model);
        let mut seen = HashSet::new();
        in_contact.retain(|node| seen.insert(*node));
        State { in_contact, error: reference.map(|truth| error(&u, truth)), u }
    };
    steps.iter().zip(after.chain([solution.u.clone()])).map(state).collect()
}
