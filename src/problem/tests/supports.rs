//! Restraints along normals, tangents and given directions, by place, and with displacements.

use problem::element::Plane;
use problem::model::Hold;
use problem::scene::{Axis, MeshBuilder, Restraint, Scene, SceneBuilder};

/// A square of side 2 whose lower corners are cut: its bottom, two slopes of 45 degrees, and its top.
///
/// ```text
///      7---8---9
///      | \ | / |
///      4---5---6
///       \  |  /
///        1-2-3
/// ```
fn body() -> SceneBuilder {
    let mut mesh = MeshBuilder::default();
    let rows = [
        [[0.5, 0.0], [1.0, 0.0], [1.5, 0.0]],
        [[0.0, 0.5], [1.0, 0.5], [2.0, 0.5]],
        [[0.0, 2.0], [1.0, 2.0], [2.0, 2.0]],
    ];
    let [bottom, middle, top] = rows.map(|row| mesh.row(row));
    mesh.join_all("body", &[bottom.clone(), middle.clone(), top.clone()]);
    mesh.edges("bottom", &bottom);
    mesh.edges("slope", &[middle[0], bottom[0]]);
    mesh.edges("corner", &[middle[0], bottom[0], bottom[1]]);
    mesh.edges("top", &top);
    SceneBuilder::new("body", mesh.finish(), Plane::Strain).material("body", 1.0, 0.3)
}

fn held(scene: &Scene) -> Vec<Vec<Hold>> {
    let mut held = vec![Vec::new(); scene.model.restraints.len()];
    scene
        .model
        .holds
        .iter()
        .for_each(|hold| held[hold.restraint.expect("all have one")].push(*hold));
    held
}

/// Why a restraint of the body is refused.
fn refused(restraint: Restraint) -> String {
    let all = body().restrain("bottom", &[Axis::X, Axis::Y]).restraint(restraint);
    all.build().expect_err("it is refused").to_string()
}

#[test]
fn a_normal_is_that_of_the_edge_outwards_and_along_an_axis_a_plain_restraint() {
    let scene = body()
        .restrain("slope", &[Axis::Normal])
        .restrain("top", &[Axis::Normal])
        .restrain_node(2, &[Axis::X])
        .build()
        .expect("it is sound");
    let holds = held(&scene);
    let half = 0.5_f64.sqrt();
    for hold in &holds[0] {
        assert!((hold.direction[0] + half).abs() < 1e-15, "{hold:?}");
        assert!((hold.direction[1] + half).abs() < 1e-15, "{hold:?}");
        assert_eq!(hold.dof(), None);
    }
    assert_eq!(holds[0].iter().map(|hold| hold.node.number()).collect::<Vec<_>>(), [1, 4]);
    assert!(holds[1].iter().all(|hold| hold.direction == [0.0, 1.0] && hold.dof().is_some()));
    assert_eq!(scene.model.free_dofs(), 18 - 2 - 3 - 1);
}

#[test]
fn at_a_corner_both_normals_are_held() {
    let scene = body()
        .restrain("corner", &[Axis::Normal])
        .restrain_node(9, &[Axis::X])
        .build()
        .expect("it is sound");
    let of_corner: Vec<Hold> =
        held(&scene)[0].iter().filter(|hold| hold.node.number() == 1).copied().collect();
    assert_eq!(of_corner.len(), 2, "{of_corner:?}");
}

#[test]
fn a_tangent_has_the_body_on_its_left() {
    let scene = body().restrain("bottom", &[Axis::Tangent, Axis::Y]).build().expect("it is sound");
    assert!(held(&scene)[0].iter().step_by(2).all(|hold| hold.direction == [1.0, 0.0]));
}

#[test]
fn a_node_is_named_by_its_place() {
    let at = |at| Restraint { at: Some(at), fix: vec![Axis::X, Axis::Y], ..Restraint::default() };
    let scene = body().restraint(at([1.0, 5e-7])).restrain_node(9, &[Axis::Y]).build();
    assert_eq!(scene.expect("it is sound").model.restraints[0], "node 2");
    let why = refused(at([1.0, 0.1]));
    assert!(why.contains("no node is at 1, 0.1") && why.contains("node 2, is at 1, 0"), "{why}");
}

