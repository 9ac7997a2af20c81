//! The variants on scenes whose answer is known.

use crate::common::embedded::scene_json;
use crate::common::json::build;
use crate::common::outcome::solve;
use crate::common::rows::scene_of;
use crate::common::tolerances::{BALANCE, assert_near};
use plane_contact::engine::error::Error;
use plane_contact::engine::linear::{Arithmetic, Solver};
use plane_contact::engine::{self, Detail, Request, Solution, Step};
use plane_contact::paper::door::Call;
use plane_contact::paper::mirror::{Pairs, Reading};
use plane_contact::problem::model::NodeId;
use plane_contact::problem::modelling::Variant;
use plane_contact::problem::scene::Scene;
use serde_json::{Value, json};

testing::tolerances! {
    /// Relative residual of a solution.
    RESIDUAL = 1e-14, "LU with partial pivoting is backward stable: some eps = 2e-16 with growth";
    /// A scene beside its mirror image, relative to the largest displacement.
    MIRRORED = 1e-11, "the same equations in another order: 1e-16 times a condition number of 1e3";
    /// `two-blocks` against its closed form, relative to the closed form.
    CLOSED_FORM = 1e-12, "some 40 equations of condition 1e2 in f64; the issue's own number";
}

fn run(request: &Request) -> Result<Solution, Error> {
    engine::solve(request, &mut |_| ())
}

fn solved(scene: &Scene, variant: Variant) -> Solution {
    run(&Request::new(scene).variant(variant)).expect("the variant runs")
}

/// The pairs of an iteration of a variant of the paper.
fn published(step: &Step) -> &Pairs<f64> {
    match &step.detail {
        Detail::Published(pairs) => pairs,
        Detail::Unilateral(_) => panic!("unilateral is no variant of the paper"),
    }
}

/// GOAL: two blocks under uniform pressure, each in uniaxial strain.
/// MESH: two squares of 2 x 2 mm, 2 x 2 x 2 triangles each, matching nodes between them.
/// BOUNDARY CONDITIONS: bottom held in y, sides held in x, 6.3 MPa on the top.
/// PARAMETERS: E = 30000 and 210000 MPa, nu = 0.2 and 0.3, plane strain.
#[test]
fn two_blocks_have_their_closed_form() {
    let p = 6.3;
    let modulus = |e: f64, nu: f64| e * (1.0 - nu) / ((1.0 + nu) * (1.0 - 2.0 * nu));
    for variant in [Variant::Tied, Variant::Stepped] {
        let (_, solution) = solve("two-blocks", variant);
        let bodies = [(0..8, 30000.0, 0.2), (8..16, 210000.0, 0.3)];
        for (triangles, e, nu) in bodies {
            for state in &solution.elements[triangles] {
                let side = -p * nu / (1.0 - nu);
                let von_mises = p * (1.0 - 2.0 * nu) / (1.0 - nu);
                let strain = p / modulus(e, nu);
                assert_near("sigma_x", state.sigma[0], side, p, &CLOSED_FORM);
                assert_near("sigma_y", state.sigma[1], -p, p, &CLOSED_FORM);
                assert_near("tau_xy", state.sigma[2], 0.0, p, &CLOSED_FORM);
                assert_near("e_yy", state.epsilon[1], -strain, strain, &CLOSED_FORM);
                assert_near("von Mises stress", state.von_mises_stress, von_mises, p, &CLOSED_FORM);
                let e_eq = 2.0 / 3.0 * strain;
                assert_near("von Mises strain", state.von_mises_strain, e_eq, strain, &CLOSED_FORM);
            }
        }
        let top = p * (2.0 / modulus(30000.0, 0.2) + 2.0 / modulus(210000.0, 0.3));
        for node in NodeId::all(18) {
            let [_, y] = solution.model.coordinates(node);
            let below = 2.0_f64.min(if node.number() < 10 { y } else { 2.0 });
            let v = p * (below / modulus(30000.0, 0.2) + (y - below) / modulus(210000.0, 0.3));
            let [along_x, along_y] = node.components(&solution.u);
            assert_near("u", along_x, 0.0, top, &CLOSED_FORM);
            assert_near("v", along_y, -v, top, &CLOSED_FORM);
        }
        let last = solution.last();
        assert_near("force on the target", solution.target_force(), 2.0 * p, p, &CLOSED_FORM);
        assert_eq!(last.in_contact, 3);
        assert_eq!(last.contact_residual, 0.0);
    }
}

