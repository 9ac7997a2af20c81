//! `plane-contact mathcad`.

use std::path::{Path, PathBuf};

use plane_contact::answer::error::Result;
use plane_contact::error::InputError;
use plane_contact::files;
use plane_contact::paper::exports::probe;
use plane_contact::paper::mathcad::{Limits, worksheet, xmcd::document};
use plane_contact::report::worksheet as report;

use super::{print_either, waiting};

/// Execute a worksheet of Mathcad 13 to 15 beside the results that it saved.
#[derive(clap::Args)]
#[command(after_help = "\
Regions are executed in the worksheet's order and settings, and each result is compared with the one
that Mathcad saved: same to the last bit, to so many digits, or differing. Units, symbolics, plots,
solve blocks, derivatives, integrals and random numbers are named as beyond us. Where the worksheet
shows a name's value and ours is not the same to the last bit, or beyond us, the saved value goes on
as input, so that each result is judged for itself; results that rest on it say so.

Examples:
  plane-contact mathcad worksheet.xmcd
  plane-contact mathcad worksheet.xmcd --json")]
pub struct Args {
    /// The worksheet.
    #[arg(value_name = "FILE.xmcd")]
    file: PathBuf,
    /// Print JSON.
    #[arg(long)]
    json: bool,
}

pub fn run(args: &Args) -> Result<()> {
    let sheet = open(&args.file)?;
    let checked = waiting("executing", || worksheet::execute(&sheet, &limits()));
    let decided = probe::decided(&sheet, &checked);
    let json = || report::json(&args.file.display().to_string(), &checked, &decided);
    print_either(args.json, json, || report::text(&checked, &decided))
}

/// Reads a worksheet's file.
pub fn open(file: &Path) -> Result<document::Worksheet, InputError> {
    let place = file.display().to_string();
    let text = files::read_text(file).map_err(|why| {
        let what = format!("the file cannot be read: {why}");
        InputError::new(&place, what, "give an .xmcd file, which is text in UTF-8")
    })?;
    document::read(&text, &place)
}

/// The limits of a region: arrays that are spelled out make long lines; a worksheet has many regions,
/// so that each has but seconds.
pub fn limits() -> Limits {
    Limits { lines: 10_000, characters: 1 << 20, entries: 1 << 22, ..Limits::default() }
}
