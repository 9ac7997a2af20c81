//! `plane-contact mathcad`.

mod export;
mod run;

use base::exit::ExitStatus;
use engine::error::Result;

/// Run a worksheet of Mathcad, or export a scene to one.
#[derive(clap::Subcommand)]
#[command(after_help = "\
Examples:
  plane-contact mathcad run worksheet.xmcd
  plane-contact mathcad export fig1 --out fig1.xmcd")]
pub enum Command {
    Run(run::Args),
    Export(export::Args),
}

/// Runs the command; returns the exit status.
pub fn run(command: &Command) -> Result<ExitStatus> {
    match command {
        Command::Run(args) => run::run(args),
        Command::Export(args) => export::run(args).map(|()| ExitStatus::Done),
    }
}
