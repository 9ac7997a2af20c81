//! Sweeps on the engines that run many jobs, and their results as one table.
//!
//! Every job is `plane-contact sweep run FILE --out DIR --only K`, which leaves a result that is there
//! alone; its file is named by the job's key.

use std::collections::BTreeMap;
use std::path::Path;

use serde_json::{Value, json};

use crate::sweep::{Job, Row};
use base::choices;
use base::error::{InputError, Result};
use base::files::json::{Kind, read};
use base::plain::{shell_quoted, shown};
use output::json;
use output::model::{Cell, Table};
use problem::scene::sha256;

choices! {
    /// An engine that runs jobs.
    Engine {
        /// A Python script for its package on PyPI.
        HyperQueue = "hyperqueue",
        /// A rule for all jobs.
        Snakemake = "snakemake",
        /// A target for each job, named by its number.
        Make = "make",
    }
}

/// The results of jobs.
const RESULT: Kind =
    Kind { name: "result of a job", fix: "move the file away, or give another folder by --out" };

/// Returns the name of a job's result.
pub fn result_name(job: &Job) -> String {
    format!("{}.json", job.key)
}

/// Returns the content of a job's result.
pub fn result(job: &Job, row: &Row) -> String {
    json::line(None, &json!({"key": job.key, "values": job.values, "result": row}))
}

/// Reads the result of a job.
///
/// # Errors
/// The text is no result, or that of another job.
pub fn read_result(job: &Job, text: &[u8]) -> Result<Row> {
    let result: Value = read(text, &RESULT)?;
    match result["result"].as_object().filter(|row| row.contains_key("exit_status")) {
        Some(row) if result["key"] == *job.key => Ok(row.clone()),
        _ => {
            let what = "this is not the result of this job";
            Err(InputError::new("the result of a job", what, RESULT.fix))
        }
    }
}

/// Returns the job file of an engine, for the program, the sweep and the folder of the results.
///
/// # Errors
/// A name cannot stand in the file.
pub fn job_file(engine: Engine, jobs: &[Job], words: [&Path; 3]) -> Result<String> {
    let fault = |path: &Path, what| InputError::new(shown(path), what, "rename it");
    let mut names = Vec::new();
    for path in words {
        let name = path.to_str().ok_or_else(|| fault(path, "its name is not in UTF-8"))?;
        if engine == Engine::Make && name.contains(['\n', '\r']) {
            return Err(fault(path, "a line of a makefile holds no name with a line break"));
        }
        // No program takes it for an option.
        let is_option = name.starts_with(['-', '+']);
        names.push(if is_option { format!("./{name}") } else { name.into() });
    }
    let keys: BTreeMap<&str, usize> = jobs.iter().map(|job| &*job.key).zip(0..).collect();
    let head = |names: Vec<String>| {
        let [program, sweep, out] = [0, 1, 2].map(|k| Value::from(&*names[k]).to_string());
        format!("PROGRAM, SWEEP, OUT = {program}, {sweep}, {out}\nJOBS = {}\n", json!(keys))
    };
    Ok(match engine {
        Engine::Make => make(jobs.len(), &names),
        Engine::HyperQueue => HYPERQUEUE.replace("HEAD", &head(names)),
        Engine::Snakemake => {
            let link = format!(".results-{}", &sha256(&names[2])[..16]);
            SNAKEMAKE.replace("LINK", &link).replace("HEAD", &head(names))
        }
    })
}

const HYPERQUEUE: &str = include_str!("engines/hyperqueue.py");

/// The folder of the results is named by a link: Snakemake takes braces in a name for wildcards.
const SNAKEMAKE: &str = include_str!("engines/Snakefile");

/// A target is a number, as no name with a blank or a colon can be one.
fn make(jobs: usize, names: &[String]) -> String {
    let quoted = |name: &String| shell_quoted(name).replace('$', "$$");
    let words: Vec<String> = names.iter().map(quoted).collect();
    let targets: Vec<String> = (0..jobs).map(|job| job.to_string()).collect();
    format!(
        "# Make: make -j 4 -f this file. Results that are there are not made again.\n\
         JOBS = {}\n\
         .PHONY: all $(JOBS)\n\
         all: $(JOBS)\n\
         $(JOBS):\n\
         \t{} sweep run {} --out {} --only $@\n",
        targets.join(" "),
        words[0],
        words[1],
        words[2]
    )
}

/// Returns the table of all jobs with what came of each, as CSV or as JSON.
pub fn table(jobs: &[Job], rows: &[Option<Row>], as_json: bool) -> String {
    let lines = jobs.iter().zip(rows).zip(0..).map(|((job, row), k): (_, usize)| {
        let mut line = Row::from_iter([("job".into(), json!(k)), ("key".into(), json!(job.key))]);
        line.extend(job.values.clone());
        line.extend(
            row.clone()
                .unwrap_or_else(|| Row::from_iter([("error".into(), json!("it has not run"))])),
        );
        line
    });
    let lines: Vec<Row> = lines.collect();
    if as_json {
        return json::line(None, &json!({"rows": lines}));
    }
    let mut headings: Vec<&String> = Vec::new();
    for name in lines.iter().flat_map(Row::keys) {
        if !headings.contains(&name) {
            headings.push(name);
        }
    }
    let of = |line: &Row| headings.iter().map(|name| cell(line.get(*name))).collect();
    Table::new(&headings, lines.iter().map(of)).csv()
}

fn cell(value: Option<&Value>) -> Cell {
    match value {
        None | Some(Value::Null) => Cell::Empty,
        Some(Value::String(text)) => Cell::Text(text.clone()),
        Some(Value::Number(number)) => match number.as_i64() {
            Some(whole) => Cell::Integer(whole.into()),
            None => Cell::plain(number.as_f64().unwrap_or(f64::NAN)),
        },
        Some(other) => Cell::Text(other.to_string()),
    }
}
