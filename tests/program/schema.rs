//! The JSON Schema of a scene file.

use std::path::Path;

use plane_contact::problem::scene::schema;

use crate::common::golden_file::assert_file;

#[test]
fn the_golden_schema_is_the_one_of_the_scene_types() {
    let golden = Path::new(env!("CARGO_MANIFEST_DIR")).join("golden/scene.schema.json");
    assert_file(&golden, &schema());
}
