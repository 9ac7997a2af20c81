//! The examples of the library run.

#[path = "../../examples/compare_variants.rs"]
mod compare_variants;
#[path = "../../examples/listing_call.rs"]
mod listing_call;
#[path = "../../examples/own_scene.rs"]
mod own_scene;
#[path = "../../examples/scene_in_code.rs"]
mod scene_in_code;
#[path = "../../examples/snapshot_in_a_test.rs"]
mod snapshot_in_a_test;

#[test]
fn examples_run() {
    scene_in_code::main().expect("a scene built in code is solved");
    listing_call::main().expect("the listing is called");
    compare_variants::main().expect("the variants are compared");
}

#[test]
fn a_scene_of_ones_own_is_solved_and_an_error_explained() {
    let folder = tempfile::TempDir::new().expect("a folder");
    let root = std::path::Path::new(env!("CARGO_MANIFEST_DIR"));
    own_scene::own_scene(&root.join("golden/fig1/scene.json"), folder.path()).expect("solved");
    assert!(folder.path().join("fields.vtu").exists());
    let error = own_scene::own_scene(std::path::Path::new("nowhere"), folder.path());
    let said = own_scene::explained(&error.expect_err("there is no such scene"));
    assert!(said.starts_with("nowhere: "), "{said}");
}

#[test]
fn a_snapshot_is_recorded_once_and_then_verified() {
    let folder = tempfile::TempDir::new().expect("a folder");
    let path = folder.path().join("s.json");
    for _ in 0..2 {
        assert!(snapshot_in_a_test::check("fig1", &path).expect("it runs"));
    }
    let text = std::fs::read_to_string(&path).expect("recorded");
    std::fs::write(&path, text.replacen("\"iterations\": 20", "\"iterations\": 19", 1))
        .expect("written");
    assert!(!snapshot_in_a_test::check("fig1", &path).expect("it runs"));
}
