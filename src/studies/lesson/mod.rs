//! A lesson: a page that executes both listings on a scene, step by step, under each reading that it offers.

pub(crate) mod command;
pub mod language;
pub mod page;
mod repairs;
mod switches;

use std::sync::Arc;

use crate::audit::prices;
use base::error::InputError;
use engine::error::Result;
use engine::{Request, solve};
use mathcad::{Listing, Recorder, Settings};
use nalgebra::DVector;
use paper::door::Call;
use paper::listings::{self, Which, settings};
use paper::mirror::Reading;
use problem::model::Model;
use problem::scene::Scene;

pub use repairs::Repairs;
pub use switches::{Switch, chapter, switches};

/// The statements that a page holds at most, both listings together.
const MOST_SHOWN: usize = 20_000;

/// Checks that a page can show the turns of the contact nodes `nodes`, of all where none is named.
///
/// # Errors
/// A named node is no contact node, or none is named and there are more steps than a page can show.
fn check(scene: &Scene, switch: &Switch, nodes: &[usize]) -> Result<()> {
    let model = switch.model(scene)?;
    let is_contact = |n: &&usize| model.contact.nodes.iter().any(|node| node.number() == **n);
    if let Some(n) = nodes.iter().find(|n| !is_contact(n)) {
        let what = format!("node {n} is no contact node");
        return Err(InputError::new("nodes", what, "name nodes of the contact surface").into());
    }
    if nodes.is_empty() && steps(switch, &model) > MOST_SHOWN {
        let what = format!("the listings take more steps than the {MOST_SHOWN} that a page shows");
        let fix = "choose contact nodes, such as 5 and 6";
        return Err(InputError::new("SCENE", what, fix).into());
    }
    Ok(())
}

/// Counts the statements that both listings execute on the initial shape, up to where one fails.
fn steps(switch: &Switch, model: &Model) -> usize {
    let mut steps = 0;
    let mut recorder = Recorder::new(|_| steps += 1);
    let (settings, Call { sheet, pairs, .. }) = (switch.settings(), Call::without_contact(model));
    let [c_cnt, km] = [Which::CCnt, Which::Km].map(|which| switch.listing(which));
    let pairs = match model.has_contact() {
        true => listings::c_cnt(&c_cnt, &settings, &sheet, &sheet.node, Some(&mut recorder)),
        false => Ok((pairs, vec![])),
    };
    // A listing that fails is shown up to there.
    let _ = pairs.and_then(|(pairs, _)| {
        listings::km(&km, &settings, &sheet, &pairs.k_cnt, Some(&mut recorder))
    });
    drop(recorder);
    steps
}

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
