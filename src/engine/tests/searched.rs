//! In which contact state `unilateral` ends, or that it fails, recorded: of bodies that little holds, and
//! under strong friction and several stages.

use engine::{Request, solve};
use fastrand::Rng;
use problem::modelling::{ContactModel, Coupling, Friction, Geometry};
use problem::scene::{Axis, SceneBuilder};

use crate::letter::letter;
use testing::bodies::{Bodies, Writing, grid, regular};
use testing::drawn::{KINDS, draw};
use testing::draws::one_of;
use testing::golden_file::assert_file;

/// Returns the statuses at the end of a run, or the exit status of one that fails.
fn outcome(scene: &SceneBuilder) -> String {
    let Ok(scene) = scene.build() else { return "no scene".into() };
    match solve(&Request::new(&scene), &mut |_| ()) {
        Ok(solution) => solution.last().statuses.iter().map(letter).collect(),
        Err(why) => format!("exit status {}", why.exit_status().number()),
    }
}

fn model(rng: &mut Rng, friction: &[f64]) -> ContactModel {
    ContactModel {
        coupling: one_of(rng, Coupling::ALL),
        friction: Friction::new(one_of(rng, friction)).unwrap(),
        geometry: one_of(rng, &[Geometry::Current, Geometry::Initial]),
        load_steps: one_of(rng, &[1, 2, 3]),
        ..ContactModel::default()
    }
}

/// Runs the seeds that begin the lines of `searched/<name>.txt`, before the words for the model and the outcome.
fn record(name: &str, one: impl Fn(&mut Rng) -> (SceneBuilder, ContactModel)) {
    let file = format!("tests/searched/{name}.txt");
    let line = |line: &str| {
        let seed = line.split(' ').next().expect("a seed");
        let (scene, model) = one(&mut Rng::with_seed(seed.parse().expect("a number")));
        let ContactModel { coupling, friction, geometry, load_steps, .. } = model;
        format!("{seed} {coupling} {friction} {geometry} {load_steps} {}\n", outcome(&scene))
    };
    let lines = std::fs::read_to_string(&file).expect("the runs");
    assert_file(&file, &lines.lines().map(line).collect::<String>());
}

/// A body that one restraint or none holds beside the target, and forces in any direction: most of
/// them tip, slide or leave.
fn loose(rng: &mut Rng) -> (SceneBuilder, ContactModel) {
    let k = rng.usize(..16);
    let mut bodies =
        if k.is_multiple_of(2) { regular(rng) } else { draw(rng, KINDS[k / 2 % 8]).bodies };
    let first = *bodies.triangles[1].iter().flatten().min().expect("it has triangles");
    bodies.restrained.retain(|(node, _)| *node < first);
    let last = bodies.nodes.len() - 1;
    let node = first + rng.usize(..=last - first);
    match rng.u8(..4) {
        0 => {}
        1 => bodies.restrained.push((node, vec![Axis::Y])),
        _ => bodies.restrained.push((node, vec![Axis::X])),
    }
    let (arm, across) = (one_of(rng, &[0.0, 0.0, 0.4, 2.0]), one_of(rng, &[0.0, 0.0, 0.3, -1.0]));
    let (sign, count) = (one_of(rng, &[1.0, 1.0, -1.0]), bodies.loads.len());
    for (k, (_, [fx, fy])) in bodies.loads.iter_mut().enumerate() {
        *fy *= sign * (1.0 + arm * (2.0 * k as f64 / count as f64 - 1.0));
        *fx = across * *fy;
    }
    let writing = Writing {
        shift: one_of(rng, &[[0.0, 0.0], [50.0, -30.0]]),
        turns: rng.usize(..4),
        scale: one_of(rng, &[1.0, 8.0]),
        ..Writing::default()
    };
    let model = model(rng, &[0.0, 0.0, 0.5, f64::INFINITY]);
    (bodies.modelled(&writing, model), model)
}

#[test]
fn loose_bodies() {
    record("loose", loose);
}

