//! What the program prints and how it ends, as text: what is typed, and all that comes out.
//!
//! ```text
//! # What must hold, or once went wrong.
//! with FOLDER              the files that it starts with, a folder of tests/cases/<area>
//! needs REQUIRE_X COMMAND  else it is left out; where the environment has REQUIRE_X, the command must succeed
//! $ COMMAND                of `sh`, with plane-contact on its path; `> ` goes on with it
//! ? 2                      its exit status, where that is not 0
//! | a line of standard output
//! ! a line of standard error
//! not: TEXT                what neither stream has
//! ```
//!
//! A line `...` stands for any lines, and `[..]` for any part of one. Words are exact; a number may differ by one in its
//! last printed digit. A case runs in a folder of its own, its commands in one shell, in which `LISTINGS` is the folder
//! of that name. No command may panic.
//! `INSTA_UPDATE=always` writes anew what a command prints, where that differs.
//!
//! Why no library runs them: trycmd joins both streams and knows no shell, and neither it nor snapbox has a tolerance.

#[path = "../common/tools.rs"]
mod tools;

use std::fmt;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use tempfile::TempDir;
use testing::golden_file::is_written;
use testing::same_text::same_text;

/// A test of each area, which is a file of cases and a folder of their files.
macro_rules! areas {
    ($($area:ident)*) => {
        $(#[test]
        fn $area() {
            check(stringify!($area));
        })*

        #[test]
        fn every_file_is_an_area() {
            let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/cases");
            let entries = std::fs::read_dir(folder).expect("the cases");
            let names = entries.filter_map(|entry| entry.expect("an entry").file_name().into_string().ok());
            let mut areas: Vec<_> = names.filter_map(|name| Some(name.strip_suffix(".txt")?.to_owned())).collect();
            areas.sort();
            assert_eq!(areas, [$(stringify!($area)),*]);
        }
    };
}

areas!(
    bodies commands contact disks edited fields files guide hostile limits meshes mistakes pictures recipes sentences shells
    snapshots solvers summary sweeps trade worksheets
);

#[derive(Default)]
struct Case {
    /// What it is for, a line each.
    about: Vec<String>,
    /// The folder of the files that it starts with.
    with: Option<String>,
    /// The variable that demands it, and the command that tells whether it can be run.
    needs: Option<String>,
    commands: Vec<Ran>,
}

/// A command, and what comes of it.
#[derive(Clone, Default)]
struct Ran {
    command: String,
    status: i32,
    out: Vec<String>,
    err: Vec<String>,
    /// What neither stream has.
    lacks: Vec<String>,
}

/// Runs the cases of an area; reports, or writes anew, all that differ.
fn check(area: &str) {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/cases");
    let file = folder.join(format!("{area}.txt"));
    let text = std::fs::read_to_string(&file).expect("the file of an area");
    let mut cases = parsed(&text);
    assert_eq!(
        written(&cases),
        text,
        "{area}.txt is written otherwise than this program writes it"
    );
    let mut wrong = Vec::new();
    for case in cases.iter_mut().filter(|case| case.is_possible()) {
        let found = case.run(&folder.join(area));
        for (expected, found) in case.commands.iter_mut().zip(found) {
            if let Some(why) = expected.difference(&found) {
                wrong.push(format!("{why}\n{found}"));
                *expected = Ran { lacks: expected.lacks.clone(), ..found };
            }
        }
    }
    if !wrong.is_empty() && is_written() {
        std::fs::write(&file, written(&cases)).expect("the file of an area");
        return;
    }
    assert!(wrong.is_empty(), "{area}.txt:\n{}", wrong.join("\n"));
}

fn parsed(text: &str) -> Vec<Case> {
    let mut cases = vec![];
    for paragraph in text.split("\n\n") {
        let mut case = Case::default();
        for line in paragraph.lines() {
            let (kind, rest) = line.split_at(line.len().min(2));
            let last = case.commands.last_mut();
            match (kind, last) {
                ("# ", None) => case.about.push(rest.into()),
                ("wi", None) => case.with = Some(rest.trim_start_matches("th ").into()),
                ("ne", None) => case.needs = Some(rest.trim_start_matches("eds ").into()),
                ("$ ", _) => case.commands.push(Ran { command: rest.into(), ..Ran::default() }),
                ("> " | ">", Some(ran)) => ran.command += &format!("\n{rest}"),
                ("? ", Some(ran)) => ran.status = rest.parse().expect("an exit status"),
                ("| " | "|", Some(ran)) => ran.out.push(rest.into()),
                ("! " | "!", Some(ran)) => ran.err.push(rest.into()),
                ("no", Some(ran)) => ran.lacks.push(rest.trim_start_matches("t: ").into()),
                _ => panic!("what is {line:?}?"),
            }
        }
        cases.push(case);
    }
    cases
}

fn written(cases: &[Case]) -> String {
    cases.iter().map(Case::to_string).collect::<Vec<_>>().join("\n")
}

impl fmt::Display for Case {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.about.iter().try_for_each(|line| writeln!(f, "# {line}"))?;
        self.with.iter().try_for_each(|folder| writeln!(f, "with {folder}"))?;
        self.needs.iter().try_for_each(|needs| writeln!(f, "needs {needs}"))?;
        self.commands.iter().try_for_each(|ran| write!(f, "{ran}"))
    }
}

