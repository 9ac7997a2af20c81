//! Exercises: the scenes that are drawn, what a sheet of zeros scores, and the marks of a class.

use plane_contact::paper::door::Call;
use plane_contact::paper::mirror::Reading;
use plane_contact::studies::lesson::exercise::{ANSWERS, Answer, Answers, Exercise, Mark};
use serde_json::{Value, json};
use tempfile::TempDir;

use crate::common::program::run;

/// The exercises of three classes.
fn exercises() -> impl Iterator<Item = Exercise> {
    (0..300).map(|k| Exercise { exercise: k / 3, seed: 2026 + k % 3 })
}

/// The file that the page saves of these answers.
fn answers(exercise: Exercise, student: &str, found: &[[f64; 4]]) -> Value {
    let answer = |[node, ct, dy, k1]: &[f64; 4]| json!({ "node": *node as usize, "ct": ct, "dy": dy, "k1": (100.0 * k1).round() / 100.0 });
    let Exercise { exercise, seed } = exercise;
    json!({ "kind": ANSWERS, "exercise": exercise, "seed": seed, "student": student,
        "answers": found.iter().map(answer).collect::<Vec<_>>() })
}

#[test]
fn each_exercise_has_a_node_in_contact_one_apart_and_one_by_the_sign_rule() {
    for exercise in exercises() {
        let model = exercise.scene().model;
        let two_decimals = |x: &f64| *x == format!("{x:.2}").parse::<f64>().expect("a number");
        assert!(model.nodes.iter().flatten().all(two_decimals), "{exercise:?}: {:?}", model.nodes);
        assert_eq!(model.nodes, exercise.scene().model.nodes, "the same each time");
        let call = Call::c_cnt(&model, &Reading::default(), &model.nodes).expect("it runs");
        let c_tll = model.contact.tolerance;
        let within = |k: &usize| call.pairs.yt[*k].abs() < c_tll;
        let places: Vec<usize> = (1..=model.contact.nodes.len()).collect();
        let (touching, apart): (Vec<usize>, Vec<usize>) =
            places.into_iter().partition(|k| call.pairs.dy[*k] == 1);
        assert!(!apart.is_empty(), "{exercise:?}: a node is apart");
        assert!(touching.iter().any(within), "{exercise:?}: a gap within c_tll");
        assert!(!touching.iter().all(within), "{exercise:?}: a node by the sign rule alone");
        let is_clear = |k: usize| (call.pairs.yt[k].abs() - c_tll).abs() > 1e-3;
        assert!((1..=model.contact.nodes.len()).all(is_clear), "{exercise:?}: no gap is c_tll");
    }
}

#[test]
fn a_sheet_of_zeros_scores_under_40_per_cent() {
    for exercise in exercises() {
        let sheet = |value: fn([f64; 4]) -> [Option<f64>; 3]| Answers {
            kind: ANSWERS.into(),
            exercise: exercise.exercise,
            seed: exercise.seed,
            student: "A. Student".into(),
            answers: (exercise.found().into_iter())
                .map(|found| (found[0] as usize, value(found)))
                .map(|(node, [ct, dy, k1])| Answer { node, ct, dy, k1 })
                .collect(),
        };
        let score = |sheet: Answers| {
            let marks = sheet.marks().expect("the page's nodes");
            let points = |is: fn(&Mark) -> bool| {
                marks.iter().filter(|mark| is(mark)).map(|mark| mark.points).sum::<usize>() as f64
            };
            points(|mark| mark.right) / points(|_| true)
        };
        assert_eq!(score(sheet(|[_, ct, dy, k1]| [ct, dy, k1].map(Some))), 1.0);
        assert_eq!(score(sheet(|_| [None; 3])), 0.0);
        let zeros = score(sheet(|_| [Some(0.0); 3]));
        assert!(zeros < 0.4, "{exercise:?}: {zeros}");
    }
}

/// A class: all right, one mistake, zeros, and files that are no answers to the exercise, which are named
/// and do not stop the others.
#[test]
fn a_class_is_marked_as_a_table() {
    let folder = TempDir::new().expect("a folder");
    let write =
        |name: &str, text: &str| std::fs::write(folder.path().join(name), text).expect("a file");
    let exercise = Exercise { exercise: 7, seed: 2026 };
    let found = exercise.found();
    let right = answers(exercise, "A. Right", &found);
    let mut wrong = right.clone();
    wrong["student"] = json!("B. Wrong");
    wrong["answers"][0]["dy"] = json!(1.0 - found[0][2]);
    let zeros: Vec<_> = found.iter().map(|[node, ..]| [*node, 0.0, 0.0, 0.0]).collect();
    let mut foreign = right.clone();
    foreign["answers"][0]["node"] = json!(1);
    let mut other = right.clone();
    other["kind"] = json!("a letter");
    let mut twice = right.clone();
    twice["answers"][1] = twice["answers"][0].clone();
    for (name, file) in [
        ("right.json", &right),
        ("wrong.json", &wrong),
        ("zeros.json", &answers(exercise, "C. Zeros", &zeros)),
        ("foreign.json", &foreign),
        ("other.json", &other),
        ("twice.json", &twice),
    ] {
        write(name, &file.to_string());
    }
    write("broken.json", r#"{"kind": "plane-contact answers"}"#);
    let verify = |args: &[&str]| {
        let output = run(folder.path(), &[&["snapshot", "verify"], args].concat());
        let [said, errors] = [output.stdout, output.stderr].map(|text| {
            String::from_utf8_lossy(&text).split_whitespace().collect::<Vec<_>>().join(" ")
        });
        (output.status.code(), said, errors)
    };
    assert_eq!(verify(&["right.json"]).0, Some(0));
    let touching = found.iter().filter(|found| found[2] == 1.0).count();
    let of = 2 * found.len() + 2 * touching;
    let row = |student: &str, points: usize| {
        format!("{student} 7 2026 {:.0} % {points} {of}", 100.0 * points as f64 / of as f64)
    };
    let (code, said, _) = verify(&["right.json", "wrong.json", "zeros.json", "--csv", "marks"]);
    assert_eq!(code, Some(1));
    for words in [row("A. Right", of), row("B. Wrong", of - 1), "C. Zeros 7 2026".into()] {
        assert!(said.contains(&words), "{words}: {said}");
    }
    let csv = std::fs::read_to_string(folder.path().join("marks/marks.csv")).expect("a table");
    assert_eq!(csv.lines().count(), 4, "{csv}");
    assert!(csv.starts_with("student,exercise,seed,score,points,of,ct,dy,k1,file,wrong"), "{csv}");
    let all =
        ["broken.json", "right.json", "nowhere.json", "other.json", "foreign.json", "twice.json"];
    let (code, said, errors) = verify(&all);
    assert_eq!(code, Some(2));
    assert!(said.contains(&row("A. Right", of)), "{said}");
    for words in [
        "where: broken.json",
        "where: nowhere.json fix: give files as the page of an exercise saves them",
        "\"a letter\" is no kind of answers where: other.json: field kind",
        "node 1 is no contact node of exercise 7 under seed 2026 where: foreign.json: field answers \
         fix: save them from the page that `plane-contact lesson --exercise 7 --seed 2026` makes",
        "is answered twice where: twice.json",
    ] {
        assert!(errors.contains(words), "{words}: {errors}");
    }
    let (_, said, _) = verify(&["right.json", "--json"]);
    let marks: Value = serde_json::from_str(&said).expect("JSON");
    assert_eq!(marks["answers"][0]["points"], marks["answers"][0]["of"]);
    assert_eq!(verify(&["right.json", "--json", "--csv", "marks"]).0, Some(2));
}
