//! The program as a process of its own.

#![allow(dead_code, reason = "some test programs need only one of them")]

use std::path::Path;
use std::process::{Command, Output};

use serde_json::Value;
use tempfile::TempDir;

/// Runs the program in `folder`, with texts of help as wide as they are without a terminal.
pub fn run(folder: &Path, args: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_plane-contact"))
        .args(args)
        .env_remove("COLUMNS")
        .current_dir(folder)
        .output()
        .expect("the program starts")
}

/// Returns the JSON that the program prints in a folder of its own, where it ends well.
pub fn json(args: &[&str]) -> Value {
    let folder = TempDir::new().expect("a temporary folder");
    let output = run(folder.path(), args);
    assert!(output.status.success(), "{args:?}: {}", String::from_utf8_lossy(&output.stderr));
    serde_json::from_slice(&output.stdout).expect("the command prints JSON")
}

/// Runs the program in `folder`; returns its exit status, what it prints, and its messages.
pub fn ran(folder: &Path, args: &[&str]) -> (i32, String, String) {
    let output = run(folder, args);
    let text = |bytes| String::from_utf8(bytes).expect("UTF-8");
    (output.status.code().expect("no signal"), text(output.stdout), text(output.stderr))
}
