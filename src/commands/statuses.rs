//! `plane-contact statuses`.

use std::path::PathBuf;

use plane_contact::engine::error::Result;
use plane_contact::files;
use plane_contact::report::statuses as report;
use plane_contact::studies::audit::statuses::measure;

use super::{TablesArgs, print, waiting};

/// Compare the rules that decide who is in contact, on random scenes whose statuses are known.
#[derive(clap::Args)]
#[command(after_help = "\
For a node that jumped deeper into the target than c_tol the paper names two remedies and takes
the cheaper: signs, as the listing prints it, and intersection. projection is the exact answer.
Wrong statuses are counted by depth of the jump, operations by size. It takes 150 times as long as
solve on fig1.

Examples:
  plane-contact statuses
  plane-contact statuses --scenes 1000 --seed 7 --json
  plane-contact statuses --picture out/statuses.svg")]
pub struct Args {
    /// Scenes for each row of the tables.
    #[arg(long, value_name = "N", default_value_t = 200)]
    #[arg(value_parser = clap::value_parser!(u32).range(1..=100_000))]
    scenes: u32,
    /// Seed of the random scenes.
    #[arg(long, value_name = "S", default_value_t = 1)]
    seed: u64,
    /// Print JSON.
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    tables: TablesArgs,
    /// Write a picture: share of wrong statuses by depth.
    #[arg(long, value_name = "SVG")]
    picture: Option<PathBuf>,
}

pub fn run(args: &Args) -> Result<()> {
    let measured = waiting("measuring", || measure(args.scenes as usize, args.seed));
    if let Some(path) = &args.picture {
        files::write(path, &report::picture(&measured))?;
    }
    if args.json {
        return print(&report::json(&measured));
    }
    args.tables.print("statuses", &report::text(&measured))
}
