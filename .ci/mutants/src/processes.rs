//! Processes that run tests, and how they end.

use std::io::{BufRead, BufReader};
use std::os::unix::process::CommandExt;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::sync::mpsc::{self, RecvTimeoutError};
use std::time::Duration;

use crate::{Failure, Work};

/// The virtual memory of a process, in KiB: a mutant may ask for more without end.
const MEMORY: u64 = 9_000_000;

/// How a process that runs tests ended, and by which test.
pub enum End {
    Passed,
    Failed(String),
    TooLong(String),
}

/// Returns a command that runs some tests of a binary as Cargo does, one after another, in a
/// process group of its own.
pub fn command(work: &Work, binary: &Path, names: &[&str], temporary: &Path) -> Command {
    let mut command = Command::new("sh");
    command
        .args(["-c", &format!("ulimit -v {MEMORY}; exec \"$@\""), "sh"])
        .arg(binary)
        .args(["--exact", "--test-threads=1"])
        .args(names)
        .current_dir(work.tree())
        .env("CARGO_MANIFEST_DIR", work.tree())
        .env("INSTA_WORKSPACE_ROOT", work.tree())
        .env("INSTA_UPDATE", "no")
        .env("RAYON_NUM_THREADS", "1")
        .env("TMPDIR", temporary)
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .stderr(Stdio::null())
        .process_group(0);
    command
}

/// Runs tests, each of which may take as long as `limit`, until one fails; then ends the processes
/// that they started.
pub fn run(command: &mut Command, limit: Duration, first: &str) -> Result<End, Failure> {
    let mut child = command.spawn()?;
    let end = follow(&mut child, limit, first);
    let group = format!("-{}", child.id());
    Command::new("kill").args(["-KILL", "--", &group]).stderr(Stdio::null()).status()?;
    child.wait()?;
    end
}

/// Reads what the tests say: a line when one ends.
fn follow(child: &mut Child, limit: Duration, first: &str) -> Result<End, Failure> {
    let output = BufReader::new(child.stdout.take().ok_or("no output")?);
    let (sender, receiver) = mpsc::channel();
    std::thread::spawn(move || {
        output.split(b'\n').map_while(Result::ok).try_for_each(|line| sender.send(line))
    });
    let mut last = first.to_owned();
    loop {
        match receiver.recv_timeout(limit) {
            Ok(line) => {
                let line = String::from_utf8_lossy(&line).into_owned();
                let name = line.strip_prefix("test ").and_then(|rest| rest.split(" ...").next());
                last = name.map_or(last, str::to_owned);
                if name.is_some() && line.ends_with("FAILED") {
                    return Ok(End::Failed(last));
                }
            }
            Err(RecvTimeoutError::Timeout) => return Ok(End::TooLong(last)),
            Err(RecvTimeoutError::Disconnected) => break,
        }
    }
    let passed = child.wait()?.success();
    Ok(if passed { End::Passed } else { End::Failed(last) })
}
