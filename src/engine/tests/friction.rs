//! Coulomb friction along the path of the load, beside closed forms.

use engine::contact::Status;
use engine::error::Error;
use engine::{self, Assessment, Request, Solution};
use problem::element::Plane;
use problem::modelling::{ContactModel, Friction, Geometry, Variant};
use problem::scene::{Axis, Contact, MeshBuilder, Scene, SceneBuilder};
use testing::tolerances::{BALANCE, assert_near};

testing::tolerances! {
    /// The slip of a pulled strip beside that of a bar, in heights over the length of the slip for its end, in heights
    /// for its edge.
    SHEAR_LAG = 1.2, "a strip is no bar over one height, and slip ends at a node";
    /// The zone of stick under partial slip, relative to Cattaneo's and Mindlin's.
    CATTANEO = 0.035, "fitted on 15 to 25 nodes; 0.6, 1.4 and 3.3 % measured, 0.2 % with 70 nodes";
    /// How far a sticking node moves on a foundation of a modulus a million times as large.
    DISSIPATION = 1e-5, "the foundation yields by its modulus over the strip's";
    /// Displacements under a coefficient of 1000 beside those of nodes that never slide.
    LARGE_FRICTION = 1e-5, "what is left of the size of the steps";
    /// Displacements in 16 steps of the load beside those in 32.
    LOAD_STEP = 1e-5, "a node that slips and then sticks within a step; 3e-6 measured";
}

fn rubbing(mu: f64) -> Contact {
    Contact {
        friction: Some(Friction::new(mu).expect("a coefficient")),
        geometry: Geometry::Initial,
        ..Contact::new("contact", "target", 0.001)
    }
}

fn solve(scene: &Scene) -> Result<Solution, Error> {
    engine::solve(&Request::new(scene).variant(Variant::Unilateral), &mut |_| ())
}

/// A strip of length 10 and height `h` in `n` parts, pressed with 1 on a rigid foundation, then
/// pulled at its right end with `pull` times the friction of its whole length.
///
/// ```text
///        | | | | | | | |  1
///      o-----------------o
///      |                 | --> pull · μ · 10
///      o-----------------o            slip length l = pull · 10, from the right end
///    ///////////////////////          u = μ s² / (2 E h) at the distance s from the slip's edge
/// ```
fn strip(n: usize, h: f64, pull: f64, mu: f64) -> SceneBuilder {
    let mut mesh = MeshBuilder::default();
    let row = |mesh: &mut MeshBuilder, y: f64| {
        mesh.row((0..=n).map(|i| [10.0 * i as f64 / n as f64, y]).collect::<Vec<_>>())
    };
    let foundation =
        |mesh: &mut MeshBuilder, y: f64| mesh.row([-1.0, 3.0, 7.0, 11.0].map(|x| [x, y]));
    let (bottom, target) = (foundation(&mut mesh, -1.0), foundation(&mut mesh, 0.0));
    let (contact, top) = (row(&mut mesh, 0.0), row(&mut mesh, h));
    mesh.join("foundation", &bottom, &target);
    mesh.join("strip", &contact, &top);
    mesh.edges("target", &target);
    mesh.edges("contact", &contact);
    mesh.edges("top", &top);
    mesh.edges("bottom", &bottom);
    mesh.edges("end", &[contact[n], top[n]]);
    SceneBuilder::new("strip", mesh.finish(), Plane::Stress)
        .variant(Variant::Stepped)
        .material("foundation", 1e9, 0.0)
        .material("strip", 1e3, 0.0)
        .restrain("bottom", &[Axis::X, Axis::Y])
        .pressure("top", 1.0)
        .traction("end", [pull * mu * 10.0 / h, 0.0])
        .in_stage(2)
        .contact(rubbing(mu))
}

/// The pulled strip slips over the length that carries the pull, and its end moves as the shear lag
/// of a bar says, but for what is not a bar in it: its height.
#[test]
fn a_pulled_strip_slips_over_the_length_that_carries_the_pull() {
    let (pull, mu) = (0.6, 0.5);
    for (n, h) in [(40, 0.5), (80, 0.25), (160, 0.1)] {
        let scene = strip(n, h, pull, mu).build().unwrap();
        let solution = solve(&scene).unwrap();
        let length = pull * 10.0;
        let slipping =
            solution.contact.iter().filter(|c| matches!(c.status, Some(Status::Slip(_))));
        let first = slipping.map(|c| c.arc).fold(f64::INFINITY, f64::min);
        assert_near("slip length", 10.0 - first, length, h + 10.0 / n as f64, &SHEAR_LAG);
        let end = solution.contact.last().unwrap().node.components(&solution.u)[0];
        let exact = mu * length * length / (2.0 * 1e3 * h);
        assert_near("end", end, exact, exact * h / length, &SHEAR_LAG);
        let shear: f64 =
            solution.contact.iter().map(|c| c.friction_needed.unwrap() * c.force.unwrap()).sum();
        assert_near("friction", shear, pull * mu * 10.0, 5.0, &BALANCE);
    }
}

