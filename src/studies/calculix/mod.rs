//! CalculiX: an input deck that `ccx` runs unchanged, and the displacements that it prints. They are one more
//! field from elsewhere, which [`field`](crate::compare) puts beside a solution.
//!
//! | contact    | in the deck                                       | what is compared         |
//! |------------|---------------------------------------------------|--------------------------|
//! | `equation` | `*EQUATION`: eq. (1) with the weights of a step   | elements and elimination |
//! | `pair`     | `*CONTACT PAIR`, node to surface, linear penalty  | the contact algorithms   |
//!
//! `equation`: what this program and `ccx` solve is the same, so they agree to the seven digits that `ccx`
//! prints. Under a total load that is one deck, the last step's. Under a stepped load the constraints change
//! from increment to increment, and no deck can change its equations: there is one deck for each contact
//! state that came, with the whole load, and the solution is their sum, each with its share of the steps.
//!
//! `pair`: they differ by the penalty, by what each takes for contact, and by the normal: `ccx` pushes along
//! that of the target's face, `unilateral` along one that turns from face to face. On the strand the latter
//! is what is left when the penalty grows: with the faces' normals in `*EQUATION`s `ccx` has 23.5475 MPa in
//! the block, with a pair of penalty 1e9 MPa/mm 23.5474, `unilateral` 24.10.
//!
//! CPS3 is no oracle for plane stress: its triangles share their change of thickness at nodes.
//!
//! Source: G. Dhondt, *CalculiX CrunchiX user's manual*, version 2.20.

pub(crate) mod arguments;
mod contact;
pub mod deck;
mod run;

pub use contact::{Contact, ContactKind, Equation, Pair, Part};
pub use deck::deck;
pub use run::{CalculixRun, check, float, parse, run};

/// The largest von Mises stress of each body of the paper's example under CalculiX's own contact without
/// sliding, MPa; `golden/tables/calculix.md` has it, and the test that makes that table compares them.
pub const RECORDED: [(&str, f64); 2] = [("block", 27.6), ("stamp", 22.3)];
