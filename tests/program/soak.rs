//! Many runs, of every command and in one process: memory does not grow, and no file handle and no
//! temporary file is left. The variable `PLANE_CONTACT_SOAK` asks for more runs.
#![cfg(target_os = "linux")]

use std::io::{BufRead, BufReader, Write};
use std::path::Path;
use std::process::{Command, Stdio};

use serde_json::json;
use tempfile::TempDir;

/// How far the memory of a process may grow after its first quarter: what an allocator keeps.
const GROWTH: u64 = 16_000_000;

/// A command line for each command.
const COMMANDS: &[&str] = &[
    "solve fig1",
    "solve two-blocks --variant unilateral --friction 0.3 --out s",
    "solve fig1 --variant printed --no-pictures --out s",
    "snapshot record fig1 --variant tied,stepped",
    "snapshot verify out/fig1.snapshot.json",
    "snapshot explain out/fig1.snapshot.json",
    "snapshot diff out/fig1.snapshot.json out/fig1.snapshot.json",
    "snapshot accept out/fig1.snapshot.json --reason soak",
    "sweep sweep.json",
    "scene key fig1",
    "audit fig1 --out a",
    "audit --finding C4",
    "listing run c_cnt fig1",
    "listing run Km fig1",
    "scene mesh blocks",
    "scene list",
    "scene copy C4 --out c4",
    "scene plan fig1",
    "listing trace fig1",
    "listing evaluate sum.txt --call f(3)",
    "mathcad run fig1.xmcd",
    "listing convert c_cnt --to xmcd",
    "lesson fig1 --out lesson.html",
    "report fig1 --out report.html",
    "trade fig1 --only symmetry --runs 1",
    "mathcad export fig1 --to mathcad --out fig1.xmcd",
    "compare fig1 --ccx false",
    "extremes --list",
    "scene schema",
    "solve nosuch",
];

/// The number of runs that is asked for.
fn runs(plain: usize) -> usize {
    std::env::var("PLANE_CONTACT_SOAK").map_or(plain, |n| n.parse().expect("a number of runs"))
}

/// Writes what the commands read.
fn prepare(folder: &Path) {
    let sweep = json!({
        "format": 1,
        "scene": "fig1",
        "grid": {
            "/options/variant": ["printed", "tied", "stepped", "unilateral"],
            "/scene/contact/c_tll": [1e-4, 1e-3, -1.0]
        }
    });
    std::fs::write(folder.join("sweep.json"), sweep.to_string()).expect("it is written");
    std::fs::write(folder.join("sum.txt"), "f(n) :=\n  n + 1\n").expect("it is written");
}

#[test]
fn runs_of_every_command_leave_nothing_temporary() {
    let (folder, temporary) =
        (TempDir::new().expect("a folder"), TempDir::new().expect("a folder"));
    prepare(folder.path());
    let mut random = fastrand::Rng::with_seed(16);
    let mut ended = std::collections::BTreeMap::<Option<i32>, usize>::new();
    for _ in 0..runs(12) {
        let line = random.choice(COMMANDS).expect("a command");
        let output = Command::new(env!("CARGO_BIN_EXE_plane-contact"))
            .args(line.split(' '))
            .current_dir(folder.path())
            .env("TMPDIR", temporary.path())
            .output()
            .expect("the program starts");
        let status = output.status.code();
        let error = String::from_utf8_lossy(&output.stderr);
        assert!(status.is_some_and(|status| status <= 4), "{line}: {status:?} {error}");
        *ended.entry(status).or_default() += 1;
        let left = |folder: &Path| {
            let entries = std::fs::read_dir(folder).expect("a folder").flatten();
            entries
                .map(|entry| entry.file_name().to_string_lossy().into_owned())
                .collect::<Vec<_>>()
        };
        assert_eq!(left(temporary.path()), [""; 0], "{line}");
        let mut here = left(folder.path()).into_iter();
        assert_eq!(here.find(|name| name.starts_with(".plane-contact")), None, "{line}");
    }
    println!("runs by exit status: {ended:?}");
}

/// The memory that a process uses, bytes, and its open files.
fn used(process: u32) -> (u64, usize) {
    let text = std::fs::read_to_string(format!("/proc/{process}/status")).expect("a process");
    let line = text.lines().find_map(|line| line.strip_prefix("VmRSS:")).expect("its memory");
    let kilobytes: u64 = line.trim().trim_end_matches(" kB").parse().expect("a number");
    let files = std::fs::read_dir(format!("/proc/{process}/fd")).expect("its files").count();
    (1000 * kilobytes, files)
}

/// The process that runs the cases of a sweep solves them one after another.
#[test]
fn solves_in_one_process_need_no_more_memory_and_no_more_files() {
    let folder = TempDir::new().expect("a folder");
    prepare(folder.path());
    let mut child = Command::new(env!("CARGO_BIN_EXE_plane-contact"))
        .args(["sweep", "sweep.json", "--worker"])
        .current_dir(folder.path())
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .expect("the program starts");
    let mut cases = child.stdin.take().expect("standard input");
    let mut rows = BufReader::new(child.stdout.take().expect("standard output")).lines();
    let mut known = vec![None; 12];
    let (all, mut random) = (runs(48), fastrand::Rng::with_seed(16));
    let (mut first, mut most, mut files) = (0, 0, 0);
    for k in 0..all {
        let case = random.usize(..known.len());
        writeln!(cases, "{case}").expect("it reads");
        let row = rows.next().expect("a row").expect("UTF-8");
        assert_eq!(*known[case].get_or_insert_with(|| row.clone()), row, "case {case}");
        let (bytes, open) = used(child.id());
        if k < all / 4 {
            (first, files) = (bytes.max(first), open);
        }
        most = bytes.max(most);
        assert_eq!(open, if k < all / 4 { open } else { files }, "open files after {k} solves");
    }
    drop(cases);
    assert!(child.wait().expect("it ends").success());
    println!("{all} solves: {first} bytes after a quarter, at most {most}, {files} open files");
    assert!(most <= first + GROWTH, "{first} bytes after a quarter, {most} later");
}
