//! Repairs of findings that are an edit of a listing's text (`listings/repairs/`).

use super::{Switch, Which};
use crate::paper::mathcad::Edit;
use crate::studies::audit::findings::Finding;

const REPAIRS: [(&str, &str); 9] = [
    ("C3", include_str!("../../../listings/repairs/C3.edit")),
    ("C4", include_str!("../../../listings/repairs/C4.edit")),
    ("C5", include_str!("../../../listings/repairs/C5.edit")),
    ("C11", include_str!("../../../listings/repairs/C11.edit")),
    ("C12", include_str!("../../../listings/repairs/C12.edit")),
    ("C14", include_str!("../../../listings/repairs/C14.edit")),
    ("C15", include_str!("../../../listings/repairs/C15.edit")),
    ("K3", include_str!("../../../listings/repairs/K3.edit")),
    ("K7", include_str!("../../../listings/readings/R3-per-node.edit")),
];

/// Returns the switch that repairs a finding; None where its repair is no edit of a listing.
pub fn repair(finding: &Finding) -> Option<Switch> {
    let (_, edit) = REPAIRS.iter().find(|(id, _)| *id == finding.id)?;
    let which: Which = finding.listing.parse().expect("a repair is of a listing");
    let edit = Edit::parse(edit).expect("the repairs are sound");
    let listing = edit.apply(&which.under(&Default::default())).expect("the repairs fit");
    let about = format!("{}: {}", which.name(), finding.repair);
    Some(Switch::edited("repaired", about, which, listing))
}
