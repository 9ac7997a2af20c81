//! Sweeps as a user meets them: rows, interruptions, crashes, engines.

use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use serde_json::{Value, json};
use tempfile::TempDir;

use crate::common::program::run;
use crate::common::tools::is_there;

const PROGRAM: &str = env!("CARGO_BIN_EXE_plane-contact");

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

fn rows(folder: &Path, file: &str) -> Vec<Value> {
    let text = std::fs::read_to_string(folder.join(file)).expect("rows");
    text.lines().map(|line| serde_json::from_str(line).expect("JSON")).collect()
}

/// `count` cases of `fig1` under two variants.
fn of_fig1(count: usize) -> Value {
    json!({"format": 1, "scene": "fig1", "grid": {
        "/options/variant": ["tied", "stepped"],
        "/scene/materials/1/E": {"from": 1e4, "to": 1e5, "count": count / 2, "log": true},
    }})
}

#[test]
fn every_case_is_a_flat_row_in_order() {
    let folder = folder(&json!({"format": 1, "scene": "fig1",
        "list": [{"/scene/contact/c_tll": 0.001}, {"/options/reading": "R4=left-to-right"},
                 {"/scene/contact/c_tll": -1.0}, {"/scene/node/4/1": 0.31}],
        "grid": {"/options/variant": ["tied", "stepped"]}}));
    let (status, printed, errors) =
        ran(folder.path(), &["sweep", "sweep.json", "--out", "r.jsonl"]);
    assert_eq!((status, &errors[..]), (0, ""), "{printed}");
    assert!(printed.contains("8 cases: 8 ran, 4 failed"), "{printed}");
    let rows = rows(folder.path(), "r.jsonl");
    let column = |name: &str| rows.iter().map(|row| row[name].clone()).collect::<Vec<Value>>();
    assert_eq!(column("case"), (0..8).map(Value::from).collect::<Vec<_>>());
    assert_eq!(column("exit_status"), [0, 0, 3, 3, 2, 2, 0, 0].map(Value::from));
    assert_eq!(rows[1]["/options/variant"], "stepped");
    assert_eq!(rows[7]["/scene/node/4/1"], 0.31);
    assert!(rows[2]["error"].as_str().expect("words").contains("c_cnt, line 18"));
    let is_cell = |value: &Value| !(value.is_array() || value.is_object());
    assert!(rows.iter().all(|row| row.as_object().expect("a row").values().all(is_cell)));
    // The numbers are those of solve.
    let (_, result, _) = ran(folder.path(), &["solve", "fig1", "--variant", "tied", "--json"]);
    let result: Value = serde_json::from_str(&result).expect("JSON");
    let last = result["iterations"].as_array().expect("rows").last().expect("one").clone();
    assert_eq!(rows[0]["max_displacement"], last["max_displacement"]);
    assert_eq!(rows[0]["in_contact"], last["in_contact"]);
}

#[test]
fn nothing_runs_twice_and_a_longer_sweep_goes_on() {
    let folder = folder(&of_fig1(20));
    let sweep = || ran(folder.path(), &["sweep", "sweep.json", "--out", "r.jsonl"]).1;
    assert!(sweep().contains("20 cases: 20 ran, 0 failed"));
    let first = std::fs::read(folder.path().join("r.jsonl")).expect("rows");
    assert!(sweep().contains("20 cases: 0 ran"));
    assert!(std::fs::read(folder.path().join("r.jsonl")).expect("rows") == first);
    let mut longer = of_fig1(20);
    longer["grid"]["/options/variant"] = json!(["tied", "stepped", "printed"]);
    std::fs::write(folder.path().join("sweep.json"), longer.to_string()).expect("written");
    assert!(sweep().contains("30 cases: 10 ran"));
    assert!(!folder.path().join("r.jsonl.journal").exists());
}

