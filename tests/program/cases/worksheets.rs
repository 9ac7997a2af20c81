//! Worksheets and programs in the notation of the listings.

use super::{Case, check};

#[test]
fn worksheets() {
    check("worksheets", CASES);
}

const CASES: &[Case] = &[];
