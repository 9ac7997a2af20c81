//! What a deck describes: the scene, and how its bodies touch.

use super::equation::Equation;
use crate::choices;
use crate::contact::{Coupling, Outcome, ties};
use crate::error::InputError;
use crate::mirror::Worksheet;
use crate::scene::Scene;

choices! {
    /// How the deck has the bodies touch.
    ContactKind {
        /// `*EQUATION`: eq. (1) as the last iteration has it.
        Equation = "equation",
        /// `*CONTACT PAIR`: node to surface, linear penalty.
        Pair = "pair",
    }
}
choices! {
    /// Friction of a contact pair.
    Friction {
        /// So much that nothing slides while it is pressed.
        Stick = "stick",
        /// None.
        None = "none",
    }
}

/// What a deck describes.
pub struct Model<'a> {
    /// The scene.
    pub scene: &'a Scene,
    /// The paper's arrays.
    pub sheet: &'a Worksheet<f64>,
    /// How the bodies touch.
    pub contact: &'a Contact,
}

/// How the bodies touch.
#[derive(Clone, Debug)]
pub enum Contact {
    /// These equations hold.
    Equations(Vec<Equation>),
    /// `ccx` looks for contact itself.
    Pair(Pair),
}

/// A contact pair.
#[derive(Clone, Copy, Debug)]
pub struct Pair {
    /// Pressure over penetration, stress/length.
    pub penalty: f64,
    /// Friction.
    pub friction: Friction,
}

impl Contact {
    /// The equations that held in the last iteration of a run.
    ///
    /// # Errors
    /// The variant `printed`, which ties nothing.
    pub fn of_last_iteration(outcome: &Outcome) -> Result<Self, InputError> {
        if outcome.variant.coupling() == Coupling::Printed {
            let what = "the variant printed adds stiffness and ties nothing: there are no equations to write";
            return Err(InputError::new(
                "--variant",
                what,
                "choose tied or stepped, or --contact pair",
            ));
        }
        let last = outcome.iterations.last().expect("a run has an iteration");
        Ok(Contact::Equations(Equation::of_ties(
            &outcome.sheet,
            &ties(&outcome.sheet, &last.pairs),
        )))
    }
}

impl Pair {
    /// Penalty over elastic modulus times edge length, unless it is given: deep in what the manual advises (5 to 50 times the
    /// modulus, in mm), for the edges of a contact are some tenths of a mm.
    const STIFFNESS: f64 = 100.0;

    /// A pair with `penalty`, or with one that suits the scene: 100 E / h, E the largest modulus and h the mean length of
    /// the target's edges.
    pub fn new(sheet: &Worksheet<f64>, penalty: Option<f64>, friction: Friction) -> Self {
        let suits = || {
            let modulus = sheet.E.iter().fold(0.0, |m: f64, e| m.max(*e));
            Self::STIFFNESS * modulus / mean_edge(sheet)
        };
        Pair { penalty: penalty.unwrap_or_else(suits), friction }
    }
}

/// Mean length of the target's edges; 1 where there is none.
fn mean_edge(sheet: &Worksheet<f64>) -> f64 {
    let count = sheet.trg.rows();
    if count == 0 {
        return 1.0;
    }
    let length = |edge: &usize| {
        let [a, b] = [6, 7].map(|column| sheet.elem[(*edge, column)]);
        let [dx, dy] = [2, 3].map(|axis| sheet.node[(b, axis)] - sheet.node[(a, axis)]);
        dx.hypot(dy)
    };
    sheet.trg.iter().map(length).sum::<f64>() / count as f64
}
