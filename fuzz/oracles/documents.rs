//! Documents in JSON: snapshots, sweeps and results. Each is refused with its fault, or is
//! written and reads back the same; what is small is run.

use std::path::Path;

use plane_contact::Request;
use plane_contact::error::InputError;
use plane_contact::report::ResultFile;
use plane_contact::report::snapshot::{self as report, VerifiedFile};
use plane_contact::studies::snapshot::{Numbers, Snapshot, difference, verify};
use plane_contact::studies::sweep::{Document, Sweep, row};

use serde_json::Value;

use super::sound;

/// The most nodes, iterations and steps of what is run.
const MOST: usize = 30;

pub fn hold(data: &[u8]) {
    if let Some(snapshot) = reads_back(Snapshot::read, data, report::file) {
        of_snapshot(&snapshot);
    }
    let write = |sweep: &Sweep| serde_json::to_string(sweep).expect("a sweep is written");
    if let Some(sweep) = reads_back(Sweep::read, data, write) {
        of_sweep(&sweep);
    }
    let result = |data: &[u8]| ResultFile::from_json(&String::from_utf8_lossy(data));
    reads_back(result, data, ResultFile::to_json);
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

/// A sweep's first cases have keys, and rows without a number that has no value. A scene of a file
/// would be read from where the fuzzer stands: only embedded ones are.
fn of_sweep(sweep: &Sweep) {
    if sweep.scene.as_deref().is_some_and(|name| !["fig1", "two-blocks"].contains(&name)) {
        return;
    }
    let cases = match sweep.clone().cases(Path::new("")) {
        Ok(cases) => cases,
        Err(error) => return sound::input_error(&error),
    };
    for k in 0..cases.len().min(3) {
        match cases.document(k) {
            // A generator may be asked for a mesh that takes too long: the target options has them.
            Ok(document) if sweep.scene.is_none() => assert_eq!(document.key().len(), 64),
            Ok(document) => of_case(&document),
            Err(error) => sound::input_error(&error),
        }
    }
}

fn of_case(document: &Document) {
    assert_eq!(document.key().len(), 64);
    match document.request() {
        Ok(request) if is_small(&request) => {
            let row = row(Ok(document.clone()));
            let status = row["exit_status"].as_i64().expect("an exit status");
            assert_eq!(status == 0, row["error"].is_null(), "{row:?}");
            assert!((0..=4).contains(&status) && status != 1, "{row:?}");
            let undefined = row.iter().filter(|(_, value)| value.is_null()).map(|(name, _)| name);
            for name in undefined {
                assert!(
                    ["error", "cycle", "max_pressure", "min_gap"].contains(&&**name),
                    "{row:?}"
                );
            }
        }
        Ok(_) => (),
        Err(error) => sound::input_error(&error),
    }
}

fn is_small(request: &Request) -> bool {
    let model = &request.scene.model;
    let sizes = [model.nodes.len(), request.iterations, request.contact.load_steps];
    sizes.into_iter().all(|size| size <= MOST)
}
