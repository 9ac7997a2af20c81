//! What the iterations that a lesson plays are compared with.

use std::sync::Arc;

use nalgebra::DVector;

use crate::audit::prices;
use engine::{Request, solve};
use problem::model::Model;
use problem::scene::Scene;

/// The most nodes of a scene whose iterations the page makes, in some tenths of a second.
pub const MOST_SOLVED: usize = 100;

/// Returns the displacements of the reference solution of a scene whose model a run may have changed, without
/// friction, node to segment, in the initial geometry, by degree of freedom, length; nothing where there is
/// none, or no page iterates the scene.
pub fn reference(scene: &Scene, model: &Arc<Model>) -> Option<DVector<f64>> {
    let mut scene = scene.clone();
    scene.model = Arc::clone(model);
    if !model.has_contact() || model.nodes.len() > MOST_SOLVED {
        return None;
    }
    // Where there is none the page says what it takes: contact that holds the scene, and a load.
    let request = prices::reference(&Request::new(&scene));
    Some(solve(&request, &mut |_| ()).ok()?.u)
}
