//! Contact: what each contact node faces on the target, who is in contact, and what the contact surface carries.

mod mortar;
mod nearest;
mod nts;
mod operations;
mod pairing;
mod pairings;
mod pressure;
pub mod status;
mod surface;

pub use nearest::{ClosestPoint, TargetSurface};
pub use operations::Operations;
pub use pairing::Pairing;
pub(super) use pressure::arcs;
pub use pressure::{ContactNode, Traction};
pub use surface::Surfaces;
