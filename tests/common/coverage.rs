//! What runs of a listing go through.

use std::collections::BTreeMap;

use plane_contact::mathcad::observe::{Operand, Place};
use plane_contact::mathcad::{Line, Observer};

/// Counts what a run, or several, went through.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Coverage {
    /// How often each line was executed, by the printed number. A line that was never reached is
    /// not there.
    pub lines: BTreeMap<usize, u64>,
    /// The statements' conditions, by the printed number of their line.
    pub conditions: BTreeMap<usize, ConditionCoverage>,
    /// The operands of each `∧`, by the printed number of its line and its place there.
    pub conjunctions: BTreeMap<(usize, usize), Vec<OperandCoverage>>,
}

/// How often a condition was true, and how often it was not.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ConditionCoverage {
    pub text: String,
    pub held: u64,
    pub failed: u64,
}

/// How often an operand of an `∧` decided: how often the other value would have turned the `∧`.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct OperandCoverage {
    pub text: String,
    /// How often it was true among operands that all were.
    pub admitted: u64,
    pub refused: u64,
}

impl OperandCoverage {
    pub fn decisive(&self) -> bool {
        self.admitted > 0 || self.refused > 0
    }

    /// Returns whether the operand decided for either value (modified condition/decision coverage).
    pub fn decided_both_ways(&self) -> bool {
        self.admitted > 0 && self.refused > 0
    }
}

impl Observer for Coverage {
    fn statement(&mut self, line: &Line) {
        *self.lines.entry(line.printed).or_default() += 1;
    }

    fn condition(&mut self, place: Place<'_>, held: bool) {
        let condition = self.conditions.entry(place.line.printed).or_default();
        condition.text = place.text.into();
        *(if held { &mut condition.held } else { &mut condition.failed }) += 1;
    }

    fn conjunction(&mut self, place: Place<'_>, operands: &[Operand<'_>]) {
        let known =
            self.conjunctions.entry((place.line.printed, place.start)).or_insert_with(|| {
                operands
                    .iter()
                    .map(|operand| OperandCoverage {
                        text: operand.text.into(),
                        ..Default::default()
                    })
                    .collect()
            });
        let admitting = operands.iter().filter(|operand| operand.held == Some(true)).count();
        for (known, operand) in known.iter_mut().zip(operands) {
            match operand.held {
                Some(true) if admitting == operands.len() => known.admitted += 1,
                Some(false) if admitting == operands.len() - 1 => known.refused += 1,
                _ => {}
            }
        }
    }
}
