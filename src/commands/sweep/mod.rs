//! `plane-contact sweep`.

mod journal;
mod workers;

use std::collections::HashMap;
use std::fs::File;
use std::io::{BufRead, Write};
use std::path::{Path, PathBuf};

use plane_contact::engine::error::Result;
use plane_contact::error::InputError;
use plane_contact::files;
use plane_contact::problem::scene::sha256;
use plane_contact::report::sweep::{Engine, Jobs, TRY_AGAIN};
use plane_contact::studies::sweep::{Cases, Row, Sweep, row};
use rayon::prelude::*;
use serde_json::{Map, Value, json};

use super::{print, print_fitted, print_stderr};
use journal::Journal;

/// The bytes of a sweep.
const MOST: u64 = 1 << 24;

/// Run a scene under many values of its fields and of options.
#[derive(clap::Args)]
#[command(after_help = "\
SWEEP is a file of JSON: format, scene (a name or a path beside it) or generate (a kind of mesh and
its parameters), options, and the values that take turns by JSON pointer: grid (every combination)
or list. Writes a line of JSON for each case, in order. Each case runs in a process of its own; one
that fails or crashes is a row. A case is known by its key, a hash of all that it reads (scene,
mesh, options) and of the version: a sweep that was interrupted goes on where it was, and nothing
runs twice.

Examples:
  plane-contact sweep sweep.json --out rows.jsonl
  plane-contact sweep sweep.json --emit hyperqueue > jobs.py
  plane-contact sweep sweep.json --emit commands | parallel
  plane-contact sweep sweep.json --rows rows             gathers what an engine ran

  {\"format\": 1, \"scene\": \"fig1\",
   \"grid\": {\"/options/variant\": [\"tied\", \"stepped\"],
            \"/scene/contact/c_tll\": {\"from\": 1e-4, \"to\": 1e-2, \"count\": 21, \"log\": true}}}")]
pub struct Args {
    /// File of the sweep.
    #[arg(value_name = "SWEEP")]
    file: PathBuf,
    /// File of the rows [default: <sweep>.jsonl in the folder out].
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// Folder of rows that an engine wrote: they are taken, and only what is missing runs.
    #[arg(long, value_name = "DIR")]
    rows: Option<PathBuf>,
    /// Print the job file of an engine and run nothing: hyperqueue, snakemake; or commands, a command
    /// of the shell on each line.
    #[arg(long, value_name = "ENGINE")]
    emit: Option<Engine>,
    /// Run this case alone, from zero.
    #[arg(long, value_name = "K", requires = "row")]
    case: Option<usize>,
    /// File of the row of --case; an equal one is left as it is.
    #[arg(long, value_name = "FILE", requires = "case")]
    row: Option<PathBuf>,
    /// Run the cases whose numbers standard input gives, and print a row each.
    #[arg(long, hide = true)]
    worker: bool,
}

pub fn run(args: &Args) -> Result<u8> {
    let place = args.file.display().to_string();
    if args.file.exists() && !args.file.is_file() {
        let what = "each process of a sweep reads its file, and this is no ordinary file";
        return Err(InputError::new(place, what, "write the sweep to a file").into());
    }
    let text = File::open(&args.file).and_then(|file| files::read_up_to(file, MOST));
    let text = text.map_err(|why| {
        let what = format!("the sweep cannot be read: {why}");
        InputError::new(&place, what, "see `plane-contact sweep --help`")
    })?;
    let sweep = Sweep::read(&text).map_err(|error| error.within(&place))?;
    let folder = args.file.parent().unwrap_or(Path::new(""));
    let cases = sweep.cases(folder).map_err(|error| error.within(&place))?;
    match (args.emit, args.case, &args.row) {
        (Some(engine), ..) => emit(args, &cases, engine),
        (None, Some(case), Some(file)) => one(&cases, case, file),
        _ if args.worker => worker(&cases),
        _ => whole(args, &cases),
    }
}

/// Returns the line of a case: its number, its key, what takes turns, and what came of it.
fn line(cases: &Cases, case: usize, key: &str, row: &Row) -> String {
    let mut columns = Map::new();
    columns.insert("case".into(), json!(case));
    columns.insert("key".into(), json!(key));
    for (pointer, value) in cases.values(case) {
        // A data frame has numbers and words in its cells.
        let is_cell = !(value.is_array() || value.is_object());
        columns.insert(pointer, if is_cell { value } else { Value::from(value.to_string()) });
    }
    columns.extend(row.clone());
    Value::Object(columns).to_string() + "\n"
}

