//! Snapshots as a user meets them: recorded, verified, tampered with, accepted.

use std::path::Path;

use serde_json::{Value, json};
use tempfile::TempDir;

use crate::common::program::run;

/// Runs the program and returns its exit status, standard output and standard error.
fn ran(folder: &Path, args: &[&str]) -> (i32, String, String) {
    let output = run(folder, args);
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).expect("UTF-8");
    (output.status.code().expect("no signal"), text(output.stdout), text(output.stderr))
}

/// A folder with a snapshot `s.json` of `fig1` under two variants.
fn recorded() -> TempDir {
    let folder = TempDir::new().expect("a folder");
    let args = ["snapshot", "record", "fig1", "--variant", "stepped,tied", "--out", "s.json"];
    let (status, printed, errors) = ran(folder.path(), &args);
    assert_eq!((status, &errors[..]), (0, ""), "{printed}");
    folder
}

fn document(folder: &Path) -> Value {
    let text = std::fs::read_to_string(folder.join("s.json")).expect("it was recorded");
    serde_json::from_str(&text).expect("JSON")
}

/// Verifies the snapshot after `change`.
fn tampered(change: impl FnOnce(&mut Value)) -> (i32, String, String) {
    let folder = recorded();
    let mut snapshot = document(folder.path());
    change(&mut snapshot);
    std::fs::write(folder.path().join("t.json"), snapshot.to_string()).expect("written");
    ran(folder.path(), &["snapshot", "verify", "t.json"])
}

#[track_caller]
fn assert_says(ran: &(i32, String, String), status: i32, words: &[&str]) {
    assert_eq!(ran.0, status, "{}{}", ran.1, ran.2);
    for word in words {
        assert!((ran.1.clone() + &ran.2).contains(word), "{word:?}: {}{}", ran.1, ran.2);
    }
}

#[test]
fn the_same_scene_gives_the_same_bytes_and_verifies() {
    let [one, other] = [recorded(), recorded()];
    let read = |folder: &TempDir| std::fs::read(folder.path().join("s.json")).expect("a snapshot");
    assert!(read(&one) == read(&other), "the same bytes");
    assert_says(
        &ran(one.path(), &["snapshot", "verify", "s.json"]),
        0,
        &["same, 2 runs", "stepped: same"],
    );
    // Recording again changes nothing, and another content is kept.
    assert_eq!(
        ran(
            one.path(),
            &["snapshot", "record", "fig1", "--variant", "stepped,tied", "--out", "s.json"]
        )
        .0,
        0
    );
    let kept = ran(one.path(), &["snapshot", "record", "fig1", "--out", "s.json"]);
    assert_says(&kept, 2, &["there is another snapshot", "accept"]);
}

