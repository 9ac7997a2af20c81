//! Result files read back as they were written.

use plane_contact::engine::linear::{Arithmetic, ScalarName};
use plane_contact::engine::plan::Plan;
use plane_contact::engine::{Assessment, Request, solve};
use plane_contact::output::{MOST_TRIANGLES, ResultFile};
use plane_contact::problem::modelling::{ContactModel, Friction, Variant};
use plane_contact::problem::scene::Scene;

fn result(scene: &str, changed: impl Fn(Request) -> Request) -> ResultFile {
    let scene = Scene::open(scene).expect("an embedded scene");
    let solution = solve(&changed(Request::new(&scene)), &mut |_| ()).expect("it is solved");
    let plan = Plan::new(&solution.request).expect("it was solved");
    ResultFile::new(&solution, &Assessment::new(&solution), Some(&plan))
}

#[test]
fn results_read_back() {
    let exact = Arithmetic { scalar: ScalarName::Exact, ..Arithmetic::default() };
    let sliding = ContactModel { friction: Friction::NONE, ..ContactModel::default() };
    for written in [
        result("fig1", |request| request),
        result("two-blocks", |request| request.arithmetic(exact)),
        result("fig1", |request| request.variant(Variant::Unilateral).contact(sliding)),
    ] {
        let text = written.to_json();
        let read = ResultFile::from_json(&text).expect("it was written by the same type");
        assert_eq!(read, written);
        assert_eq!(read.to_json(), text);
    }
}

#[test]
fn what_is_not_finite_is_null() {
    let mut result = result("fig1", |request| request);
    let estimates = result.error_estimates.as_mut().expect("they were asked for");
    estimates.mesh_energy_relative = None;
    let distance = result.distance.as_mut().expect("fig1 has a reference solution");
    distance.displacement_relative = f64::INFINITY;
    result.contact[0].force = None;
    let text = result.to_json();
    for field in ["mesh_energy_relative", "displacement_relative", "force"] {
        let null = [": null", ":null"].map(|null| format!("\"{field}\"{null}"));
        assert!(null.iter().any(|null| text.contains(null)), "{field}: {text}");
    }
    assert_eq!(ResultFile::from_json(&text).map(|read| read.to_json()), Ok(text));
}

#[test]
fn a_wrong_field_is_named() {
    let text = result("fig1", |request| request).to_json();
    let wrong = text.replace("\"k\": 2,", "\"k\": \"second\",");
    let error = ResultFile::from_json(&wrong).expect_err("a number is asked for");
    assert!(error.place.starts_with("field iterations[1].k, line "), "{}", error.place);
}

#[test]
fn numbers_that_no_mesh_has_are_refused() {
    let text = result("fig1", |request| request).to_json();
    let read = |number: &str| {
        let (before, after) = text.split_once("\"at\":").expect("a body has a largest stress");
        let (_, rest) = after.split_once(',').expect("more follows");
        ResultFile::from_json(&format!("{before}\"at\":{number},{rest}"))
    };
    let largest = read("2147483648").expect("all of its degrees of freedom have numbers");
    assert_eq!(largest.bodies[0].at.number(), 1 << 31);
    for (number, words) in [("0", "count from 1"), ("2147483649", "so large"), ("5e15", "number")] {
        let error = read(number).expect_err(number);
        assert!(
            error.place.starts_with("field bodies[0].at") && error.what.contains(words),
            "{error}"
        );
    }
}

#[test]
fn fields_of_a_large_mesh_are_elsewhere_unless_asked_for() {
    let mut scene = Scene::open("two-blocks").expect("an embedded scene");
    while scene.model.triangles.len() <= MOST_TRIANGLES {
        scene = scene.refined().expect("a finer mesh").scene;
    }
    let solution = solve(&Request::new(&scene), &mut |_| ()).expect("it is solved");
    assert!(solution.elements.len() > MOST_TRIANGLES);
    let assessment = Assessment::without_estimates(&solution);
    assert!(assessment.estimates.is_none());
    let written = ResultFile::new(&solution, &assessment, None);
    let text = written.to_json();
    assert!(text.len() < 100_000 && text.contains("\"fields_in\": \"fields.vtu\""), "{text}");
    assert!(!text.contains("\"error_estimates\""));
    let read = ResultFile::from_json(&text).expect("it was written by the same type");
    assert_eq!(read, written);
    let missing = read.fields().expect_err("the fields are elsewhere").to_string();
    assert!(missing.contains("fields.vtu") && missing.contains("--fields"), "{missing}");
    let asked = ResultFile::from_json(&read.with_fields(&solution, &assessment).to_json())
        .expect("as above");
    let (nodes, elements) = asked.fields().expect("they were asked for");
    assert_eq!(nodes.u, solution.displacements());
    assert_eq!(elements.len(), solution.elements.len());
    assert_eq!(asked.fields_in, None);
}

#[test]
fn a_result_says_where_its_fields_are() {
    let text = result("fig1", |request| request).to_json();
    let end = text.find(",\n  \"elements\":").expect("the fields come last");
    let error = ResultFile::from_json(&(text[..end].to_owned() + "}")).expect_err("half of it");
    assert_eq!(error.place, "u and elements of the result");
}
