//! The program as a process of its own.

use std::path::Path;
use std::process::{Command, Output};

/// Runs the program in `folder`, with texts of help as wide as they are without a terminal.
pub fn run(folder: &Path, args: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_plane-contact"))
        .args(args)
        .env_remove("COLUMNS")
        .current_dir(folder)
        .output()
        .expect("the program starts")
}
