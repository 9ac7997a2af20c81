//! In which contact state `unilateral` ends, or that it fails, recorded: of bodies that little holds, and
//! under strong friction and several stages.

use engine::contact::{Sense, Status};
use engine::{Detail, Request, Solution, solve};
use fastrand::Rng;
use problem::modelling::{ContactModel, Coupling, Friction, Geometry};
use problem::scene::{Axis, SceneBuilder};

use testing::bodies::{Bodies, Writing, grid, regular};
use testing::drawn::{KINDS, draw};
use testing::draws::one_of;
use testing::recorded::assert_recorded_exactly;

/// Returns the statuses at the end of a run, or the exit status of one that fails.
fn outcome(scene: &SceneBuilder) -> String {
    let Ok(scene) = scene.build() else { return "no scene".into() };
    match solve(&Request::new(&scene), &mut |_| ()) {
        Ok(solution) => match &solution.last().detail {
            Detail::Unilateral(own) => own.statuses.iter().map(letter).collect(),
            Detail::Published(_) => unreachable!("unilateral was asked for"),
        },
        Err(why) => format!("exit status {}", why.exit_status().number()),
    }
}

fn letter(status: &Status) -> char {
    match status {
        Status::Open => 'o',
        Status::Stick => 's',
        Status::Slip(Sense::Forward) => 'f',
        Status::Slip(Sense::Backward) => 'b',
        Status::Slip(Sense::Free) => 'c',
    }
}

fn model(rng: &mut Rng, friction: &[f64]) -> ContactModel {
    ContactModel {
        coupling: one_of(rng, &[Coupling::Nts, Coupling::Mortar]),
        friction: Friction::new(one_of(rng, friction)).unwrap(),
        geometry: one_of(rng, &[Geometry::Current, Geometry::Initial]),
        load_steps: one_of(rng, &[1, 2, 3]),
        ..ContactModel::default()
    }
}

