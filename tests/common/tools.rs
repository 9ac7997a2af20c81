//! Programs that some tests need.

#![allow(dead_code, reason = "some test programs need only one of them")]

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// Whether a command succeeds; where the environment demands it, it must.
pub fn is_there(mut command: Command, demanded_by: &str) -> bool {
    let found = command.stdout(Stdio::null()).stderr(Stdio::null()).status();
    let is_there = found.is_ok_and(|status| status.success());
    assert!(is_there || std::env::var_os(demanded_by).is_none(), "{command:?} is demanded");
    is_there
}

/// Whether Python has some packages, as it must where the environment demands it.
pub fn has_python(packages: &str, demanded_by: &str) -> bool {
    let mut python = Command::new("python3");
    python.args(["-c", &format!("import {packages}")]);
    is_there(python, demanded_by)
}

/// Whether node is installed, as it must be where `REQUIRE_BROWSER` is set.
pub fn has_node() -> bool {
    let mut node = Command::new("node");
    node.arg("--version");
    is_there(node, "REQUIRE_BROWSER")
}

/// The folder of playwright-core and axe-core where a browser can be driven, as it must be where
/// `REQUIRE_BROWSER` is set.
pub fn browser() -> Option<PathBuf> {
    let modules = Path::new(env!("CARGO_MANIFEST_DIR")).join("target/browser/node_modules");
    let starts = |program: &str| Command::new(program).arg("--version").output().is_ok();
    let there = modules.join("playwright-core").is_dir() && starts("node") && starts("chromium");
    assert!(there || std::env::var_os("REQUIRE_BROWSER").is_none(), "chromium is required");
    if !there {
        eprintln!("chromium cannot be driven: the pages are not opened in it");
    }
    there.then_some(modules)
}
