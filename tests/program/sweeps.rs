//! Sweeps as a user meets them: results, what runs again, the table, engines.

use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use serde_json::{Value, json};
use tempfile::TempDir;

use crate::common::program::run;
use crate::common::tools::{has_python, is_there};

fn ran(folder: &Path, args: &[&str]) -> (i32, String, String) {
    let output = run(folder, args);
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).expect("UTF-8");
    (output.status.code().expect("no signal"), text(output.stdout), text(output.stderr))
}

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

#[test]
fn every_job_is_a_flat_row_in_order() {
    let folder = folder(&json!({"format": 1, "scene": "fig1",
        "list": [{"/scene/contact/c_tll": 0.001}, {"/options/reading": "R4=left-to-right"},
                 {"/scene/contact/c_tll": -1.0}, {"/scene/node/4/1": 0.31}],
        "grid": {"/options/variant": ["tied", "stepped"]}}));
    assert!(swept(folder.path()).contains("8 jobs: 8 ran, 4 failed"));
    let rows = table(folder.path());
    let column = |name: &str| rows.iter().map(|row| row[name].clone()).collect::<Vec<Value>>();
    assert_eq!(column("job"), (0..8).map(Value::from).collect::<Vec<_>>());
    assert_eq!(column("exit_status"), [0, 0, 3, 3, 2, 2, 0, 0].map(Value::from));
    assert_eq!(rows[1]["/options/variant"], "stepped");
    assert_eq!(rows[7]["/scene/node/4/1"], 0.31);
    assert!(rows[2]["error"].as_str().expect("words").contains("c_cnt, line 18"));
    let is_cell = |value: &Value| !(value.is_array() || value.is_object() || value.is_null());
    assert!(rows.iter().all(|row| row.as_object().expect("a row").values().all(is_cell)));
    // The numbers are those of solve.
    let (_, result, _) = ran(folder.path(), &["solve", "fig1", "--variant", "tied", "--json"]);
    let result: Value = serde_json::from_str(&result).expect("JSON");
    let last = result["iterations"].as_array().expect("rows").last().expect("one").clone();
    assert_eq!(rows[0]["max_displacement"], last["max_displacement"]);
    assert_eq!(rows[0]["in_contact"], last["in_contact"]);
}

#[test]
fn a_table_is_csv_with_a_line_for_each_job() {
    let folder = folder(&json!({"format": 1, "scene": "fig1", "grid": {
        "/options/variant": ["tied", "stepped"], "/scene/title": ["a, \"b\""]}}));
    let csv = |folder: &Path| ran(folder, &["sweep", "table", "sweep.json"]);
    let (status, text, errors) = csv(folder.path());
    assert!(status == 0 && errors.contains("2 of 2 jobs have not run"), "{errors}");
    assert_eq!(text.matches("it has not run").count(), 2, "{text}");
    swept(folder.path());
    let (_, text, errors) = csv(folder.path());
    assert_eq!(errors, "");
    let lines: Vec<&str> = text.lines().collect();
    assert!(lines[0].starts_with("job,key,/options/variant,/scene/title,exit_status"), "{text}");
    assert!(lines.len() == 3 && lines[1].contains(",tied,\"a, \"\"b\"\"\",0,"), "{text}");
}

#[test]
fn nothing_runs_twice_and_a_longer_sweep_goes_on() {
    let folder = folder(&of_fig1(20));
    assert!(swept(folder.path()).contains("20 jobs: 20 ran, 0 failed"));
    let first = table(folder.path());
    assert!(swept(folder.path()).contains("20 jobs: 0 ran"));
    assert_eq!(table(folder.path()), first);
    let mut longer = of_fig1(20);
    longer["grid"]["/options/variant"] = json!(["tied", "stepped", "printed"]);
    std::fs::write(folder.path().join("sweep.json"), longer.to_string()).expect("written");
    assert!(swept(folder.path()).contains("30 jobs: 10 ran"));
    assert_eq!(table(folder.path())[..20], first);
}

#[test]
fn faults_of_the_file_are_named() {
    let says = |sweep: Value, words: &str| {
        let folder = folder(&sweep);
        let (status, _, errors) = ran(folder.path(), &["sweep", "run", "sweep.json"]);
        assert!(status == 2 && errors.contains(words), "{words}: {errors}");
    };
    says(json!({"format": 2, "scene": "fig1"}), "format 2");
    says(json!({"format": 1, "grit": {}}), "grit");
    says(json!({"format": 1}), "the field \"scene\" is missing");
    says(
        json!({"format": 1, "scene": "fig1", "grid": {"/scene/x": 3}}),
        "neither a list nor steps",
    );
    says(json!({"format": 1, "scene": "nowhere"}), "cannot be read");
    let steps = json!({"from": 1, "to": 2, "count": 100_001});
    says(json!({"format": 1, "scene": "fig1", "grid": {"/scene/x": steps}}), "more than 100000");
    let steps = json!({"from": 1, "to": 2, "count": 1000});
    let grid = json!({"/scene/x": steps, "/scene/y": steps});
    says(json!({"format": 1, "scene": "fig1", "grid": grid}), "more than 100000");
    says(
        json!({"format": 1, "scene": "fig1", "list": [{"/scene/a/b": 1}, {}]}),
        "leads into no part",
    );
    says(json!({"format": 1, "scene": "fig1", "list": [{"/other": 1}]}), "leads into no part");
}