#[test]
fn what_a_restraint_repeats_counts_once_and_what_it_contradicts_is_refused() {
    let pressed = body().restrain("bottom", &[Axis::X, Axis::Y]).displace("top", Axis::Y, -0.1);
    let twice = pressed.clone().displace("top", Axis::Normal, -0.1).build().expect("the same");
    assert_eq!(held(&twice)[2], []);
    let other = pressed.displace("top", Axis::Normal, -0.2).build().expect_err("two displacements");
    assert!(other.to_string().contains("displaced by -0.2"), "{other}");
    let down = Restraint {
        on: Some("bottom".into()),
        fix: vec![Axis::Direction([3.0, 4.0])],
        displacement: vec![0.5],
        ..Restraint::default()
    };
    assert!(refused(down).contains("displaced by 0.5"), "both axes are held at 0");
    let near = body().restrain("slope", &[Axis::Normal, Axis::Direction([1.0, 1.01])]);
    let why = near.build().expect_err("nearly one direction").to_string();
    assert!(why.contains("degrees apart"), "{why}");
}

#[test]
fn a_restraint_that_says_nothing_is_refused() {
    let on = |fix: Vec<Axis>| Restraint { on: Some("top".into()), fix, ..Restraint::default() };
    let cases = [
        (on(Vec::new()), "fixes no direction"),
        (on(vec![Axis::Direction([0.0, 0.0])]), "has no length"),
        (
            Restraint { displacement: vec![1.0, 2.0], ..on(vec![Axis::X]) },
            "a list of 2, where fix has 1",
        ),
        (Restraint { displacement: vec![f64::NAN], ..on(vec![Axis::X]) }, "is not finite"),
        (Restraint { node: Some(1), ..on(vec![Axis::X]) }, "exactly one of on, node and at"),
        (
            Restraint { node: Some(1), fix: vec![Axis::Normal], ..Restraint::default() },
            "neither normal nor tangent",
        ),
    ];
    for (restraint, says) in cases {
        let why = refused(restraint);
        assert!(why.contains(says), "{why}");
    }
}

#[test]
fn a_body_that_slides_or_turns_is_named_with_its_motion() {
    let slides = body().restrain("slope", &[Axis::Normal, Axis::Normal]);
    let why = slides.build().expect_err("it slides").to_string();
    assert!(why.contains("slide along") || why.contains("rotate about"), "{why}");
    let turns = body().restrain_node(2, &[Axis::X, Axis::Y]).build().expect_err("it turns");
    assert!(turns.to_string().contains("rotate about 1, 0"), "{turns}");
}

/// Two groups that meet at a bend hold their common node along both normals; one group along their mean.
#[test]
fn a_smooth_curve_in_two_groups_is_named() {
    let bent = |rise: f64| {
        let mut mesh = MeshBuilder::default();
        let bottom = mesh.row([[0.0, 0.0], [1.0, rise], [2.0, 0.0]]);
        let top = mesh.row([[0.0, 2.0], [1.0, 2.0], [2.0, 2.0]]);
        mesh.join("body", &bottom, &top);
        mesh.edges("left", &bottom[..2]);
        mesh.edges("right", &bottom[1..]);
        let scene =
            SceneBuilder::new("bent", mesh.finish(), Plane::Strain).material("body", 1.0, 0.3);
        let scene = scene.restrain("left", &[Axis::Normal]).restrain("right", &[Axis::Normal]);
        scene.build().expect("it is sound").adapted().to_vec()
    };
    let note = &bent(5.0_f64.to_radians().tan())[0];
    assert!(
        note.starts_with(
            "Node 2 is held by restraints 1 (left) and 2 (right) along directions 10 degrees"
        ),
        "{note}"
    );
    assert_eq!(bent(1.0), [""; 0]);
}
