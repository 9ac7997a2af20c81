//! Runs of `ccx`, each in a temporary folder, and the displacements that it printed to its `.dat` file.

use std::io;
use std::path::Path;
use std::process::{Command, ExitStatus};

use nalgebra::DVector;

use super::contact::Part;
use super::deck::deck;
use base::child;
use base::error::{InputError, Result};
use base::files;
use problem::model::Model;

/// How many of the last lines of a failed run are shown.
const TAIL: usize = 12;

/// The bytes that a run may print.
const PRINTED: u64 = 1 << 24;

/// The most bytes of results: those of two million triangles in ten increments.
const RESULTS: u64 = 1 << 31;

/// The largest displacement: its energy stays finite.
const LARGEST: f64 = 1e150;

/// The time at the end of a deck's step, as it is printed.
const END: f64 = 1.0;

/// What a run of `ccx` computed.
pub struct CalculixRun {
    /// The version that `ccx` reports.
    pub version: String,
    /// The displacements by degree of freedom, length.
    pub u: DVector<f64>,
}

/// Runs `program` on a deck for each part and sums the displacements with the parts' shares.
///
/// # Errors
/// There is no such program, or it fails, with the last lines of its output; its results
/// cannot be read; a pair's surfaces bound no triangle.
pub fn run(program: &str, title: &str, model: &Model, parts: &[Part]) -> Result<CalculixRun> {
    let version = version(program)?;
    let mut u = DVector::zeros(model.dofs());
    for Part { contact, share } in parts {
        let printed = print(program, &deck(title, model, contact)?)?;
        u += *share * parse(&printed, model.nodes.len())?;
    }
    Ok(CalculixRun { version, u })
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

/// Reads the displacements of `nodes` nodes at the end of the step, by degree of freedom.
///
/// # Errors
/// A node is missing, as where the file is cut; something is no number.
pub fn parse(text: &str, nodes: usize) -> Result<DVector<f64>> {
    if !text.ends_with('\n') {
        return Err(cut("its last line has no end".into()));
    }
    let mut u = DVector::from_element(2 * nodes, f64::NAN);
    let mut is_wanted = false;
    for line in text.lines().map(str::trim).filter(|line| !line.is_empty()) {
        if line.starts_with(|c: char| c.is_ascii_alphabetic()) {
            let is_last = line.split_whitespace().last().and_then(float) == Some(END);
            is_wanted = is_last && line.starts_with("displacements");
            if is_wanted {
                u.fill(f64::NAN);
            }
        } else if is_wanted {
            let node = node(line).filter(|(number, _)| (1..=nodes).contains(number));
            let (number, displacement) = node.ok_or_else(|| {
                let fix = "use CalculiX 2.20, which this was written for";
                results(format!("the line {line:?} is not understood"), fix)
            })?;
            u.rows_mut(2 * number - 2, 2).copy_from_slice(&displacement);
        }
    }
    match u.iter().position(|component| component.is_nan()) {
        None => Ok(u),
        Some(dof) => {
            let node = dof / 2 + 1;
            Err(cut(format!("node {node} is not in them at time {END}, the end of the step")))
        }
    }
}

fn cut(what: String) -> InputError {
    results(
        what,
        "see whether the disk of TMPDIR is full; else export the deck and see what ccx says of it",
    )
}

fn results(what: String, fix: &str) -> InputError {
    InputError::new("the results of ccx", what, fix)
}

/// Reads a line of displacements: the number of the node, then those along x, y and z.
fn node(line: &str) -> Option<(usize, [f64; 2])> {
    let (number, components) = line.split_once(char::is_whitespace)?;
    let components: Vec<f64> = components.split_whitespace().map(float).collect::<Option<_>>()?;
    let [x, y, _] = components[..] else { return None };
    Some((number.parse().ok()?, [x, y]))
}

/// A number as Fortran prints it: `1.0E-01`, and `1.0-101` where the exponent is long; none beyond
/// the largest.
pub fn float(word: &str) -> Option<f64> {
    let plain = word.parse::<f64>().ok();
    let short = || {
        let sign = word.rfind(['+', '-']).filter(|&at| at > 0)?;
        format!("{}e{}", &word[..sign], &word[sign..]).parse().ok()
    };
    plain.or_else(short).filter(|x| x.abs() <= LARGEST)
}
