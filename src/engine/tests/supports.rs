//! Restraints along directions that are no axes, and displacements other than 0, beside the same scenes turned and
//! closed forms.

use approx::assert_relative_eq;
use engine::error::Error;
use engine::{Request, Solution, SupportForce, resultant};
use problem::element::Plane;
use problem::modelling::{Friction, Geometry, Variant};
use problem::scene::{Axis, Contact, MeshBuilder, Scene, SceneBuilder};

/// The modulus of both blocks, stress.
const E: f64 = 1000.0;

/// The rounding of two runs on coordinates that differ in the last digit, relative.
const TURNED: f64 = 1e-9;

fn solve(scene: &Scene, variant: Variant) -> Result<Solution, Error> {
    engine::solve(&Request::new(scene).variant(variant), &mut |_| ())
}

/// Two blocks of width 2, each of height 1, the upper one on the lower one, all turned by an angle about the origin.
///
/// ```text
///      o---o---o   top
///      | / | / |
///      o---o---o   contact
///      o---o---o   target
///      | / | / |
///      o---o---o   bottom
/// ```
fn blocks(degrees: f64, friction: Friction) -> SceneBuilder {
    let (s, c) = degrees.to_radians().sin_cos();
    let mut mesh = MeshBuilder::default();
    let mut row = |y: f64| mesh.row([0.0, 1.0, 2.0].map(|x| [c * x - s * y, s * x + c * y]));
    let (bottom, target, contact, top) = (row(0.0), row(1.0), row(1.0), row(2.0));
    mesh.join("lower", &bottom, &target);
    mesh.join("upper", &contact, &top);
    for (name, nodes) in
        [("bottom", &bottom), ("target", &target), ("contact", &contact), ("top", &top)]
    {
        mesh.edges(name, nodes);
    }
    mesh.edges("side", &[bottom[0], target[0]]);
    let rubbing = Contact {
        friction: Some(friction),
        geometry: Geometry::Initial,
        ..Contact::new("contact", "target", 0.001)
    };
    SceneBuilder::new("blocks", mesh.finish(), Plane::Stress)
        .variant(Variant::Stepped)
        .material("lower", E, 0.3)
        .material("upper", E, 0.3)
        .contact(rubbing)
}

/// Blocks on a roller along their bottom, held along it at one node, pressed and pushed at the top.
fn on_a_slope(degrees: f64) -> Scene {
    let (s, c) = degrees.to_radians().sin_cos();
    let mu = Friction::new(0.5).expect("a coefficient");
    let [normal, push] = [[-s, c], [c, s]];
    blocks(degrees, mu)
        .restrain("bottom", &[Axis::Normal])
        .restrain_node(1, &[Axis::Direction(push)])
        .traction("top", [0, 1].map(|d| -3.0 * normal[d] + 0.6 * push[d]))
        .build()
        .expect("it is sound")
}

#[test]
fn a_roller_on_a_slope_carries_what_one_along_an_axis_does() {
    let flat = solve(&on_a_slope(0.0), Variant::Unilateral).expect("there is an equilibrium");
    for degrees in [17.0, 45.0, 90.0, 200.0] {
        let turned = solve(&on_a_slope(degrees), Variant::Unilateral).expect("as above");
        let (s, c) = f64::to_radians(degrees).sin_cos();
        let back = |[x, y]: [f64; 2]| [c * x + s * y, c * y - s * x];
        let size = flat.u.amax();
        for (one, other) in flat.displacements().into_iter().zip(turned.displacements()) {
            let other = back(other);
            (0..2).for_each(|d| {
                assert_relative_eq!(one[d], other[d], epsilon = TURNED * size, max_relative = 0.0);
            });
        }
        let [flat, turned] = [&flat, &turned].map(SupportForce::all);
        for (one, other) in flat.iter().zip(&turned) {
            let other = back(other.reaction);
            (0..2).for_each(|d| assert_relative_eq!(one.reaction[d], other[d], epsilon = 1e-8));
        }
    }
}

#[test]
fn reactions_balance_the_load() {
    let solution = solve(&on_a_slope(30.0), Variant::Unilateral).expect("there is an equilibrium");
    let rows = SupportForce::all(&solution);
    let load = solution.model.total_load();
    for d in [0, 1] {
        let sum: f64 = rows.iter().map(|row| row.reaction[d]).sum();
        assert_relative_eq!(sum, -load[d], epsilon = 1e-9);
    }
}

