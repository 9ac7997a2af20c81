//! Documents in JSON: snapshots, sweeps, results and answers. Each is refused with its fault, or is
//! written and reads back the same; what is small is run.

use std::path::Path;

use plane_contact::Request;
use plane_contact::error::InputError;
use plane_contact::report::ResultFile;
use plane_contact::report::answers::{self, MarkedAnswers};
use plane_contact::report::snapshot::{self as report, VerifiedFile};
use plane_contact::studies::lesson::exercise::Answers;
use plane_contact::studies::snapshot::{Numbers, Snapshot, difference, verify};
use plane_contact::studies::sweep::Jobs;

use serde_json::Value;

use super::sound;

/// The most nodes, iterations and steps of what is run.
const MOST: usize = 30;

pub fn hold(data: &[u8]) {
    let Ok(text) = std::str::from_utf8(data) else { return };
    if let Some(snapshot) = reads_back(Snapshot::read, data, report::file) {
        of_snapshot(&snapshot);
    }
    of_sweep(data);
    let result = |data: &[u8]| ResultFile::from_json(&String::from_utf8_lossy(data));
    reads_back(result, data, ResultFile::to_json);
    let Ok(answers) = serde_json::from_str::<Answers>(text) else { return };
    match answers.marks() {
        Ok(marks) => {
            let marked = [MarkedAnswers { file: "fuzz".into(), marks, answers }];
            assert!(!answers::json(&marked).is_empty());
            assert!(!answers::report(&marked).blocks.is_empty());
        }
        Err(error) => sound::input_error(&error),
    }
}

/// Reads a document; None where it is refused.
fn reads_back<T>(
    read: impl Fn(&[u8]) -> Result<T, InputError>,
    data: &[u8],
    write: impl Fn(&T) -> String,
) -> Option<T> {
    match read(data) {
        Ok(document) => {
            let written = write(&document);
            let again =
                read(written.as_bytes()).unwrap_or_else(|error| panic!("{error}\n{written}"));
            assert_eq!(write(&again), written);
            Some(document)
        }
        Err(error) => {
            sound::input_error(&error);
            None
        }
    }
}

/// A snapshot is the same as itself, but for numbers that are none; and it is verified.
fn of_snapshot(snapshot: &Snapshot) {
    for run in difference(snapshot, snapshot).runs {
        for difference in run.differences {
            let numbers = run.run.numbers.get(&difference.entry).map(Numbers::places);
            let mut numbers = numbers.into_iter().flatten();
            assert!(numbers.any(|((n, _), x)| n.is_nan() || x.is_nan()), "{difference:?}");
        }
    }
    let Ok(scene) = snapshot.input.build() else { return };
    let requests = snapshot.runs.iter().map(|(_, run)| run.options.request(&scene));
    if snapshot.runs.len() > 2 || !requests.into_iter().all(|request| is_small(&request)) {
        return;
    }
    match verify(snapshot, None, &|| ()) {
        Ok(verified) => {
            let checked = [VerifiedFile { file: "fuzz".into(), verified: Ok(verified) }];
            // What is no number differs, and is null.
            let json: Result<Value, _> = serde_json::from_str(&report::json(&checked));
            let found = report::report(&checked);
            assert!(json.is_ok() && !found.text(80).is_empty() && !found.markdown().is_empty());
            assert!(!report::junit(&checked).is_empty());
        }
        Err(error) => assert_eq!(error.exit_status(), 2, "{error}"),
    }
}

/// A sweep's first jobs have keys, and rows without a number that has no value. A scene of a file
/// would be read from where the fuzzer stands: only embedded ones are.
fn of_sweep(data: &[u8]) {
    let sweep: Value = serde_json::from_slice(data).unwrap_or_default();
    if !["fig1", "two-blocks"].iter().any(|name| sweep["scene"] == **name) {
        return;
    }
    let jobs = match Jobs::read(data, Path::new("")) {
        Ok(jobs) => jobs,
        Err(error) => return sound::input_error(&error),
    };
    for job in jobs.list.iter().take(3) {
        assert_eq!(job.key.len(), 64);
        match jobs.request(job) {
            Ok(request) if is_small(&request) => {
                let row = jobs.run(job).expect("no mesh is changed");
                let status = row["exit_status"].as_i64().expect("an exit status");
                assert_eq!(status == 0, !row.contains_key("error"), "{row:?}");
                assert!((0..=4).contains(&status) && status != 1, "{row:?}");
                assert!(row.values().all(|value| !value.is_null()), "{row:?}");
            }
            Ok(_) => (),
            Err(error) => sound::input_error(&error),
        }
    }
}

fn is_small(request: &Request) -> bool {
    let model = &request.scene.model;
    let sizes = [model.nodes.len(), request.iterations, request.contact.load_steps];
    sizes.into_iter().all(|size| size <= MOST)
}
