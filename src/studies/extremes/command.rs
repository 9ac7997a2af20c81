//! `plane-contact extremes`.

use serde_json::json;

use crate::extremes::digit_tables::report;
use crate::extremes::{GENERATORS, Generator, measure};
use clap::builder::PossibleValuesParser;
use engine::error::Result;

use commands::{TablesArgs, waiting};

/// Find where a method breaks down, every answer compared with exact numbers.
#[derive(clap::Args)]
#[command(after_help = "\
Each generator sweeps one magnitude. A cell is exact, a number of right digits, WRONG (an answer \
without a right digit, or another contact), or refused (and by which error). A method breaks down \
where it is refused or keeps fewer than 3 digits; that point is bisected. It takes 300 times as \
long as solve on fig1.

Examples:
  plane-contact extremes
  plane-contact extremes offset slivers
  plane-contact extremes lengths --json")]
pub struct Args {
    #[arg(value_name = "NAME", value_parser = PossibleValuesParser::new(GENERATORS.iter().map(|g| g.name)),
        help = format!("Generators: {} [default: all]", GENERATORS.each_ref().map(|g| g.name).join(", ")))]
    names: Vec<String>,
    #[command(flatten)]
    tables: TablesArgs,
}

pub fn run(args: &Args) -> Result<()> {
    args.tables.check()?;
    let is_chosen =
        |g: &&Generator| args.names.is_empty() || args.names.iter().any(|n| n == g.name);
    let chosen: Vec<&'static Generator> = GENERATORS.iter().filter(is_chosen).collect();
    let measured = waiting("sweeping", || measure(&chosen));
    args.tables.print_either(None, &json!({ "rows": measured }), || report(&measured))
}
