//! The conclusion of an audit: every number is the one that its command prints.

use serde_json::Value;
use tempfile::TempDir;

use crate::common::program::run;
use crate::common::tolerances::{CLAIM, assert_near};

fn json_of(folder: &TempDir, args: &[&str]) -> Value {
    serde_json::from_slice(&run(folder.path(), args).stdout).expect("the command prints JSON")
}

#[test]
fn an_answers_number_is_the_one_that_its_command_prints() {
    let folder = TempDir::new().expect("a temporary folder");
    for scene in ["strand", "fig1", "two-blocks"] {
        let audit = json_of(&folder, &["audit", scene, "--json"]);
        let answers = audit["answers"].as_array().expect("answers");
        assert_eq!(answers.len(), 5);
        for answer in answers {
            let question = format!("{scene}: {}", answer["question"]);
            let value = answer["value"].as_f64();
            assert_eq!(value.is_some(), answer["at"].is_string(), "{question}");
            let Some(value) = value else { continue };
            let command = answer["command"].as_str().expect("a command");
            let json = match command == format!("audit {scene} --json") {
                true => audit.clone(),
                false => json_of(&folder, &command.split(' ').collect::<Vec<_>>()),
            };
            let printed = json.pointer(answer["at"].as_str().expect("a pointer"));
            let printed = printed.and_then(Value::as_f64).expect("a number");
            assert_near(&question, value, printed, printed, &CLAIM);
        }
    }
}

/// What the repair of C4 changes is what `solve` says of the listing repaired by hand.
#[test]
fn what_a_repair_changes_is_what_solve_says_of_the_repaired_listing() {
    let folder = TempDir::new().expect("a temporary folder");
    let audit = json_of(&folder, &["audit", "fig1", "--json"]);
    let repairs = audit["conclusion"]["repairs"].as_array().expect("repairs");
    let repair = repairs.iter().find(|repair| repair["id"] == "C4").expect("a repair");
    let printed = include_str!("../../listings/c_cnt.txt");
    let text = printed
        .replace("yt[i1] < 0 ∧ yt[i1+1] > 0", "yt[i1] > 0 ∧ yt[i1+1] < 0")
        .replace("yt[i1] < 0 ∧ yt[i1−1] > 0", "yt[i1] > 0 ∧ yt[i1−1] < 0");
    assert_ne!(text, printed);
    std::fs::write(folder.path().join("c_cnt.txt"), text).expect("a file");
    let args = ["solve", "fig1", "--variant", "stepped", "--json"];
    let runs = [
        json_of(&folder, &args),
        json_of(&folder, &[&args[..], &["--c-cnt", "c_cnt.txt"]].concat()),
    ];
    let [own, repaired] = runs.each_ref().map(|run| run["u"].as_array().expect("u"));
    let number = |x: &Value| x.as_f64().expect("a number");
    let length = |x: f64, y: f64| x.hypot(y);
    let largest = own.iter().map(|u| length(number(&u[0]), number(&u[1]))).fold(0.0, f64::max);
    let change = own
        .iter()
        .zip(repaired)
        .map(|(a, b)| length(number(&a[0]) - number(&b[0]), number(&a[1]) - number(&b[1])));
    let change = change.fold(0.0, f64::max) / largest;
    assert_near("C4", number(&repair["change"]), change, change, &CLAIM);
}
