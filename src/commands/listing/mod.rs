//! `plane-contact listing`.

mod convert;
mod evaluate;
mod run;
mod trace;

use plane_contact::engine::error::Result;

/// Run, trace, evaluate, or convert a listing.
#[derive(clap::Subcommand)]
#[command(after_help = "\
Examples:
  plane-contact listing run c_cnt fig1
  plane-contact listing run Km fig1 --coupled-by none
  plane-contact listing trace fig1 --node 7
  plane-contact listing evaluate sum.txt --call \"sum(10)\"
  plane-contact listing convert c_cnt --to xmcd --out c_cnt.xmcd")]
pub enum Command {
    #[command(subcommand)]
    Run(run::Which),
    Trace(trace::Args),
    Evaluate(evaluate::Args),
    Convert(convert::Args),
}

/// Runs the command; returns the exit status.
pub fn run(command: &Command) -> Result<u8> {
    match command {
        Command::Run(which) => run::run(which).map(|()| 0),
        Command::Trace(args) => trace::run(args),
        Command::Evaluate(args) => evaluate::run(args),
        Command::Convert(args) => convert::run(args).map(|()| 0),
    }
}
