//! Contact: what each contact node faces on the target, who is in contact, and what the contact
//! surface carries.

mod mortar;
mod nts;
mod pairing;
mod pairings;
mod pressure;
pub mod search;
pub mod status;
mod surface;

pub use pairing::Pairing;
pub(super) use pressure::arcs;
pub use pressure::{ContactNode, Traction};
pub use surface::Surfaces;
