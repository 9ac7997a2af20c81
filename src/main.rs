//! The command line.
#![forbid(unsafe_code)]

use std::io;
use std::num::NonZero;
use std::path::PathBuf;
use std::process::ExitCode;
use std::sync::mpsc::channel;
use std::thread::{Builder, available_parallelism};

use clap::error::{ContextKind, ContextValue, ErrorKind};
use clap::{CommandFactory, FromArgMatches, Parser};
use clap_complete::CompleteEnv;
use clap_complete::env::Shells;
use plane_contact::commands::Verbosity;
use plane_contact::error::InputError;
use plane_contact::exit::ExitStatus;
use plane_contact::files;
use plane_contact::plain::is_hidden;
use plane_contact::report::failure::failure;
use plane_contact::studies::command::{self, Command};
use plane_contact::{Error, commands};

/// Audited reimplementation of a published plane contact algorithm (Filipov & Khomenko): finite
/// elements, contact pairs by the listing c_cnt, stiffness by the listing Km.
#[derive(Parser)]
#[command(
    version,
    arg_required_else_help = true,
    override_usage = "plane-contact [OPTIONS]\n       plane-contact [-q | -v] <COMMAND>",
    // Help names them in the words of the program; completions have them.
    hide_possible_values = true,
    subcommand_value_name = "COMMAND",
    help_template = "\
{about-with-newline}
{usage-heading} {usage}

{before-help}Options:
{options}{after-help}",
    after_help = format!("\
Exit status:
{}
Examples:
  plane-contact solve                        the paper's example
  plane-contact solve fig1 --variant printed
  plane-contact audit                        every ambiguity and finding, on the paper's example
  plane-contact listing run c_cnt fig1
  plane-contact snapshot record fig1
  plane-contact scene copy fig1 --out my     a scene to edit
  plane-contact guide                        what there is to read
  plane-contact --completions bash > /etc/bash_completion.d/plane-contact", exit_statuses())
)]
struct Cli {
    /// Print the completions of a shell: bash, elvish, fish, powershell, zsh.
    #[arg(long, value_name = "SHELL", value_parser = ["bash", "elvish", "fish", "powershell", "zsh"])]
    completions: Option<String>,
    /// Write the man pages of all commands to a folder.
    #[arg(long, value_name = "DIR", conflicts_with = "completions")]
    man: Option<PathBuf>,
    /// Print errors alone to standard error: no progress, no notes.
    #[arg(short, long, global = true, hide = true)]
    quiet: bool,
    /// Print each stage of the work to standard error, with its time.
    #[arg(short, long, global = true, hide = true, conflicts_with = "quiet")]
    verbose: bool,
    #[command(subcommand)]
    command: Option<Command>,
}

/// Bytes of the stack of each thread, whatever the environment (RUST_MIN_STACK) says; the default of Rust.
const STACK: usize = 1 << 21;

/// The variable of the environment by which a shell asks what completes a command line.
const COMPLETE: &str = "PLANE_CONTACT_COMPLETE";

fn main() -> ExitCode {
    CompleteEnv::with_factory(Cli::command).var(COMPLETE).complete();
    start_pool();
    #[cfg(unix)]
    heed_signals();
    // Every command that prints JSON has this option.
    let json = std::env::args_os().any(|arg| arg == "--json");
    let groups = command::grouped(&Cli::command());
    let mut grammar = grammar().before_help(groups);
    let parsed = grammar.try_get_matches_from_mut(std::env::args_os());
    let cli = match parsed.and_then(|matches| Cli::from_arg_matches(&matches)) {
        Ok(cli) => cli,
        Err(mut why) if why.use_stderr() => {
            command::name_subcommands(&mut why, &grammar);
            escape(&mut why);
            if why.kind() == ErrorKind::InvalidUtf8 {
                return exit_code(Err(not_utf8()), json);
            }
            if json {
                // The error itself counts, not that its JSON could not be printed.
                let _ = commands::print(&failure(&usage(&why)));
            }
            commands::print_stderr(&rendered(&why));
            return ExitStatus::Input.into();
        }
        // What was asked for is help, or the version.
        Err(why) => return exit_code(commands::help(&why).map(|()| ExitStatus::Done), json),
    };
    match (cli.quiet, cli.verbose) {
        (true, _) => Verbosity::Quiet.choose(),
        (false, true) => Verbosity::Verbose.choose(),
        (false, false) => Verbosity::Usual.choose(),
    }
    let result = match cli.command {
        Some(_) if cli.completions.is_some() || cli.man.is_some() => {
            let what = "--completions and --man stand in place of a command";
            Err(InputError::new("the command line", what, "leave one out").into())
        }
        Some(command) => command.run().map_err(named_by_option),
        None => shell_files(&cli).map(|()| ExitStatus::Done),
    };
    exit_code(result, json)
}