#[test]
fn a_job_runs_alone_and_its_result_is_left_alone() {
    let folder = folder(&of_fig1(6));
    let at = folder.path();
    let only = |job: &str| ran(at, &["sweep", "run", "sweep.json", "--only", job]);
    for job in ["0", "5"] {
        assert!(only(job).1.contains("1 jobs: 1 ran, 0 failed"));
        assert!(only(job).1.contains("1 jobs: 0 ran, 0 failed"));
    }
    assert!(swept(at).contains("6 jobs: 4 ran"));
    let (status, _, errors) = only("6");
    assert!(status == 2 && errors.contains("there are 6 jobs, counted from 0"), "{errors}");
    // A result that was changed is no result.
    let key = table(at)[3]["key"].as_str().expect("a key").to_string();
    let file = at.join(format!("out/sweep/{key}.json"));
    let text = std::fs::read_to_string(&file).expect("a result");
    std::fs::write(&file, text.replace(&key, "other")).expect("written");
    let (status, _, errors) = only("3");
    assert!(status == 2 && errors.contains("this is not the result of this job"), "{errors}");
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

/// A job runs again where a file that it reads has changed, and no other does.
#[test]
fn a_job_is_known_by_every_file_that_it_reads() {
    let folder = folder(&json!({"format": 1, "scene": "c4/scene.json",
        "grid": {"/scene/mesh": ["a.msh", "b.msh"], "/options/c_tll": [null]}}));
    let at = folder.path();
    for n in ["4", "5", "6"] {
        let mesh = ["scene", "mesh", "punch", "--punch", n, "--foundation", n];
        assert_eq!(ran(at, &[&mesh[..], &["--out", &format!("c{n}")]].concat()).0, 0);
    }
    let copy = |from: &str, to: &str| {
        std::fs::copy(at.join(from), at.join("c4").join(to)).expect("a copy");
    };
    let sweep = |ran_again: &str| {
        let printed = swept(at);
        assert!(printed.contains(&format!("2 jobs: {ran_again} ran, 0 failed")), "{printed}");
        let found = table(at);
        std::fs::remove_dir_all(at.join("out")).expect("results");
        assert!(swept(at).contains("2 ran"));
        assert_eq!(found, table(at), "the rows are those of a sweep from the start");
    };
    copy("c4/punch.msh", "a.msh");
    copy("c5/punch.msh", "b.msh");
    sweep("2");
    sweep("0");
    copy("c6/punch.msh", "b.msh");
    sweep("1");
    copy("c5/punch.msh", "a.msh");
    sweep("1");
    copy("c6/punch.msh", "punch.msh");
    sweep("0");
    let scene = std::fs::read_to_string(at.join("c4/scene.json")).expect("a scene");
    let scene = scene.replacen('{', "{\"iterations\": 7,", 1);
    std::fs::write(at.join("c4/scene.json"), scene).expect("written");
    sweep("2");
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
    let mut program = Command::new("make");
    program.arg("--version");
    if is_there(program, "REQUIRE_MAKE") {
        names_reach("make", |at| succeeds(Command::new("make").args(["-j2", "-f", "jobs"]), at));
    }
}

#[test]
fn any_name_reaches_hyperqueue() {
    if has_python("hyperqueue", "REQUIRE_HYPERQUEUE") {
        names_reach("hyperqueue", |at| succeeds(Command::new("python3").args(["-c", CLUSTER]), at));
    }
}

#[test]
fn any_name_reaches_snakemake() {
    let mut program = Command::new("snakemake");
    program.arg("--version");
    if is_there(program, "REQUIRE_SNAKEMAKE") {
        let args = ["-s", "jobs", "--cores", "2"];
        names_reach("snakemake", |at| succeeds(Command::new("snakemake").args(args), at));
    }
}

/// The process of HyperQueue's server and both workers is killed in the middle and started again:
/// nothing is lost.
#[test]
fn hyperqueue_runs_two_hundred_jobs_with_its_workers_killed_in_the_middle() {
    if !has_python("hyperqueue", "REQUIRE_HYPERQUEUE") {
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
