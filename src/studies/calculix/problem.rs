//! What a deck describes: the scene, and how its bodies touch.

use super::equation::Equation;
use crate::answer::Solution;
use crate::choices;
use crate::error::InputError;
use crate::paper::mirror::Schedule;
use crate::problem::model::{Edge, Model};
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

/// The problem that a deck describes.
pub struct Problem<'a> {
    /// The scene, which gives the title.
    pub scene: &'a Scene,
    /// The scene's model under the reading that was asked for.
    pub model: &'a Model,
    /// How the bodies touch in the deck.
    pub contact: &'a Contact,
}

/// How the bodies touch.
#[derive(Clone, Debug)]
pub enum Contact {
    /// By these equations, which `ccx` satisfies.
    Equations(Vec<Equation>),
    /// `ccx` looks for contact itself.
    Pair(Pair),
}

/// A contact pair of `ccx`, node to surface.
#[derive(Clone, Copy, Debug)]
pub struct Pair {
    /// Pressure over penetration, stress/length.
    pub penalty: f64,
    /// Whether nodes in contact slide or stick.
    pub friction: Friction,
}

/// One of the problems whose sum is a run: the whole load on one contact state.
pub struct Part {
    /// How the bodies touch in it.
    pub contact: Contact,
    /// Its share of the run, from 0 to 1.
    pub share: f64,
}

impl Contact {
    /// The problems whose sum a solution is. With total load that is its last step. With stepped
    /// load it is the sum of the increments: each contact state that came, with the whole load,
    /// times its share of the steps. The last step's state comes last.
    ///
    /// # Errors
    /// The variant is `printed`, which constrains nothing.
    pub fn parts(solution: &Solution) -> Result<Vec<Part>, InputError> {
        if solution.request.variant == Variant::Printed {
            let what = "the variant printed adds stiffness and ties nothing: there are no \
                        equations to write";
            let fix = "choose tied, stepped or unilateral, or --contact pair";
            return Err(InputError::new("--variant", what, fix));
        }
        let steps = solution.steps.len();
        let carried = match solution.request.schedule() {
            Schedule::Total => steps - 1..steps,
            Schedule::Stepped => 0..steps,
        };
        let share = 1.0 / carried.len() as f64;
        let mut states: Vec<(Vec<Equation>, f64)> = Vec::new();
        for step in &solution.steps[carried] {
            let equations = Equation::of_step(&solution.model, step);
            let same = states.iter().position(|(other, _)| *other == equations);
            let before = same.map_or(0.0, |k| states.remove(k).1);
            states.push((equations, before + share));
        }
        let part = |(equations, share)| Part { contact: Contact::Equations(equations), share };
        Ok(states.into_iter().map(part).collect())
    }
}

impl Pair {
    /// Penalty times edge length over elastic modulus, unless a penalty is given: the manual
    /// advises 5 to 50 times the modulus, in mm. With more, ccx takes many more iterations, and may
    /// settle on another contact zone.
    const STIFFNESS: f64 = 10.0;

    /// A pair with `penalty`, or with one that suits the model: 10 E / h, E the largest modulus and
    /// h the mean length of the target's edges.
    pub fn new(model: &Model, penalty: Option<f64>, friction: Friction) -> Self {
        let suits = || {
            let moduli = model.triangles.iter().map(|triangle| triangle.material.e);
            Self::STIFFNESS * moduli.fold(0.0, f64::max) / mean_edge(model)
        };
        Pair { penalty: penalty.unwrap_or_else(suits), friction }
    }
}

/// Mean length of the target's edges; 1 where there is none.
fn mean_edge(model: &Model) -> f64 {
    let length = |edge: &Edge| {
        let [[ax, ay], [bx, by]] = edge.nodes.map(|node| model.at(node));
        (bx - ax).hypot(by - ay)
    };
    match model.contact.target.len() {
        0 => 1.0,
        count => model.target_edges().map(length).sum::<f64>() / count as f64,
    }
}
