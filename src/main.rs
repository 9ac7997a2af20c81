//! The command line; its commands are listed in `src/studies/command.rs`.
#![forbid(unsafe_code)]

use std::process::ExitCode;

use clap::{CommandFactory, FromArgMatches, Parser};
use plane_contact::Error;
use plane_contact::commands::{self, Verbosity, process, shells};
use plane_contact::error::InputError;
use plane_contact::exit::ExitStatus;
use plane_contact::studies::command::{self, Command};

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
    #[arg(long, value_name = "SHELL", value_parser = shells::SHELLS)]
    completions: Option<String>,
    /// Print errors alone to standard error: no progress, no notes.
    #[arg(short, long, global = true, hide = true)]
    quiet: bool,
    /// Print each stage of the work to standard error, with its time.
    #[arg(short, long, global = true, hide = true, conflicts_with = "quiet")]
    verbose: bool,
    #[command(subcommand)]
    command: Option<Command>,
}

fn main() -> ExitCode {
    shells::complete(Cli::command);
    process::start_pool();
    #[cfg(unix)]
    process::heed_signals();
    // Every command that prints JSON has this option.
    let json = std::env::args_os().any(|arg| arg == "--json");
    let mut grammar = grammar().before_help(command::grouped(&Cli::command()));
    let parsed = grammar.try_get_matches_from_mut(std::env::args_os());
    let result = match parsed.and_then(|matches| Cli::from_arg_matches(&matches)) {
        Ok(cli) => cli.run(),
        Err(why) if why.use_stderr() => {
            return commands::report_usage(why, &grammar, json).into();
        }
        // What was asked for is help, or the version.
        Err(why) => commands::help(&why).map(|()| ExitStatus::Done),
    };
    result.unwrap_or_else(|error| commands::report_failure(&error, json)).into()
}

impl Cli {
    /// Does what is asked for; returns the exit status.
    fn run(self) -> Result<ExitStatus, Error> {
        match (self.quiet, self.verbose) {
            (true, _) => Verbosity::Quiet.choose(),
            (false, true) => Verbosity::Verbose.choose(),
            (false, false) => Verbosity::Usual.choose(),
        }
        let fault = |what, fix| Err(InputError::new("the command line", what, fix).into());
        match (self.command, &self.completions) {
            (Some(command), None) => command::run(&command).map_err(named_by_option),
            (Some(_), Some(_)) => {
                fault("--completions stands in place of a command", "leave one out")
            }
            (None, None) => {
                fault("there is no command", "name a command: plane-contact --help lists them")
            }
            (None, Some(shell)) => shells::print_completions(shell).map(|()| ExitStatus::Done),
        }
    }
}

/// Returns the grammar of the command line, in which the first page of help alone names the options that
/// every command has.
fn grammar() -> clap::Command {
    let mut grammar = Cli::command();
    grammar.build();
    grammar.mut_args(|arg| match arg.is_global_set() {
        true => arg.hide(false),
        false => arg,
    })
}

/// Returns a line for each exit status.
fn exit_statuses() -> String {
    let line = |status: &ExitStatus| format!("{:>5}  {}\n", status.number(), status.explained());
    ExitStatus::ALL.iter().map(line).collect()
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