/// A square that one restraint or none holds over a short target, and forces on its top in any
/// direction: it falls, tips, slides or leaves, or rests.
fn square(rng: &mut Rng) -> (SceneBuilder, ContactModel) {
    let left = one_of(rng, &[0.0, 0.4, 1.2, 1.9]);
    let gap = one_of(rng, &[0.0, 0.0, 0.1]);
    let width = one_of(rng, &[1.0, 1.5]);
    let upper = [gap, gap + 1.0].map(|y| [[left, y], [left + width, y]]);
    let both = vec![Axis::X, Axis::Y];
    let mut restrained: Vec<_> = (0..3).map(|n| (n, both.clone())).collect();
    let node = 6 + rng.usize(..4);
    match rng.u8(..4) {
        0 => {}
        1 => restrained.push((node, vec![Axis::Y])),
        2 => restrained.push((node, vec![Axis::X])),
        _ => restrained.push((node, both)),
    }
    let force = |rng: &mut Rng| {
        let across = one_of(rng, &[0.0, 0.0, 0.3, -0.3, 1.0]);
        [across, one_of(rng, &[-1.0, -1.0, -0.2, 0.0, 0.5])]
    };
    let loads = [8, 9].map(|n| (n, force(rng))).into();
    let lower = [-1.0, 0.0].iter().flat_map(|y| [0.0, 1.0, 2.5].map(|x| [x, *y]));
    let bodies = Bodies {
        nodes: lower.chain(upper.into_iter().flatten()).collect(),
        triangles: [grid(0, 3, 2), grid(6, 2, 2)],
        moduli: [(1e3, 0.2), (1e3, 0.3)],
        contact: vec![6, 7],
        target: vec![[3, 4], [4, 5]],
        restrained,
        loads,
    };
    let writing = Writing {
        shift: one_of(rng, &[[0.0, 0.0], [50.0, -30.0]]),
        turns: rng.usize(..4),
        scale: one_of(rng, &[1.0, 8.0]),
        ..Writing::default()
    };
    let geometry = Geometry::Initial;
    let model = ContactModel { geometry, ..model(rng, &[0.0, 0.0, 0.0, 0.5]) };
    (bodies.modelled(&writing, model), model)
}

#[test]
fn squares_that_little_holds() {
    record("squares", square);
}

/// Friction that is strong, pushes to either side in a second stage, ties.
fn rubbing(rng: &mut Rng) -> (SceneBuilder, ContactModel) {
    let k = rng.usize(..16);
    let bodies =
        if k.is_multiple_of(2) { regular(rng) } else { draw(rng, KINDS[k / 2 % 8]).bodies };
    let model = model(rng, &[0.3, 0.7, 1.5, 4.0]);
    let (node, [_, force]) = bodies.loads[bodies.loads.len() - 1];
    let push = one_of(rng, &[0.3, 1.0, -1.0, -3.0]) * force;
    let lift = one_of(rng, &[0.0, 0.0, -0.5, -1.5]) * force;
    let scene = bodies
        .modelled(&Writing::default(), model)
        .force(node + 1, [push, lift])
        .in_stage(one_of(rng, &[1, 2, 3]));
    (scene, model)
}

#[test]
fn bodies_whose_active_set_returns() {
    record("complementary", rubbing);
}

#[test]
fn rubbing_bodies() {
    record("rubbing", rubbing);
}

/// Powers of two as units of length and force change no digit, and so no contact state.
#[test]
fn units_change_no_contact_state() {
    for seed in [3, 4, 45, 118, 134, 151, 281, 290] {
        let (scene, _) = rubbing(&mut Rng::with_seed(seed));
        for (length, force) in [(-30, 0), (30, 0), (0, -30), (0, 30)] {
            let (length, force) = (2.0_f64.powi(length), 2.0_f64.powi(force));
            let mut other = scene.clone();
            other.mesh.nodes.iter_mut().flat_map(|node| &mut node.xyz).for_each(|x| *x *= length);
            assert!(other.description.loads.iter_mut().all(|load| load.scale(length * force)));
            other.description.materials.0.iter_mut().for_each(|(_, own)| own.e *= force);
            assert_eq!(outcome(&other), outcome(&scene), "{seed}: {length} {force}");
        }
    }
}
