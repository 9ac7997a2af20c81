//! What a finding's chapter has before and after: the listings as printed, and with the repair
//! (`listings/repairs/`); or why no edit of a listing repairs it.

use super::{Model, Switch, Which};
use crate::audit::findings::Finding;
use mathcad::Edit;

const PER_NODE: &str = include_str!("../../../listings/readings/R3-per-node.edit");
const C14: &str = include_str!("../../../listings/repairs/C14.edit");
const K1: &str = include_str!("../../../listings/repairs/K1.edit");

const REPAIRS: [(&str, Which, &str); 20] = [
    ("C1", Which::CCnt, C14),
    ("C2", Which::CCnt, include_str!("../../../listings/repairs/C2.edit")),
    ("C3", Which::CCnt, include_str!("../../../listings/repairs/C3.edit")),
    ("C4", Which::CCnt, include_str!("../../../listings/repairs/C4.edit")),
    ("C5", Which::CCnt, include_str!("../../../listings/repairs/C5.edit")),
    ("C7", Which::Km, K1),
    ("C8", Which::CCnt, include_str!("../../../listings/repairs/C8.edit")),
    ("C9", Which::CCnt, include_str!("../../../listings/repairs/C9.edit")),
    ("C10", Which::CCnt, include_str!("../../../listings/repairs/C10.edit")),
    ("C11", Which::CCnt, include_str!("../../../listings/repairs/C11.edit")),
    ("C12", Which::CCnt, include_str!("../../../listings/repairs/C12.edit")),
    ("C13", Which::Km, K1),
    ("C14", Which::CCnt, C14),
    ("C15", Which::CCnt, include_str!("../../../listings/repairs/C15.edit")),
    ("K1", Which::Km, K1),
    ("K2", Which::Km, K1),
    ("K3", Which::Km, include_str!("../../../listings/repairs/K3.edit")),
    ("K4", Which::Km, include_str!("../../../listings/repairs/K4.edit")),
    ("K7", Which::Km, PER_NODE),
    ("K8", Which::CCnt, include_str!("../../../listings/repairs/K8.edit")),
];

/// Why a lesson, which executes the first call of each listing, cannot show a repair.
const REASONS: [(&str, &str); 4] = [
    (
        "C6",
        "the page shows the first call, in which nothing has moved and both tables are the same; \
         solve findings/C6 --reading R5=node_n has all iterations with weights within [0, 1]",
    ),
    (
        "K5",
        "the iterations stand around the listings, and no listing prints them; solve findings/K5 \
         --variant stepped, eq. (1) on increments, does not cycle",
    ),
    (
        "K6",
        "what is restrained is the scene's choice, not a listing's; solve findings/K6, whose \
         stamp's axis is held, runs",
    ),
    (
        "K9",
        "no line of a listing looks at a contact force; solve findings/K9 --variant unilateral \
         releases the node",
    ),
];

/// Returns what a finding's chapter runs: the listings as printed, then repaired.
///
/// # Errors
/// Why no edit of a listing is the repair.
pub fn repair(finding: &Finding) -> Result<[Switch; 2], &'static str> {
    let Some((_, which, edit)) = REPAIRS.iter().find(|(id, ..)| *id == finding.id) else {
        let reason = REASONS.iter().find(|(id, _)| *id == finding.id);
        return Err(reason.expect("each finding has a repair or a reason").1);
    };
    let before = before(finding.id);
    let edit = Edit::parse(edit).expect("the repairs are sound");
    let listing = edit.apply(&which.under(&Default::default())).expect("the repairs fit");
    let about = format!("{}: {}", which.name(), finding.repair);
    let after = Switch {
        name: "repaired".into(),
        about,
        edited: Some((*which, listing)),
        ..before.clone()
    };
    Ok([before, after])
}

/// Returns the listings as printed, where the finding shows: some need more than its scene.
fn before(id: &str) -> Switch {
    let printed = Switch::as_printed();
    let under = |what: &str| format!("{}, {what}", printed.about);
    match id {
        "C1" => {
            Switch { about: under("each target edge turned round"), change: turn_target, ..printed }
        }
        "C10" => Switch {
            about: under("the operands of ∧ from left to right (R4)"),
            reading: "R4=left-to-right".parse().expect("a reading"),
            ..printed
        },
        "K4" => Switch { about: under("a node more, of no triangle"), change: orphan, ..printed },
        _ => printed,
    }
}

fn turn_target(model: &mut Model) {
    for edge in &model.contact.target {
        model.edges[edge.index()].nodes.reverse();
    }
}

fn orphan(model: &mut Model) {
    model.nodes.push([1.0, 0.0]);
    model.restrained.extend([false; 2]);
}