/// Two blocks in a row press each other by u / 2 each: the stress is E u / 2 where Poisson's ratio does nothing.
#[test]
fn a_displaced_edge_presses_as_hooke_has_it() {
    for degrees in [0.0, 30.0] {
        let (s, c) = f64::to_radians(degrees).sin_cos();
        let scene = blocks(degrees, Friction::NONE)
            .restrain("bottom", &[Axis::Normal])
            .restrain_node(1, &[Axis::Direction([c, s])])
            .restrain_node(10, &[Axis::Direction([c, s])])
            .displace("top", Axis::Normal, -0.01)
            .build()
            .expect("it is sound");
        let solution = solve(&scene, Variant::Unilateral).expect("there is an equilibrium");
        let stress = E * 0.01 / 2.0;
        for state in &solution.elements {
            assert_relative_eq!(state.von_mises_stress, stress, max_relative = 1e-9);
        }
        let top = &SupportForce::all(&solution)[3];
        assert_eq!((&*top.restraint, top.nodes), ("top", 3));
        let along = -s * top.reaction[0] + c * top.reaction[1];
        assert_relative_eq!(along, -2.0 * stress, max_relative = 1e-9);
        assert_relative_eq!(solution.target_force(), 2.0 * stress, max_relative = 1e-9);
        let passed = resultant(&solution).expect("two bodies meet");
        let back = |[x, y]: [f64; 2]| [c * x + s * y, c * y - s * x];
        let ([fx, fy], [x, _]) = (back(passed.force), back(passed.through.expect("it presses")));
        assert_relative_eq!(fx, 0.0, epsilon = 1e-9 * stress);
        assert_relative_eq!(fy, -2.0 * stress, max_relative = 1e-9);
        assert_relative_eq!(x, 1.0, max_relative = 1e-9);
    }
}

#[test]
fn the_displacement_grows_with_the_steps_of_the_load() {
    let mu = Friction::new(0.3).expect("a coefficient");
    let scene = blocks(0.0, mu)
        .restrain("bottom", &[Axis::X, Axis::Y])
        .displace("top", Axis::Y, -0.01)
        .restrain_node(10, &[Axis::X])
        .build()
        .expect("it is sound");
    let solution = solve(&scene, Variant::Unilateral).expect("there is an equilibrium");
    let forces: Vec<f64> = solution.steps.iter().map(|step| step.target_force).collect();
    let [first, last] = [forces[0], solution.target_force()];
    assert!(first > 0.0 && first < last / 2.0, "{forces:?}");
}

#[test]
fn the_listings_hold_along_axes_alone() {
    for variant in [Variant::Printed, Variant::Tied, Variant::Stepped] {
        let why = solve(&on_a_slope(30.0), variant).expect_err("S has no directions").to_string();
        assert!(why.contains("lines 7 and 8") && why.contains("unilateral"), "{why}");
        let along_axes = solve(&on_a_slope(0.0), variant).map(|solution| solution.target_force());
        assert!(!matches!(along_axes, Err(Error::Input(_))), "{along_axes:?}");
    }
}

/// Fields by node, point and restraint are those of the whole arrays.
#[test]
fn fields_are_read_by_node_point_and_restraint() {
    let solution = solve(&on_a_slope(30.0), Variant::Unilateral).expect("there is an equilibrium");
    assert_eq!(solution.displacement(0), None);
    assert_eq!(solution.displacement(3), Some([solution.u[4], solution.u[5]]));
    assert_eq!(solution.displacement(solution.model.nodes.len() + 1), None);
    for (triangle, state) in solution.model.triangles.iter().zip(&solution.elements) {
        let corners = triangle.nodes.map(|node| solution.model.nodes[node.index()]);
        let [x, y] = [0, 1].map(|d| corners.iter().map(|corner| corner[d]).sum::<f64>() / 3.0);
        assert_eq!(solution.stress_at(x, y), Some(state.sigma.into()));
    }
    assert_eq!(solution.stress_at(99.0, 99.0), None);
    let rows = SupportForce::all(&solution);
    for row in &rows {
        let same = rows.iter().filter(|other| other.restraint == row.restraint);
        let sum = same.fold([0.0; 2], |[x, y], row| [x + row.reaction[0], y + row.reaction[1]]);
        assert_eq!(solution.reaction(&row.restraint), Some(sum));
    }
    assert_eq!(solution.reaction("no such group"), None);
}