/// K1: as printed, nothing reaches the target: exactly zero.
#[test]
fn k1_as_printed_nothing_reaches_the_target() {
    for name in ["strand", "fig1", "two-blocks"] {
        let (_, solution) = solve(name, Variant::Printed);
        let target = solution.model.target().expect("a scene with contact");
        for n in &target.nodes {
            assert_eq!(n.components(&solution.u), [0.0, 0.0], "{name}, node {n}");
        }
        for n in &target.triangles {
            let state = &solution.elements[n.index()];
            assert_eq!(state.von_mises_stress, 0.0, "{name}, triangle {n}");
        }
        assert!(solution.steps.iter().all(|it| it.target_force == 0.0 && it.in_contact > 0));
        assert!(solution.steps.iter().all(|it| it.contact_residual > 0.0), "eq. (1) does not hold");
    }
}

/// Where eq. (1) is imposed, the whole load reaches the target, step by step.
#[test]
fn tied_and_stepped_carry_the_load_to_the_target() {
    for name in ["strand", "fig1", "two-blocks"] {
        for variant in [Variant::Tied, Variant::Stepped] {
            let (scene, solution) = solve(name, variant);
            let load = scene.model.total_load()[1].abs();
            for it in &solution.steps {
                let part = if variant == Variant::Tied { 1.0 } else { it.k as f64 / 20.0 };
                let force = it.target_force;
                assert_near(name, force, part * load, load, &BALANCE);
                assert!(it.solve_residual < RESIDUAL.limit, "{}", RESIDUAL.reason);
            }
        }
    }
}

/// K5 on the paper's example: under `tied` the contact set ends in a cycle, under `stepped` it
/// settles.
#[test]
fn k5_tied_cycles_and_stepped_settles_on_the_strand() {
    let (_, tied) = solve("strand", Variant::Tied);
    let cycle = tied.last().cycle.clone().expect("a state seen before");
    assert_eq!((cycle.length, cycle.members), (2, vec![18, 19]));
    let (_, stepped) = solve("strand", Variant::Stepped);
    let counts: Vec<usize> = stepped.steps.iter().map(|it| it.in_contact).collect();
    assert!(counts.is_sorted(), "the contact set grows steadily: {counts:?}");
    let last = stepped.last();
    assert_eq!((last.in_contact, last.cycle.as_ref().map(|c| c.length)), (8, Some(1)));
}

/// A state that came before is not factored again, and gives the same displacements.
#[test]
fn a_state_met_before_is_not_factored_again() {
    let (_, solution) = solve("strand", Variant::Tied);
    let new = solution.steps.iter().filter(|it| it.cycle.is_none()).count();
    assert_eq!((solution.factored, new), (8, 8));
    let of = |k: usize| &solution.steps[k - 1];
    let largest = |k: usize| of(k).max_displacement.to_bits();
    assert_eq!(largest(18), largest(20));
    assert_eq!(published(of(18)), published(of(20)));
}

/// A mirror image of `fig1`: coordinates times `signs`, triangles turned back counter-clockwise,
/// target edges running towards +x again, both surfaces in order of x.
fn mirrored(signs: [f64; 2]) -> Scene {
    let mut scene = scene_json("fig1");
    for row in scene["node"].as_array_mut().unwrap() {
        for (column, sign) in [(1, signs[0]), (2, signs[1])] {
            row[column] = json!(row[column].as_f64().unwrap() * sign);
        }
    }
    for row in scene["elem"].as_array_mut().unwrap() {
        let triangle = row[1] == 2;
        if triangle || signs[0] < 0.0 {
            row.as_array_mut().unwrap().swap(5, 6);
        }
    }
    if signs[0] < 0.0 {
        for surface in ["cnt", "trg"] {
            let numbers: &mut Vec<Value> = scene["contact"][surface].as_array_mut().unwrap();
            numbers.reverse();
        }
    }
    build(&scene).expect("a mirror image is as sound as the scene")
}

