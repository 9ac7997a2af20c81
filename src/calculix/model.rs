//! What a deck describes: the scene, and how its bodies touch.

use super::equation::Equation;
use crate::choices;
use crate::contact::{Coupling, Iteration, Outcome, ties};
use crate::error::InputError;
use crate::mirror::{Schedule, Worksheet};
use crate::scene::Scene;

choices! {
    /// How the deck has the bodies touch.
    ContactKind {
        /// `*EQUATION`: eq. (1) as an iteration has it.
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

/// One of the problems whose sum is a run: the whole load on one contact state.
pub struct Part {
    /// How the bodies touch.
    pub contact: Contact,
    /// Its share of the run.
    pub share: f64,
}

impl Contact {
    /// The problems whose sum a run is. A run with total load is its last iteration. A run with stepped load is the sum of its
    /// increments: each contact state that it met, with the whole load, times the share of the iterations that it stood. The last
    /// iteration's state comes last.
    ///
    /// # Errors
    /// The variant `printed`, which ties nothing.
    pub fn parts(outcome: &Outcome) -> Result<Vec<Part>, InputError> {
        if outcome.variant.coupling() == Coupling::Printed {
            let what = "the variant printed adds stiffness and ties nothing: there are no equations to write";
            let mend = "choose tied or stepped, or --contact pair";
            return Err(InputError::new("--variant", what, mend));
        }
        let carried = match outcome.schedule {
            Schedule::Total => outcome.iterations.len() - 1..outcome.iterations.len(),
            Schedule::Stepped => 0..outcome.iterations.len(),
        };
        let share = 1.0 / carried.len() as f64;
        let mut states: Vec<(Vec<Equation>, f64)> = Vec::new();
        for iteration in &outcome.iterations[carried] {
            let equations = equations(outcome, iteration);
            let met = states.iter().position(|(other, _)| *other == equations);
            let before = met.map_or(0.0, |k| states.remove(k).1);
            states.push((equations, before + share));
        }
        let part = |(equations, share)| Part { contact: Contact::Equations(equations), share };
        Ok(states.into_iter().map(part).collect())
    }
}

/// What held in an iteration.
fn equations(outcome: &Outcome, iteration: &Iteration) -> Vec<Equation> {
    Equation::of_ties(&outcome.sheet, &ties(&outcome.sheet, &iteration.pairs))
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
