//! `plane-contact snapshot diff`.

use std::path::{Path, PathBuf};

use crate::snapshot::verified_file::{self as report, VerifiedFile};
use crate::snapshot::{Snapshot, difference};
use base::exit::ExitStatus;
use base::files;
use base::plain::shown;
use engine::error::Result;

use commands::print_either;

/// Compare two snapshots.
#[derive(clap::Args)]
#[command(after_help = "\
A difference is printed as by verify, which runs a scene beside a snapshot. Where each has one run, these are \
compared, under whatever options.

Examples:
  plane-contact snapshot diff old.json new.json
  plane-contact snapshot diff stepped.json tied.json --json")]
pub struct Args {
    /// A snapshot.
    #[arg(value_name = "OLD")]
    old: PathBuf,
    /// Another one.
    #[arg(value_name = "NEW")]
    new: PathBuf,
    /// Print JSON in place of text.
    #[arg(long)]
    json: bool,
}

pub fn run(args: &Args) -> Result<ExitStatus> {
    let verified = difference(&read(&args.old)?, &read(&args.new)?);
    let status = ExitStatus::compared(verified.is_same());
    let file = format!("{} and {}", shown(&args.old), shown(&args.new));
    let checked = [VerifiedFile { file, scene: None, verified: Ok(verified) }];
    print_either(args.json, || report::json(&checked), || report::report(&checked, false))?;
    Ok(status)
}

/// Returns the snapshot in a file; what it says of its scene must be true.
fn read(file: &Path) -> Result<Snapshot> {
    let snapshot = Snapshot::of_file(file, &files::read(file))?;
    snapshot.scene().map_err(|error| error.within(&shown(file)))?;
    Ok(snapshot)
}