#[test]
fn generators_are_swept_too() {
    let folder = folder(&json!({"format": 1, "generate": {"kind": "cook"},
        "grid": {"/generate/n": [2, 4, -1], "/scene/thickness": [1.0, 2.0]}}));
    let (status, printed, _) = ran(folder.path(), &["sweep", "sweep.json", "--out", "r.jsonl"]);
    assert!(status == 0 && printed.contains("6 cases: 6 ran, 2 failed"), "{printed}");
    let rows = rows(folder.path(), "r.jsonl");
    let u = |k: usize| rows[k]["max_displacement"].as_f64().expect("a number");
    assert!(u(2) > u(0) && (u(0) / u(1) - 2.0).abs() < 0.1 || u(1) != u(0));
    assert_eq!(rows[4]["exit_status"], 2);
}

#[test]
fn faults_of_the_file_are_named() {
    let says = |sweep: Value, words: &str| {
        let folder = folder(&sweep);
        let (status, _, errors) = ran(folder.path(), &["sweep", "sweep.json"]);
        assert!(status == 2 && errors.contains(words), "{words}: {errors}");
    };
    says(json!({"format": 2}), "format 2");
    says(json!({"format": 1, "grit": {}}), "grit");
    says(json!({"format": 1}), "either scene or generate");
    says(
        json!({"format": 1, "scene": "fig1", "grid": {"/scene/x": 3}}),
        "neither a list nor steps",
    );
    says(json!({"format": 1, "scene": "nowhere"}), "cannot be read");
    // A pointer that leads nowhere is a row: other cases run.
    let folder = folder(&json!({"format": 1, "scene": "fig1", "list": [{"/scene/a/b": 1}, {}]}));
    let printed = ran(folder.path(), &["sweep", "sweep.json", "--out", "r.jsonl"]).1;
    assert!(printed.contains("2 cases: 2 ran, 1 failed"), "{printed}");
}

#[test]
fn keys_tell_scene_options_and_nothing_else_apart() {
    let folder = TempDir::new().expect("a folder");
    let key = |args: &[&str]| {
        let (status, printed, errors) = ran(folder.path(), &[&["scene", "key"], args].concat());
        assert_eq!(status, 0, "{errors}");
        printed
    };
    assert_eq!(key(&["fig1"]), key(&["fig1"]));
    let all = [key(&["fig1"]), key(&["strand"]), key(&["fig1", "--variant", "tied"])];
    assert!(all[0] != all[1] && all[0] != all[2] && all.iter().all(|key| key.len() == 65));
}

#[test]
fn an_equal_row_is_left_alone_and_rows_are_gathered() {
    let folder = folder(&of_fig1(6));
    let at = folder.path();
    std::fs::create_dir(at.join("rows")).expect("a folder");
    for case in 0..6 {
        let row = format!("rows/{case}.json");
        let args = ["sweep", "sweep.json", "--case", &case.to_string(), "--row", &row];
        assert_eq!(ran(at, &args).0, 0);
        let written = std::fs::metadata(at.join(&row)).and_then(|m| m.modified()).expect("a time");
        assert_eq!(ran(at, &args).0, 0);
        let again = std::fs::metadata(at.join(&row)).and_then(|m| m.modified()).expect("a time");
        assert_eq!(written, again);
    }
    let gather = ["sweep", "sweep.json", "--rows", "rows", "--out", "gathered.jsonl"];
    assert!(ran(at, &gather).1.contains("6 cases: 0 ran, 0 failed"));
    ran(at, &["sweep", "sweep.json", "--out", "own.jsonl"]);
    let read = |name: &str| std::fs::read(at.join(name)).expect("rows");
    assert!(read("gathered.jsonl") == read("own.jsonl"));
    assert_eq!(ran(at, &["sweep", "sweep.json", "--case", "6", "--row", "rows/6.json"]).0, 2);
}

