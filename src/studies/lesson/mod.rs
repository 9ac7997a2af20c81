//! A lesson: both listings executed on a small scene, every step kept, under each reading that the
//! lesson offers.

pub(crate) mod command;
mod iterations;
pub mod language;
pub mod page;
mod repairs;
mod switches;
mod trace;

use std::collections::BTreeSet;
use std::sync::Arc;

use base::error::InputError;
use engine::Request;
use engine::error::Result;
use mathcad::{Listing, Settings};
use paper::door::Call;
use paper::listings::{Which, settings};
use paper::mirror::Reading;
use problem::model::{Model, NodeId};
use problem::scene::Scene;
use trace::trace;

pub use iterations::{MOST_SOLVED, reference};
pub use repairs::Repairs;
pub use switches::{Switch, chapter, switches};
pub use trace::{Product, Step, Trace};

/// The statements that a page holds at most, both listings together.
const MOST_SHOWN: usize = 20_000;

/// Both listings on a scene under a switch.
pub struct Run {
    /// What is changed for the run.
    pub switch: Switch,
    /// The model under the switch.
    pub model: Arc<Model>,
    /// `c_cnt` at the initial shape; nothing without contact.
    pub c_cnt: Option<Program>,
    /// `Km` on the pairs that `c_cnt` found; nothing where `c_cnt` stopped.
    pub km: Option<Program>,
}

/// A listing and what it did.
pub struct Program {
    /// The listing, as it was executed.
    pub listing: Listing,
    /// What was executed.
    pub trace: Trace,
}

/// Executes both listings on a scene under a switch. Of `nodes`, where some are named, the turns of
/// `c_cnt` over these contact nodes are kept and those of `Km` over the triangles that have one of
/// them; else every step is.
///
/// # Errors
/// A named node is no contact node, or there are more steps than a page can show.
pub fn run(scene: &Scene, switch: Switch, nodes: &[usize]) -> Result<Run> {
    let model = switch.model(scene)?;
    check(&model, nodes)?;
    let kept = Kept::from_nodes(&model, nodes);
    let worksheet = switch.settings();
    let executed =
        |which, call: &Call| kept.program(which, switch.listing(which), &worksheet, call);
    let call = Call::without_contact(&model);
    let c_cnt = model.has_contact().then(|| executed(Which::CCnt, &call));
    let call = match c_cnt.as_ref().map(|c_cnt| &c_cnt.trace.result) {
        Some(Ok(Product::Pairs(pairs))) => Some(Call { pairs: pairs.clone(), ..call }),
        Some(_) => None,
        None => Some(call),
    };
    let km = call.map(|call| executed(Which::Km, &call));
    let programs = [&c_cnt, &km].into_iter().flatten();
    if programs.map(|program| program.trace.steps.len()).sum::<usize>() > MOST_SHOWN {
        let what = format!("the listings take more steps than the {MOST_SHOWN} that a page shows");
        let fix = "choose contact nodes, such as 5 and 6";
        return Err(InputError::new("SCENE", what, fix).into());
    }
    Ok(Run { switch, model, c_cnt, km })
}

fn check(model: &Model, nodes: &[usize]) -> Result<(), InputError> {
    let is_contact = |n: &&usize| model.contact.nodes.iter().any(|node| node.number() == **n);
    match nodes.iter().find(|n| !is_contact(n)) {
        Some(n) => {
            let what = format!("node {n} is no contact node");
            Err(InputError::new("nodes", what, "name nodes of the contact surface"))
        }
        None => Ok(()),
    }
}

/// The turns of each listing that a lesson keeps.
struct Kept {
    /// The places in `cnt`, from 1, and the triangles' numbers.
    turns: [BTreeSet<usize>; 2],
    /// Whether the steps outside the turns are kept too.
    outside: bool,
}

impl Kept {
    fn from_nodes(model: &Model, nodes: &[usize]) -> Self {
        let chosen = |node: &NodeId| nodes.is_empty() || nodes.contains(&node.number());
        let places = model.contact.nodes.iter().zip(1..).filter(|(node, _)| chosen(node));
        let triangles =
            model.triangle_ids().filter(|id| model.triangle(*id).nodes.iter().any(chosen));
        let turns =
            [places.map(|(_, place)| place).collect(), triangles.map(|id| id.number()).collect()];
        Kept { turns, outside: nodes.is_empty() }
    }

    fn program(&self, which: Which, listing: Listing, settings: &Settings, call: &Call) -> Program {
        let turns = &self.turns[usize::from(which == Which::Km)];
        let wanted = |turn: Option<usize>| turn.map_or(self.outside, |turn| turns.contains(&turn));
        let trace = trace(which, &listing, settings, call, wanted, MOST_SHOWN + 1);
        Program { listing, trace }
    }
}