#[test]
fn facts_stand_apart_from_numbers_and_rounding_is_measured() {
    let folder = recorded();
    let snapshot = document(folder.path());
    let run = &snapshot["runs"]["stepped"];
    assert_eq!(run["facts"]["iteration 1 ct"], json!([1, 2, 2, 3, 3]));
    assert_eq!(run["facts"]["iteration 1 dy"], json!([1, 1, 1, 0, 1]));
    assert_eq!(run["facts"]["iteration 1 in contact"], json!([5, 6, 7, 9]));
    assert_eq!(run["facts"]["iteration 2 cycle"], json!([1]));
    assert_eq!(run["facts"]["iterations"], json!(20));
    for (name, numbers) in run["numbers"].as_object().expect("an object") {
        let measured = numbers["bound"].as_f64().expect("it decides nothing");
        assert!(measured >= 0.0, "{name}: {measured:e}");
    }
    assert_eq!(run["numbers"]["u"]["unit"], "mm");
    assert_eq!(run["numbers"]["u"]["values"].as_array().expect("rows").len(), 13);
    let text = std::fs::read_to_string(folder.path().join("s.json")).expect("a snapshot");
    assert!(text.lines().any(|line| line.trim() == r#""iteration 1 ct": [1,2,2,3,3],"#));
}

#[test]
fn what_was_tampered_with_is_seen() {
    let number = |entry: &'static str| {
        move |s: &mut Value| s["runs"]["tied"]["numbers"][entry]["values"][4][1] = json!(1.0)
    };
    assert_says(
        &tampered(number("u")),
        1,
        &["tied: differs", "first difference: u, node 5", "u: 1 of 26"],
    );
    let nan = |s: &mut Value| s["runs"]["tied"]["numbers"]["u"]["values"][4][1] = Value::Null;
    assert_says(&tampered(nan), 1, &["u: 1 of 26 numbers differ", "was no finite number"]);
    let missing = |s: &mut Value| {
        s["runs"]["tied"]["numbers"].as_object_mut().expect("an object").remove("stress");
    };
    assert_says(&tampered(missing), 1, &["stress: new"]);
    let extra = |s: &mut Value| s["runs"]["tied"]["facts"]["iteration 3 statuses"] = json!(1);
    assert_says(&tampered(extra), 1, &["iteration 3 statuses: missing"]);
    let shorter = |s: &mut Value| {
        s["runs"]["tied"]["numbers"]["u"]["values"].as_array_mut().expect("rows").remove(3);
    };
    assert_says(&tampered(shorter), 1, &["u: 26 numbers, were 24, first at row 5"]);
    let fact =
        |s: &mut Value| s["runs"]["tied"]["facts"]["iteration 3 dy"] = json!([1, 1, 1, 1, 1]);
    assert_says(&tampered(fact), 1, &["first status: iteration 3, node 8: it is not in contact"]);
    let no_run = |s: &mut Value| s["runs"] = json!({});
    assert_says(&tampered(no_run), 1, &["nothing was compared"]);
    let nothing = |s: &mut Value| {
        s["runs"]["tied"]["facts"] = json!({});
        s["runs"]["tied"]["numbers"] = json!({});
    };
    assert_says(&tampered(nothing), 1, &["tied: nothing was compared"]);
}

#[test]
fn a_broken_snapshot_is_the_inputs_fault() {
    let format = |s: &mut Value| s["format"] = json!(2);
    assert_says(&tampered(format), 2, &["is of format 2", "field format"]);
    let no_format = |s: &mut Value| drop(s.as_object_mut().expect("an object").remove("format"));
    assert_says(&tampered(no_format), 2, &["names no format"]);
    let scene = |s: &mut Value| s["input"]["scene"]["contact"]["c_tll"] = json!(0.002);
    assert_says(&tampered(scene), 2, &["scene was changed after it was recorded", "SHA-256"]);
    let mesh = |s: &mut Value| s["input"]["mesh"]["nodes"][0][1] = json!(0.5);
    assert_says(&tampered(mesh), 2, &["mesh was changed after it was recorded"]);
    let unknown = |s: &mut Value| s["runs"]["tied"]["options"]["speed"] = json!(1);
    assert_says(&tampered(unknown), 2, &["speed", "runs.tied.options"]);
    let no_quantity = |s: &mut Value| s["runs"]["tied"]["facts"]["more"] = json!(1);
    assert_says(&tampered(no_quantity), 2, &["\"more\" is none of cnt, trg", "runs.tied.facts"]);
    let folder = recorded();
    let text = std::fs::read(folder.path().join("s.json")).expect("a snapshot");
    std::fs::write(folder.path().join("half.json"), &text[..text.len() / 2]).expect("written");
    assert_says(
        &ran(folder.path(), &["snapshot", "verify", "half.json"]),
        2,
        &["the text ends within a", "half.json"],
    );
    let twice = String::from_utf8(text).expect("UTF-8").replacen(
        "\"iteration 1 dy\"",
        "\"iteration 1 ct\": [], \"iteration 1 dy\"",
        1,
    );
    std::fs::write(folder.path().join("twice.json"), twice).expect("written");
    assert_says(&ran(folder.path(), &["snapshot", "verify", "twice.json"]), 2, &["is given twice"]);
    assert_says(&ran(folder.path(), &["snapshot", "verify", "none.json"]), 2, &["cannot be read"]);
}

#[test]
fn a_field_has_its_own_tolerance_where_the_snapshot_gives_one() {
    let moved = |tolerance: Value| {
        tampered(move |s| {
            let u = &mut s["runs"]["tied"]["numbers"]["u"];
            let value = u["values"][4][2].as_f64().expect("a number");
            u["values"][4][2] = json!(value * (1.0 + 1e-9));
            u["tolerance"] = tolerance;
        })
        .0
    };
    assert_eq!(moved(Value::Null), 1);
    assert_eq!(moved(json!({"absolute": 1e-9})), 0);
    assert_eq!(moved(json!({"absolute": 1e-15})), 1);
    assert_eq!(moved(json!({"relative": 1e-8})), 0);
    assert_eq!(moved(json!({"relative": 1e-11})), 1);
    assert_eq!(moved(json!({"ulps": 1e8})), 0);
    assert_eq!(moved(json!({"ulps": 4})), 1);
}

#[test]
fn a_failure_is_a_snapshot_like_any_other() {
    let folder = TempDir::new().expect("a folder");
    let args = ["snapshot", "record", "fig1", "--reading", "R4=left-to-right", "--out", "s.json"];
    assert_says(&ran(folder.path(), &args), 0, &["exit status 3", "\"line\":18"]);
    assert_says(&ran(folder.path(), &["snapshot", "verify", "s.json"]), 0, &["same"]);
    let mut snapshot = document(folder.path());
    let facts = &mut snapshot["runs"]["stepped R4=left-to-right"]["facts"];
    assert_eq!(facts["failure"]["listing"], "c_cnt");
    facts["failure"]["line"] = json!(17);
    std::fs::write(folder.path().join("t.json"), snapshot.to_string()).expect("written");
    assert_says(&ran(folder.path(), &["snapshot", "verify", "t.json"]), 1, &["failure: ", "was "]);
}

/// The scene of `fig1` in a folder, with another tolerance.
fn with_tolerance(folder: &Path, c_tll: f64) {
    let mut scene = crate::common::embedded::scene_json("fig1");
    scene["contact"]["c_tll"] = json!(c_tll);
    std::fs::write(folder.join("scene.json"), scene.to_string()).expect("written");
}

#[test]
fn what_changed_is_said_and_accepted() {
    let folder = recorded();
    let at = folder.path();
    with_tolerance(at, 0.02);
    let asked = ["s.json", "--scene", "scene.json"];
    let words = [
        "changed: scene contact.c_tll: 0.02, was 0.001",
        "first difference: c_tll",
        "first status: iteration 1, node 8: it is in contact, was not in contact: |yt[i1]| 4.000e-3, c_tll 2.000e-2; was",
        "c_cnt line 16: dy[i1] ← 1 if |yt[i1]| < c_tll ∧ ct[i1] > 0",
    ];
    assert_says(&ran(at, &[&["snapshot", "verify"], &asked[..]].concat()), 1, &words);
    // Options and tolerances stay.
    let mut snapshot = document(at);
    snapshot["runs"]["stepped"]["numbers"]["u"]["tolerance"] = json!({"relative": 0.5});
    std::fs::write(at.join("s.json"), snapshot.to_string()).expect("written");
    let accepted = ran(at, &[&["snapshot", "accept"], &asked[..]].concat());
    assert_says(&accepted, 0, &[&words[..], &["Recorded again: s.json"]].concat());
    let tolerance = &document(at)["runs"]["stepped"]["numbers"]["u"]["tolerance"];
    assert_eq!(*tolerance, json!({"relative": 0.5}));
    assert_says(&ran(at, &["snapshot", "verify", "s.json"]), 0, &["same, 2 runs"]);
    assert_says(&ran(at, &["snapshot", "accept", "s.json"]), 0, &["same, 2 runs"]);
    let words = ["same, 2 runs", "Nothing changed: s.json"];
    assert_says(&ran(at, &["snapshot", "accept", "s.json"]), 0, &words);
}

/// What went in is said where nothing that came out differs: it is in the snapshot too.
#[test]
fn a_change_without_an_effect_is_said() {
    let folder = recorded();
    let at = folder.path();
    let mut scene = crate::common::embedded::scene_json("fig1");
    scene["title"] = json!("another title");
    std::fs::write(at.join("scene.json"), scene.to_string()).expect("written");
    for command in ["verify", "accept"] {
        let said = ran(at, &["snapshot", command, "s.json", "--scene", "scene.json"]);
        let words = ["same, 2 runs", "changed: scene title: \"another title\", was \"The"];
        assert_says(&said, 0, &words);
    }
}

/// Of several who accept at once each changes what the one before it left, or is told that another was quicker.
#[test]
fn who_accepts_at_once_loses_nothing() {
    let folder = recorded();
    let at = folder.path();
    let accept = &|tolerance: usize| {
        let mut scene = crate::common::embedded::scene_json("fig1");
        scene["contact"]["c_tll"] = json!(tolerance as f64);
        let name = format!("scene{tolerance}.json");
        std::fs::write(at.join(&name), scene.to_string()).expect("written");
        (tolerance, ran(at, &["snapshot", "accept", "s.json", "--scene", &name]))
    };
    let mut left = Vec::new();
    std::thread::scope(|scope| {
        let threads: Vec<_> = (1..=8).map(|k| scope.spawn(move || accept(k))).collect();
        for thread in threads {
            let (tolerance, said) = thread.join().expect("it ran");
            if said.0 == 0 {
                let changed =
                    said.1.split("contact.c_tll: ").nth(1).expect("a change").lines().next();
                let was = changed.expect("a line").split(", was ").nth(1).expect("what it was");
                left.push((was.parse::<f64>().expect("a number"), tolerance as f64));
            } else {
                assert_says(&said, 2, &["it was changed since it was read", "run it again"]);
            }
        }
    });
    // Each value that was replaced was replaced once, and the last one stands there.
    let mut now = 0.001;
    while let Some(place) = left.iter().position(|(was, _)| *was == now) {
        now = left.swap_remove(place).1;
    }
    assert!(left.is_empty(), "{left:?} were accepted beside {now}");
    assert_eq!(document(at)["input"]["scene"]["contact"]["c_tll"], json!(now));
}

#[test]
fn a_run_that_fails_now_is_accepted_with_its_failure_printed() {
    let folder = TempDir::new().expect("a folder");
    let at = folder.path();
    with_tolerance(at, 0.001);
    let record = ["snapshot", "record", "scene.json", "--variant", "tied", "--out", "s.json"];
    assert_eq!(ran(at, &record).0, 0);
    // A vertical target edge: line 10 divides by zero.
    let mut scene = crate::common::embedded::scene_json("fig1");
    scene["node"][2][1] = json!(1.0);
    scene["node"][5][1] = json!(1.0);
    scene["node"][5][2] = json!(0.025);
    std::fs::write(at.join("scene.json"), scene.to_string()).expect("written");
    let accepted = ran(at, &["snapshot", "accept", "s.json", "--scene", "scene.json"]);
    assert_says(&accepted, 0, &["exit status: 3, was 0", "\"line\":10"]);
    assert_says(&ran(at, &["snapshot", "verify", "s.json"]), 0, &["same"]);
}

#[test]
fn reports_are_json_junit_and_markdown() {
    let folder = recorded();
    let at = folder.path();
    let mut snapshot = document(at);
    snapshot["runs"]["tied"]["numbers"]["u"]["values"][4][1] = json!(0.5);
    std::fs::write(at.join("t.json"), snapshot.to_string()).expect("written");
    let args = [
        "snapshot",
        "verify",
        "s.json",
        "t.json",
        "--json",
        "--junit",
        "v.xml",
        "--report",
        "v.markdown",
    ];
    let (status, printed, _) = ran(at, &args);
    assert_eq!(status, 1);
    let report: Value = serde_json::from_str(&printed).expect("JSON");
    assert_eq!((&report["same"], &report["files"][0]["same"]), (&json!(false), &json!(true)));
    let run = &report["files"][1]["runs"][1];
    assert_eq!((&run["run"], &run["first"]["node"]), (&json!("tied"), &json!(5)));
    assert_eq!(run["differences"][0]["entry"], "u");
    let xml = std::fs::read_to_string(at.join("v.xml")).expect("a report");
    let xml = roxmltree::Document::parse(&xml).expect("XML");
    let count = |name: &str| xml.descendants().filter(|node| node.has_tag_name(name)).count();
    assert_eq!((count("testsuite"), count("testcase"), count("failure")), (2, 4, 1));
    let page = std::fs::read_to_string(at.join("v.markdown")).expect("a report");
    assert!(page.contains("- tied: differs\n\n```text\nfirst difference: "), "{page}");
}

#[test]
fn two_sets_of_options_are_compared() {
    let folder = TempDir::new().expect("a folder");
    let at = folder.path();
    let differ = ran(at, &["snapshot", "diff", "strand", "--variant", "stepped,tied"]);
    let words = ["changed: option variant: \"tied\", was \"stepped\"", "first status: iteration 2"];
    assert_says(&differ, 1, &words);
    let same = ran(at, &["snapshot", "diff", "fig1", "--solver", "sparse-lu,sparse-cholesky"]);
    assert_says(&same, 0, &["same"]);
    assert_says(&ran(at, &["snapshot", "diff", "fig1"]), 2, &["nothing to compare"]);
    let both = ran(at, &["snapshot", "diff", "fig1", "two-blocks"]);
    assert_says(&both, 1, &["changed: scene title"]);
}