/// Starts a sweep that prints nothing.
fn start(folder: &Path, out: &str) -> Child {
    let mut command = Command::new(PROGRAM);
    command.args(["sweep", "sweep.json", "--out", out]).current_dir(folder);
    command.stdout(Stdio::null()).stderr(Stdio::null()).spawn().expect("the program starts")
}

/// A sweep killed twenty times at random, its workers too, ends with the bytes of one that was not.
#[cfg(target_os = "linux")]
#[test]
fn a_sweep_that_was_killed_twenty_times_ends_with_the_same_bytes() {
    let folder = folder(&of_fig1(4000));
    let mut rng = fastrand::Rng::with_seed(20);
    assert!(start(folder.path(), "whole.jsonl").wait().expect("it ends").success());
    let mut killed = 0;
    let mut pause = 150;
    while killed < 20 {
        let mut sweep = start(folder.path(), "killed.jsonl");
        std::thread::sleep(Duration::from_millis(rng.u64(1..=pause)));
        if killed % 3 == 0 {
            children(sweep.id()).into_iter().for_each(|id| _ = kill(id));
        }
        match sweep.try_wait().expect("it can be asked") {
            // It ended before: the next one has less time, and starts anew.
            Some(_) => {
                pause = pause.div_ceil(2);
                let _ = std::fs::remove_file(folder.path().join("killed.jsonl"));
            }
            None => {
                sweep.kill().expect("it is killed");
                killed += 1;
            }
        }
        sweep.wait().expect("it ended");
    }
    assert!(start(folder.path(), "killed.jsonl").wait().expect("it ends").success());
    let read = |name: &str| std::fs::read(folder.path().join(name)).expect("rows");
    assert!(read("whole.jsonl") == read("killed.jsonl"));
    assert_eq!(rows(folder.path(), "killed.jsonl").len(), 4000);
}

/// A worker that is killed in the middle loses nothing.
#[cfg(target_os = "linux")]
#[test]
fn killed_workers_lose_no_case() {
    let folder = folder(&of_fig1(4000));
    let mut sweep = start(folder.path(), "r.jsonl");
    for _ in 0..5 {
        std::thread::sleep(Duration::from_millis(40));
        children(sweep.id()).into_iter().take(1).for_each(|id| _ = kill(id));
    }
    assert!(sweep.wait().expect("it ends").success());
    let rows = rows(folder.path(), "r.jsonl");
    assert_eq!(rows.len(), 4000);
    assert!(rows.iter().all(|row| row["exit_status"] == 0));
}

/// The processes that a process has started.
#[cfg(target_os = "linux")]
fn children(id: u32) -> Vec<u32> {
    let tasks = std::fs::read_dir(format!("/proc/{id}/task")).into_iter().flatten().flatten();
    let of_task =
        |task: std::fs::DirEntry| std::fs::read_to_string(task.path().join("children")).ok();
    let lists: Vec<String> = tasks.filter_map(of_task).collect();
    lists.iter().flat_map(|list| list.split_whitespace()).filter_map(|id| id.parse().ok()).collect()
}

/// Kills a process; returns whether it was there.
#[cfg(target_os = "linux")]
fn kill(id: u32) -> bool {
    let mut kill = Command::new("kill");
    let status = kill.args(["-9", &id.to_string()]).stderr(Stdio::null()).status();
    status.expect("kill is there").success()
}

/// A case that takes more seconds than its process may have ends it, and is a row; the others run.
#[cfg(target_os = "linux")]
#[test]
fn a_crash_is_a_row() {
    let folder = folder(&json!({"format": 1, "generate": {"kind": "cook"},
        "grid": {"/generate/n": [2, 300, 4]}}));
    let limited = format!("ulimit -t 1; exec {PROGRAM} sweep sweep.json --out r.jsonl");
    let output = Command::new("sh").args(["-c", &limited]).current_dir(folder.path()).output();
    let output = output.expect("a shell");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let rows = rows(folder.path(), "r.jsonl");
    assert_eq!((&rows[0]["exit_status"], &rows[2]["exit_status"]), (&json!(0), &json!(0)));
    let error = rows[1]["error"].as_str().expect("words");
    assert!(error.contains("crashed"), "{error}");
}

