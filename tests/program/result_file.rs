//! `result.json` has the numbers of the run, to the bit.

use plane_contact::engine::linear::{Arithmetic, ScalarName};
use plane_contact::engine::{Assessment, Request, Solution, solve};
use plane_contact::output::{MOST_TRIANGLES, ResultFile};
use plane_contact::problem::modelling::{ContactModel, Friction, Variant};
use plane_contact::problem::scene::Scene;
use serde_json::{Value, json};

fn solved(scene: &Scene, changed: impl Fn(Request) -> Request) -> Solution {
    solve(&changed(Request::new(scene)), &mut |_| ()).expect("it is solved")
}

fn written(solution: &Solution, assessment: &Assessment, all_fields: bool) -> (Value, String) {
    let text = ResultFile::new(solution, assessment, None, all_fields).to_json();
    (serde_json::from_str(&text).expect("JSON"), text)
}

#[test]
fn numbers_read_back_to_the_bit() {
    let exact = Arithmetic { scalar: ScalarName::Exact, ..Arithmetic::default() };
    let sliding = ContactModel { friction: Friction::NONE, ..ContactModel::default() };
    let [fig1, two_blocks] =
        ["fig1", "two-blocks"].map(|scene| Scene::open(scene).expect("an embedded scene"));
    for solution in [
        solved(&fig1, |request| request),
        solved(&two_blocks, |request| request.arithmetic(exact)),
        solved(&fig1, |request| request.variant(Variant::Unilateral).contact(sliding)),
    ] {
        let (read, _) = written(&solution, &Assessment::new(&solution), false);
        assert_eq!(read["u"], json!(solution.displacements()));
        assert_eq!(read["contact"][0]["gap"], json!(solution.contact[0].gap));
        let stress = solution.elements[2].von_mises_stress;
        assert_eq!(read["elements"][2]["von_mises_stress"], json!(stress));
        let digits = read["u_digits"][0][1].as_str();
        assert_eq!(digits.is_some(), solution.digits.is_some());
        let parsed = digits.map(|digits| digits.parse::<f64>().expect("a decimal"));
        assert!(parsed.is_none_or(|y| y == solution.displacements()[0][1]));
    }
}

#[test]
fn what_is_not_finite_is_null_with_its_reason() {
    let mut solution = solved(&Scene::open("fig1").expect("embedded"), |request| request);
    solution.contact[0].force = None;
    let mut assessment = Assessment::new(&solution);
    let estimates = assessment.estimates.as_mut().expect("they were asked for");
    estimates.errors.mesh_energy_relative = None;
    let Some(Ok(measured)) = &mut assessment.reference else {
        panic!("it has a reference solution")
    };
    measured.distance.displacement_relative = f64::INFINITY;
    let (read, text) = written(&solution, &assessment, false);
    for pointer in [
        "/error_estimates/mesh_energy_relative",
        "/distance/displacement_relative",
        "/contact/0/force",
    ] {
        assert_eq!(read.pointer(pointer), Some(&Value::Null), "{pointer}: {text}");
        let (_, field) = pointer.rsplit_once('/').expect("it has one");
        assert!(
            read["nulls"].as_object().is_some_and(|nulls| nulls.contains_key(field)),
            "{field}: {text}"
        );
    }
}

#[test]
fn fields_of_a_large_mesh_are_elsewhere_unless_asked_for() {
    let mut scene = Scene::open("two-blocks").expect("an embedded scene");
    while scene.model.triangles.len() <= MOST_TRIANGLES {
        scene = scene.refined().expect("a finer mesh").scene;
    }
    let solution = solved(&scene, |request| request);
    assert!(solution.elements.len() > MOST_TRIANGLES);
    let assessment = Assessment::without_estimates(&solution);
    let (read, text) = written(&solution, &assessment, false);
    assert!(text.len() < 100_000, "{} bytes", text.len());
    assert_eq!(read["fields_in"], "fields.vtu");
    for absent in ["u", "elements", "error_estimates"] {
        assert_eq!(read.get(absent), None, "{absent}");
    }
    let (asked, _) = written(&solution, &assessment, true);
    assert_eq!(asked["u"], json!(solution.displacements()));
    assert_eq!(asked["elements"].as_array().map(Vec::len), Some(solution.elements.len()));
    assert_eq!(asked.get("fields_in"), None);
}
