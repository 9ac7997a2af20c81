//! Five problems of engineers, from the geometry of Gmsh to numbers that textbooks have.

use std::f64::consts::PI;
use std::fs;
use std::path::Path;
use std::process::Command;

use serde_json::Value;
use tempfile::TempDir;

use crate::common::program::run;
use crate::common::tolerances::assert_near;
use crate::common::tools::has;

testing::tolerances! {
    /// Forces and pressures of the five problems meshed by Gmsh, relative to the textbook's.
    GMSH = 0.03,
        "meshes of 400 to 3,400 nodes: 0.3 % was measured at the press fit, 0.2 % at the cylinders, 1 % at the punch \
         and the ring, whose thickness is a tenth of its radius";
}

/// What the program has for a scene of the folder `gmsh`, whose mesh is made here; nothing without Gmsh.
fn solved(name: &str, edit: impl Fn(String) -> String) -> Option<(Option<i32>, Value)> {
    if !has("gmsh --version", "REQUIRE_GMSH") {
        return None;
    }
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/program/gmsh");
    let folder = TempDir::new().expect("a folder");
    let scene = fs::read_to_string(source.join(format!("{name}.json"))).expect("a scene");
    fs::write(folder.path().join("scene.json"), edit(scene)).expect("written");
    let mesh = Command::new("gmsh")
        .args(["-2", "-v", "2"])
        .arg(source.join(format!("{name}.geo")))
        .arg("-o")
        .arg(folder.path().join(format!("{name}.msh")))
        .status();
    assert!(mesh.expect("gmsh starts").success(), "{name}");
    let output = run(folder.path(), &["solve", "scene.json", "--json"]);
    Some((output.status.code(), serde_json::from_slice(&output.stdout).expect("JSON")))
}

/// The same of a scene that is solved.
fn result(name: &str) -> Option<Value> {
    let (status, result) = solved(name, |scene| scene)?;
    assert_eq!(status, Some(0), "{name}: {result}");
    Some(result)
}

fn number(result: &Value, at: &str) -> f64 {
    result.pointer(at).and_then(Value::as_f64).expect(at)
}

/// Lamé: S. Timoshenko and J. N. Goodier, Theory of Elasticity, section 28.
#[test]
fn a_ring_pressed_into_a_hub() {
    let Some(result) = result("pressfit") else { return };
    let (a, b, c, e, overlap) = (10.0_f64, 20.0_f64, 40.0_f64, 210e3, 0.01);
    let [a, square, c] = [a, b, c].map(|x| x * x);
    let pressure = e * overlap / b * (square - a) * (c - square) / (2.0 * square * (c - a));
    for direction in [0, 1] {
        let force = number(&result, &format!("/resultant/force/{direction}"));
        assert_near("force on the hub", force, pressure * b, pressure * b, &GMSH);
    }
    assert!(result["hertz"].is_null(), "the pressure is no ellipse");
}

/// Hertz: K. L. Johnson, Contact Mechanics, section 4.2(c).
#[test]
fn a_cylinder_on_another() {
    let Some(result) = result("hertz") else { return };
    let (load, modulus, radius) = (2.0 * 2000.0, 210e3 / (2.0 * (1.0 - 0.09)), 5.0);
    let peak = (load * modulus / (PI * radius)).sqrt();
    let pressures = result["contact"].as_array().expect("a list").iter();
    let largest = pressures.filter_map(|node| node["pressure"].as_f64()).fold(0.0, f64::max);
    assert_near("peak pressure", largest, peak, peak, &GMSH);
    assert_near("Hertz's own", number(&result, "/hertz/peak"), peak, peak, &GMSH);
}

/// Up to Poisson's ratio 0.45 the peak is Hertz's within a few per cent; nearer to 0.5 linear triangles lock.
#[test]
fn a_cylinder_that_is_nearly_incompressible() {
    for (nu, is_said, least, most) in
        [(0.45_f64, false, 0.95, 1.03), (0.49, true, 1.02, 1.2), (0.499, true, 1.08, 9.0)]
    {
        let edit = |scene: String| scene.replace("0.3 }", &format!("{nu} }}"));
        let Some((status, result)) = solved("hertz", edit) else { return };
        assert_eq!((status, result["locking"].is_string()), (Some(0), is_said), "{nu}");
        let peak = (2.0 * 2000.0 * 210e3 / (2.0 * (1.0 - nu * nu)) / (PI * 5.0)).sqrt();
        let pressures = result["contact"].as_array().expect("a list").iter();
        let largest = pressures.filter_map(|node| node["pressure"].as_f64()).fold(0.0, f64::max);
        assert!((least * peak..most * peak).contains(&largest), "{nu}: {largest}, {peak}");
    }
}

/// A flat rigid punch on a half-plane, in its middle: K. L. Johnson, Contact Mechanics, eq. (2.64).
#[test]
fn a_flat_punch() {
    let Some(result) = result("punch") else { return };
    let middle = 2.0 * 50.0 / (PI * 5.0);
    assert_near("pressure", number(&result, "/contact/0/pressure"), middle, middle, &GMSH);
    assert!(result["hertz"].is_null(), "the pressure is no ellipse");
}

/// A block on a slope of 20 degrees needs a coefficient of friction of tan 20 = 0.364.
#[test]
fn a_block_on_a_slope() {
    let Some(result) = result("slope") else { return };
    assert_near("weight", number(&result, "/resultant/force/1"), -40.0, 40.0, &GMSH);
    assert!(result["hertz"].is_null(), "the surfaces are flat");
    let less = |scene: String| scene.replace("0.38", "0.35");
    let (status, failure) = solved("slope", less).expect("gmsh is there");
    assert_eq!(status, Some(4), "{failure}");
    let words = failure["failure"]["message"].as_str().expect("words");
    assert!(words.contains("body \"block\" slides as a whole"), "{words}");
    assert!(words.contains("0.364"), "{words}");
}

/// A thin ring under two forces: S. Timoshenko, Strength of Materials II, section 80.
#[test]
fn a_ring_between_plates() {
    let Some(result) = result("ring") else { return };
    let (e, radius, height, change) = (200e3, 20.0_f64, 2.0_f64, 0.02);
    let force = change * e * height.powi(3) / 12.0 / ((PI / 4.0 - 2.0 / PI) * radius.powi(3));
    assert_near("half the force", number(&result, "/resultant/force/1"), force / 2.0, force, &GMSH);
}
