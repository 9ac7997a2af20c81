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
