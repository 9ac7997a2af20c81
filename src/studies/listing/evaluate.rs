//! `plane-contact listing evaluate`.

use std::path::PathBuf;
use std::rc::Rc;

use base::error::InputError;
use base::exit::ExitStatus;
use base::files;
use base::plain::shown;
use engine::error::{Error, Result};
use mathcad::{
    Cause, Ended, Limits, Listing, Settings, Sheet, Value, file, json, unsupported::is_unit,
};
use output::evaluation as report;
use output::model::Report;

use commands::{print, print_either, read_listing, report_error, waiting};

/// Run a program in the notation of the listings.
#[derive(clap::Args)]
#[command(after_help = "\
The file holds one function or several, in the notation that plane-contact guide notation \
describes. Rules, and where each was measured: plane-contact guide interpreter.

Examples:
  plane-contact listing evaluate gauss.txt --call \"gauss(A, 2)\" --inputs '{\"A\": [[2, 1, 5], [1, 3, 10]]}'
  plane-contact listing evaluate sum.txt --call \"sum(10)\" --settings origin=0 --json")]
pub struct Args {
    /// The file of the program.
    #[arg(value_name = "FILE")]
    file: PathBuf,
    /// The call [default: the first function, its arguments taken from --inputs by name].
    #[arg(long, value_name = "CALL")]
    call: Option<String>,
    /// The worksheet's names, as a JSON object: numbers, strings, lists (columns), lists of rows.
    #[arg(long, value_name = "JSON", default_value = "{}")]
    inputs: String,
    /// Settings of the worksheet that differ from the default, such as
    /// origin=0,zero-over-zero=0,exact-boolean=false.
    /// origin N (default 1), zero-over-zero error|0, exact-boolean true|false, conjunction
    /// guarded|left-to-right|eager, descending counts-down|empty, last-if previous|0, tiny itself|0.
    #[arg(long, value_name = "LIST", default_value = "")]
    settings: Settings,
    /// The most steps that are executed. A step is a statement or a turn of a loop; what is computed
    /// counts too, by the time that it takes.
    #[arg(long, value_name = "STEPS", default_value_t = Limits::default().steps)]
    limit: u64,
    /// Print JSON: {\"value\": ..., \"trace\": [...]}, or {\"error\": {...}}.
    #[arg(long)]
    json: bool,
}

/// Runs the call; returns the exit status.
pub fn run(args: &Args) -> Result<ExitStatus> {
    let place = shown(&args.file);
    let text = read_listing(&args.file)?;
    let notation = "see `plane-contact guide notation`";
    let programs = file::listings(&place, &text, &Limits::default())
        .map_err(|error| InputError::new(&place, error.to_string(), notation))?;
    let mut sheet = inputs(&args.inputs)?;
    let call = match &args.call {
        Some(call) => call.clone(),
        None => call_of(&programs[0]),
    };
    for program in programs {
        sheet.define_program(Rc::new(program));
    }
    let call = Listing::parse("--call", &format!("_() :=\n  {call}"))
        .map_err(|error| InputError::new("--call", error.to_string(), notation))?;
    let is_unknown = |name: &&str| is_unit(name) && !sheet.has(name);
    if let Some(name) = call.free_names().into_iter().find(is_unknown) {
        let what = format!("{name} is not defined");
        return Err(InputError::new("--call", what, "give its value by --inputs").into());
    }
    let limits = Limits { steps: args.limit, ..Limits::default() };
    let outcome = waiting("executing", || call.runner(&sheet, &args.settings, &limits).call(&[]));
    let failure = match outcome {
        Ok(outcome) => {
            let printed = print_either(args.json, || report::json(&outcome), || ended(&outcome));
            return printed.map(|()| ExitStatus::Done);
        }
        Err(failure) => failure,
    };
    let fix = match failure.cause {
        Cause::Unsupported { .. } | Cause::Complex { .. } => {
            "the program may be right: write it with what `plane-contact guide interpreter` lists"
        }
        Cause::Limit { of: "steps", .. } => "correct the program, or give more steps by --limit",
        _ => "correct the program or its inputs",
    };
    let wrong = Error::from(InputError::new(&place, failure.to_string(), fix));
    if !args.json {
        return Err(wrong);
    }
    // The failure of the program is what was asked for: no other document follows it.
    print(&report::error_json(&failure))?;
    Ok(report_error(&wrong))
}

/// The call of a function on names of the worksheet.
fn call_of(program: &Listing) -> String {
    let parameters = program.parameters.iter().map(|slot| program.names.name(*slot));
    format!("{}({})", program.function(), parameters.collect::<Vec<_>>().join(", "))
}

/// The worksheet that `--inputs` spells.
fn inputs(text: &str) -> Result<Sheet, InputError> {
    let fix = "give an object such as {\"x\": 1, \"A\": [[1, 2], [3, 4]]}";
    let kind = files::json::Kind { name: "object of inputs", fix };
    let names: serde_json::Map<String, serde_json::Value> =
        files::json::read(text.as_bytes(), &kind).map_err(|error| error.within("--inputs"))?;
    let mut sheet = Sheet::default();
    for (name, value) in names {
        let value = json::read(&value)
            .map_err(|why| InputError::new(format!("--inputs {name}"), why, fix))?;
        sheet.define(&name, value);
    }
    Ok(sheet)
}

/// Reports what `trace` was given, then the value, a row on each line.
fn ended(outcome: &Ended) -> Report {
    let traces = outcome.trace_output.iter().map(|line| format!("trace: {line}"));
    let value = match &outcome.value {
        nested @ Value::Nested(_) => serde_json::to_string(nested).expect("an array of JSON"),
        value => value.to_string().replace("; ", "\n"),
    };
    traces.chain([value]).fold(Report::default(), Report::line)
}
