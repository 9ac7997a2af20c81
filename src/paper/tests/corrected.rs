//! The corrected programs, executed: two blocks in closed form, and what an ending says.

use std::sync::Arc;

use paper::corrected::{Bound, Ending, FAULTS, Worksheet, check};
use paper::findings::FindingId;
use problem::model::{Force, Material, Model, NodeId};
use problem::scene::Scene;
use testing::tolerances::{ELEMENT, assert_near};

/// The iterations of the paper.
const STEPS: usize = 20;

fn model(scene: &str) -> Arc<Model> {
    Scene::open(scene).expect("embedded scenes are sound").model
}

fn ending(model: &Model, bound: Bound, steps: usize) -> Ending {
    Worksheet::new(model, bound).iterate(&[], steps).expect("the programs end")
}

/// Each block is 2 mm high, in uniaxial strain under 6.3 MPa: `golden/two-blocks/README.md`.
#[test]
fn two_blocks_in_closed_form() {
    let model = model("two-blocks");
    let strain = |material: Material| {
        let Material { e, nu } = material;
        6.3 * (1.0 + nu) * (1.0 - 2.0 * nu) / (e * (1.0 - nu))
    };
    let [first, .., last] = &model.triangles[..] else { panic!("two blocks") };
    let [lower, upper] = [first, last].map(|triangle| strain(triangle.material));
    for bound in Bound::ALL {
        let found = ending(&model, *bound, STEPS);
        assert_eq!((found.period, found.is_settled), (Some(1), true), "{bound}");
        assert_eq!(found.in_contact.len(), model.contact.nodes.len(), "{bound}");
        let pressed: f64 = found.in_contact.iter().map(|(_, force)| force).sum();
        assert_near("force", pressed, 6.3 * 2.0 * model.thickness, 12.6, &ELEMENT);
        for (n, [_, y]) in model.nodes.iter().enumerate() {
            let below = n < model.nodes.len() / 2;
            let v = if below { -lower * y } else { -lower * 2.0 - upper * (y - 2.0) };
            assert_near("v", found.u[2 * n + 1], v, 4.0 * lower, &ELEMENT);
        }
    }
}

/// A force along the surface at the contact node in the middle, whose mate is the target's node under it.
#[test]
fn bound_in_both_components_a_node_goes_with_its_target() {
    let mut model = model("two-blocks");
    let free = |node: &&NodeId| !model.is_restrained(node.dofs()[0]);
    let node = *model.contact.nodes.iter().find(free).expect("one in the middle");
    let place = model.nodes[node.index()];
    let mate = (0..model.nodes.len())
        .find(|n| *n != node.index() && model.nodes[*n] == place)
        .expect("meshes match");
    Arc::make_mut(&mut model).forces.push(Force::Node(node, [5.0, 0.0]));
    let slip = |bound| {
        let u = ending(&model, bound, STEPS).u;
        u[2 * node.index()] - u[2 * mate]
    };
    let (free, bound) = (slip(Bound::Normal), slip(Bound::Both));
    assert!(free > 1e-6, "along the normal alone it slides by {free}");
    assert!(bound.abs() < 1e-9 * free, "bound in both it slides by {bound}");
}

/// Of the strand's surface a part is in contact, and is so from the seventh iteration on; before that
/// nothing has come back.
#[test]
fn what_an_ending_says() {
    let model = model("strand");
    let found = ending(&model, Bound::Normal, STEPS);
    assert_eq!((found.iterations, found.period, found.is_settled), (7, Some(1), true));
    assert_eq!(found.in_contact.len(), 9);
    assert!(found.in_contact.iter().all(|(_, force)| *force > 0.0));
    let begun = ending(&model, Bound::Normal, 2);
    assert_eq!((begun.iterations, begun.period, begun.is_settled), (2, None, false));
}

#[test]
fn models_that_the_programs_do_not_take() {
    let mut model = model("two-blocks");
    assert_eq!(check(&model), Ok(()));
    let contact = &mut Arc::make_mut(&mut model).contact;
    let first = contact.nodes[0];
    contact.nodes.push(first);
    let twice = check(&model).expect_err("a node stands twice").what;
    assert!(twice.contains(&format!("{first} stands twice")), "{twice}");
    Arc::make_mut(&mut model).contact.nodes.clear();
    assert_eq!(check(&model).expect_err("there is none").place, "contact");
}

#[test]
fn faults_are_named_as_their_edits() {
    let [first, .., release, _] = FAULTS else { panic!("there are several") };
    assert!(first.words().starts_with("an edge is looked at only where its box holds"));
    assert_eq!(
        [FindingId::C1, FindingId::C14, FindingId::C2].map(|finding| first.is_of(finding)),
        [true, true, false]
    );
    assert_eq!(first.places(), ["c_cnt 14"]);
    assert_eq!(release.name(), "K9 (release)");
    for fault in FAULTS {
        let heading = format!("# {}: {}.\n", fault.name(), fault.words());
        assert!(fault.edit.starts_with(&heading), "{heading}");
    }
}
