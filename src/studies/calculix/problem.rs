//! What a deck describes: the scene, and how its bodies touch.

use super::equation::Equation;
use crate::answer::contact::Outcome;
use crate::choices;
use crate::error::InputError;
use crate::paper::mirror::{Schedule, Worksheet};
use crate::problem::modelling::{Friction, Variant};
use crate::problem::scene::Scene;

choices! {
    /// How the deck has the bodies touch.
    ContactKind {
        /// `*EQUATION`: eq. (1) as an iteration has it.
        Equation = "equation",
        /// `*CONTACT PAIR`: node to surface, linear penalty.
        Pair = "pair",
    }
}
/// What a deck describes.
pub struct Problem<'a> {
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
        if outcome.variant == Variant::Printed {
            let what = "the variant printed adds stiffness and ties nothing: there are no equations to write";
            let mend = "choose tied, stepped or unilateral, or --contact pair";
            return Err(InputError::new("--variant", what, mend));
        }
        let carried = match outcome.schedule {
            Schedule::Total => outcome.iterations.len() - 1..outcome.iterations.len(),
            Schedule::Stepped => 0..outcome.iterations.len(),
        };
        let share = 1.0 / carried.len() as f64;
        let mut states: Vec<(Vec<Equation>, f64)> = Vec::new();
        for iteration in &outcome.iterations[carried] {
            let equations = Equation::of_iteration(&outcome.sheet, iteration);
            let met = states.iter().position(|(other, _)| *other == equations);
            let before = met.map_or(0.0, |k| states.remove(k).1);
            states.push((equations, before + share));
        }
        let part = |(equations, share)| Part { contact: Contact::Equations(equations), share };
        Ok(states.into_iter().map(part).collect())
    }
}

impl Pair {
    /// Penalty times edge length over elastic modulus, unless a penalty is given: the manual advises 5 to 50 times the modulus,
    /// in mm. With more, ccx takes many more iterations, and may settle on another contact zone.
    const STIFFNESS: f64 = 10.0;

    /// A pair with `penalty`, or with one that suits the scene: 10 E / h, E the largest modulus and h the mean length of
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
