//! CalculiX beside this program: an input deck that `ccx` runs unchanged, and its results read back.
//!
//! ```text
//!  Scene, Outcome --model--> Model --deck--> job.inp --ccx--> job.dat --results--> Fields
//!         |                    |                                                     |
//!         +---- reference ---- Fields, by this program ------------ comparison ------+
//! ```
//!
//! | contact    | in the deck                                            | what it is compared with                              |
//! |------------|--------------------------------------------------------|-------------------------------------------------------|
//! | `equation` | `*EQUATION`: eq. (1) as the last iteration has it      | one linear solve here: those ties, the whole load     |
//! | `pair`     | `*CONTACT PAIR`, node to surface, linear penalty       | the variant's own result                              |
//!
//! `equation` compares the finite elements and the elimination; `pair` compares the contact algorithms, and differs by the
//! penalty, by what the two take for contact, and by what they let slide.
//!
//! Source: G. Dhondt, *CalculiX CrunchiX user's manual*, version 2.20.

mod comparison;
mod deck;
mod equation;
mod model;
mod number;
mod reference;
mod results;
mod run;

pub use comparison::{BodyStress, Comparison, Difference, Largest};
pub use deck::deck;
pub use equation::{Equation, Term};
pub use model::{Contact, ContactKind, Friction, Model, Pair};
pub use reference::{Fields, reference};
pub use results::parse;
pub use run::{Ran, run};
