//! Runs of `ccx`, each in a temporary folder.

use std::io;
use std::path::Path;
use std::process::{Command, ExitStatus};

use super::deck::deck;
use super::fields::Fields;
use super::problem::{Part, Problem};
use super::results::parse;
use base::child;
use base::error::{InputError, Result};
use base::files;
use problem::model::Model;
use problem::scene::Scene;

/// How many of the last lines of a failed run are shown.
const TAIL: usize = 12;

/// The bytes that a run may print.
const PRINTED: u64 = 1 << 24;

/// The most bytes of results: those of two million triangles in ten increments.
const RESULTS: u64 = 1 << 31;

/// What a run of `ccx` computed.
pub struct CalculixRun {
    /// The version that `ccx` reports.
    pub version: String,
    /// Its displacements and stresses.
    pub fields: Fields,
}

/// Runs `program` on a deck for each part and sums the results with the parts' shares.
///
/// # Errors
/// There is no such program, or it fails, with the last lines of its output; its results
/// cannot be read; a pair's surfaces bound no triangle.
pub fn run(program: &str, scene: &Scene, model: &Model, parts: &[Part]) -> Result<CalculixRun> {
    let version = version(program)?;
    let (nodes, triangles) = (model.nodes.len(), model.triangles.len());
    let mut fields = Fields::zero(nodes, triangles);
    for Part { contact, share } in parts {
        let printed = print(program, &deck(&Problem { scene, model, contact })?)?;
        fields.add(*share, &parse(&printed, nodes, triangles)?);
    }
    Ok(CalculixRun { version, fields })
}

/// Checks that `program` can be started.
///
/// # Errors
/// Says how to install or to name it.
pub fn check(program: &str) -> Result<()> {
    version(program).map(drop)
}

/// What `program` prints to its `.dat` file for `deck`, in a temporary folder.
fn print(program: &str, deck: &str) -> Result<String> {
    let no_folder = |why| {
        let what = format!("no temporary folder can be written: {why}");
        InputError::new("the temporary folder", what, "set TMPDIR to a place that can be written")
    };
    let folder = files::temporary_folder().map_err(no_folder)?;
    std::fs::write(folder.path().join("job.inp"), deck).map_err(no_folder)?;
    let (status, text) = ended(program, &["job"], folder.path())?;
    if !status.success() || text.contains("*ERROR") {
        return Err(failed(program, &format!("failed ({status})"), &text));
    }
    let results = files::read_in(folder.path(), Path::new("job.dat"), RESULTS);
    results
        .and_then(files::text)
        .map_err(|why| failed(program, &format!("left no results ({why})"), &text))
}

/// The last word of `ccx -v`: "This is Version 2.20".
fn version(program: &str) -> Result<String> {
    let (_, text) = ended(program, &["-v"], Path::new("."))?;
    Ok(text.split_whitespace().last().unwrap_or("unknown").to_string())
}

/// Runs `program` to its end, on one thread: with several, sums come in any order. Returns how it ended and
/// what it printed; one that prints without end is killed.
fn ended(program: &str, args: &[&str], folder: &Path) -> Result<(ExitStatus, String)> {
    let fault = |how: &str, why: io::Error| {
        let fix = match why.raw_os_error() {
            // Processes, memory or open files.
            Some(11 | 12 | 23 | 24) => "see what the system runs short of: ulimit -a",
            Some(_) | None => {
                "install CalculiX (on Debian and Ubuntu: apt-get install calculix-ccx), or name \
                 its program"
            }
        };
        InputError::new("ccx", format!("{program} {how}: {why}"), fix)
    };
    let start = || {
        // A path is that of the folder where this program was started, a name that of a program.
        let path = Path::new(program);
        let is_path = path.components().count() > 1;
        let mut command =
            Command::new(if is_path { std::path::absolute(path)? } else { path.into() });
        command.args(args).current_dir(folder).env("OMP_NUM_THREADS", "1");
        child::start(command)
    };
    let running = start().map_err(|why| fault("cannot be started", why))?;
    let ended = running.end(PRINTED);
    let (status, bytes) =
        ended.map_err(|why| fault("was ended, as its output cannot be read", why))?;
    Ok((status, String::from_utf8_lossy(&bytes).into_owned()))
}

fn failed(program: &str, how: &str, output: &str) -> InputError {
    let lines: Vec<&str> = output.lines().filter(|line| !line.trim().is_empty()).collect();
    let tail = lines[lines.len().saturating_sub(TAIL)..].join("\n  ");
    let what = format!("{program} {how}; the end of its output:\n  {tail}");
    InputError::new("ccx", what, "export the deck and run it by hand, or choose another penalty")
}
