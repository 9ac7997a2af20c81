//! `plane-contact snapshot`.

mod accept;
mod diff;
mod given_files;
mod record;
mod verify;

use base::exit::ExitStatus;
use engine::error::Result;

/// Record, verify, diff, or accept what a scene gives.
#[derive(clap::Subcommand)]
#[command(after_help = "\
Examples:
  plane-contact snapshot record fig1
  plane-contact snapshot verify out/fig1.snapshot.json
  plane-contact snapshot diff old.json new.json
  plane-contact snapshot accept my/snapshot.json")]
pub enum Command {
    Record(record::Args),
    Verify(verify::Args),
    Diff(diff::Args),
    Accept(accept::Args),
}

/// Runs the command; returns the exit status.
pub fn run(command: &Command) -> Result<ExitStatus> {
    match command {
        Command::Record(args) => record::run(args).map(|()| ExitStatus::Done),
        Command::Verify(args) => verify::run(args),
        Command::Diff(args) => diff::run(args),
        Command::Accept(args) => accept::run(args),
    }
}