#[test]
fn a_second_sweep_of_the_same_rows_is_refused() {
    let folder = folder(&of_fig1(4));
    let held = std::fs::File::create(folder.path().join("r.jsonl.journal")).expect("a file");
    held.lock().expect("a lock");
    let (status, _, errors) = ran(folder.path(), &["sweep", "sweep.json", "--out", "r.jsonl"]);
    assert!(status == 2 && errors.contains("another sweep writes these rows"), "{errors}");
}

/// Rows for which there is no file leave none beside it either.
#[test]
fn rows_that_would_be_a_folder_are_refused_and_leave_nothing() {
    let folder = folder(&of_fig1(4));
    let (status, _, errors) = ran(folder.path(), &["sweep", "sweep.json", "--out", "."]);
    assert!(status == 2 && errors.contains("it is a folder"), "{errors}");
    let left = std::fs::read_dir(folder.path()).expect("a folder").count();
    assert_eq!(left, 1, "the sweep alone");
}

/// A row that cannot be written is worth another try: the exit status says so to an engine.
#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_worth_another_try() {
    let folder = folder(&of_fig1(4));
    let args = ["sweep", "sweep.json", "--case", "1", "--row", "/dev/full"];
    let (status, _, errors) = ran(folder.path(), &args);
    assert!(status == 75 && errors.contains("cannot be written"), "{errors}");
}

/// The job file of an engine, made for a thousand cases, in the folder of the sweep.
fn emitted(at: &Path, engine: &str, file: &str) {
    let (status, jobs, errors) = ran(at, &["sweep", "sweep.json", "--emit", engine]);
    assert_eq!(status, 0, "{errors}");
    std::fs::write(at.join(file), jobs).expect("written");
}

/// Checks that an engine's rows are those of a sweep on this machine, none lost and none doubled.
fn same_as_here(at: &Path) {
    let gathered =
        std::fs::read(at.join("out/sweep.jsonl")).expect("the job file gathers the rows");
    assert!(ran(at, &["sweep", "sweep.json", "--out", "here.jsonl"]).1.contains("1000 ran"));
    assert!(gathered == std::fs::read(at.join("here.jsonl")).expect("rows"));
    assert_eq!(rows_there(at), 1000);
}

/// The number of rows that an engine has written.
fn rows_there(at: &Path) -> usize {
    let rows = std::fs::read_dir(at.join("sweep.rows")).into_iter().flatten().flatten();
    rows.filter(|row| row.path().extension().is_some_and(|extension| extension == "json")).count()
}

/// A server of HyperQueue with two workers, which runs a job file.
const CLUSTER: &str = "
import os, subprocess, sys
from hyperqueue import LocalCluster
from hyperqueue.cluster import WorkerConfig
with LocalCluster() as cluster:
    for _ in range(2):
        cluster.start_worker(WorkerConfig(cores=1))
    environment = dict(os.environ, HQ_SERVER_DIR=str(cluster.cluster.server_dir), HQ_MEMORY='0')
    sys.exit(subprocess.run([sys.executable, 'jobs.py'], env=environment).returncode)
";

/// A thousand cases on HyperQueue; the process of its server and both workers is killed in the middle
/// and started again: nothing is lost, and nothing doubled.
#[test]
fn hyperqueue_runs_a_thousand_cases_with_its_workers_killed_in_the_middle() {
    let mut package = Command::new("python3");
    package.args(["-c", "import hyperqueue"]);
    if !is_there(package, "REQUIRE_HYPERQUEUE") {
        return;
    }
    let folder = folder(&of_fig1(1000));
    let at = folder.path();
    emitted(at, "hyperqueue", "jobs.py");
    let start = || {
        let mut command = Command::new("python3");
        command.args(["-c", CLUSTER]).current_dir(at).stdout(Stdio::null()).stderr(Stdio::null());
        command.spawn().expect("python")
    };
    let rows = || rows_there(at);
    let mut cluster = start();
    let since = Instant::now();
    while rows() < 200 {
        assert!(since.elapsed() < Duration::from_secs(120), "the engine runs nothing");
        std::thread::sleep(Duration::from_millis(20));
    }
    cluster.kill().expect("it is killed");
    cluster.wait().expect("it ended");
    assert!(rows() < 1000, "it was killed in the middle");
    assert!(start().wait().expect("it ends").success());
    same_as_here(at);
}

