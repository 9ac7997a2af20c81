//! Every file is whole, whatever happens in the middle: kills, full disks, two runs at once, folders
//! that cannot be written.
#![cfg(target_os = "linux")]

use std::collections::BTreeMap;
use std::os::unix::process::ExitStatusExt;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use std::time::{Duration, Instant};

use rustix::process::{Pid, Signal, kill_process};
use tempfile::TempDir;

use crate::common::program::run;

/// The kills of a test; the variable of this name asks for more.
const KILLS: (&str, usize) = ("PLANE_CONTACT_KILLS", 24);

/// How soon a signal ends a run, beside other tests on a busy machine; alone it is below 0.2 s.
const SOON: Duration = Duration::from_secs(2);

/// How the name of everything temporary begins.
const STAGED: &str = ".plane-contact-";

/// Two runs that leave different files.
const RUNS: [&[&str]; 2] = [
    &["solve", "fig1", "--variant", "tied", "--no-error-estimate", "--out", "o"],
    &[
        "solve",
        "fig1",
        "--variant",
        "printed",
        "--no-error-estimate",
        "--no-pictures",
        "--out",
        "o",
    ],
];

type Files = BTreeMap<String, Vec<u8>>;

/// Runs a line of the shell, in which `$P` is the program.
fn shell(folder: &Path, line: &str) -> Output {
    Command::new("sh")
        .args(["-c", line])
        .env("P", env!("CARGO_BIN_EXE_plane-contact"))
        .current_dir(folder)
        .output()
        .expect("a shell")
}

/// The content of each file in `folder` and below, by its name there; none where it is missing.
fn files(folder: &Path) -> Files {
    let mut found = Files::new();
    for entry in std::fs::read_dir(folder).into_iter().flatten() {
        let entry = entry.expect("an entry");
        let name = entry.file_name().into_string().expect("UTF-8");
        if entry.path().is_dir() {
            found.extend(files(&entry.path()).into_iter().map(|(k, v)| (format!("{name}/{k}"), v)));
        } else {
            found.insert(name, std::fs::read(entry.path()).expect("a file"));
        }
    }
    found
}

/// The names of what is temporary in `folder`.
fn staged(folder: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
    let names = entries.map(|entry| entry.file_name().to_string_lossy().into_owned());
    names.filter(|name| name.starts_with(STAGED)).collect()
}

/// The name and size of each file in `folder` and below, as they are while a run changes them.
fn sizes(folder: &Path) -> BTreeMap<PathBuf, u64> {
    let mut found = BTreeMap::new();
    for entry in std::fs::read_dir(folder).into_iter().flatten().flatten() {
        found.extend(sizes(&entry.path()));
        found.insert(entry.path(), entry.metadata().map_or(0, |file| file.len()));
    }
    found
}

/// What each of the two runs leaves; what the first left is there.
fn whole(folder: &Path) -> [Files; 2] {
    let [second, first] = [1, 0].map(|k| {
        let _ = std::fs::remove_dir_all(folder.join("o"));
        assert!(run(folder, RUNS[k]).status.success());
        files(&folder.join("o"))
    });
    assert_ne!(first, second);
    [first, second]
}

/// Starts the program so that it heeds SIGINT, also where the tests run in the background.
fn start(folder: &Path, args: &[&str]) -> Child {
    Command::new("env")
        .args(["--default-signal=INT", env!("CARGO_BIN_EXE_plane-contact")])
        .args(args)
        .current_dir(folder)
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .expect("the program starts")
}

/// Sends `signal` to a process, and returns how long it lives on and the signal that it died of;
/// None where it had ended by itself.
fn kill(child: &mut Child, signal: Signal) -> (Duration, Option<i32>) {
    let sent = Instant::now();
    let _ = kill_process(Pid::from_child(child), signal);
    let status = child.wait().expect("it ends");
    (sent.elapsed(), status.signal())
}

