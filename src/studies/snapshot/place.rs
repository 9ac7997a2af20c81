//! The place of an entry in the order of computation, by its name.
//!
//! ```text
//!  cnt, trg, ... | iteration 1 ct, yt, dy, ... | iteration 2 ct, ... | exit status, u, stress, ...
//!    worksheet              iterations                                        end
//! ```

/// What is recorded before the first iteration.
const WORKSHEET: &[&str] = &["cnt", "trg", "c_tll", "restrained", "load"];

/// What is recorded of an iteration, in the order in which it is computed.
const ITERATION: &[&str] =
    &["load", "ct", "yt", "dy", "statuses", "in contact", "mates", "weights", "MJS", "u", "cycle"];

/// The facts that are recorded at the end.
const END_FACTS: &[&str] = &["exit status", "failure", "iterations"];

/// The numbers that are recorded at the end.
pub const FIELDS: &[&str] = &[
    "u",
    "stress",
    "largest von Mises stress",
    "largest von Mises strain",
    "reactions",
    "gap",
    "pressure",
];

/// The facts that are recorded with some of these alone.
pub const FACTS: &[&str] = &["cnt", "trg", "restrained", "exit status", "failure"];

/// A place in the order of computation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Place {
    /// The iteration: 0 before the first, the largest number after the last.
    pub iteration: usize,
    /// The place among the entries of the iteration.
    rank: usize,
}

/// Returns the name of an entry of iteration `k`.
pub fn of_iteration(k: usize, quantity: &str) -> String {
    format!("iteration {k} {quantity}")
}

/// Returns the iteration and the quantity of an entry of an iteration.
pub fn iteration(entry: &str) -> Option<(usize, &str)> {
    let (k, quantity) = entry.strip_prefix("iteration ")?.split_once(' ')?;
    Some((k.parse().ok()?, quantity))
}

/// Returns the place of an entry; one of an unknown name comes last.
pub fn place(entry: &str) -> Place {
    let rank = |list: &[&str], name: &str| {
        list.iter().position(|other| *other == name).unwrap_or(list.len())
    };
    if let Some((iteration, quantity)) = iteration(entry) {
        return Place { iteration, rank: rank(ITERATION, quantity) };
    }
    match rank(WORKSHEET, entry) {
        rank if rank < WORKSHEET.len() => Place { iteration: 0, rank },
        _ => Place { iteration: usize::MAX, rank: rank(&[END_FACTS, FIELDS].concat(), entry) },
    }
}
