//! Contact: the target that each contact node faces, the nodes in contact, and their traction.
//!
//! | question | where |
//! |---|---|
//! | what does a contact node face, and how far is it? | `pairing.rs`: by `nts.rs` with `outline.rs`, or by `mortar.rs` |
//! | is it in contact under `printed`, `tied`, `stepped`? | `c_cnt`, or [`status_rules`], by the rule that is asked for |
//! | is it open, does it stick or slide under `unilateral`? | `../unilateral/mod.rs` |
//! | what is its force, and do its restraints leave it undetermined? | `forces.rs`, `direct` and `by_target` |
//! | what is its traction? | `pressure.rs` |
//!
//! A gap is < 0 inside the target. The listing's `yt`, and what [`status_rules`] gives in its place, is of the
//! opposite sign: > 0 where the target's line is above the node.

mod forces;
mod initial;
mod mortar;
mod nts;
mod order;
mod outline;
mod overlap;
mod pairing;
mod pressure;
pub mod search;
pub mod status_rules;
mod surface;
pub use crate::quantities::ContactNode;
pub(super) use forces::{ContactForce, add, contact_forces, load_of};
pub use initial::InitialGaps;
pub use order::{along, hidden, oddity, turned};
pub use overlap::{InsideNode, Watched};
pub use pairing::{Pairing, STEEP, Sense, Status};
pub(crate) use pressure::ContactPlace;
pub(super) use pressure::arcs;
pub(super) use pressure::rounding;
pub use pressure::{NodeEnd, ROUNDING_OF_A_FORCE, pulling, reactions};
pub use surface::Surfaces;

use problem::modelling::Coupling;

impl Surfaces {
    /// Returns what each entry of the contact surface faces in a shape, given as the coordinates of
    /// each node, length. None for a node that faces no edge, and for a node's second entry.
    pub fn pairings(&self, coupling: Coupling, shape: &[[f64; 2]]) -> Vec<Option<Pairing>> {
        match coupling {
            Coupling::Nts => nts::pairings(self, shape),
            Coupling::Mortar => self.mortar(shape),
        }
    }
}