/// Records the runs of some seeds, each after the words for its model.
fn record(name: &str, seeds: &[u64], one: impl Fn(&mut Rng) -> (SceneBuilder, ContactModel)) {
    let line = |seed: &u64| {
        let (scene, model) = one(&mut Rng::with_seed(*seed));
        let ContactModel { coupling, friction, geometry, load_steps, .. } = model;
        format!("{coupling} {friction} {geometry} {load_steps} {}\n", outcome(&scene))
    };
    assert_recorded_exactly(name, &seeds.iter().map(line).collect::<String>());
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

/// Seeds of runs that take milliseconds, as a search without success takes hundreds of iterations;
/// and one in which no node may slide, so that a fixed point on its bounds is not tried.
const QUICK: [u64; 67] = [
    0, 1, 3, 6, 8, 9, 10, 14, 19, 20, 21, 22, 23, 24, 25, 28, 29, 31, 33, 36, 37, 39, 40, 41, 43,
    44, 52, 54, 55, 56, 58, 59, 60, 62, 66, 69, 72, 75, 82, 85, 87, 88, 89, 90, 91, 93, 97, 99,
    100, 102, 104, 107, 109, 110, 111, 114, 116, 118, 121, 122, 124, 125, 127, 131, 133, 134, 137,
];

#[test]
fn loose_bodies() {
    record("loose", &QUICK, loose);
}

/// Two squares, the target, whose six nodes are the first, and one body of four nodes, row by row,
/// over them.
fn square_over_two(
    upper: [[[f64; 2]; 2]; 2],
    restrained: Vec<(usize, Vec<Axis>)>,
    loads: Vec<(usize, [f64; 2])>,
) -> Bodies {
    let lower = [-1.0, 0.0].iter().flat_map(|y| [0.0, 1.0, 2.5].map(|x| [x, *y]));
    Bodies {
        nodes: lower.chain(upper.into_iter().flatten()).collect(),
        triangles: [grid(0, 3, 2), grid(6, 2, 2)],
        moduli: [(1e3, 0.2), (1e3, 0.3)],
        contact: vec![6, 7],
        target: vec![[3, 4], [4, 5]],
        restrained,
        loads,
    }
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
    let bodies = square_over_two(upper, restrained, loads);
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
    record("squares", &SQUARES, square);
}

/// Seeds of few runs that take longer than a millisecond.
const SQUARES: [u64; 151] = [
    0, 2, 3, 4, 6, 8, 10, 11, 12, 13, 14, 16, 18, 19, 20, 21, 22, 23, 25, 26, 28, 29, 30, 31, 33,
    34, 36, 37, 38, 39, 41, 42, 43, 44, 45, 46, 47, 48, 49, 51, 52, 54, 55, 56, 57, 58, 59, 60, 62,
    64, 66, 67, 68, 69, 70, 71, 72, 74, 76, 77, 79, 81, 82, 83, 84, 85, 88, 89, 90, 91, 94, 95, 96,
    97, 99, 100, 102, 104, 105, 106, 107, 108, 111, 112, 113, 118, 121, 123, 126, 130, 131, 133,
    135, 138, 142, 146, 149, 151, 152, 153, 155, 161, 164, 167, 169, 172, 174, 176, 180, 181, 186,
    188, 189, 192, 193, 195, 199, 201, 203, 208, 213, 217, 220, 227, 237, 240, 261, 267, 290, 371,
    382, 415, 427, 430, 451, 543, 550, 574, 601, 605, 613, 615, 678, 692, 725, 753, 768, 769, 771,
    775, 847,
];

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

/// Seeds of runs in which the active set finds no equilibrium, and a fixed point on the bounds of friction is tried.
const COMPLEMENTARY: [u64; 25] = [
    8, 13, 63, 108, 138, 271, 296, 343, 386, 458, 697, 772, 795, 838, 843, 942, 946, 971, 977,
    1015, 1019, 1041, 1065, 1119, 1128,
];

/// Seeds of other runs that take milliseconds.
const RUBBING: [u64; 52] = [
    0, 3, 4, 5, 6, 11, 12, 17, 18, 19, 20, 21, 22, 24, 25, 27, 30, 31, 32, 33, 34, 35, 36, 37, 38,
    40, 41, 42, 45, 46, 47, 49, 51, 53, 54, 55, 56, 58, 59, 60, 62, 65, 66, 67, 68, 69, 72, 75, 76,
    77, 303, 2241,
];

#[test]
fn bodies_whose_active_set_returns() {
    record("complementary", &COMPLEMENTARY, rubbing);
}

#[test]
fn rubbing_bodies() {
    record("rubbing", &RUBBING, rubbing);
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

/// A square on the left end of a short target, both held along x on the left side, whose top
/// carries 2; its right lower corner stands `gap` higher.
fn on_the_left(gap: f64, friction: f64, loads: &[(usize, [f64; 2])]) -> (Bodies, ContactModel) {
    let upper = [[[0.0, 0.0], [1.0, gap]], [[0.0, 1.0], [1.0, 1.0]]];
    let both = vec![Axis::X, Axis::Y];
    let mut restrained: Vec<_> = (0..3).map(|n| (n, both.clone())).collect();
    restrained.extend([3, 6, 8].map(|n| (n, vec![Axis::X])));
    let loads = [&[(8, [0.0, -1.0]), (9, [0.0, -1.0])], loads].concat();
    let bodies = square_over_two(upper, restrained, loads);
    let geometry = Geometry::Initial;
    let friction = Friction::new(friction).unwrap();
    (bodies, ContactModel { geometry, friction, load_steps: 1, ..ContactModel::default() })
}

fn solved(bodies: &Bodies, model: ContactModel, turns: usize) -> Solution {
    let scene = bodies.modelled(&Writing { turns, ..Writing::default() }, model).build();
    solve(&Request::new(&scene.expect("a sound scene")), &mut |_| ()).expect("it rests")
}

#[test]
fn friction_does_not_act_on_a_line_of_symmetry() {
    for turns in 0..4 {
        for coupling in Coupling::ALL {
            let (mut bodies, model) = on_the_left(0.0, 5.0, &[]);
            let model = ContactModel { coupling: *coupling, ..model };
            let status = |bodies: &Bodies| solved(bodies, model, turns).contact[0].status;
            assert_eq!(status(&bodies), Some(Status::Slip(Sense::Free)));
            bodies.restrained.retain(|(node, _)| *node != 3);
            let free = status(&bodies);
            assert!(free == Some(Status::Stick) || *coupling == Coupling::Mortar, "{free:?}");
        }
    }
}

/// Gaps count as closed up to a half of a millionth of a millionth of the scene's size, which is
/// 2.5; far from the origin up to four units in the last place of the coordinates there.
#[test]
fn the_first_state_takes_the_nodes_that_touch() {
    let near = [(0.0, 1e-12, 2), (0.0, 2e-12, 1), (0.0, 1e-11, 1), (0.0, 1e-10, 1)];
    let far = [(1e6, 5e-10, 2), (1e6, 2e-9, 1)];
    for (x, gap, closed) in near.into_iter().chain(far) {
        let (bodies, model) = on_the_left(gap, 0.0, &[]);
        let writing = Writing { shift: [x, 0.0], ..Writing::default() };
        let scene = bodies.modelled(&writing, model).build().expect("a sound scene");
        let solution = solve(&Request::new(&scene), &mut |_| ()).expect("it rests");
        assert_eq!(solution.steps[0].in_contact, closed, "{gap} at {x}");
    }
}

/// The force on the target is what the square passes to it, whatever acts on the target itself.
#[test]
fn the_force_on_the_target_is_what_contact_passes_on() {
    for supports in [0..3, 3..6] {
        for load in [0.0, -1.0, 0.5] {
            let node = supports.start + 1;
            let (mut bodies, model) = on_the_left(0.0, 0.0, &[(node, [0.0, load])]);
            bodies.restrained.retain(|(node, _)| *node > 5);
            let both = vec![Axis::X, Axis::Y];
            bodies.restrained.extend(supports.clone().map(|n| (n, both.clone())));
            let force = solved(&bodies, model, 0).target_force();
            assert!((force - 2.0).abs() < 1e-11, "{force} under {load}");
        }
    }
}

/// Why a search ended is told with the part of the load that it had come to.
#[test]
fn the_load_without_an_equilibrium_is_told() {
    let end = |stage: usize, steps: usize| {
        let (bodies, model) = on_the_left(0.0, 0.5, &[]);
        let mut bodies = bodies;
        bodies.restrained.retain(|(node, _)| *node < 3);
        let model = ContactModel { load_steps: steps, ..model };
        let scene = bodies.modelled(&Writing::default(), model).force(10, [3.0, 0.0]);
        let request = Request::new(&scene.in_stage(stage).build().expect("a sound scene"));
        let why = solve(&request, &mut |_| ()).expect_err("it slides away").to_string();
        why.rsplit_once(" (").map_or(why.clone(), |(_, end)| end.to_owned())
    };
    assert_eq!(end(1, 1), "under any part of the load)");
    assert_eq!(end(1, 2), "under any part of the load)");
    assert_eq!(end(2, 1), "from 0.333 of stage 2 on)");
}