/// Returns the grammar of the command line, in which the first page of help alone names the options that every
/// command has.
fn grammar() -> clap::Command {
    let mut grammar = Cli::command();
    grammar.build();
    grammar.mut_args(|arg| match arg.is_global_set() {
        true => arg.hide(false),
        false => arg,
    })
}

/// Starts the threads of the pool, one for each processor unless RAYON_NUM_THREADS says otherwise. Where the system
/// does not start so many, this thread alone is the pool: rayon, which fails then, builds no second one.
fn start_pool() {
    let asked = std::env::var("RAYON_NUM_THREADS").ok().and_then(|count| count.parse().ok());
    let count = asked.or_else(|| available_parallelism().ok()).map_or(1, NonZero::get);
    let start = |_| {
        let (give, given) = channel::<rayon::ThreadBuilder>();
        let work = move || given.iter().for_each(rayon::ThreadBuilder::run);
        Builder::new().stack_size(STACK).spawn(work).map(|_| give)
    };
    let pool = rayon::ThreadPoolBuilder::new();
    let built = match (0..count).map(start).collect::<io::Result<Vec<_>>>() {
        Ok(started) => {
            let mut started = started.into_iter();
            let hand_over = move |work| {
                let thread = started.next().expect("one was started for each");
                thread.send(work).map_err(|_| io::ErrorKind::BrokenPipe.into())
            };
            pool.num_threads(count).spawn_handler(hand_over).build_global()
        }
        // Those that were started end, as nothing is given to them.
        Err(_) => pool.num_threads(1).use_current_thread().build_global(),
    };
    built.expect("nothing used the pool before");
}

/// Returns a line for each exit status.
fn exit_statuses() -> String {
    let line = |status: &ExitStatus| format!("{:>5}  {}\n", status.number(), status.explained());
    ExitStatus::ALL.iter().map(line).collect()
}

/// Prints the completions of a shell, or writes the man pages: what is asked for in place of a command.
fn shell_files(cli: &Cli) -> Result<(), Error> {
    if cli.completions.is_none() && cli.man.is_none() {
        let fix = "name a command: plane-contact --help lists them";
        return Err(InputError::new("the command line", "there is no command", fix).into());
    }
    if let Some(shell) = &cli.completions {
        let (shells, mut script) = (Shells::builtins(), Vec::new());
        let completer = shells.completer(shell).expect("clap knows the values of the option");
        let [name, program] = ["plane_contact", "plane-contact"];
        completer
            .write_registration(COMPLETE, name, program, program, &mut script)
            .expect("memory can be written");
        commands::print(&String::from_utf8(script).expect("it is UTF-8"))?;
    }
    if let Some(folder) = &cli.man {
        files::write_all(folder, &man_pages(&grammar()))?;
        commands::report_written(folder);
    }
    Ok(())
}

/// Returns the man pages of a command and of those in it, each with the name of its file.
fn man_pages(command: &clap::Command) -> Vec<(String, Vec<u8>)> {
    let inner = command.get_subcommands().filter(|command| command.get_name() != "help");
    let mut pages: Vec<_> = inner.flat_map(man_pages).collect();
    let (page, mut text) = (clap_mangen::Man::new(command.clone()), Vec::new());
    page.render(&mut text).expect("memory can be written");
    pages.push((page.get_filename(), text));
    pages
}