#[test]
fn beyond_the_friction_of_its_whole_length_a_strip_finds_no_equilibrium() {
    let error = solve(&strip(10, 0.5, 1.01, 0.5).build().unwrap()).unwrap_err();
    assert_eq!(error.exit_status().number(), 4, "{error}");
    let words =
        "body \"strip\" slides as a whole from 0.99 of stage 2 on; it needs a coefficient of 0.505";
    assert!(error.to_string().contains(words), "{error}");
}

/// Slip works against friction in every step, and only sliding nodes slip.
#[test]
fn friction_dissipates() {
    let scene = strip(40, 0.5, 0.6, 0.5).build().unwrap();
    let solution = solve(&scene).unwrap();
    let dissipated: f64 = solution
        .contact
        .iter()
        .map(|c| {
            let slip = c.node.components(&solution.u)[0];
            let force = c.friction_needed.unwrap() * c.force.unwrap();
            if c.status == Some(Status::Stick) {
                assert_near("a sticking node", slip, 0.0, solution.u.amax(), &DISSIPATION);
            }
            assert!(slip >= -1e-12, "node {} slips against the pull", c.node);
            slip * force
        })
        .sum();
    assert!(dissipated > 0.0);
}

/// Distances from the middle: `n` steps of `step`, then longer and longer ones to 160.
fn graded(n: usize, mut step: f64, growth: f64) -> Vec<f64> {
    let mut x: Vec<f64> = (0..=n).map(|i| step * i as f64).collect();
    while x[x.len() - 1] + step * growth < 160.0 {
        step *= growth;
        x.push(x[x.len() - 1] + step);
    }
    x.push(160.0);
    x
}

/// A parabola of radius 1000 pressed on a block of the same material to the half width 1, then
/// sheared by the part `shear` of what friction can carry. `n` elements lie on 1.6 half widths.
fn cattaneo(n: usize, shear: f64, mu: f64) -> (SceneBuilder, f64) {
    let (e, nu, radius) = (1e3, 0.3, 1e3);
    let load = std::f64::consts::PI * e / (2.0 * (1.0 - nu * nu)) / (4.0 * radius);
    let half = graded(n, 1.6 / n as f64, 1.35);
    let x: Vec<f64> = half[1..].iter().rev().map(|x| -x).chain(half.iter().copied()).collect();
    let depth = graded(1, 1.6 / n as f64, 1.25);
    let bulge =
        |x: f64| x.abs().min(1.65).powi(2) / (2.0 * radius) + 0.02 * (x.abs() - 1.65).max(0.0);
    let mut mesh = MeshBuilder::default();
    let lower: Vec<Vec<usize>> =
        depth.iter().rev().map(|y| mesh.row(x.iter().map(|x| [*x, -y]))).collect();
    let upper: Vec<Vec<usize>> = depth
        .iter()
        .map(|y| mesh.row(x.iter().map(|x| [*x, y + (1.0 - y / 160.0) * bulge(*x)])))
        .collect();
    lower.windows(2).for_each(|rows| mesh.join("lower", &rows[0], &rows[1]));
    upper.windows(2).for_each(|rows| mesh.join("upper", &rows[0], &rows[1]));
    let side = |end: usize| lower.iter().map(|row| row[end]).collect::<Vec<_>>();
    let middle = x.len() / 2;
    mesh.edges("left", &side(0));
    mesh.edges("right", &side(x.len() - 1));
    mesh.edges("bottom", &lower[0]);
    mesh.edges("target", lower.last().unwrap());
    mesh.edges("contact", &upper[0][middle - n..=middle + n]);
    mesh.edges("top", upper.last().unwrap());
    let scene = SceneBuilder::new("cattaneo", mesh.finish(), Plane::Strain)
        .variant(Variant::Stepped)
        .material("lower", e, nu)
        .material("upper", e, nu)
        .restrain("top", &[Axis::Y])
        .restrain("left", &[Axis::X])
        .restrain("right", &[Axis::X])
        .pressure("bottom", load / 320.0)
        .traction("top", [shear * mu * load / 320.0, 0.0])
        .in_stage(2)
        .contact(Contact { load_steps: 2, ..rubbing(mu) });
    (scene, load)
}

