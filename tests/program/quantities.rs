//! The quantities of a result, each declared once: `golden/quantities.md`, for users.

use std::path::Path;

use plane_contact::output::quantities::page;

use crate::common::golden_file::assert_file;

#[test]
fn the_page_of_quantities_is_made_of_their_declarations() {
    assert_file(&Path::new(env!("CARGO_MANIFEST_DIR")).join("golden/quantities.md"), &page());
}