/// Names the option where what is asked for is at fault: the library names the setting.
fn named_by_option(error: Error) -> Error {
    const OPTIONS: [&str; 9] =
        ["accuracy", "entry", "nodes", "reason", "scalar", "solver", "status", "tol", "variant"];
    match error {
        Error::Input(why) if OPTIONS.contains(&&*why.place) => {
            InputError { place: format!("--{}", why.place), ..why }.into()
        }
        other => other,
    }
}

/// Returns the exit status of a command, once its error is reported.
fn exit_code(result: Result<ExitStatus, Error>, json: bool) -> ExitCode {
    match result {
        Ok(status) => status.into(),
        Err(error) => {
            if json {
                // As above.
                let _ = commands::print(&failure(&error));
            }
            commands::report_error(&error).into()
        }
    }
}

/// Has SIGHUP, SIGINT, SIGQUIT and SIGTERM end the process as they do by themselves, once nothing temporary and
/// no program that it started is left;
/// and has a file that may not grow further be an error of its writing, not the end of the process.
#[cfg(unix)]
fn heed_signals() {
    use signal_hook::consts::{SIGHUP, SIGINT, SIGQUIT, SIGTERM, SIGXFSZ};
    use signal_hook::{flag, iterator::Signals, low_level::emulate_default_handler};
    // Where one of these cannot be had, signals end the process at once.
    let _ = flag::register(SIGXFSZ, Default::default());
    let ending =
        [SIGHUP, SIGINT, SIGQUIT, SIGTERM].into_iter().filter(|signal| !is_ignored(*signal));
    let end = |signal| files::abandon(|| emulate_default_handler(signal).unwrap_or_default());
    let (give, given) = channel::<Signals>();
    let wait = move || given.iter().for_each(|mut signals| signals.forever().for_each(end));
    // No signal is caught before there is a thread that waits for it.
    if Builder::new().stack_size(STACK).spawn(wait).is_ok() {
        let _ = Signals::new(ending).map(|signals| give.send(signals));
    }
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

/// Writes what controls a terminal, or breaks a line, in the words of the user that an error repeats as escapes.
fn escape(why: &mut clap::Error) {
    let escaped = |text: &String| text.escape_debug().to_string();
    let is_unsafe = |text: &String| text.contains(is_hidden);
    let context = why.context().filter_map(|(kind, value)| match value {
        ContextValue::String(text) if is_unsafe(text) => {
            Some((kind, ContextValue::String(escaped(text))))
        }
        _ => None,
    });
    for (kind, value) in context.collect::<Vec<_>>() {
        why.remove(ContextKind::Suggested);
        why.insert(kind, value);
    }
}

/// Returns what is wrong with the command line, with plain words in place of those that Rust has for numbers.
fn rendered(why: &clap::Error) -> String {
    const WORDS: [(&str, &str); 5] = [
        ("invalid float literal", "it is no number"),
        ("cannot parse float from empty string", "it is empty"),
        ("invalid digit found in string", "it is no whole number of 0 or more"),
        ("cannot parse integer from empty string", "it is empty"),
        ("number too large to fit in target type", "it is too large"),
    ];
    let text = why.render().to_string();
    WORDS
        .iter()
        .fold(text, |text, (rust, plain)| text.replace(&format!(": {rust}"), &format!(": {plain}")))
}

/// Returns the fault of an argument that is no text.
fn not_utf8() -> Error {
    let arg = std::env::args_os().find(|arg| arg.to_str().is_none()).unwrap_or_default();
    let what = format!("the argument {arg:?} is not in UTF-8");
    InputError::new("the command line", what, "rename the file, or type a value in UTF-8").into()
}

/// Returns a fault of the command line.
fn usage(why: &clap::Error) -> Error {
    let text = rendered(why);
    let start = text.lines().take_while(|line| !line.is_empty()).map(str::trim);
    let start = start.collect::<Vec<_>>().join(" ");
    InputError::new("the command line", start.trim_start_matches("error: "), "see --help").into()
}
