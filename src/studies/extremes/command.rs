//! `plane-contact extremes`.

use std::path::PathBuf;

use crate::extremes::digit_tables as report;
use crate::extremes::{GENERATORS, Generator, SweepTable, measure};
use base::files;
use clap::builder::PossibleValuesParser;
use engine::error::Result;

use commands::{TablesArgs, folder, print, waiting};

/// Find where a method breaks down, every answer compared with exact numbers.
#[derive(clap::Args)]
#[command(after_help = "\
Each generator sweeps one magnitude. A cell is exact, a number of right digits, WRONG (an answer \
without a right digit, or another contact), or refused (and by which error). A method breaks down \
where it is refused or keeps fewer than 3 digits; that point is bisected. It takes 300 times as \
long as solve on fig1.

Examples:
  plane-contact extremes
  plane-contact extremes offset steep-edge
  plane-contact extremes lengths --json --out out/lengths")]
pub struct Args {
    #[arg(value_name = "NAME", value_parser = PossibleValuesParser::new(GENERATORS.iter().map(|g| g.name)),
        help = format!("Generators: {} [default: all]", GENERATORS.each_ref().map(|g| g.name).join(", ")))]
    names: Vec<String>,
    #[command(flatten)]
    tables: TablesArgs,
    /// Folder for extremes.txt, extremes.json and a picture for each generator [default:
    /// out/extremes, with --json none].
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
}

pub fn run(args: &Args) -> Result<()> {
    args.tables.check()?;
    let out = folder(&args.out, "extremes".into());
    let is_written = !args.tables.json || args.out.is_some();
    let is_chosen =
        |g: &&Generator| args.names.is_empty() || args.names.iter().any(|n| n == g.name);
    let chosen: Vec<&'static Generator> = GENERATORS.iter().filter(is_chosen).collect();
    if is_written {
        let pictures = chosen.iter().map(|generator| format!("{}.svg", generator.name));
        let texts = ["extremes.txt", "extremes.json"].map(String::from);
        files::check_folder(&out, &pictures.chain(texts).collect::<Vec<_>>())?;
    }
    let measured = waiting("sweeping", || measure(&chosen));
    let json = report::json(&measured);
    if !is_written {
        return print(&json);
    }
    let report = report::report(&measured);
    let picture = |of: &SweepTable| (format!("{}.svg", of.generator.name), report::picture(of));
    let mut written = vec![("extremes.txt".into(), report.text(usize::MAX))];
    written.extend(measured.iter().map(picture));
    written.push(("extremes.json".into(), json.clone()));
    files::write_all(&out, &written)?;
    if args.tables.json { print(&json) } else { args.tables.print(report) }
}
