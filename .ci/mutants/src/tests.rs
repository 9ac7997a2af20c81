//! The tests of the rewritten tree: how long each takes, and which places it reaches.

use std::collections::BTreeSet;
use std::fs::{self, File, OpenOptions};
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::Mutex;
use std::time::{Duration, Instant};

use serde::{Deserialize, Serialize};
use serde_json::Value;

use crate::processes::{End, command, run};
use crate::workers::share;
use crate::{Failure, Work};

/// A test is ended after this: what it reaches until then is enough.
const SLOW: Duration = Duration::from_secs(60);

/// The package is optimised less than its dependencies, which takes less time to compile.
const LESS_OPTIMISED: &str = "profile.release.package.plane-contact.opt-level=2";

#[derive(Clone, Serialize, Deserialize)]
pub struct Test {
    pub binary: PathBuf,
    pub name: String,
    /// How long it takes when no mutant is on and what it reaches is written down, in seconds.
    pub seconds: f64,
    /// The places that it reaches, each by the number of its first mutant.
    pub reached: BTreeSet<usize>,
}

/// A test that cannot judge mutants.
#[derive(Deserialize)]
struct LeftOut {
    test: String,
    #[serde(rename = "reason")]
    _reason: String,
}

/// Removes what tests left in their folder of temporary files.
pub fn clear(temporary: &Path) -> Result<(), Failure> {
    if temporary.exists() {
        let _ = fs::remove_dir_all(temporary);
    }
    fs::create_dir_all(temporary)?;
    Ok(())
}

/// Runs every test by itself, on every core one, but for those in the file `left_out` and those that
/// ran before, and writes down what each reaches.
pub fn reach(work: &Work, left_out: &Path) -> Result<(), Failure> {
    let left_out: Vec<LeftOut> = serde_json::from_str(&fs::read_to_string(left_out)?)?;
    let left_out: BTreeSet<&str> = left_out.iter().map(|test| test.test.as_str()).collect();
    let done: BTreeSet<_> = read(work)?.into_iter().map(|t| (t.binary, t.name)).collect();
    let mut left = Vec::new();
    for binary in binaries(work)? {
        let names = names(&binary)?.into_iter().filter(|name| !left_out.contains(name.as_str()));
        left.extend(names.map(|name| (binary.clone(), name)).filter(|test| !done.contains(test)));
    }
    let file = Mutex::new(OpenOptions::new().create(true).append(true).open(work.tests())?);
    let failed = Mutex::new(Vec::new());
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    share(left.iter(), cores, |(binary, name), worker| {
        match alone(work, binary, name, worker)? {
            Some(test) => append(&mut file.lock().expect("no worker panics"), &test)?,
            None => failed.lock().expect("no worker panics").push(name.as_str()),
        }
        Ok(())
    })?;
    let failed = failed.into_inner().expect("no worker panics");
    match failed.is_empty() {
        true => Ok(()),
        false => Err(format!("with no mutant on, these tests fail: {}", failed.join(", ")).into()),
    }
}

/// Appends a value after a line break of its own: a line that a killed run cut off, which readers
/// pass over, spoils no other.
pub fn append(file: &mut File, value: &impl Serialize) -> Result<(), Failure> {
    file.write_all(format!("\n{}", serde_json::to_string(value)?).as_bytes())?;
    Ok(())
}

/// Runs a test with no mutant on; returns nothing where it fails.
fn alone(work: &Work, binary: &Path, name: &str, worker: usize) -> Result<Option<Test>, Failure> {
    let temporary = work.temporary(worker);
    clear(&temporary)?;
    let list = work.0.join(format!("reached-{worker}"));
    let _ = fs::remove_file(&list);
    let start = Instant::now();
    let mut command = command(work, binary, &[name], &temporary);
    let end = run(command.env("MUTANTS_REACHED", &list), SLOW, name)?;
    let seconds = start.elapsed().as_secs_f64();
    let text = fs::read_to_string(&list).unwrap_or_default();
    let reached = text.lines().filter_map(|line| line.parse().ok()).collect();
    let passes = !matches!(end, End::Failed(_));
    println!("{seconds:7.2} s {name}{}", if passes { "" } else { " FAILS" });
    let test = Test { binary: binary.to_owned(), name: name.to_owned(), seconds, reached };
    Ok(passes.then_some(test))
}

/// Returns the tests that are known, the fastest first.
pub fn read(work: &Work) -> Result<Vec<Test>, Failure> {
    let text = fs::read_to_string(work.tests()).unwrap_or_default();
    let mut tests: Vec<Test> =
        text.lines().filter_map(|line| serde_json::from_str(line).ok()).collect();
    tests.sort_by(|a, b| a.seconds.total_cmp(&b.seconds));
    Ok(tests)
}

/// Builds the tests and returns their binaries.
fn binaries(work: &Work) -> Result<Vec<PathBuf>, Failure> {
    let output = Command::new("cargo")
        .args(["test", "--release", "--locked", "--no-run", "--message-format=json"])
        .args(["--tests", "--config", LESS_OPTIMISED])
        .current_dir(work.tree())
        .env("CARGO_TARGET_DIR", work.target())
        .stderr(Stdio::inherit())
        .output()?;
    if !output.status.success() {
        return Err("the tests are not built".into());
    }
    let text = String::from_utf8(output.stdout)?;
    let messages = text.lines().filter_map(|line| serde_json::from_str::<Value>(line).ok());
    let tests = messages.filter(|message| message["profile"]["test"] == true);
    let paths = tests.filter_map(|message| message["executable"].as_str().map(PathBuf::from));
    Ok(paths.collect())
}

/// Returns the names of the tests that are run unasked.
fn names(binary: &Path) -> Result<Vec<String>, Failure> {
    let list = |options: &[&str]| -> Result<BTreeSet<String>, Failure> {
        let output =
            Command::new(binary).args(["--list", "--format=terse"]).args(options).output()?;
        let text = String::from_utf8(output.stdout)?;
        Ok(text.lines().filter_map(|line| line.strip_suffix(": test").map(str::to_owned)).collect())
    };
    let ignored = list(&["--ignored"])?;
    Ok(list(&[])?.into_iter().filter(|name| !ignored.contains(name)).collect())
}
