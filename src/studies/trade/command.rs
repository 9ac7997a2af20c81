//! `plane-contact trade`.

use std::path::PathBuf;

use crate::trade::trial_tables::report;
use crate::trade::{self, AXES, Axis};
use clap::builder::PossibleValuesParser;
use engine::Request;
use engine::error::Result;
use problem::scene::Scene;

use commands::{ReadingArg, TablesArgs, progress};

/// The runs of each trial by default.
const RUNS: u16 = 3;

/// Measure speed against accuracy: precisions, solvers and the paper's own parameters.
#[derive(clap::Args)]
#[command(after_help = "\
Times are medians of several runs in one process, in turn (A B C A B C ...), each of which factors \
anew; a trial that took 0.05 s is not repeated. Settings of contact are varied in f64 by \
sparse-cholesky, meshes under unilateral.

Examples:
  plane-contact trade
  plane-contact trade fig1 --only arithmetic,solver
  plane-contact trade strand --only c_tll --runs 1 --json")]
pub struct Args {
    /// Path of a scene, or the name of an embedded one: strand, fig1, two-blocks.
    #[arg(value_name = "SCENE", default_value = "strand")]
    scene: PathBuf,
    /// Runs of each trial.
    #[arg(long, value_name = "N", default_value_t = RUNS)]
    #[arg(value_parser = clap::value_parser!(u16).range(1..=1000))]
    runs: u16,
    #[arg(long, value_name = "LIST", value_delimiter = ',', value_parser = PossibleValuesParser::new(AXES.iter().map(|axis| axis.name)), help = format!("What to vary: {} [default: all]", Axis::help()))]
    only: Vec<String>,
    #[command(flatten)]
    reading: ReadingArg,
    #[command(flatten)]
    tables: TablesArgs,
}

pub fn run(args: &Args) -> Result<()> {
    args.tables.check()?;
    let scene = Scene::open(&args.scene)?;
    scene.check_friction()?;
    let request = Request::new(&scene).reading(args.reading.reading);
    let plan = trade::plan(&request, &args.only)?;
    let trials: usize = plan.iter().map(|(_, trials)| trials.len()).sum();
    let runs = usize::from(args.runs);
    let bar = progress("measuring", trials * runs, "{pos} of {len} {wide_bar} {eta} {msg}");
    let watch = |trial: &str| {
        bar.set_message(trial.to_string());
        bar.inc(1);
    };
    let measured = trade::measure(&request, plan, runs, watch);
    bar.finish();
    args.tables.print_either(Some(&scene), &measured, || report(&measured))
}
