//! Files read and written: output folders, sweeps, other programs.

use super::{Case, check};

#[test]
fn files() {
    check("files", CASES);
}

const CASES: &[Case] = &[Case {
    input: "",
    command: "echo mine > o && plane-contact solve fig1 --out o",
    status: 2,
    contains: &["o is a file"],
    lacks: &["panicked"],
}];
