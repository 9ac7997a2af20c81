//! Scenes whose equilibrium is hard to find, each held against the conditions of contact by equations of
//! its own: rough blocks and leaning arms under friction, rings and arcs in the current geometry without.
//!
//! ```text
//!   r = K u − F     p = n·r, q = t·r at a contact node     p ≥ 0, gap ≥ 0, p gap = 0, |q| ≤ μ p
//!   r = −Σ w (p n + q t) at a target node                  r = 0 at any other that is free
//! ```

use engine::contact::{Pairing, Surfaces};
use engine::error::{Cause, Error};
use engine::{Request, Solution, solve};
use fastrand::Rng;
use nalgebra::DVector;
use problem::element::{B, D, area};
use problem::model::{Model, NodeId};
use problem::modelling::{Coupling, Geometry};

use crate::hard_scenes::{Draw, Hard, arc, arm, disc, ring, rough, thin};
use testing::bodies::Writing;
use testing::tolerances::assert_near;

testing::tolerances! {
    /// Forces and gaps of an equilibrium in the shape that it reaches, relative to the largest force and to the size of
    /// the scene.
    HARD = 1e-8, "the shape may change by 1e-8 of the displacements after contact was measured in it";
    /// Displacements of a scene that is hard to solve in two numberings, over the largest.
    RENUMBERED = 1e-7, "thin and loosely held bodies amplify rounding by up to 1e8";
}

/// The number of scenes of each kind. `PLANE_CONTACT_HARD` gives another.
const SCENES: usize = 40;

/// Of each kind: equilibria that are the only ones as far as is known, that have others, proofs that there
/// is none, and searches that find none.
const COUNTS: &str = "\
    rough [40, 0, 0, 0]\n\
    arc [40, 0, 0, 0]\n\
    ring [39, 0, 0, 1]\n\
    arm [38, 2, 0, 0]\n\
    thin [40, 0, 0, 0]\n";

fn solved(hard: &Hard) -> Result<Solution, Error> {
    written(hard, &Writing { degrees: hard.degrees, ..Default::default() })
}

fn written(hard: &Hard, writing: &Writing) -> Result<Solution, Error> {
    solve(&Request::new(&hard.scene(writing)), &mut |_| ())
}

/// Holds an equilibrium against the conditions of contact in the shape that it reaches.
fn check(hard: &Hard, solution: &Solution, what: &str) {
    let (model, u) = (&*solution.model, &solution.u);
    let surfaces = Surfaces::new(model).expect("surfaces");
    let shape = model.shape(u);
    let measured_in = match hard.geometry {
        Geometry::Initial => &model.nodes,
        Geometry::Current => &shape,
    };
    let mut left = stiffness_times(model, u) - &model.load;
    let most = left.amax();
    let size = model.bounds().larger_side();
    for pairing in surfaces.pairings(hard.coupling, measured_in).iter().flatten() {
        let Pairing { node, normal: [nx, ny], masters, .. } = pairing;
        let [rx, ry] = node.components(&left);
        let (p, q) = (nx * rx + ny * ry, nx * ry - ny * rx);
        let gap = pairing.opening(|node| shape[node.index()]);
        let is_near = |name: &str, x: f64, scale: f64| {
            assert_near(&format!("{what}: {name} at node {node}"), x, 0.0, scale, &HARD);
        };
        is_near("pull", (-p).max(0.0), most);
        is_near("overlap", (-gap).max(0.0), size);
        is_near("work of the gap", (p / most) * (gap.max(0.0) / size), 1.0);
        is_near("friction beyond its bound", (q.abs() - hard.mu * p.max(0.0)).max(0.0), most);
        let weights = std::iter::once((*node, 1.0));
        for (node, w) in weights.chain(masters.iter().map(|(master, w)| (*master, -w))) {
            for (dof, r) in node.dofs().into_iter().zip([rx, ry]) {
                left[dof.index()] -= w * r;
            }
        }
    }
    for dof in model.all_dofs().filter(|dof| !model.is_restrained(*dof)) {
        let what = format!("{what}: balance of node {}", dof.node());
        assert_near(&what, left[dof.index()], 0.0, most, &HARD);
    }
}

/// Returns K u from the paper's B and D alone, force.
fn stiffness_times(model: &Model, u: &DVector<f64>) -> DVector<f64> {
    let mut force = DVector::zeros(u.len());
    for id in model.triangle_ids() {
        let (triangle, corners) = (model.triangle(id), model.corners(id));
        let b = B(&corners);
        let d = D(model.plane, triangle.material.e, triangle.material.nu);
        let dofs: Vec<usize> =
            triangle.nodes.iter().flat_map(|n: &NodeId| n.dofs()).map(|dof| dof.index()).collect();
        let own = nalgebra::SVector::<f64, 6>::from_fn(|k, _| u[dofs[k]]);
        let forces = b.transpose() * (d * (b * own)) * (area(&corners) * model.thickness);
        dofs.iter().zip(forces.iter()).for_each(|(dof, f)| force[*dof] += f);
    }
    force
}

