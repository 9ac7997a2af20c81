//! The plan of a run: counts are exact, nothing that could be left out is passed over.
//!
//! A row of `plan.txt` is a variant, a solver or `-`, and a scene of `golden` as `testing::rows` has it.

use plane_contact::engine::linear::Arithmetic;
use plane_contact::engine::plan::{Idle, Plan};
use plane_contact::engine::{Request, solve};
use plane_contact::output::plan::line;
use serde_json::json;

use crate::common::golden_file::assert_rows;
use crate::common::rows::{scene_of, two_and_scene};

#[test]
fn plans() {
    let answer = |row: &str| {
        let [variant, solver, scene] = two_and_scene(row);
        let scene = scene_of("golden", scene).expect("it is sound");
        let solver = (solver != "-").then(|| solver.parse().expect("a solver"));
        let arithmetic = Arithmetic { solver, ..Arithmetic::default() };
        let request = Request::new(&scene).variant(variant.parse().expect("a variant"));
        let plan = Plan::new(&request.clone().arithmetic(arithmetic)).expect("it is sound");
        if plan.bodies.iter().any(|body| body.idle == Some(Idle::NoLoadNoContact)) {
            let u = solve(&request, &mut |_| ()).expect("it is sound").u;
            assert!(u.iter().skip(36).all(|u| *u == 0.0), "the third block does not move");
        }
        let found = json!({
            "equations": plan.equations,
            "candidates": plan.contact.as_ref().map(|contact| &contact.candidates),
            "storage": plan.storage,
            "half": plan.half,
            "half would do": plan.half_would_do(),
            "idle": plan.bodies.iter().map(|body| body.idle).collect::<Vec<_>>(),
        });
        format!("{found}\n{}", line(&plan))
    };
    assert_rows("tests/program/plan.txt", answer);
}
