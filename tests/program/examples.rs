//! The examples of the library run.

#[path = "../../examples/compare_variants.rs"]
mod compare_variants;
#[path = "../../examples/listing_call.rs"]
mod listing_call;
#[path = "../../examples/scene_in_code.rs"]
mod scene_in_code;

#[test]
fn examples_run() {
    scene_in_code::main().expect("a scene built in code is solved");
    listing_call::main().expect("the listing is called");
    compare_variants::main().expect("the variants are compared");
}
