//! The JSON Schema of a scene file.

use std::path::Path;

use problem::scene::schema;

use testing::golden_file::assert_file;

#[test]
fn the_golden_schema_is_the_one_of_the_scene_types() {
    let golden = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../golden/scene.schema.json");
    assert_file(&golden, &schema());
}