impl fmt::Display for Ran {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut line =
            |kind: &str, text: &str| writeln!(f, "{}", format!("{kind} {text}").trim_end());
        line("$", &self.command.replace('\n', "\n> "))?;
        if self.status != 0 {
            line("?", &self.status.to_string())?;
        }
        self.out.iter().try_for_each(|text| line("|", text))?;
        self.err.iter().try_for_each(|text| line("!", text))?;
        self.lacks.iter().try_for_each(|text| line("not:", text))
    }
}

impl Case {
    fn is_possible(&self) -> bool {
        self.needs.as_ref().is_none_or(|needs| {
            let (demanded_by, command) = needs.split_once(' ').expect("a variable and a command");
            tools::has(command, demanded_by)
        })
    }

    /// Runs the commands in one shell, in a folder that has the case's files; returns what comes of each that it
    /// reaches, with the folder's own name as `[..]`.
    fn run(&self, inputs: &Path) -> Vec<Ran> {
        let folder = TempDir::new().expect("a folder");
        let (at, kept) = (folder.path().join("at"), folder.path().join("kept"));
        std::fs::create_dir(&kept).expect("a folder");
        match &self.with {
            Some(with) => copy(&inputs.join(with), &at),
            None => std::fs::create_dir(&at).expect("a folder"),
        }
        let script = self.commands.iter().enumerate().map(|(k, ran)| {
            let of = format!("{}/{k}", kept.display());
            let Ran { command, .. } = ran;
            format!("exec >{of}.out 2>{of}.err\n{command}\nS=$?; echo $S >{of}.status; (exit $S)\n")
        });
        let program = Path::new(env!("CARGO_BIN_EXE_plane-contact")).parent().expect("a folder");
        let path = std::env::var("PATH").unwrap_or_default();
        Command::new("sh")
            .args(["-c", &script.collect::<String>()])
            .current_dir(&at)
            .env("PATH", format!("{}:{path}", program.display()))
            .env("LISTINGS", inputs.ancestors().nth(3).expect("the root").join("listings"))
            .env("LC_ALL", "C.UTF-8")
            .env_remove("COLUMNS")
            .stdin(Stdio::null())
            .status()
            .expect("sh starts");
        let read = |k: usize, stream: &str| {
            let bytes = std::fs::read(kept.join(format!("{k}.{stream}"))).unwrap_or_default();
            let text = String::from_utf8_lossy(&bytes);
            text.replace(&*at.to_string_lossy(), "[..]")
                .lines()
                .map(String::from)
                .collect::<Vec<_>>()
        };
        let ran = |(k, own): (usize, &Ran)| Ran {
            command: own.command.clone(),
            status: read(k, "status")
                .first()
                .map_or(-1, |status| status.parse().expect("a number")),
            out: read(k, "out"),
            err: read(k, "err").into_iter().filter(|line| !is_progress(line)).collect(),
            lacks: vec![],
        };
        self.commands.iter().enumerate().map(ran).collect()
    }
}

impl Ran {
    /// Returns in what another run of the command differs from what is expected.
    fn difference(&self, found: &Ran) -> Option<String> {
        let all = || found.out.iter().chain(&found.err);
        let has = |text: &str| all().any(|line| line.contains(text));
        let unwanted =
            self.lacks.iter().map(String::as_str).chain(["panicked"]).find(|text| has(text));
        if let Some(text) = unwanted {
            Some(format!("it has {text:?}:"))
        } else if found.status != self.status {
            Some(format!("its exit status is {}, not {}:", found.status, self.status))
        } else if !is_like(&self.out, &found.out) {
            Some("it prints something else:".into())
        } else {
            (!is_like(&self.err, &found.err)).then(|| "its messages are others:".into())
        }
    }
}

/// Whether a line says in a log how far work is, `auditing: 5 s, 12 of 60`, as on a slow machine.
fn is_progress(line: &str) -> bool {
    let said = line.rsplit_once(": ").and_then(|(_, said)| said.split_once(" s"));
    said.is_some_and(|(seconds, _)| seconds.parse::<u64>().is_ok())
}

/// Whether lines are as expected, where `...` is any of them.
fn is_like(expected: &[String], found: &[String]) -> bool {
    match (expected, found) {
        ([], found) => found.is_empty(),
        ([any, rest @ ..], _) if any == "..." => {
            (0..=found.len()).any(|skipped| is_like(rest, &found[skipped..]))
        }
        ([line, rest @ ..], [own, others @ ..]) => is_like_line(line, own) && is_like(rest, others),
        ([_, ..], []) => false,
    }
}

/// Whether a line is as expected, where `[..]` is any part of it.
fn is_like_line(expected: &str, found: &str) -> bool {
    let found = found.trim_end();
    let Some((head, rest)) = expected.split_once("[..]") else { return same_text(expected, found) };
    let Some(mut found) = found.strip_prefix(head) else { return false };
    let mut parts = rest.split("[..]").collect::<Vec<_>>();
    let last = parts.pop().expect("a part follows");
    for part in parts {
        let Some((_, behind)) = found.split_once(part) else { return false };
        found = behind;
    }
    found.ends_with(last)
}

fn copy(from: &Path, to: &PathBuf) {
    std::fs::create_dir(to).expect("a folder");
    for entry in std::fs::read_dir(from).expect("the files of a case") {
        let entry = entry.expect("an entry");
        let target = to.join(entry.file_name());
        if entry.path().is_dir() {
            copy(&entry.path(), &target);
        } else {
            std::fs::copy(entry.path(), target).expect("a file");
        }
    }
}
