//! Restraints along normals, tangents and given directions, by place, and with displacements: the rows of
//! `supports/rows.txt`, each with the directions that its restraints hold, or why it is refused.

use problem::scene::{Axis, Restraint, Scene, SceneBuilder};
use testing::golden_file::assert_rows;
use testing::rows::scene_of;

const FOLDER: &str = "tests/supports";

fn held(scene: &Scene) -> String {
    let model = &scene.model;
    let mut lines = vec![format!("{} degrees of freedom are free", model.free_dofs())];
    for (k, name) in model.restraints.iter().enumerate() {
        let own = model.holds.iter().filter(|hold| hold.restraint == Some(k));
        let holds = own.map(|hold| {
            let [x, y] = hold.direction;
            let how = if hold.dof().is_some() { "plainly" } else { "by an equation" };
            format!(" node {} along {x:.15} {y:.15}, {how};", hold.node)
        });
        lines.push(format!("{name}:{}", holds.collect::<String>()));
    }
    lines.extend(scene.adapted().to_vec());
    lines.join("\n")
}

#[test]
fn what_restraints_hold() {
    let answer =
        |row: &str| scene_of(FOLDER, row).map_or_else(|why| why.to_string(), |scene| held(&scene));
    assert_rows(format!("{FOLDER}/rows.txt"), answer);
}

/// JSON has no such number.
#[test]
fn a_displacement_that_is_no_number_is_refused() {
    let scene = scene_of(FOLDER, r#"body /restraints/-={"on":10,"fix":["x","y"]}"#);
    let (description, mesh) = scene.as_ref().expect("it is sound").source();
    let (description, mesh) = (description.clone(), mesh.clone());
    let on = Restraint { on: Some(13.into()), fix: vec![Axis::X], ..Restraint::default() };
    let restraint = Restraint { displacement: vec![f64::NAN], ..on };
    let all = SceneBuilder { name: "body".into(), description, mesh }.restraint(restraint);
    assert!(all.build().expect_err("it is refused").to_string().contains("is not finite"));
}
