//! The stiffness condensed to the nodes that contact can bind. The bodies are factored once; each
//! contact state Tᵀ K T is solved on these nodes alone.
//!
//! ```text
//!   K --Factored--> S on the surfaces --Condensation--> S on the kept nodes --T of a state--> Tᵀ S T, dense
//! ```
//!
//! Kept are all nodes of small surfaces, else those that a state binds and their neighbours; when a
//! state binds others, the bodies are condensed anew (`bodies`): small ones from their surfaces, for which
//! they are factored once, large ones from the whole. Where none of it can be done or trusted, a state has
//! no such factors: its whole matrix is to be factored.
//!
//! The search for a contact state goes on with S alone (`OnKept`), where it can be in terms of gaps and
//! slips, of which a state holds some: then all else is eliminated once (`gaps`). In the current geometry
//! a state differs little from the last one, whose factors serve it, with refinement. Where every digit
//! counts, the factors of Tᵀ S T serve to refine the solution of the whole equations (`Bound`).

mod bodies;
mod factored;
mod gaps;
mod refinement;
mod rows;
mod schur;
mod state;

pub use bodies::{Bodies, kept_equations};
pub use factored::{Factored, few_surfaces};
pub use gaps::Gaps;
pub use refinement::refine;
pub(crate) use refinement::refined;
pub use schur::{Condensation, Eliminated};
pub use state::{Bound, Inside, OnKept};
