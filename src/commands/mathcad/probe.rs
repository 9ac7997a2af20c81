//! `plane-contact mathcad probe`.

use std::path::PathBuf;

use plane_contact::engine::error::Result;
use plane_contact::report::exports::probe;

use crate::commands::write_or_print;

/// Write a worksheet of questions to Mathcad that no source answers.
#[derive(clap::Args)]
#[command(after_help = "\
Open it in Mathcad, save it, and run it here: the saved results decide the questions.

Examples:
  plane-contact mathcad probe --out probe.xmcd
  plane-contact mathcad run probe.xmcd")]
pub struct Args {
    /// Write to a file in place of standard output.
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
}

pub fn run(args: &Args) -> Result<()> {
    write_or_print(&args.out, &probe::worksheet())
}
