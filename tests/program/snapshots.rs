//! Snapshots accepted by several at once; what else is done with them stands in `tests/cases/snapshots.txt`.

use serde_json::{Value, json};
use tempfile::TempDir;

use crate::common::embedded::scene_json;
use crate::common::program::ran;

/// Of several who accept at once each changes what the one before it left, or is told that another was quicker.
#[test]
fn who_accepts_at_once_loses_nothing() {
    let folder = TempDir::new().expect("a folder");
    let at = folder.path();
    assert_eq!(ran(at, &["snapshot", "record", "fig1", "--out", "s.json"]).0, 0);
    let accept = &|tolerance: usize| {
        let mut scene = scene_json("fig1");
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
                assert_eq!(said.0, 2, "{}", said.2);
                assert!(said.2.contains("it was changed since it was read"), "{}", said.2);
            }
        }
    });
    // Each value that was replaced was replaced once, and the last one stands there.
    let mut now = 0.001;
    while let Some(place) = left.iter().position(|(was, _)| *was == now) {
        now = left.swap_remove(place).1;
    }
    assert!(left.is_empty(), "{left:?} were accepted beside {now}");
    let there = std::fs::read(at.join("s.json")).expect("a snapshot");
    let there: Value = serde_json::from_slice(&there).expect("JSON");
    assert_eq!(there["input"]["scene"]["contact"]["c_tll"], json!(now));
}
