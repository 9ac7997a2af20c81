//! Sentences, labels and answers of solvers.

use super::{Case, check};

#[test]
fn sentences() {
    check("sentences", CASES);
}

const CASES: &[Case] = &[];