#[test]
fn equilibria_are_found_where_they_are_hard_to_find() {
    let kinds: [(&str, Draw); 5] =
        [("rough", rough), ("arc", arc), ("ring", ring), ("arm", arm), ("thin", thin)];
    let count =
        std::env::var("PLANE_CONTACT_HARD").map_or(SCENES, |n| n.parse().expect("a number"));
    let mut text = String::new();
    for (name, draw) in kinds {
        let mut counts = [0; 4];
        for seed in 0..count {
            let coupling = [Coupling::Mortar, Coupling::Nts][seed % 2];
            let hard = draw(&mut Rng::with_seed(seed as u64), coupling);
            let what = format!("{name} {seed}");
            let outcome = match solved(&hard) {
                Ok(solution) => {
                    check(&hard, &solution, &what);
                    let found = solution.equilibrium.as_ref().expect("unilateral");
                    usize::from(found.uniqueness.is_refuted())
                }
                Err(Error::Equilibrium(why)) => {
                    println!("{what}: {why}");
                    match why.cause {
                        Cause::NoneExists => 2,
                        Cause::NotFound | Cause::OutOfRange | Cause::Several => 3,
                    }
                }
                Err(why) => panic!("{what}: {why}"),
            };
            counts[outcome] += 1;
        }
        text += &format!("{name} {counts:?}\n");
    }
    if count == SCENES {
        assert_eq!(text, COUNTS);
    }
    println!("{text}");
}

/// Other numbers of nodes, triangles and bodies, and surfaces listed in another order.
#[test]
fn numbers_and_lists_change_no_answer() {
    let kinds: [Draw; 5] = [rough, arc, ring, arm, thin];
    for (kind, draw) in kinds.into_iter().enumerate() {
        for seed in 0..6 {
            let coupling = [Coupling::Mortar, Coupling::Nts][seed % 2];
            let hard = draw(&mut Rng::with_seed(seed as u64), coupling);
            let writing = Writing {
                degrees: hard.degrees,
                numbers: 1 + seed as u64,
                target_reversed: true,
                contact_reversed: seed % 3 == 0,
                edges_turned: seed % 3 == 1,
                ..Default::default()
            };
            let what = format!("kind {kind}, {seed}");
            match (solved(&hard), written(&hard, &writing)) {
                (Ok(one), Ok(other)) => {
                    let places = writing.places(one.model.nodes.len()).into_iter().enumerate();
                    let places: Vec<_> =
                        places.map(|(n, place)| [n, place].map(NodeId::new)).collect();
                    for [n, place] in places {
                        let ([x, y], [a, b]) = (n.components(&one.u), place.components(&other.u));
                        let most = one.u.amax();
                        assert_near(&format!("{what}: x of {n}"), a, x, most, &RENUMBERED);
                        assert_near(&format!("{what}: y of {n}"), b, y, most, &RENUMBERED);
                    }
                }
                (Err(one), Err(other)) => assert_eq!(one.exit_status(), other.exit_status()),
                (one, other) => panic!("{what}: {:?}, {:?}", one.err(), other.err()),
            }
        }
    }
}

/// A disc that can turn in its place is named, whatever the load, the geometry and the mesh.
#[test]
fn a_disc_that_can_turn_is_named() {
    for seed in 0..24 {
        let coupling = [Coupling::Mortar, Coupling::Nts][seed % 2];
        let mut hard = disc(&mut Rng::with_seed(seed as u64), coupling);
        let words = solved(&hard).expect_err("it can turn").to_string();
        assert!(words.contains("can turn about (0"), "{seed}: {words}");
        // Two nodes across hold it, and so does friction, on its own mesh.
        let held = hard.bodies.restrained.pop().expect("it is held");
        hard.bodies.restrained.extend([held.clone(), (held.0 + 3, held.1)]);
        if let Err(why) = solved(&hard) {
            assert!(!why.to_string().contains("can turn"), "{seed}: {why}");
        }
    }
}

/// Bodies that overlap and are held by contact alone start where a vanishing load brings them. Where it holds them in no
/// place without friction, there is no start, but for flat ones: there all nodes touch at once and none slips.
#[test]
fn an_overlap_that_comes_apart_in_many_ways_has_no_start() {
    for seed in 0..40 {
        let coupling = [Coupling::Mortar, Coupling::Nts][seed % 2];
        let mut hard = rough(&mut Rng::with_seed(seed as u64), coupling);
        let first = hard.bodies.triangles[1].iter().flatten().min().copied().expect("a body");
        let overlaps = |why: &Error| why.to_string().contains("the start is not determined");
        assert!(!solved(&hard).err().as_ref().is_some_and(overlaps), "{seed}: the load holds it");
        hard.bodies.restrained.retain(|(node, _)| *node < first);
        hard.bodies.nodes[first..].iter_mut().for_each(|[_, y]| *y -= 0.01);
        hard.bodies.loads.iter_mut().for_each(|(_, force)| *force = [1.0, 0.0]);
        let why = solved(&hard).expect_err("nothing holds it");
        let none = why.to_string().contains("there is no equilibrium");
        assert!(none && why.exit_status().number() == 4, "{seed}: {why}");
        // What the load stretches alone needs no holding.
        hard.bodies.loads.iter_mut().for_each(|(_, force)| *force = [0.0; 2]);
        let last = hard.bodies.loads.len() - 1;
        (hard.bodies.loads[0].1, hard.bodies.loads[last].1) = ([-1.0, 0.0], [1.0, 0.0]);
        let y = |n: usize| hard.bodies.nodes[n][1];
        let is_level = |nodes: &[usize]| nodes.iter().all(|n| y(*n) == y(nodes[0]));
        let is_flat = is_level(&hard.bodies.contact) && is_level(hard.bodies.target.as_flattened());
        let why = solved(&hard).err();
        assert_eq!(why.as_ref().is_some_and(overlaps), !is_flat, "{seed}: {why:?}");
    }
}
