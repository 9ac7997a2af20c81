//! `plane-contact snapshot accept`.

use std::path::PathBuf;

use plane_contact::engine::error::Result;
use plane_contact::files;
use plane_contact::report::snapshot as report;
use plane_contact::studies::snapshot::{Chosen, accept};

use super::verify::verify_one;
use crate::commands::print_report;

/// Take new values into a snapshot, with a reason.
#[derive(clap::Args)]
#[command(after_help = "\
Runs the snapshot again, takes what differs, and adds to the log in the snapshot: what, from, to, by
how much in units of its bound, the reason, the version of the program; a short summary is
printed. Nothing is taken where a run fails that did not, unless --failing says that it should.

Examples:
  plane-contact snapshot accept out/fig1.snapshot.json --reason \"the load was doubled\"
  plane-contact snapshot accept my/snapshot.json --dry-run --reason \"not yet\"
  plane-contact snapshot accept my/snapshot.json --entry stepped/u --reason \"a finer solver\"
  plane-contact snapshot accept my/snapshot.json --scene my/scene.json --reason \"a stiffer block\"")]
pub struct Args {
    /// A snapshot.
    #[arg(value_name = "FILE")]
    file: PathBuf,
    /// The run, or the run and the entry, that is taken: stepped, stepped/u [default: all].
    #[arg(long, value_name = "E")]
    entry: Option<String>,
    /// Why the new values are right.
    #[arg(long, value_name = "TEXT")]
    reason: String,
    /// Take a run that fails where it did not, or fails otherwise.
    #[arg(long)]
    failing: bool,
    /// Print what would be taken, and leave the file as it is.
    #[arg(long)]
    dry_run: bool,
    /// Run this scene in place of the one in the snapshot, and take it too.
    #[arg(long, value_name = "SCENE")]
    scene: Option<String>,
}

pub fn run(args: &Args) -> Result<()> {
    // What cannot be read is named below.
    let was = files::read(&args.file).unwrap_or_default();
    let (mut snapshot, verified) = verify_one(&args.file, args.scene.as_deref())?;
    let (entry, reason, failing) = (args.entry.as_deref(), &args.reason[..], args.failing);
    let accepted = accept(&mut snapshot, &verified, Chosen { entry, reason, failing })?;
    if !args.dry_run {
        files::rewrite(&args.file, &was, &report::file(&snapshot))?;
    }
    print_report(report::accepted(&accepted))
}