#[test]
fn a_scene_mirrored_in_x_has_the_mirrored_answer() {
    for variant in [Variant::Tied, Variant::Stepped] {
        let (_, scene) = solve("fig1", variant);
        let image = solved(&mirrored([-1.0, 1.0]), variant);
        let mut dy = published(&image.steps[0]).dy.as_slice().to_vec();
        dy.reverse();
        assert_eq!(published(&scene.steps[0]).dy.as_slice(), dy);
        let scale = scene.u.amax();
        for node in NodeId::all(13) {
            let ([u, v], [image_u, image_v]) =
                (node.components(&scene.u), node.components(&image.u));
            assert_near("u", image_u, -u, scale, &MIRRORED);
            assert_near("v", image_v, v, scale, &MIRRORED);
        }
    }
}

/// C7 and K2: as printed the answer depends on the order of the contact nodes, for a target node
/// keeps only the last one's number, and an element only the last weight. The image, whose nodes
/// come in the other order, is no mirror image.
#[test]
fn c7_k2_a_scene_mirrored_in_x_has_another_answer_as_printed() {
    let (_, scene) = solve("fig1", Variant::Printed);
    let image = solved(&mirrored([-1.0, 1.0]), Variant::Printed);
    let v = |solution: &Solution, node: NodeId| node.components(&solution.u)[1];
    let difference = NodeId::all(13).map(|node| (v(&image, node) - v(&scene, node)).abs());
    assert!(difference.fold(0.0, f64::max) > 0.1 * scene.u.amax());
}

/// C4: the sign rule is one-sided. With the target below, node 2.4 is deep inside and is lost, and
/// the separated node 2.3 beside it is flagged; turn the scene upside down and it is the other way
/// round.
#[test]
fn c4_a_scene_mirrored_in_y_has_another_answer() {
    let (_, scene) = solve("fig1", Variant::Tied);
    assert_eq!(published(&scene.steps[0]).dy.as_slice(), [1, 1, 1, 0, 1]);
    let image = mirrored([1.0, -1.0]);
    let call = Call::c_cnt(&image.model, &Reading::default(), &image.model.nodes).unwrap();
    assert_eq!(call.pairs.dy.as_slice(), [1, 1, 0, 1, 1]);
}

/// The residual of eq. (1) is measured on the target edge, not by the weights that were imposed:
/// where a reading or a scene inflates them, it shows.
#[test]
fn the_residual_of_eq_1_shows_inflated_weights() {
    let inside: Reading = "R1=inside".parse().unwrap();
    let once = scene_of("golden", "fig1/scene /iterations=1").unwrap();
    let request = Request::new(&once).variant(Variant::Tied).reading(inside);
    assert!(run(&request).unwrap().steps[0].contact_residual > 1e-3);
    let twice = scene_of("golden", "two-blocks/scene cnt=[10,11,11,12]").unwrap();
    let solution = solved(&twice, Variant::Tied);
    assert!(solution.steps[0].contact_residual > 1e-4);
}

/// As printed, sparse and dense LU lead to the same displacements and states.
#[test]
fn as_printed_sparse_and_dense_lu_agree() {
    let readings = ["", "R3=per-node", "R3=nested", "R5=node_n", "R7=stepped", "R2=printed"];
    for (name, reading) in ["fig1", "two-blocks"].iter().flat_map(|n| readings.map(|r| (n, r))) {
        let scene = Scene::open(name).expect("embedded");
        let reading: Reading = reading.parse().expect("a reading");
        let request = Request::new(&scene).variant(Variant::Printed).reading(reading);
        let solver = Some(Solver::DenseLu);
        let whole = request.clone().arithmetic(Arithmetic { solver, ..Arithmetic::default() });
        let (own, whole) = match (run(&request), run(&whole)) {
            (Ok(own), Ok(whole)) => (own, whole),
            (own, whole) => {
                let [own, whole] =
                    [own, whole].map(|run| run.map(|_| ()).map_err(|e| e.to_string()));
                assert_eq!(own, whole);
                continue;
            }
        };
        let sets = |run: &Solution| -> Vec<Vec<usize>> {
            run.steps.iter().map(|step| step.closed().map(usize::from).collect()).collect()
        };
        assert_eq!(sets(&own), sets(&whole), "{name}");
        let largest = whole.u.amax();
        for (own, whole) in own.u.iter().zip(&whole.u) {
            assert_near("displacement", *own, *whole, largest, &MIRRORED);
        }
    }
}

