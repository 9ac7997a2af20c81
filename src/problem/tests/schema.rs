//! The JSON Schema of a scene file.

use problem::scene::schema;

use testing::golden_file::assert_file;

#[test]
fn the_golden_schema_is_the_one_of_the_scene_types() {
    assert_file("../../golden/scene.schema.json", &schema());
}