/// Asserts that each file of a folder is whole, from one run or the other, but for what is temporary.
#[track_caller]
fn each_is_whole(folder: &Path, expected: &[Files; 2]) {
    for (name, content) in files(folder) {
        let is_whole = expected.iter().any(|files| files.get(&name) == Some(&content));
        assert!(is_whole || name.starts_with(STAGED), "{name}");
    }
}

/// Kills at equal parts of a run, and kills that come when the folder has changed once and more often: while files are
/// staged and put in their places. After a kill the next run finds the folder to be the program's.
#[test]
fn a_kill_leaves_whole_files() {
    let folder = TempDir::new().expect("a folder");
    let expected = whole(folder.path());
    let out = folder.path().join("o");
    let kills = std::env::var(KILLS.0).ok().map_or(KILLS.1, |n| n.parse().expect("a number"));
    let begun = Instant::now();
    assert!(run(folder.path(), RUNS[0]).status.success());
    let duration = begun.elapsed();
    let (mut died, mut slowest) = (0, Duration::ZERO);
    for k in 0..kills {
        let signal = [Signal::KILL, Signal::TERM, Signal::INT, Signal::HUP][k / 2 % 4];
        let left = staged(&out);
        let mut child = start(folder.path(), RUNS[k / 4 % 2]);
        if k % 2 == 0 {
            std::thread::sleep(duration * k as u32 / kills as u32);
        } else {
            let (mut changes, mut last) = (0, sizes(&out));
            while changes < 1 + k / 8 && child.try_wait().expect("a process").is_none() {
                let now = sizes(&out);
                changes += usize::from(now != last);
                last = now;
            }
        }
        let (lived, of) = kill(&mut child, signal);
        each_is_whole(&out, &expected);
        if let Some(of) = of {
            assert_eq!(of, signal.as_raw());
            died += 1;
            slowest = slowest.max(lived);
            assert!(lived < SOON, "{signal:?} took {lived:?}");
            if signal != Signal::KILL {
                let new = staged(&out).into_iter().find(|name| !left.contains(name));
                assert_eq!(new, None, "kill {k} by {signal:?}");
            }
        }
    }
    println!("{kills} kills, {died} in the middle; at most {slowest:?}");
    assert!(died > 0, "every run ended before its kill");
    assert!(run(folder.path(), RUNS[0]).status.success());
    for (name, content) in &expected[0] {
        assert_eq!(files(&out).get(name), Some(content), "{name}");
    }
}

/// Signals that come when a temporary folder is made, written or removed: one after each 80 µs.
#[test]
fn a_signal_at_any_moment_leaves_nothing_temporary() {
    let folder = TempDir::new().expect("a folder");
    for k in 0..100 {
        let mut child = start(folder.path(), &["scene", "mesh", "blocks", "--out", "o"]);
        std::thread::sleep(Duration::from_micros(80 * k));
        kill(&mut child, Signal::TERM);
        assert_eq!(staged(&folder.path().join("o")), [""; 0], "signal {k}");
        let _ = std::fs::remove_dir_all(folder.path().join("o"));
    }
}

#[test]
fn a_long_run_ends_by_a_signal_and_leaves_the_old_files() {
    let folder = TempDir::new().expect("a folder");
    whole(folder.path());
    let before = files(&folder.path().join("o"));
    for signal in [Signal::INT, Signal::TERM] {
        let mut child = start(folder.path(), &["report", "strand", "--out", "o/r.html"]);
        std::thread::sleep(Duration::from_millis(300));
        let (lived, of) = kill(&mut child, signal);
        assert_eq!(of, Some(signal.as_raw()));
        assert!(lived < SOON, "{signal:?} took {lived:?}");
        assert_eq!(files(&folder.path().join("o")), before);
    }
}

