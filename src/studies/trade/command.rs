//! `plane-contact trade`.

use std::path::PathBuf;

use crate::trade::trial_tables as report;
use crate::trade::{self, AXES, Axis};
use base::exit::ExitStatus;
use base::files;
use base::plain::shown;
use clap::builder::PossibleValuesParser;
use engine::Request;
use engine::error::Result;
use output::json;
use problem::scene::Scene;

use commands::{ReadingArg, TablesArgs, folder, folder_name, print, progress};

/// The runs of each trial by default.
const RUNS: u16 = 3;

/// Measure speed against accuracy: precisions, solvers and the paper's own parameters.
#[derive(clap::Args)]
#[command(after_help = "\
Times are medians of several runs in one process, in turn (A B C A B C ...), each of which factors \
anew; a trial that took 0.05 s is not repeated. Settings of contact are varied in f64 by \
sparse-cholesky, meshes under unilateral. Writes trade.json and trade.svg to --out.

Examples:
  plane-contact trade
  plane-contact trade fig1 --only arithmetic,solver
  plane-contact trade strand --only c_tll --runs 1 --json")]
#[command(mut_arg("json", |json| json.help("Print trade.json in place of the tables; files are written only to a folder that --out names")))]
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
    /// Folder for the files [default: out/trade-<scene>, and every option that is given].
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
}

pub fn run(args: &Args) -> Result<ExitStatus> {
    args.tables.check()?;
    let scene = Scene::open(&args.scene)?;
    scene.check_friction()?;
    let request = Request::new(&scene).reading(args.reading.reading);
    let runs = (args.runs != RUNS).then(|| format!("runs-{}", args.runs));
    let asked: Vec<String> = args.only.iter().cloned().chain(runs).collect();
    let start = format!("trade-{}", scene.name);
    let out = folder(&args.out, folder_name(start, &request, &asked));
    let is_written = !args.tables.json || args.out.is_some();
    if is_written {
        files::check_folder(&out, &["trade.svg", "trade.json"])?;
    }
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
    let json = json::line(Some(&scene), &measured);
    if is_written {
        let picture = report::picture(&measured);
        let picture = picture.iter().map(|picture| ("trade.svg", picture));
        let written = picture.chain([("trade.json", &json)]).collect::<Vec<_>>();
        files::write_all(&out, &written)?;
    }
    if args.tables.json {
        print(&json)?;
    } else {
        let report = report::report(&measured).line(format!("Written to {}", shown(&out)));
        args.tables.print(report)?;
    }
    Ok(measured.exit_status())
}
