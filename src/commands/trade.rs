//! `plane-contact trade`.

use std::path::PathBuf;
use std::process::Command;

use plane_contact::child;
use plane_contact::engine::error::Result;
use plane_contact::engine::{Request, solve};
use plane_contact::error::InputError;
use plane_contact::files;
use plane_contact::plain::shown;
use plane_contact::problem::scene::Scene;
use plane_contact::report::trade as report;
use plane_contact::studies::trade::{self, Options, Trial, Varied, peak};

use super::{ReadingArg, TablesArgs, folder, folder_name, print, progress};

/// The runs of each trial by default.
const RUNS: u16 = 3;

/// Measure speed against accuracy: precisions, solvers and the paper's own parameters.
#[derive(clap::Args)]
#[command(after_help = "\
Times are medians of several runs in one process, in turn (A B C A B C ...), each of which factors
anew; what has taken 0.05 s is not run again. Peak memory is that of a process of its own, program
included. Settings of contact are varied in f64 by sparse-cholesky, meshes under unilateral.
Geometry is what the paper leaves open of its example: clearance, radius, mesh, shape of the
stamp's top, unit of c_tll, each with the claims' verdicts; its runs are not timed. Writes
trade.json, trade.csv, trade.svg and, of geometry, a picture a parameter to --out. The whole takes 50
to 150 times as long as solve.

Examples:
  plane-contact trade
  plane-contact trade fig1 --only arithmetic,solver
  plane-contact trade strand --only c_tll --runs 1 --json
  plane-contact trade strand --only geometry")]
pub struct Args {
    /// Path of a scene, or the name of an embedded one: strand, fig1, two-blocks.
    #[arg(value_name = "SCENE", default_value = "strand")]
    scene: PathBuf,
    /// Runs of each trial.
    #[arg(long, value_name = "N", default_value_t = RUNS)]
    #[arg(value_parser = clap::value_parser!(u16).range(1..=1000))]
    runs: u16,
    #[arg(long, value_name = "LIST", value_delimiter = ',', help = format!("What to vary: {} [default: all]", Varied::help()))]
    only: Vec<Varied>,
    #[command(flatten)]
    reading: ReadingArg,
    /// Print trade.json in place of the tables; files are written only to a folder that --out names.
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    tables: TablesArgs,
    /// Folder for the files [default: out/trade-<scene>, and every option that is given].
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Run this trial alone and print the peak memory of the process, bytes.
    #[arg(long, value_name = "TRIAL", hide = true)]
    peak_of: Option<String>,
}

pub fn run(args: &Args) -> Result<()> {
    args.tables.check()?;
    let scene = Scene::open(&args.scene)?;
    let request = Request::new(&scene).reading(args.reading.reading);
    if let Some(name) = &args.peak_of {
        return peak_of(&request, name);
    }
    let only = if args.only.is_empty() { Varied::ALL.to_vec() } else { args.only.clone() };
    let options = Options { runs: usize::from(args.runs), only };
    let runs = (args.runs != RUNS).then(|| format!("runs-{}", args.runs));
    let asked: Vec<String> = args.only.iter().map(Varied::to_string).chain(runs).collect();
    let start = format!("trade-{}", scene.name);
    let out = folder(&args.out, folder_name(start, &request, &asked));
    let is_written = !args.json || args.out.is_some();
    if is_written {
        files::check_folder(&out, &["trade.csv", "trade.json"])?;
    }
    let bar = progress(trade::steps(&request, &options)?, "{pos} of {len} {wide_bar} {eta} {msg}");
    let watch = |trial: &str| {
        bar.set_message(trial.to_string());
        bar.inc(1);
    };
    let measured = trade::measure(&request, &options, in_a_process, watch)?;
    bar.finish_and_clear();
    if !is_written {
        return print(&report::json(&scene, &measured));
    }
    let json = report::write(&out, &scene, &measured)?;
    if args.json {
        return print(&json);
    }
    let report = report::report(&measured).line(format!("Written to {}", shown(&out)));
    args.tables.print(report)
}

/// The bytes that a process which measures its memory may print.
const PRINTED: u64 = 1 << 16;

/// The peak memory of a process that runs nothing but `trial`: this command again, with one more
/// option.
fn in_a_process(trial: &Trial) -> Option<u64> {
    let mut command = Command::new(std::env::current_exe().ok()?);
    command.args(std::env::args_os().skip(1)).arg(format!("--peak-of={}", trial.name()));
    let (_, printed) = child::start(command).and_then(|running| running.end(PRINTED)).ok()?;
    std::str::from_utf8(&printed).ok()?.trim().parse().ok()
}

fn peak_of(request: &Request, name: &str) -> Result<()> {
    let trial = trade::find(request, name).ok_or_else(|| {
        InputError::new("--peak-of", format!("there is no trial {name:?}"), "leave it out")
    })?;
    solve(&trial.request(request)?, &mut |_| ())?;
    let bytes = peak::of_this_process();
    print(&bytes.map_or(String::new(), |bytes| format!("{bytes}\n")))
}
