//! Programs that some tests need.

#![allow(dead_code, reason = "some test programs need only one of them")]

use std::process::{Command, Stdio};

/// Whether a command succeeds; where the environment demands it, it must.
pub fn is_there(mut command: Command, demanded_by: &str) -> bool {
    let found = command.stdout(Stdio::null()).stderr(Stdio::null()).status();
    let is_there = found.is_ok_and(|status| status.success());
    assert!(is_there || std::env::var_os(demanded_by).is_none(), "{command:?} is demanded");
    is_there
}

/// Whether node is installed, as it must be where `REQUIRE_BROWSER` is set.
pub fn has_node() -> bool {
    let mut node = Command::new("node");
    node.arg("--version");
    is_there(node, "REQUIRE_BROWSER")
}
