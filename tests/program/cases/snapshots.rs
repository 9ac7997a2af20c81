//! Snapshots: record, verify, explain, diff, accept.

use super::{Case, check};

#[test]
fn snapshots() {
    check("snapshots", CASES);
}

const CASES: &[Case] = &[];
