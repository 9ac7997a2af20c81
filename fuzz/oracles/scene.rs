//! A scene file, with a mesh of two blocks beside it whatever its name: it is refused with its fault,
//! or it is a scene that is written, read back and planned.

use plane_contact::engine::plan::Plan;
use plane_contact::input::Variant;
use plane_contact::output;
use plane_contact::problem::scene::{SceneBuilder, file, gmsh};
use plane_contact::studies::snapshot::Input;
use plane_contact::{Request, Scene};

use super::sound;

const MESH: &[u8] = include_bytes!("../../src/problem/tests/gmsh/blocks-2.2-ascii.msh");

pub fn hold(data: &[u8]) {
    match Scene::build("fuzz", data, |_| Ok(MESH.into())) {
        Err(error) => sound::input_error(&error),
        Ok(scene) => {
            reads_back(&scene);
            Variant::ALL.iter().for_each(|variant| is_planned(&scene, *variant));
        }
    }
}

/// The scene's file and its mesh's file are the same scene, and so is what a snapshot keeps.
fn reads_back(scene: &Scene) {
    let (description, mesh) = scene.source();
    let text = file::write(description, "mesh.msh");
    let beside = |_: &str| Ok(gmsh::write(mesh).into_bytes());
    let read = SceneBuilder::read("fuzz", text.as_bytes(), beside).expect("what was written");
    assert_eq!((&read.description, &read.mesh), (description, mesh));
    let kept = Input::from_scene(scene);
    let built = kept.build().expect("what was kept");
    assert_eq!(built.source(), scene.source());
}

fn is_planned(scene: &Scene, variant: Variant) {
    match Plan::new(&Request::new(scene).variant(variant)) {
        Err(error) => sound::input_error(&error),
        Ok(plan) => drop(sound::document(&output::json::line(Some(scene), &plan))),
    }
}
