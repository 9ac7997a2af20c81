//! The command line.
#![forbid(unsafe_code)]

mod commands;

use std::process::ExitCode;

use clap::{Parser, Subcommand};
use plane_contact::Error;
use plane_contact::error::InputError;
use plane_contact::files;
use plane_contact::memory;
use plane_contact::report::failure::failure;

/// Audited reimplementation of a published plane contact algorithm (Filipov & Khomenko): finite
/// elements, contact pairs by the listing c_cnt, stiffness by the listing Km.
#[derive(Parser)]
#[command(
    version,
    after_help = "\
Exit status: 0 done; 1 what was compared differs; 2 the input is at fault; 3 the published
algorithm fails as printed (an audit result); 4 no equilibrium was found, or more than one.

Examples:
  plane-contact solve                        the paper's example
  plane-contact solve fig1 --variant printed
  plane-contact audit                        every ambiguity and finding, on the paper's example
  plane-contact c-cnt fig1
  plane-contact km fig1 --coupled-by none"
)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    Solve(commands::solve::Args),
    Record(commands::record::Args),
    Verify(commands::verify::Args),
    Explain(commands::verify::ExplainArgs),
    Diff(commands::diff::Args),
    Accept(commands::accept::Args),
    Sweep(commands::sweep::Args),
    Key(commands::sweep::KeyArgs),
    Audit(commands::audit::Args),
    CCnt(commands::c_cnt::Args),
    Km(commands::km::Args),
    Mesh(commands::mesh::Args),
    Scenes(commands::scenes::Args),
    Scene(commands::scenes::SceneArgs),
    Plan(commands::plan::Args),
    Statuses(commands::statuses::Args),
    Trace(commands::trace::Args),
    Evaluate(commands::evaluate::Args),
    Mathcad(commands::mathcad::Args),
    Listing(commands::listing::Args),
    Lesson(commands::lesson::Args),
    Report(commands::report::Args),
    Trade(commands::trade::Args),
    Export(commands::export::Args),
    Compare(commands::compare::Args),
    Extremes(commands::extremes::Args),
    Schema(commands::schema::Args),
}

fn main() -> ExitCode {
    #[cfg(unix)]
    heed_signals();
    let done = |()| 0;
    // Every command that prints JSON has this option.
    let json = std::env::args_os().any(|arg| arg == "--json");
    let command = match Cli::try_parse() {
        Ok(Cli { command }) => command,
        Err(why) if why.use_stderr() => {
            if json {
                let _ = commands::print(&failure(&usage(&why)));
            }
            commands::tell(&why.render().to_string());
            return ExitCode::from(2);
        }
        // What was asked for is help, or the version.
        Err(why) => return ended(commands::help(&why).map(done), json),
    };
    // What they take is no longer free when a command asks how much is.
    if let Err(why) = start_threads() {
        return ended(Err(why.into()), json);
    }
    let result = match command {
        Command::Record(args) => commands::record::run(&args).map(done),
        Command::Verify(args) => commands::verify::run(&args),
        Command::Explain(args) => commands::verify::run_explain(&args),
        Command::Diff(args) => commands::diff::run(&args),
        Command::Accept(args) => commands::accept::run(&args).map(done),
        Command::Sweep(args) => commands::sweep::run(&args),
        Command::Key(args) => commands::sweep::run_key(&args).map(done),
        Command::Solve(args) => commands::solve::run(&args),
        Command::Audit(args) => commands::audit::run(&args).map(done),
        Command::CCnt(args) => commands::c_cnt::run(&args).map(done),
        Command::Km(args) => commands::km::run(&args).map(done),
        Command::Mesh(args) => commands::mesh::run(&args).map(done),
        Command::Scenes(args) => commands::scenes::run(&args).map(done),
        Command::Scene(args) => commands::scenes::run_scene(&args).map(done),
        Command::Plan(args) => commands::plan::run(&args).map(done),
        Command::Statuses(args) => commands::statuses::run(&args).map(done),
        Command::Trace(args) => commands::trace::run(&args),
        Command::Evaluate(args) => commands::evaluate::run(&args),
        Command::Mathcad(args) => commands::mathcad::run(&args),
        Command::Listing(args) => commands::listing::run(&args).map(done),
        Command::Lesson(args) => commands::lesson::run(&args).map(done),
        Command::Report(args) => commands::report::run(&args).map(done),
        Command::Trade(args) => commands::trade::run(&args).map(done),
        Command::Export(args) => commands::export::run(&args).map(done),
        Command::Compare(args) => commands::compare::run(&args).map(done),
        Command::Extremes(args) => commands::extremes::run(&args).map(done),
        Command::Schema(args) => commands::schema::run(&args).map(done),
    };
    ended(result, json)
}

/// Starts the threads that all commands share, as many as rayon would: RAYON_NUM_THREADS, or one for
/// each processor.
fn start_threads() -> Result<(), InputError> {
    let asked = std::env::var("RAYON_NUM_THREADS").ok().and_then(|number| number.parse().ok());
    let processors = || std::thread::available_parallelism().map_or(1, usize::from);
    let threads = asked.filter(|threads| *threads > 0).unwrap_or_else(processors);
    memory::check_stacks(threads)?;
    rayon::ThreadPoolBuilder::new().num_threads(threads).build_global().map_err(|why| {
        let what = format!("its threads cannot start: {why}");
        InputError::new("the process", what, memory::FIX_THREADS)
    })
}

/// Returns the exit status of what was done, once an error is said.
fn ended(result: Result<u8, Error>, json: bool) -> ExitCode {
    match result {
        Ok(status) => ExitCode::from(status),
        Err(error) => {
            if json {
                let _ = commands::print(&failure(&error));
            }
            ExitCode::from(commands::told(&error))
        }
    }
}

/// Has SIGINT and SIGTERM end the process as they do by themselves, once nothing temporary is left;
/// and has a file that may not grow further be an error of its writing, not the end of the process.
#[cfg(unix)]
fn heed_signals() {
    use signal_hook::consts::{SIGINT, SIGTERM, SIGXFSZ};
    use signal_hook::{flag, iterator::Signals, low_level::emulate_default_handler};
    let _ = flag::register(SIGXFSZ, Default::default());
    let ending = [SIGINT, SIGTERM].into_iter().filter(|signal| !is_ignored(*signal));
    let Ok(mut signals) = Signals::new(ending) else { return };
    let end = |signal| files::abandon(|| emulate_default_handler(signal).unwrap_or_default());
    std::thread::spawn(move || signals.forever().for_each(end));
}

/// Returns whether a signal is ignored from the start, as SIGINT is in the background of a shell's
/// script. Only Linux says so.
#[cfg(unix)]
fn is_ignored(signal: i32) -> bool {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let ignored = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    let set = ignored.and_then(|digits| u64::from_str_radix(digits.trim(), 16).ok());
    set.is_some_and(|set| set >> (signal - 1) & 1 == 1)
}

/// Returns a fault of the command line.
fn usage(why: &clap::Error) -> Error {
    let text = why.render().to_string();
    let start = text.lines().take_while(|line| !line.is_empty()).map(str::trim);
    let start = start.collect::<Vec<_>>().join(" ");
    let what = start.trim_start_matches("error: ");
    InputError::new("the command line", what, "see --help").into()
}
