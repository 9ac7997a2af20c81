//! Every file is whole, whatever happens in the middle: kills, full disks, two runs at once, folders
//! that cannot be written.
#![cfg(target_os = "linux")]

use std::collections::BTreeMap;
use std::os::unix::process::ExitStatusExt;
use std::path::Path;
use std::process::{Child, Command, Output, Stdio};
use std::time::{Duration, Instant};

use tempfile::TempDir;

use crate::common::program::run;

/// The kills of a test; the variable of this name asks for more.
const KILLS: (&str, u32) = ("PLANE_CONTACT_KILLS", 20);

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

/// Checks that a line ends with exit status 2, and that its error has all the `words`.
#[track_caller]
fn refused(folder: &Path, line: &str, words: &[&str]) {
    let output = shell(folder, line);
    let error = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(2), "{line}: {error}");
    for word in words {
        assert!(error.contains(word), "{line}: {word:?} is not in {error}");
    }
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

/// What each of the two runs leaves, and the longer of their durations; what the first left is there.
fn whole(folder: &Path) -> ([Files; 2], Duration) {
    let mut longest = Duration::ZERO;
    let found = [1, 0].map(|k| {
        let _ = std::fs::remove_dir_all(folder.join("o"));
        let start = Instant::now();
        assert!(run(folder, RUNS[k]).status.success());
        longest = longest.max(start.elapsed());
        files(&folder.join("o"))
    });
    let [second, first] = found;
    let found = [first, second];
    assert_ne!(found[0], found[1]);
    (found, longest)
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
fn kill(child: &mut Child, signal: &str) -> (Duration, Option<i32>) {
    let kill = format!("kill -{signal} {} 2>/dev/null", child.id());
    let sent = Instant::now();
    let _ = Command::new("sh").args(["-c", &kill]).status().expect("a shell");
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

/// Every other kill comes when files are being written: something temporary is there. After it the
/// next run finds the folder to be the program's.
#[test]
fn a_kill_leaves_whole_files() {
    let folder = TempDir::new().expect("a folder");
    let (expected, duration) = whole(folder.path());
    let out = folder.path().join("o");
    let kills = std::env::var(KILLS.0).ok().map_or(KILLS.1, |n| n.parse().expect("a number"));
    let mut random = fastrand::Rng::with_seed(16);
    let (mut died, mut slowest) = (0, Duration::ZERO);
    // On a busy machine runs may end before their kill comes: then there are more.
    for k in 0.. {
        if k >= kills && died > 0 {
            break;
        }
        assert!(k < 20 * kills, "every run ended before its kill");
        let (signal, number) = [("KILL", 9), ("TERM", 15), ("INT", 2), ("HUP", 1)][k as usize % 4];
        let left = staged(&out);
        let mut child = start(folder.path(), RUNS[random.usize(..2)]);
        if k % 2 == 0 {
            std::thread::sleep(duration.mul_f64(1.2 * random.f64()));
        } else {
            let is_staged = || staged(&out).iter().any(|name| !left.contains(name));
            while !is_staged() && child.try_wait().expect("a process").is_none() {}
            std::thread::sleep(Duration::from_micros(random.u64(0..4000)));
        }
        let (lived, of) = kill(&mut child, signal);
        each_is_whole(&out, &expected);
        if let Some(of) = of {
            assert_eq!(of, number);
            died += 1;
            slowest = slowest.max(lived);
            assert!(lived < SOON, "{signal} took {lived:?}");
            if signal != "KILL" {
                let new = staged(&out).into_iter().find(|name| !left.contains(name));
                assert_eq!(new, None, "kill {k} by {signal}");
            }
        }
    }
    println!("{kills} kills, {died} in the middle; at most {slowest:?}");
    assert!(run(folder.path(), RUNS[0]).status.success());
    for (name, content) in &expected[0] {
        assert_eq!(files(&out).get(name), Some(content), "{name}");
    }
}

/// Signals that come when a temporary folder is made, written or removed.
#[test]
fn a_signal_at_any_moment_leaves_nothing_temporary() {
    let folder = TempDir::new().expect("a folder");
    let mut random = fastrand::Rng::with_seed(16);
    for k in 0..100 {
        let mut child = start(folder.path(), &["scene", "mesh", "blocks", "--out", "o"]);
        std::thread::sleep(Duration::from_micros(random.u64(1000..8000)));
        kill(&mut child, "TERM");
        assert_eq!(staged(&folder.path().join("o")), [""; 0], "signal {k}");
        let _ = std::fs::remove_dir_all(folder.path().join("o"));
    }
}

#[test]
fn a_long_run_ends_by_a_signal_and_leaves_the_old_files() {
    let folder = TempDir::new().expect("a folder");
    whole(folder.path());
    let before = files(&folder.path().join("o"));
    for (signal, number) in [("INT", 2), ("TERM", 15)] {
        let mut child = start(folder.path(), &["report", "strand", "--out", "o/r.html"]);
        std::thread::sleep(Duration::from_millis(300));
        let (lived, of) = kill(&mut child, signal);
        assert_eq!(of, Some(number));
        assert!(lived < SOON, "{signal} took {lived:?}");
        assert_eq!(files(&folder.path().join("o")), before);
    }
}

#[test]
fn two_runs_into_one_folder_leave_whole_files() {
    let folder = TempDir::new().expect("a folder");
    let (expected, _) = whole(folder.path());
    for _ in 0..8 {
        let both = RUNS.map(|args| start(folder.path(), args));
        for mut child in both {
            assert!(child.wait().expect("it ends").success());
        }
        each_is_whole(&folder.path().join("o"), &expected);
    }
    assert_eq!(staged(&folder.path().join("o")), [""; 0]);
}

/// What is not written is left alone: a user's files, and those of an earlier run.
#[test]
fn other_files_stay() {
    let folder = TempDir::new().expect("a folder");
    let (expected, _) = whole(folder.path());
    let at = |name: &str| folder.path().join("o").join(name);
    std::fs::create_dir(at("mine")).expect("a folder");
    for name in ["notes.txt", "mine/data.csv"] {
        std::fs::write(at(name), "mine").expect("it is written");
    }
    let before = files(&folder.path().join("o"));
    assert!(run(folder.path(), RUNS[1]).status.success());
    let now = files(&folder.path().join("o"));
    for (name, content) in &now {
        assert_eq!(content, expected[1].get(name).unwrap_or(&before[name]), "{name}");
    }
    assert_eq!(now.keys().collect::<Vec<_>>(), before.keys().collect::<Vec<_>>());
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

/// A scene is solved where it lies, and its tables stand beside.
#[test]
fn commands_share_a_folder() {
    let folder = TempDir::new().expect("a folder");
    assert!(run(folder.path(), &["scene", "copy", "fig1", "--out", "o"]).status.success());
    let scene = files(&folder.path().join("o"));
    for args in [RUNS[0], RUNS[1], &["solve", "o", "--out", "o", "--csv", "o"]] {
        assert!(run(folder.path(), args).status.success());
    }
    let now = files(&folder.path().join("o"));
    assert_eq!(now["scene.json"], scene["scene.json"]);
    assert!(now.contains_key("result.json") && now.keys().any(|name| name.ends_with(".csv")));
}

/// The folder in which a process works is written to as any other.
#[test]
fn the_current_folder_is_written_to() {
    let folder = TempDir::new().expect("a folder");
    let (expected, _) = whole(folder.path());
    let here = folder.path().join("here");
    std::fs::create_dir(&here).expect("a folder");
    let args: Vec<&str> = [&RUNS[0][..RUNS[0].len() - 1], &["."]].concat();
    assert!(run(&here, &args).status.success());
    assert_eq!(files(&here), expected[0]);
}

/// A file that grows too large stands for a disk that is full.
#[test]
fn what_cannot_be_written_leaves_the_old_files() {
    let folder = TempDir::new().expect("a folder");
    let (expected, _) = whole(folder.path());
    std::fs::write(folder.path().join("file"), "").expect("it is written");
    std::fs::create_dir_all(folder.path().join("p/result.json")).expect("a folder");
    let solve = "$P solve fig1 --variant tied --no-error-estimate --out";
    for (line, words) in [
        (format!("{solve} file"), ["where: ", "file is a file"]),
        (format!("{solve} file/o"), ["file/o", "file is a file"]),
        (format!("{solve} p"), ["where: ", "result.json is in the way: it is a folder"]),
        (format!("{solve} /proc/o"), ["/proc/o", "No such file or directory (os error 2)"]),
        (format!("ulimit -f 8; {solve} o"), ["where: ", "File too large (os error 27)"]),
    ] {
        refused(folder.path(), &line, &words);
        refused(folder.path(), &line, &["fix:   choose another place"]);
        let json = shell(folder.path(), &format!("{line} --json"));
        let document: serde_json::Value = serde_json::from_slice(&json.stdout).expect("JSON alone");
        assert_eq!(document["failure"]["exit_status"], 2, "{line}: {document}");
    }
    assert_eq!(files(&folder.path().join("o")), expected[0]);
    assert_eq!(files(&folder.path().join("p")), Files::new());
    let gone = "mkdir q && cd q && rm -r ../q && $P solve fig1 --out o";
    refused(folder.path(), gone, &["cannot be written"]);
}

/// The system ends a process whose file grows beyond a limit, unless the process heeds its signal.
#[test]
fn a_file_that_may_not_grow_is_named_and_leaves_nothing() {
    let folder = TempDir::new().expect("a folder");
    let sweep =
        r#"{"format": 1, "scene": "fig1", "grid": {"/options/variant": ["tied", "stepped"]}}"#;
    std::fs::write(folder.path().join("sweep.json"), sweep).expect("it is written");
    for (command, file) in [
        ("solve fig1 --out", "a"),
        ("scene mesh hertz --out", "m"),
        ("snapshot record fig1 --out", "r.json"),
        ("lesson fig1 --out", "page.html"),
        ("report fig1 --out", "report.html"),
        ("sweep run sweep.json --out", "rows"),
        ("listing run Km fig1 >", "standard output"),
    ] {
        let out = file.replace(' ', "-");
        let line = format!("ulimit -f 1; $P {command} {out}");
        refused(folder.path(), &line, &[&format!("where: {file}"), "too large (os error 27)\n"]);
    }
    assert!(!files(folder.path()).keys().any(|name| name.contains(STAGED)));
}

/// A job in the background of a shell's script is not ended by the key that ends the script.
#[test]
fn an_interrupt_that_is_ignored_stays_so() {
    let folder = TempDir::new().expect("a folder");
    let kills = "sleep 0.3; kill -INT $!; sleep 0.3; kill -TERM $!; wait $!";
    let line = format!("mkfifo f; trap '' INT; $P solve f & {kills}");
    assert_eq!(shell(folder.path(), &line).status.code(), Some(128 + 15));
}

/// A disk that is mounted for reading alone, where a user may mount one.
#[test]
fn a_read_only_disk_is_named() {
    let folder = TempDir::new().expect("a folder");
    let mount = "unshare -rm sh -c 'mount -t tmpfs -o ro tmpfs .";
    if !shell(folder.path(), &format!("{mount}'")).status.success() {
        eprintln!("no disk can be mounted: a read-only one is not tried");
        return;
    }
    for command in ["solve fig1 --out .", "snapshot record fig1", "lesson fig1 --out page.html"] {
        let line = format!("{mount} && cd \"$PWD\" && \"$P\" {command}'");
        refused(folder.path(), &line, &["cannot be written: ", "Read-only file system"]);
    }
}

#[test]
fn a_poor_environment_changes_nothing_but_the_width() {
    let folder = TempDir::new().expect("a folder");
    let solve = "$P solve fig1 --variant tied --out o";
    let plain = shell(folder.path(), solve);
    let poor = shell(folder.path(), &format!("env -i LANG=C P=\"$P\" sh -c '{solve}'"));
    assert_eq!((plain.status.code(), &plain.stdout), (Some(0), &poor.stdout));
    let narrow = shell(folder.path(), &format!("COLUMNS=20 {solve}"));
    assert_eq!(narrow.status.code(), Some(0));
    let text = String::from_utf8(narrow.stdout).expect("UTF-8");
    assert!(text.lines().all(|line| line.chars().count() <= 40), "{text}");
    let expected = files(&folder.path().join("o"));
    for line in [format!("{solve} | true"), format!("{solve} >&-"), format!("{solve} 2>&-")] {
        assert_eq!(shell(folder.path(), &line).status.code(), Some(0), "{line}");
        assert_eq!(files(&folder.path().join("o")), expected, "{line}");
    }
    for command in [solve, "$P --help", "$P solve --help", "$P --version"] {
        let line = format!("{command} >/dev/full");
        refused(folder.path(), &line, &["standard output", "No space left"]);
    }
    assert_eq!(shell(folder.path(), "$P --help | true").status.code(), Some(0));
}

/// Whichever signal ends the program, CalculiX ends with it, and so does what it started.
#[test]
fn calculix_ends_with_the_program() {
    let folder = TempDir::new().expect("a folder");
    let ccx = "#!/bin/sh\nif [ $1 = -v ]; then echo Version 2.21; exit; fi\n\
               sleep 300 &\necho $! > id.new\nmv id.new ../id\nwait\n";
    let made = format!("mkdir t; printf '%s' '{ccx}' > ccx; chmod +x ccx");
    assert!(shell(folder.path(), &made).status.success());
    for signal in ["HUP", "INT", "QUIT", "TERM"] {
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
        assert!(kill(&mut child, signal).1.is_some(), "{signal}");
        let left = "sleep 0.2; ps -o args= -p $(cat t/id); rm t/id; ls -A t";
        let left = String::from_utf8(shell(folder.path(), left).stdout).expect("UTF-8");
        assert!(!left.contains("300") && !left.contains("plane"), "{signal}: {left}");
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
