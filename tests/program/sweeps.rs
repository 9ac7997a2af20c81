//! Sweeps that are killed, and engines that run their jobs; what else is done with them stands in `tests/cases/sweeps.txt`.

use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use serde_json::{Value, json};
use tempfile::TempDir;

use crate::common::program::ran;
use crate::common::tools::has;

/// A folder with `sweep.json`.
fn folder(sweep: &Value) -> TempDir {
    let folder = TempDir::new().expect("a folder");
    std::fs::write(folder.path().join("sweep.json"), sweep.to_string()).expect("written");
    folder
}

/// Runs the sweep, and returns what it says.
fn swept(folder: &Path) -> String {
    let (status, printed, errors) = ran(folder, &["sweep", "run", "sweep.json"]);
    assert_eq!((status, &errors[..]), (0, ""), "{printed}");
    printed
}

fn table(folder: &Path) -> Vec<Value> {
    let (status, printed, errors) = ran(folder, &["sweep", "table", "sweep.json", "--json"]);
    assert_eq!(status, 0, "{errors}");
    let table: Value = serde_json::from_str(&printed).expect("JSON");
    table["rows"].as_array().expect("rows").clone()
}

/// `count` jobs of `fig1` under two variants.
fn of_fig1(count: usize) -> Value {
    json!({"format": 1, "scene": "fig1", "grid": {
        "/options/variant": ["tied", "stepped"],
        "/scene/materials/1/E": {"from": 1e4, "to": 1e5, "count": count / 2, "log": true},
    }})
}

/// A sweep that is killed goes on where it was.
#[test]
fn a_sweep_that_was_killed_ends_with_the_same_results() {
    let folder = folder(&of_fig1(400));
    let results = || {
        let results = std::fs::read_dir(folder.path().join("out/sweep"));
        results.into_iter().flatten().flatten().filter(|r| r.path().extension().is_some()).count()
    };
    for least in [5, 20, 60] {
        let mut sweep = Command::new(env!("CARGO_BIN_EXE_plane-contact"));
        sweep.args(["sweep", "run", "sweep.json"]).current_dir(folder.path());
        let mut sweep = sweep.stdout(Stdio::null()).spawn().expect("the program starts");
        while results() < least {
            assert!(sweep.try_wait().expect("it can be asked").is_none(), "it ended before");
        }
        sweep.kill().expect("it is killed");
        sweep.wait().expect("it ended");
    }
    let known = results();
    assert!(known < 400 && swept(folder.path()).contains(&format!("{} ran", 400 - known)));
    let killed = table(folder.path());
    std::fs::remove_dir_all(folder.path().join("out")).expect("results");
    assert!(swept(folder.path()).contains("400 ran, 0 failed"));
    assert_eq!(table(folder.path()), killed);
}

/// Names that a shell, an engine, or a program that has options would take for something else.
const NAMES: &[&str] = &[
    "a b",
    "x;touch pwned;",
    "$(touch pwned)",
    "`touch pwned`",
    "q'u\"o",
    "{}{.}{key}{output}{{x}}",
    "-dash",
    "+plus",
    "line\nbreak",
    "back\\slash%n&|<>*?#~!$HOME:=$$",
];

/// Runs the job file that `engine` is given for a sweep of each of the names, with results in a folder
/// of that name: they are those of a sweep here, and nothing else is run.
fn names_reach(engine: &str, run: impl Fn(&Path)) {
    for name in NAMES {
        let folder = folder(&of_fig1(4));
        let at = folder.path();
        let file = format!("{name}.json");
        std::fs::rename(at.join("sweep.json"), at.join(&file)).expect("it is renamed");
        let out = format!("--out={name}");
        let export = ["sweep", "export", "--to", engine, &out, "--", &file];
        let (status, jobs, errors) = ran(at, &export);
        if engine == "make" && name.contains('\n') {
            assert!(status == 2 && errors.contains("no name with a line break"), "{errors}");
            continue;
        }
        assert_eq!(status, 0, "{name}: {errors}");
        std::fs::write(at.join("jobs"), jobs).expect("written");
        run(at);
        let (_, there, errors) = ran(at, &["sweep", "table", &out, "--", &file]);
        assert_eq!(errors, "", "{engine}, {name:?}: all have run");
        assert!(ran(at, &["sweep", "run", "--out", "here", "--", &file]).1.contains("4 ran"));
        assert_eq!(there, ran(at, &["sweep", "table", "--out", "here", "--", &file]).1);
        assert!(!at.join("pwned").exists(), "{engine}, {name:?}");
    }
}

fn succeeds(command: &mut Command, at: &Path) {
    let output = command.current_dir(at).output().expect("it starts");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
}

/// A server of HyperQueue with two workers, which runs a job file.
const CLUSTER: &str = "
import os, subprocess, sys
from hyperqueue import LocalCluster
from hyperqueue.cluster import WorkerConfig
with LocalCluster() as cluster:
    for _ in range(2):
        cluster.start_worker(WorkerConfig(cores=1))
    environment = dict(os.environ, HQ_SERVER_DIR=str(cluster.cluster.server_dir))
    sys.exit(subprocess.run([sys.executable, 'jobs'], env=environment).returncode)
";

#[test]
fn any_name_reaches_make() {
    if has("make --version", "REQUIRE_MAKE") {
        names_reach("make", |at| succeeds(Command::new("make").args(["-j2", "-f", "jobs"]), at));
    }
}

#[test]
fn any_name_reaches_hyperqueue() {
    if has("python3 -c 'import hyperqueue'", "REQUIRE_HYPERQUEUE") {
        names_reach("hyperqueue", |at| succeeds(Command::new("python3").args(["-c", CLUSTER]), at));
    }
}

#[test]
fn any_name_reaches_snakemake() {
    if has("snakemake --version", "REQUIRE_SNAKEMAKE") {
        let args = ["-s", "jobs", "--cores", "2"];
        names_reach("snakemake", |at| succeeds(Command::new("snakemake").args(args), at));
    }
}

/// The process of HyperQueue's server and both workers is killed in the middle and started again:
/// nothing is lost.
#[test]
fn hyperqueue_runs_two_hundred_jobs_with_its_workers_killed_in_the_middle() {
    if !has("python3 -c 'import hyperqueue'", "REQUIRE_HYPERQUEUE") {
        return;
    }
    let folder = folder(&of_fig1(200));
    let at = folder.path();
    let (_, jobs, _) = ran(at, &["sweep", "export", "sweep.json", "--to", "hyperqueue"]);
    std::fs::write(at.join("jobs"), jobs).expect("written");
    let start = || {
        let mut command = Command::new("python3");
        command.args(["-c", CLUSTER]).current_dir(at).stdout(Stdio::null()).stderr(Stdio::null());
        command.spawn().expect("python")
    };
    let results = || std::fs::read_dir(at.join("out/sweep")).into_iter().flatten().count();
    let mut cluster = start();
    let since = Instant::now();
    while results() < 40 {
        assert!(since.elapsed() < Duration::from_secs(120), "the engine runs nothing");
        std::thread::sleep(Duration::from_millis(20));
    }
    cluster.kill().expect("it is killed");
    cluster.wait().expect("it ended");
    assert!(results() < 200, "it was killed in the middle");
    assert!(start().wait().expect("it ends").success());
    assert!(swept(at).contains("200 jobs: 0 ran, 0 failed"));
}
