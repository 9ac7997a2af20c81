//! `plane-contact listing`.

mod evaluate;
mod run;

use base::exit::ExitStatus;
use engine::error::Result;

/// Run a listing of the paper, or evaluate a program in its notation.
#[derive(clap::Subcommand)]
#[command(after_help = "\
Examples:
  plane-contact listing run c_cnt fig1
  plane-contact listing run Km fig1 --coupled-by none
  plane-contact listing evaluate sum.txt --call \"sum(10)\"")]
pub enum Command {
    #[command(subcommand)]
    Run(run::Which),
    Evaluate(evaluate::Args),
}

/// Runs the command; returns the exit status.
pub fn run(command: &Command) -> Result<ExitStatus> {
    match command {
        Command::Run(which) => run::run(which).map(|()| ExitStatus::Done),
        Command::Evaluate(args) => evaluate::run(args),
    }
}