/// Returns the key of a case; of one without a document, that of the values it was to have.
fn key(cases: &Cases, case: usize) -> String {
    match cases.document(case) {
        Ok(document) => document.key(),
        Err(_) => sha256(&cases.values(case)),
    }
}

/// Runs the cases that are not known yet, and writes all rows.
fn whole(args: &Args, cases: &Cases) -> Result<u8> {
    let stem = args.file.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    let default = || Path::new("out").join(format!("{stem}.jsonl"));
    let out = args.out.clone().unwrap_or_else(default);
    let mut journal = Journal::open(&out)?;
    let mut known: HashMap<String, Row> = journal.known(&out)?;
    if let Some(folder) = &args.rows {
        known.extend(journal::in_folder(folder)?);
    }
    let keys: Vec<String> = (0..cases.len()).into_par_iter().map(|k| key(cases, k)).collect();
    let mut missing: Vec<usize> = Vec::new();
    let mut asked = std::collections::HashSet::new();
    for (case, key) in keys.iter().enumerate() {
        if !known.contains_key(key) && asked.insert(key) {
            missing.push(case);
        }
    }
    let ran = missing.len();
    workers::run(&args.file, &missing, |case, row| {
        journal.add(&keys[case], &row)?;
        known.insert(keys[case].clone(), row);
        Ok(())
    })?;
    let of_case = |case: usize| line(cases, case, &keys[case], &known[&keys[case]]);
    let text: String = (0..cases.len()).map(of_case).collect();
    files::write(&out, &text)?;
    journal.remove();
    let status = |key: &String| known[key].get("exit_status").and_then(Value::as_i64);
    let failed = keys.iter().filter(|key| status(key) != Some(0)).count();
    print_fitted(&format!(
        "{} cases: {ran} ran, {failed} failed\nWritten to {}\n",
        cases.len(),
        out.display()
    ))?;
    Ok(0)
}

/// Runs the cases whose numbers stand on standard input.
fn worker(cases: &Cases) -> Result<u8> {
    for number in std::io::stdin().lock().lines() {
        let Some(case) = number.ok().and_then(|number| number.parse().ok()) else { break };
        let text = Value::Object(row(cases.document(case))).to_string() + "\n";
        let mut out = std::io::stdout().lock();
        if out.write_all(text.as_bytes()).and_then(|()| out.flush()).is_err() {
            break;
        }
    }
    Ok(0)
}

/// Runs one case and writes its row, unless the same is there.
fn one(cases: &Cases, case: usize, file: &Path) -> Result<u8> {
    if case >= cases.len() {
        let what = format!("there are {} cases, counted from 0", cases.len());
        return Err(InputError::new("--case", what, "give the number of one").into());
    }
    let text = line(cases, case, &key(cases, case), &row(cases.document(case)));
    let is_file = std::fs::metadata(file).is_ok_and(|file| file.is_file());
    if is_file && std::fs::read(file).is_ok_and(|there| there == text.as_bytes()) {
        return Ok(0);
    }
    match files::write(file, &text) {
        Ok(()) => Ok(0),
        Err(why) => {
            print_stderr(&format!("error: {why}\n"));
            Ok(TRY_AGAIN)
        }
    }
}

/// Prints the job file of an engine.
fn emit(args: &Args, cases: &Cases, engine: Engine) -> Result<u8> {
    if cases.is_empty() {
        let what = "the sweep has no case";
        return Err(InputError::new("grid and list", what, "give each pointer a value").into());
    }
    let program = std::env::current_exe().ok().map(|path| path.display().to_string());
    let rows = args.rows.clone().unwrap_or_else(|| args.file.with_extension("rows"));
    let jobs = Jobs {
        program: &program.unwrap_or_else(|| "plane-contact".into()),
        sweep: name(&args.file)?,
        rows: name(&rows)?,
        cases: cases.len(),
        memory: 1e9,
    };
    if engine == Engine::Commands && [jobs.program, jobs.sweep, jobs.rows].concat().contains('\n') {
        let what = "a line holds no name with a line break";
        return Err(InputError::new("--emit", what, "rename it, or ask for another engine").into());
    }
    print(&jobs.file(engine))?;
    Ok(0)
}

/// Returns the name of a file as a job file can have it.
fn name(path: &Path) -> Result<&str, InputError> {
    path.to_str().ok_or_else(|| {
        InputError::new(path.display().to_string(), "its name is not in UTF-8", "rename it")
    })
}
