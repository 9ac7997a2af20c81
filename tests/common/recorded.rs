//! Golden files of many numbers that nothing but a change of the program changes,
//! `golden/recorded/<name>.snap`: words are exact, floats toleranced, each by itself.
#![allow(dead_code, reason = "some test programs record only one of the two kinds")]

use plane_contact::numbers::solve::{Inputs, Solver};
use plane_contact::paper::mirror::NodeTable;
use plane_contact::problem::modelling::{Coupling, Geometry, StatusRule};

use super::golden::assert_golden_by;
use super::tolerances::{RECORDED, RECORDED_BOUND, RECORDED_FLOOR};

// What recorded tests draw from: lists of their own, so that a new member of a closed set shifts no
// draw. A new member gets recorded draws of its own.
pub const RECORDED_NODE_TABLES: [NodeTable; 2] = [NodeTable::Node, NodeTable::NodeN];
pub const RECORDED_COUPLINGS: [Coupling; 2] = [Coupling::Nts, Coupling::Mortar];
pub const RECORDED_GEOMETRIES: [Geometry; 2] = [Geometry::Current, Geometry::Initial];
pub const RECORDED_RULES: [StatusRule; 3] =
    [StatusRule::Signs, StatusRule::Intersection, StatusRule::Projection];
pub const RECORDED_INPUTS: [Inputs; 2] = [Inputs::Binary, Inputs::Decimal];
pub const RECORDED_SOLVERS: [Solver; 3] =
    [Solver::DenseLu, Solver::SparseLu, Solver::SparseCholesky];

/// Compares `text` with `golden/recorded/<name>.snap`; `cargo insta review` (or INSTA_UPDATE=always)
/// changes it. A float is a word with a point in it; behind `~` stands a bound, which may differ more.
#[track_caller]
pub fn assert_recorded(name: &str, text: &str) {
    assert_golden_by("recorded", name, text, same);
}

/// Does the same where no library rounds: every word is exact.
#[track_caller]
pub fn assert_recorded_exactly(name: &str, text: &str) {
    assert_golden_by("recorded", name, text, |recorded, found| {
        recorded.trim_end() == found.trim_end()
    });
}

fn same(recorded: &str, found: &str) -> bool {
    let words = |text: &str| -> Vec<String> {
        text.trim_end()
            .split(|c: char| c.is_whitespace() || "=,()[]{};|".contains(c))
            .map(String::from)
            .collect()
    };
    let (recorded, found) = (words(recorded), words(found));
    let other = recorded.iter().zip(&found).find(|(r, f)| !same_word(r, f));
    other.iter().for_each(|(r, f)| eprintln!("recorded {r:?}, found {f:?}"));
    other.is_none() && recorded.len() == found.len()
}

fn same_word(recorded: &str, found: &str) -> bool {
    let number = |word: &str| word.trim_matches(['~', ';']).parse::<f64>().ok();
    let within = |limit: f64, floor: f64| match (number(recorded), number(found)) {
        (Some(r), Some(f)) => (r - f).abs() <= limit * r.abs() + floor,
        _ => false,
    };
    let is_float = recorded.contains(['.', 'e']);
    recorded == found
        || recorded.starts_with('~') && within(RECORDED_BOUND.limit, 0.0)
        || is_float && within(RECORDED.limit, RECORDED_FLOOR.limit)
}
