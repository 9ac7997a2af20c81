//! A run of `ccx`.

use std::path::Path;
use std::process::{Command, Output};

use super::fields::Fields;
use super::results;
use crate::error::InputError;
use crate::report::files;

/// How many of the last lines of a failed run are shown.
const TAIL: usize = 12;

/// What a run gave.
pub struct Ran {
    /// The version that `ccx` says it is.
    pub version: String,
    /// Its results.
    pub fields: Fields,
}

/// Runs `program` on `deck` in a temporary folder and reads the displacements of `nodes` nodes and the stresses of `triangles`
/// triangles.
///
/// # Errors
/// No such program; one that fails, with the last lines of its output; results that cannot be read.
pub fn run(program: &str, deck: &str, nodes: usize, triangles: usize) -> Result<Ran, InputError> {
    let folder = tempfile::tempdir().map_err(|why| {
        let what = format!("no temporary folder can be made: {why}");
        InputError::new("the temporary folder", what, "set TMPDIR to a place that can be written")
    })?;
    let version = version(program)?;
    files::write(&folder.path().join("job.inp"), deck)?;
    let output = start(program, &["job"], folder.path())?;
    let printed = text(&output);
    if !output.status.success() || printed.contains("*ERROR") {
        return Err(failed(program, &format!("failed ({})", output.status), &printed));
    }
    let dat = std::fs::read_to_string(folder.path().join("job.dat"))
        .map_err(|why| failed(program, &format!("left no results ({why})"), &printed))?;
    Ok(Ran { version, fields: results::parse(&dat, nodes, triangles)? })
}

/// The last word of `ccx -v`: "This is Version 2.20".
fn version(program: &str) -> Result<String, InputError> {
    let output = start(program, &["-v"], Path::new("."))?;
    Ok(text(&output).split_whitespace().last().unwrap_or("unknown").to_string())
}

/// One thread: sums of several come in any order.
fn start(program: &str, args: &[&str], folder: &Path) -> Result<Output, InputError> {
    let mut command = Command::new(program);
    command.args(args).current_dir(folder).env("OMP_NUM_THREADS", "1");
    command.output().map_err(|why| {
        let what = format!("{program} cannot be started: {why}");
        let mend = "install CalculiX (on Debian and Ubuntu: apt-get install calculix-ccx), or name its program with --ccx";
        InputError::new("ccx", what, mend)
    })
}

fn text(output: &Output) -> String {
    let both = [&output.stdout, &output.stderr].map(|bytes| String::from_utf8_lossy(bytes));
    both.concat()
}

fn failed(program: &str, how: &str, printed: &str) -> InputError {
    let lines: Vec<&str> = printed.lines().filter(|line| !line.trim().is_empty()).collect();
    let tail = lines[lines.len().saturating_sub(TAIL)..].join("\n  ");
    let what = format!("{program} {how}; the end of its output:\n  {tail}");
    InputError::new("ccx", what, "export the deck and run it by hand, or choose another penalty")
}
