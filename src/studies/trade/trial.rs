//! A trial, and what came of it.

use std::time::Instant;

use super::axis::{Axis, Truth};
use engine::error::Result;
use engine::estimates::{Certainty, certain};
use engine::linear::cost;
use engine::{Request, Solution, solve};
use problem::scene::Derived;

/// Free equations beyond which exact numbers are left out: 20 iterations of so many take 13 s.
const EXACT: usize = 100;

/// Seconds in all beyond which a trial is not run again: what interrupts a run is short beside them.
const PATIENCE: f64 = 0.05;

/// A run with one thing changed.
#[derive(Clone, Debug)]
pub struct Trial {
    /// The value of its axis, in words.
    pub label: String,
    /// What is asked for.
    pub request: Request,
    /// Whether this is where the scene has the axis.
    pub own: bool,
    /// The place of the trial of whose mesh its own was made, and how; nothing where it is the scene's own.
    pub mesh: Option<(usize, Derived)>,
}

/// The free equations up to which exact numbers are tried.
pub(super) fn most_exact(request: &Request) -> usize {
    let growing = request.reading.r5.follows_the_shape();
    cost::most_equations(growing, request.iterations).min(EXACT)
}

/// The runs of a trial: how long each took, and what all of them computed.
pub(super) struct TimedTrial {
    pub(super) trial: Trial,
    /// A time for each run, seconds.
    pub(super) seconds: Vec<f64>,
    pub(super) solution: Result<Solution>,
    /// Whether rounding decides who is in contact; nothing where that was not asked.
    pub(super) certainty: Option<Certainty>,
}

impl TimedTrial {
    /// Runs a trial from the scene alone: the time includes every factorisation.
    pub(super) fn new(trial: Trial, axis: &Axis) -> Self {
        let start = Instant::now();
        let solution = solve(&trial.request, &mut |_| ());
        let seconds = vec![start.elapsed().as_secs_f64()];
        let solution = match axis.truth {
            // What rounding decides shows in all steps.
            Truth::Equilibrium => solution,
            Truth::Last(_) | Truth::Finest | Truth::Own(_) => solution.map(light),
        };
        TimedTrial { trial, seconds, solution, certainty: None }
    }

    /// Runs it once more for the time, unless it failed or took long.
    pub(super) fn repeat(&mut self) {
        if self.solution.is_ok() && self.seconds.iter().sum::<f64>() < PATIENCE {
            let start = Instant::now();
            let _the_same = solve(&self.trial.request, &mut |_| ());
            self.seconds.push(start.elapsed().as_secs_f64());
        }
    }

    /// Asks whether rounding decides who is in contact, where the axis has errors against the equilibrium.
    pub(super) fn judged(self, axis: &Axis) -> Self {
        match self.solution {
            Ok(solution) if axis.truth == Truth::Equilibrium => {
                let (solution, certainty) = certain(solution);
                TimedTrial { solution: Ok(light(solution)), certainty: Some(certainty), ..self }
            }
            solution => TimedTrial { solution, ..self },
        }
    }
}

/// A solution without all steps but the last.
fn light(mut solution: Solution) -> Solution {
    let before = solution.steps.len().saturating_sub(1);
    solution.steps.drain(..before);
    solution
}
