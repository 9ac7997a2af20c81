//! Meshes, scenes and every reader of JSON.

use super::{Case, check};

#[test]
fn meshes() {
    check("meshes", CASES);
}

const CASES: &[Case] = &[];