/// Under R2 = printed `Km` takes other equations for restrained than S names; a force there stays a
/// force.
#[test]
fn r2_printed_holds_what_km_holds() {
    let held = r#"[{"on":11,"fix":["x","y"]},{"node":13,"fix":["x"]},{"node":12,"fix":["y"]}]"#;
    let row = r#"/loads=[{"node":12,"force":[5.0,0.0]}] /iterations=1"#;
    let scene = scene_of("golden", &format!("fig1/scene /restraints={held} {row}")).unwrap();
    let reading: Reading = "R2=printed".parse().unwrap();
    let request = Request::new(&scene).variant(Variant::Printed).reading(reading);
    assert_eq!(NodeId::from_number(12).components(&run(&request).unwrap().u), [0.0, 0.0]);
}

/// Loads from 1e-200 to 1e150: forces stay forces; what overflows is refused.
#[test]
fn loads_of_any_size() {
    let pressed = |p: f64| {
        let scene = scene_of("golden", &format!("two-blocks/scene /loads/0/pressure={p:?}"));
        run(&Request::new(&scene.unwrap()).variant(Variant::Tied))
    };
    for p in [1e-200, 1e150] {
        let force = pressed(p).unwrap().target_force();
        assert_near("force on the target", force, 2.0 * p, p, &CLOSED_FORM);
    }
    let error = pressed(1e308).unwrap_err();
    assert!(error.to_string().contains("too large to represent"), "{error}");
}

/// What a constraint passes straight to a restrained target node reaches the target too.
#[test]
fn forces_on_held_target_nodes_count() {
    let row = r#"two-blocks/scene /restraints/-={"on":11,"fix":["y"]}"#;
    let scene = scene_of("golden", row).unwrap();
    for variant in [Variant::Tied, Variant::Stepped] {
        let solution = solved(&scene, variant);
        let u = &solution.u;
        for node in NodeId::all(9) {
            for u_node in node.components(u) {
                assert_near("the lower block does not move", u_node, 0.0, u.amax(), &CLOSED_FORM);
            }
        }
        assert_near("force on the target", solution.target_force(), 12.6, 12.6, &CLOSED_FORM);
    }
}

/// `stepped` is `tied` with R7 = stepped, and the other way round.
#[test]
fn r7_turns_one_variant_into_the_other() {
    let scene = Scene::open("fig1").unwrap();
    let reading: Reading = "R7=stepped".parse().unwrap();
    let by_reading = run(&Request::new(&scene).variant(Variant::Tied).reading(reading)).unwrap();
    assert_eq!(by_reading.u, solved(&scene, Variant::Stepped).u);
}

/// Without contact nothing of contact is built, and one body stands for itself.
#[test]
fn a_scene_without_contact_is_plain_elasticity() {
    let row = r#"two-blocks/scene /contact=null /restraints/-={"on":20,"fix":["y"]}"#;
    let scene = scene_of("golden", row).unwrap();
    let solution = solved(&scene, Variant::Tied);
    assert!(solution.steps.iter().all(|it| it.in_contact == 0 && it.target_force == 0.0));
    let mut lower = NodeId::all(9).map(|node| node.components(&solution.u));
    assert!(lower.all(|u| u == [0.0, 0.0]), "the lower block carries nothing");
    assert!(solution.elements[15].von_mises_stress > 1.0);
}
