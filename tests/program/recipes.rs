//! The recipes of `src/guide/snapshots.md`, executed as they stand there, and `.pre-commit-hooks.yaml`.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use tempfile::TempDir;

use crate::common::program::run;
use crate::common::tools::{has_python, is_there};

const ROOT: &str = env!("CARGO_MANIFEST_DIR");

/// In place of `cargo install --git`: the options and the package are read by Cargo, from the sources here, and
/// nothing is built. Only a Cargo that is to be developed has such a trial run.
const CARGO: &str = r#"#!/bin/sh
[ "$1 $2 $3 $4" = "install --locked --git $PLANE_CONTACT" ] && [ "$5" = plane-contact ] || exit 9
RUSTC_BOOTSTRAP=1 exec "$REAL_CARGO" -Zunstable-options install --dry-run --locked --offline \
    --root "$PWD/installed" --path "$ROOT" "$5"
"#;

/// The blocks of code of a language on the page.
fn blocks(language: &str) -> Vec<String> {
    let page =
        fs::read_to_string(Path::new(ROOT).join("src/guide/snapshots.md")).expect("the page");
    let start = format!("```{language}\n");
    page.split(&start)
        .skip(1)
        .map(|rest| rest.split("```").next().expect("a block").into())
        .collect()
}

/// A folder with a scene and its snapshot in `my`, and a folder of programs, in front of all others.
fn repository() -> (TempDir, PathBuf) {
    let folder = TempDir::new().expect("a folder");
    let copied = run(folder.path(), &["scene", "copy", "fig1", "--out", "my"]);
    assert!(copied.status.success());
    fs::rename(folder.path().join("my/scene.json"), folder.path().join("my/block.json"))
        .expect("moved");
    let args = ["snapshot", "record", "my/block.json", "--out", "my/block.snapshot.json"];
    assert!(run(folder.path(), &args).status.success());
    let programs = folder.path().join("programs");
    fs::create_dir(&programs).expect("a folder");
    fs::copy(env!("CARGO_BIN_EXE_plane-contact"), programs.join("plane-contact")).expect("copied");
    (folder, programs)
}

/// Edits the scene, which its snapshot then differs from.
fn edit(folder: &Path) {
    let scene = folder.join("my/block.json");
    let text = fs::read_to_string(&scene).expect("the scene");
    fs::write(&scene, text.replace("30000", "31000")).expect("written");
}

/// Asserts that what holds of the snapshot ends with another status once the scene is edited.
#[track_caller]
fn holds_until_edited(folder: &Path, status: i32, command: impl Fn() -> Command) {
    succeeds(&command().output().expect("it starts"), "the recipe");
    edit(folder);
    let output = command().output().expect("it starts");
    assert_eq!(output.status.code(), Some(status), "{output:?}");
}

fn command(program: &str, args: &[&str], folder: &Path, programs: &Path) -> Command {
    let path = std::env::var("PATH").expect("a path");
    let mut command = Command::new(program);
    command.args(args).current_dir(folder);
    command.env("PATH", format!("{}:{path}", programs.display()));
    command
}

#[track_caller]
fn succeeds(output: &Output, what: &str) {
    let text = [&output.stdout, &output.stderr].map(|text| String::from_utf8_lossy(text));
    assert!(output.status.success(), "{what}: {}{}", text[0], text[1]);
}

/// Every `run:` line of the recipe of a forge, as the forge runs it.
#[cfg(unix)]
#[test]
fn every_line_of_the_recipe_for_a_forge_runs() {
    use std::os::unix::fs::PermissionsExt;
    let (folder, programs) = repository();
    fs::write(programs.join("cargo"), CARGO).expect("written");
    fs::set_permissions(programs.join("cargo"), fs::Permissions::from_mode(0o755)).expect("set");
    let recipe =
        blocks("yaml").into_iter().find(|block| block.contains("jobs:")).expect("a recipe");
    let steps = |line: &str| {
        let output = command("bash", &["-e", "-c", line], folder.path(), &programs)
            .env("PLANE_CONTACT", "https://example.org/plane-contact.git")
            .env("GITHUB_STEP_SUMMARY", folder.path().join("summary"))
            .env("REAL_CARGO", env!("CARGO"))
            .env("ROOT", ROOT)
            .output();
        output.expect("bash")
    };
    let lines: Vec<&str> =
        recipe.lines().filter_map(|line| line.trim().strip_prefix("- run: ")).collect();
    assert_eq!(lines.len(), 3, "{lines:?}");
    for line in &lines {
        succeeds(&steps(line), line);
    }
    let summary = || fs::read_to_string(folder.path().join("summary")).expect("a summary");
    assert!(summary().contains("block.snapshot.json: same"), "{}", summary());
    let junit = fs::read_to_string(folder.path().join("verify.xml")).expect("a file of JUnit");
    assert!(junit.contains("<testsuite"), "{junit}");
    edit(folder.path());
    assert_eq!(steps(lines[1]).status.code(), Some(1));
    succeeds(&steps(lines[2]), lines[2]);
    assert!(summary().contains("31000.0, was 30000.0"), "{}", summary());
}

#[cfg(unix)]
#[test]
fn the_recipe_for_a_shell_runs() {
    let (folder, programs) = repository();
    let lines = blocks("sh");
    let line = lines.iter().find(|block| block.lines().count() == 1).expect("a line");
    holds_until_edited(folder.path(), 1, || command("sh", &["-c", line], folder.path(), &programs));
}