/// Returns the half width of the parabola that fits the squares of `values` at `places`, those
/// beyond a quarter of the largest: of an ellipse, its half axis.
fn half_width(places: &[f64], values: &[f64]) -> f64 {
    let most = values.iter().copied().fold(0.0, f64::max);
    let large: Vec<(f64, f64)> = places
        .iter()
        .zip(values)
        .filter(|(_, value)| **value > 0.25 * most)
        .map(|(x, value)| (*x, value * value))
        .collect();
    let rows = large.iter().flat_map(|(x, _)| [1.0, *x, x * x]);
    let matrix = nalgebra::DMatrix::from_row_iterator(large.len(), 3, rows);
    let right = nalgebra::DVector::from_iterator(large.len(), large.iter().map(|(_, y)| *y));
    let fit = matrix.svd(true, true).solve(&right, 0.0).unwrap();
    let centre = -fit[1] / (2.0 * fit[2]);
    (centre * centre - fit[0] / fit[2]).sqrt()
}

/// GOAL: Cattaneo's and Mindlin's zone of stick, c/a = √(1 − Q/(μ P)) in the plane. SOURCE: K. L.
/// Johnson, Contact Mechanics, section 7.2(a). MESH: parabola of radius 1000 a on a block 320 a
/// wide, equal materials. PARAMETERS: Q/(μ P) of 0.25 and 0.5; μ = 0.3.
#[test]
fn the_zone_of_stick_is_cattaneos_and_mindlins() {
    for shear in [0.25, 0.5] {
        let (scene, load) = cattaneo(24, shear, 0.3);
        let solution = solve(&scene.build().unwrap()).unwrap();
        let at: Vec<f64> = solution
            .contact
            .iter()
            .map(|c| c.node.index())
            .map(|n| solution.model.nodes[n][0])
            .collect();
        let normal: Vec<f64> = solution.contact.iter().map(|c| c.force.unwrap()).collect();
        let tangent: Vec<f64> = solution
            .contact
            .iter()
            .zip(&normal)
            .map(|(c, p)| c.friction_needed.map_or(0.0, |needed| needed * p))
            .collect();
        let spare: Vec<f64> = normal.iter().zip(&tangent).map(|(p, q)| 0.3 * p - q).collect();
        assert_near("load", normal.iter().sum(), load, load, &BALANCE);
        assert_near("shear", tangent.iter().sum(), shear * 0.3 * load, load, &BALANCE);
        let exact = (1.0 - shear).sqrt();
        let ratio = half_width(&at, &spare) / half_width(&at, &normal);
        assert_near(&format!("c/a at {shear}"), ratio, exact, exact, &CATTANEO);
    }
}

/// A strand under friction from none to more than any node needs.
#[test]
fn friction_reaches_from_none_to_stick() {
    let scene = Scene::open("strand").unwrap();
    let of = |mu: f64, load_steps: usize| {
        let friction = Friction::new(mu).unwrap();
        let contact = ContactModel { friction, load_steps, ..scene.contact };
        let request = Request::new(&scene).variant(Variant::Unilateral).contact(contact);
        engine::solve(&request, &mut |_| ()).unwrap()
    };
    let near = |what: &str, a: &Solution, b: &Solution, limit| {
        assert_near(what, (&a.u - &b.u).amax(), 0.0, b.u.amax(), limit);
    };
    near("without friction", &of(1e-14, 8), &of(0.0, 8), &BALANCE);
    near("much friction", &of(1e3, 16), &of(f64::INFINITY, 16), &LARGE_FRICTION);
    near("steps of the load", &of(0.2, 16), &of(0.2, 32), &LOAD_STEP);
    let solution = of(0.2, 16);
    let change = Assessment::new(&solution).path_change.expect("16 is even").unwrap();
    assert!(change < 1e-5 * solution.u.amax(), "{change:e}");
}

/// A stage only adds its load: nothing else of the scene changes, and without friction the path has
/// no effect.
#[test]
fn stages_sum_to_the_load() {
    let staged = strip(10, 0.5, 0.3, 0.5);
    let mut at_once = staged.clone();
    at_once.description.loads.iter_mut().for_each(|load| load.stage = None);
    let [staged, at_once] = [staged, at_once].map(|scene| scene.build().unwrap());
    assert_eq!(staged.model.load, at_once.model.load);
    assert_eq!((staged.model.stages.len(), at_once.model.stages.len()), (2, 1));
    assert_eq!(at_once.model.stages[0], at_once.model.load);
    let [a, b] = [&staged, &at_once].map(|scene| {
        let contact = ContactModel { friction: Friction::STICK, ..scene.contact };
        let request = Request::new(scene).variant(Variant::Unilateral).contact(contact);
        engine::solve(&request, &mut |_| ()).unwrap().u
    });
    assert_near("stuck from the start", (&a - &b).amax(), 0.0, a.amax(), &BALANCE);
}
