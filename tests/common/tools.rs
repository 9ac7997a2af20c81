//! Programs that some tests need.

#![allow(dead_code, reason = "some test programs need only one of them")]

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// Whether a line of the shell succeeds, as it must where the environment has the variable that demands it.
pub fn has(line: &str, demanded_by: &str) -> bool {
    let mut shell = Command::new("sh");
    shell.args(["-c", line]).stdout(Stdio::null()).stderr(Stdio::null());
    let is_there = shell.status().is_ok_and(|status| status.success());
    assert!(is_there || std::env::var_os(demanded_by).is_none(), "{line} is demanded");
    if !is_there {
        eprintln!("what needs `{line}` is left out");
    }
    is_there
}

pub fn has_ccx() -> bool {
    has("command -v ccx", "REQUIRE_CCX")
}

pub fn has_node() -> bool {
    has("node --version", "REQUIRE_BROWSER")
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