#[cfg(unix)]
#[test]
fn the_recipe_for_git_says_what_differs() {
    let (folder, programs) = repository();
    fs::write(folder.path().join(".gitattributes"), &blocks("gitattributes")[0]).expect("written");
    let ran = |program: &str, args: &[&str]| {
        let output = command(program, args, folder.path(), &programs).output().expect(program);
        succeeds(&output, &format!("{args:?}"));
        String::from_utf8(output.stdout).expect("UTF-8")
    };
    ran("git", &["init", "-q"]);
    ran("git", &["add", "."]);
    ran("sh", &["-c", &blocks("git")[0]]);
    edit(folder.path());
    ran("plane-contact", &["snapshot", "accept", "my/block.snapshot.json"]);
    let said = ran("git", &["diff", "my/block.snapshot.json"]);
    assert!(said.contains("materials.1.E: 31000.0, was 30000.0"), "{said}");
    let lines = ran("git", &["diff", "--no-ext-diff", "--text", "-U0", "my/block.snapshot.json"]);
    let first = lines.lines().find(|line| line.starts_with('+') && line.contains(':'));
    assert!(first.is_some_and(|line| line.contains("force on the target")), "{lines}");
}

#[cfg(unix)]
#[test]
fn the_recipe_for_fieldcompare_runs() {
    let mut fieldcompare = Command::new("fieldcompare");
    fieldcompare.arg("--version");
    if !is_there(fieldcompare, "REQUIRE_VTU") {
        return;
    }
    let (folder, programs) = repository();
    let reference = ["solve", "my/block.json", "--no-pictures", "--out", "reference"];
    assert!(run(folder.path(), &reference).status.success());
    fs::copy(folder.path().join("reference/fields.vtu"), folder.path().join("my/reference.vtu"))
        .expect("copied");
    let lines = blocks("bash")[0].replace("\nfieldcompare", " &&\nfieldcompare");
    holds_until_edited(folder.path(), 1, || {
        command("sh", &["-c", &lines], folder.path(), &programs)
    });
}

#[cfg(unix)]
#[test]
fn the_recipe_for_ctest_runs() {
    let mut ctest = Command::new("ctest");
    ctest.arg("--version");
    if !is_there(ctest, "REQUIRE_CTEST") {
        return;
    }
    let (folder, programs) = repository();
    let head = "cmake_minimum_required(VERSION 3.16)\nproject(my NONE)\nenable_testing()\n";
    fs::write(folder.path().join("CMakeLists.txt"), head.to_string() + &blocks("cmake")[0])
        .expect("written");
    let ran = |program: &str, args: &[&str]| command(program, args, folder.path(), &programs);
    succeeds(&ran("cmake", &["-S", ".", "-B", "build"]).output().expect("cmake"), "cmake");
    let tests = ["--test-dir", "build", "--output-on-failure"];
    holds_until_edited(folder.path(), 8, || ran("ctest", &tests));
}

/// pytest with the module of Python and its fixtures.
#[cfg(unix)]
fn pytest(folder: &Path, programs: &Path) -> Command {
    let args =
        ["-m", "pytest", "-q", "-p", "no:cacheprovider", "-p", "plane_contact.pytest_plugin"];
    let mut pytest = command("python3", &args, folder, programs);
    pytest.env("PYTHONPATH", Path::new(ROOT).join("src/python"));
    pytest.env("PYTHONDONTWRITEBYTECODE", "1");
    pytest
}

#[cfg(unix)]
#[test]
fn the_recipe_for_pytest_runs() {
    if !has_python("numpy, pytest", "REQUIRE_PYTEST") {
        return;
    }
    let (folder, programs) = repository();
    fs::write(folder.path().join("test_snapshots.py"), &blocks("python")[0]).expect("written");
    let ran = || pytest(folder.path(), &programs).output().expect("python3");
    let output = ran();
    succeeds(&output, "pytest");
    assert!(String::from_utf8_lossy(&output.stdout).contains("2 passed"));
    edit(folder.path());
    let output = ran();
    assert!(String::from_utf8_lossy(&output.stdout).contains("Differs"), "{output:?}");
}

/// The hook finds the snapshots of a repository, whatever their folder.
#[cfg(unix)]
#[test]
fn the_hook_verifies_the_snapshots_of_a_repository() {
    let (folder, programs) = repository();
    let hooks = fs::read_to_string(Path::new(ROOT).join(".pre-commit-hooks.yaml")).expect("hooks");
    let entry =
        hooks.lines().find_map(|line| line.trim().strip_prefix("entry: ")).expect("an entry");
    for args in [&["init", "-q"][..], &["add", "my"]] {
        succeeds(&command("git", args, folder.path(), &programs).output().expect("git"), "git");
    }
    holds_until_edited(folder.path(), 123, || {
        command("sh", &["-c", entry], folder.path(), &programs)
    });
}

/// The module of Python beside scikit-fem, its examples and its types.
#[cfg(unix)]
#[test]
fn the_module_of_python_passes_its_tests() {
    if !has_python("numpy, pytest, skfem, meshio, mypy", "REQUIRE_PYTEST") {
        return;
    }
    let (folder, programs) = repository();
    let mut pytest = pytest(folder.path(), &programs);
    pytest.arg("-c");
    pytest.args([Path::new(ROOT).join("pyproject.toml"), Path::new(ROOT).join("src/python")]);
    succeeds(&pytest.output().expect("python3"), "pytest");
}