/// The processes that a process has started, and those that these have.
#[cfg(target_os = "linux")]
fn descendants(id: u32) -> Vec<u32> {
    children(id).into_iter().flat_map(|id| [vec![id], descendants(id)].concat()).collect()
}

/// A thousand cases on Snakemake; three that are running are killed in the middle, and tried again.
#[cfg(target_os = "linux")]
#[test]
fn snakemake_runs_a_thousand_cases_of_which_three_are_killed() {
    let mut program = Command::new("snakemake");
    program.arg("--version");
    if !is_there(program, "REQUIRE_SNAKEMAKE") {
        return;
    }
    let folder = folder(&of_fig1(1000));
    let at = folder.path();
    emitted(at, "snakemake", "Snakefile");
    let args = ["--cores", "2", "--quiet", "all"];
    let mut command = Command::new("snakemake");
    command.args(args).current_dir(at).stdout(Stdio::null()).stderr(Stdio::null());
    let mut engine = command.spawn().expect("snakemake");
    let is_case = |id: &u32| {
        let program = std::fs::read_link(format!("/proc/{id}/exe"));
        program.is_ok_and(|program| program == Path::new(PROGRAM))
    };
    let mut killed = 0;
    while killed < 3 {
        assert!(engine.try_wait().expect("it can be asked").is_none(), "it ended before");
        if rows_there(at) >= 100 {
            let cases = descendants(engine.id()).into_iter().filter(is_case);
            killed += cases.filter(|id| kill(*id)).count();
        }
    }
    assert!(engine.wait().expect("it ends").success());
    same_as_here(at);
}

/// Names that a shell, an engine or an option would take for something else.
const NAMES: &[&str] = &[
    "a b",
    "x;touch pwned;",
    "$(touch pwned)",
    "`touch pwned`",
    "q'u\"o",
    "{}{.}{case}{output}{{x}}",
    "-dash",
    "+plus",
    "line\nbreak",
    "back\\slash%n&|<>*?#~!$HOME",
];

/// Runs the job file that `engine` is given for a sweep of each of the names: its rows are those of
/// a sweep on this machine, and nothing else is run.
fn names_reach(engine: &str, run: impl Fn(&Path)) {
    for name in NAMES {
        let folder = folder(&of_fig1(2));
        let at = folder.path();
        let file = format!("{name}.json");
        std::fs::rename(at.join("sweep.json"), at.join(&file)).expect("it is renamed");
        let (status, jobs, errors) = ran(at, &["sweep", "--emit", engine, "--", &file]);
        if engine == "commands" && name.contains('\n') {
            assert_eq!(status, 2);
            continue;
        }
        assert_eq!(status, 0, "{name}: {errors}");
        std::fs::write(at.join("jobs.py"), jobs).expect("written");
        run(at);
        if engine == "commands" {
            let rows = format!("--rows={name}.rows");
            assert_eq!(ran(at, &["sweep", &rows, "--", &file]).0, 0, "{name}");
        }
        let gathered = std::fs::read(at.join("out").join(format!("{name}.jsonl")));
        let gathered = gathered.unwrap_or_else(|why| panic!("{engine}, {name:?}: {why}"));
        assert_eq!(ran(at, &["sweep", "--out", "here.jsonl", "--", &file]).0, 0);
        assert!(gathered == std::fs::read(at.join("here.jsonl")).expect("rows"), "{name:?}");
        assert!(!at.join("pwned").exists(), "{engine}, {name:?}");
    }
}