#[test]
fn two_runs_into_one_folder_leave_whole_files() {
    let folder = TempDir::new().expect("a folder");
    let expected = whole(folder.path());
    for _ in 0..8 {
        let both = RUNS.map(|args| start(folder.path(), args));
        for mut child in both {
            assert!(child.wait().expect("it ends").success());
        }
        each_is_whole(&folder.path().join("o"), &expected);
    }
    assert_eq!(staged(&folder.path().join("o")), [""; 0]);
}

/// A folder below may be a link.
#[test]
fn no_file_is_written_through_a_link() {
    let folder = TempDir::new().expect("a folder");
    let at = |name: &str| folder.path().join(name);
    ["o", "d"].iter().for_each(|name| std::fs::create_dir(at(name)).expect("a folder"));
    std::os::unix::fs::symlink("../d", at("o/below")).expect("a link");
    std::fs::write(at("o/notes.txt"), "mine").expect("it is written");
    let write = |name| plane_contact::files::write_all(&at("o"), &[("a", "1"), (name, "2")]);
    let why = write("below/b").expect_err("it leads out");
    assert!(why.what.contains("below/b is in the way: a folder on its way is a link"), "{why}");
    assert_eq!(files(folder.path()), Files::from([("o/notes.txt".into(), b"mine".to_vec())]));
    write("there/b").expect("it is a folder of its own");
    assert!(at("o/there/b").is_file());
}

/// Whichever signal ends the program, CalculiX ends with it, and so does what it started.
#[test]
fn calculix_ends_with_the_program() {
    let folder = TempDir::new().expect("a folder");
    let ccx = "#!/bin/sh\nif [ $1 = -v ]; then echo Version 2.21; exit; fi\n\
               sleep 300 &\necho $! > id.new\nmv id.new ../id\nwait\n";
    let made = format!("mkdir t; printf '%s' '{ccx}' > ccx; chmod +x ccx");
    assert!(shell(folder.path(), &made).status.success());
    for signal in [Signal::HUP, Signal::INT, Signal::QUIT, Signal::TERM] {
        let mut child = Command::new("env")
            .args(["--default-signal=INT,QUIT,HUP", env!("CARGO_BIN_EXE_plane-contact")])
            .args(["compare", "fig1", "--ccx", "./ccx"])
            .env("TMPDIR", folder.path().join("t"))
            .current_dir(folder.path())
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .expect("the program starts");
        let started = "for i in $(seq 600); do test -s t/id && exit; sleep 0.05; done; exit 1";
        assert!(shell(folder.path(), started).status.success(), "CalculiX starts");
        assert!(kill(&mut child, signal).1.is_some(), "{signal:?}");
        let left = "sleep 0.2; ps -o args= -p $(cat t/id); rm t/id; ls -A t";
        let left = String::from_utf8(shell(folder.path(), left).stdout).expect("UTF-8");
        assert!(!left.contains("300") && !left.contains("plane"), "{signal:?}: {left}");
    }
}

/// Of several that read a file and replace it, one does; the others are told that it was changed.
#[test]
fn no_update_is_lost() {
    let folder = TempDir::new().expect("a folder");
    let file = folder.path().join("s.json");
    std::fs::write(&file, "old").expect("it is written");
    let replace = |_| plane_contact::files::rewrite(&file, b"old", "new!");
    let replaced: Vec<_> = std::thread::scope(|scope| {
        let threads: Vec<_> = (0..8).map(|k| scope.spawn(move || replace(k))).collect();
        threads.into_iter().map(|thread| thread.join().expect("no panic")).collect()
    });
    let (done, refused): (Vec<_>, Vec<_>) = replaced.into_iter().partition(Result::is_ok);
    assert_eq!((done.len(), refused.len()), (1, 7));
    let changed = |why: &plane_contact::error::InputError| why.what.contains("was changed since");
    assert!(refused.iter().filter_map(|refused| refused.as_ref().err()).all(changed));
    assert_eq!(std::fs::read_to_string(&file).expect("a file"), "new!");
}