fn succeeds(command: &mut Command, at: &Path) {
    let output = command.current_dir(at).output().expect("it starts");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
}

#[test]
fn any_name_reaches_hyperqueue() {
    let mut package = Command::new("python3");
    package.args(["-c", "import hyperqueue"]);
    if is_there(package, "REQUIRE_HYPERQUEUE") {
        names_reach("hyperqueue", |at| succeeds(Command::new("python3").args(["-c", CLUSTER]), at));
    }
}

#[test]
fn any_name_reaches_snakemake() {
    let mut program = Command::new("snakemake");
    program.arg("--version");
    if is_there(program, "REQUIRE_SNAKEMAKE") {
        let args = ["-s", "jobs.py", "--cores", "2"];
        names_reach("snakemake", |at| succeeds(Command::new("snakemake").args(args), at));
    }
}

/// Commands are lines of the shell, each of which has a whole name.
#[test]
fn any_name_reaches_a_command() {
    names_reach("commands", |at| succeeds(Command::new("sh").arg("jobs.py"), at));
}

/// A case runs again where a file that it reads has changed, and no other does.
#[test]
fn a_case_is_known_by_every_file_that_it_reads() {
    let folder = folder(&json!({"format": 1, "scene": "c2/scene.json",
        "grid": {"/scene/mesh": ["a.msh", "b.msh"], "/options/c_tll": [null]}}));
    let at = folder.path();
    for n in ["2", "3", "4"] {
        assert_eq!(ran(at, &["scene", "mesh", "cook", "--n", n, "--out", &format!("c{n}")]).0, 0);
    }
    let copy = |from: &str, to: &str| {
        std::fs::copy(at.join(from), at.join("c2").join(to)).expect("a copy");
    };
    let largest = || -> Vec<f64> {
        let rows = rows(at, "r.jsonl");
        rows.iter().map(|row| row["max_displacement"].as_f64().expect("a number")).collect()
    };
    let sweep = |ran_again: &str| {
        let printed = ran(at, &["sweep", "sweep.json", "--out", "r.jsonl"]).1;
        assert!(printed.contains(&format!("2 cases: {ran_again} ran, 0 failed")), "{printed}");
        let found = largest();
        std::fs::remove_file(at.join("r.jsonl")).expect("rows");
        assert_eq!(ran(at, &["sweep", "sweep.json", "--out", "r.jsonl"]).0, 0);
        assert_eq!(found, largest(), "the rows are those of a sweep from the start");
    };
    copy("c2/cook.msh", "a.msh");
    copy("c3/cook.msh", "b.msh");
    sweep("2");
    sweep("0");
    copy("c4/cook.msh", "b.msh");
    sweep("1");
    copy("c3/cook.msh", "a.msh");
    sweep("1");
    copy("c4/cook.msh", "cook.msh");
    sweep("0");
    let scene = std::fs::read_to_string(at.join("c2/scene.json")).expect("a scene");
    std::fs::write(at.join("c2/scene.json"), scene.replace("0.0625", "0.125")).expect("written");
    sweep("2");
}

/// Every engine's job file names the cases, the memory and how rows are gathered.
#[test]
fn job_files_name_cases_and_memory() {
    let folder = folder(&of_fig1(10));
    for (engine, words) in [
        ("hyperqueue", ["job.program(", "\"mem\": MEGABYTES"]),
        ("snakemake", ["mem_mb=", "retries: 2"]),
    ] {
        let (status, jobs, _) = ran(folder.path(), &["sweep", "sweep.json", "--emit", engine]);
        assert_eq!(status, 0);
        for word in words.iter().chain(&["--rows"]) {
            assert!(jobs.contains(word), "{word}: {jobs}");
        }
    }
}
