//! `plane-contact solve`.

use std::path::PathBuf;

use crate::trade::{check_accuracy, solve_to};
use base::error::InputError;
use base::exit::ExitStatus;
use base::files;
use base::plain::shown;
use engine::error::Result;
use engine::estimates::perturbed;
use engine::linear::Solver;
use engine::plan::Plan;
use engine::{self, Assessment, Request, Solution, Step};
use output::folder::FolderOptions;
use output::model::Report;
use output::{self, ResultFile, tables};
use paper::edited::Edited;
use paper::listings::Which;
use problem::modelling::Variant;
use problem::scene::Scene;

use commands::{
    RunArgs, SceneArgs, TablesArgs, command_line, folder, folder_name, print, print_report,
    print_stderr, progress, read_listing, report_error, waiting,
};

/// Run the iterations and write pictures and data.
#[derive(clap::Args)]
#[command(after_help = format!("\
Prints what is in contact, bodies, contact nodes, error estimates, the distance from the reference \
solution, and the iterations. Beyond 20,000 triangles only fields.vtu has their values. Writes to --out:
{}.

Examples:
  plane-contact solve
  plane-contact solve strand --variant tied --out out/tied
  plane-contact solve fig1 --variant printed --reading R3=nested --json
  plane-contact solve my/block.json --csv out/tables
  plane-contact solve strand --reference
  plane-contact solve fig1 --scalar exact --inputs decimal
  plane-contact solve strand --accuracy 1e-3
  plane-contact solve fig1 --variant tied --c-cnt my-c_cnt.txt
  plane-contact solve strand --variant unilateral --check-rounding
  plane-contact solve my/scene.json --reading R6=stress,R8=m", output::folder::help()))]
#[command(mut_arg("json", |json| json.help("Print result.json in place of the tables; files are written only to a folder that --out names")))]
pub struct Args {
    /// Path of a scene, or the name of an embedded one: strand, fig1, two-blocks.
    #[arg(value_name = "SCENE", default_value = "strand")]
    scene: PathBuf,
    #[command(flatten)]
    run: RunArgs,
    #[command(flatten)]
    changes: SceneArgs,
    /// Execute this edited listing in place of c_cnt (notation: plane-contact guide notation).
    #[arg(long, value_name = "FILE")]
    c_cnt: Option<PathBuf>,
    /// Execute this edited listing in place of Km; under tied and stepped it builds the matrix
    /// without contact.
    #[arg(long, value_name = "FILE")]
    km: Option<PathBuf>,
    /// Take the cheapest precision whose rounding changes displacements by at most this part of the
    /// largest: from f64 on, as f32 is slower.
    #[arg(long, value_name = "A",
        conflicts_with_all = ["scalar", "solver", "inputs", "c_cnt", "km"])]
    accuracy: Option<f64>,
    /// Repeat the run three times with coordinates, loads and moduli changed at random in the last digit, and
    /// print what that changes; under the paper's variants this is done unless estimates are left out.
    #[arg(long)]
    check_rounding: bool,
    /// Folder for pictures and data [default: out/<scene>-<variant>, and every option that differs
    /// from the scene's own].
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Leave out the pictures; fields.vtu and result.json are written.
    #[arg(long)]
    no_pictures: bool,
    /// Leave out the estimates of the errors of rounding, of the mesh and of the load's steps.
    #[arg(long)]
    no_error_estimate: bool,
    /// Leave out what is computed beside the run: the error estimates, the reference solution, and
    /// the equilibrium.
    #[arg(long)]
    no_assessment: bool,
    /// Have the values of all nodes and triangles in result.json, however many there are.
    #[arg(long)]
    fields: bool,
    #[command(flatten)]
    tables: TablesArgs,
}

/// Solves a scene and writes its files; returns the exit status.
pub fn run(args: &Args) -> Result<ExitStatus> {
    args.tables.check()?;
    let request = waiting("reading", || request(args))?;
    let out = folder(&args.out, own_folder(args, &request));
    let wanted = FolderOptions { pictures: !args.no_pictures, fields: args.fields };
    let is_written = !args.tables.json || args.out.is_some();
    if is_written {
        files::check_folder(&out, &output::folder::names(wanted))?;
    }
    // The plan's count of the factors takes a fifth of the time of a large run.
    let (plan, solved) = rayon::join(|| Plan::new(&request), || solve(args, &request));
    let ((solution, accuracy), plan) = (solved?, plan?);
    let assessment = waiting("assessing", || assess(args, &solution));
    let result = waiting("writing", || match is_written {
        true => {
            let command = command_line();
            output::folder::write(&out, &solution, &assessment, Some(&plan), wanted, &command)
        }
        false => Ok(ResultFile::new(&solution, &assessment, Some(&plan), args.fields).to_json()),
    })?;
    if args.tables.json {
        print_stderr(&accuracy.text(usize::MAX));
        print(&result)?;
        return Ok(status(&solution));
    }
    let report = tables::solution(&solution, &assessment)
        .then(tables::error_estimates(&solution, &assessment))
        .then(tables::distance(&solution, &assessment))
        .then(accuracy)
        .then(beside_the_print(&solution))
        .then(tables::steps(&solution, &assessment, args.changes.all_iterations()))
        .line(output::plan::line(&plan))
        .line(format!("Written to {}", shown(&out)));
    print_report(report.clone())?;
    if args.tables.is_whole() {
        let fields = tables::fields(&solution, &assessment);
        args.tables.write(&report.then(fields))?;
    }
    Ok(status(&solution))
}

/// Returns what is asked for.
///
/// # Errors
/// The scene or an option is at fault, or the run does not fit in memory.
fn request(args: &Args) -> Result<Request> {
    let scene = args.changes.change(Scene::open(&args.scene)?)?;
    let request = edited(args, args.run.request(&scene)?)?;
    engine::check(&request)?;
    args.accuracy.map_or(Ok(()), check_accuracy)?;
    Ok(request)
}

/// Returns the folder where no other is asked for.
fn own_folder(args: &Args, request: &Request) -> String {
    let mut asked = args.changes.names();
    asked.extend(args.accuracy.iter().map(|a| format!("accuracy-{a:e}")));
    asked.extend(request.edited.iter().map(|edited| format!("edited-{}", edited.which)));
    folder_name(format!("{}-{}", request.scene.name, request.variant), request, &asked)
}

/// Assesses a solution as far as that is asked for.
fn assess<'a>(args: &Args, solution: &'a Solution) -> Assessment<'a> {
    let assessment = if args.no_assessment {
        Assessment::none(solution)
    } else if args.no_error_estimate {
        Assessment::without_estimates(solution)
    } else {
        Assessment::new(solution)
    };
    match assessment.rounding {
        None if args.check_rounding => Assessment { rounding: perturbed(solution), ..assessment },
        Some(_) | None => assessment,
    }
}

/// Asks for the edited listings of `--c-cnt` and `--km`.
fn edited(args: &Args, mut request: Request) -> Result<Request> {
    for (which, file) in [(Which::CCnt, &args.c_cnt), (Which::Km, &args.km)] {
        let Some(file) = file else { continue };
        let place = shown(file);
        let edited = Edited::new(&place, &read_listing(file)?)?;
        if edited.which != which {
            let what = format!("it is the listing {}, not {which}", edited.which);
            return Err(InputError::new(place, what, "give it to the other option").into());
        }
        request.edited.push(edited);
    }
    if request.is_edited(Which::Km) {
        // Its matrix need not be symmetric.
        request.arithmetic.solver.get_or_insert(Solver::SparseLu);
    }
    Ok(request)
}

/// Compares a run of edited listings with that of the printed ones; nothing where none is edited.
fn beside_the_print(solution: &Solution) -> Report {
    if solution.request.edited.is_empty() {
        return Report::default();
    }
    let mut request = solution.request.clone();
    request.edited.clear();
    match engine::solve(&request, &mut |_| ()) {
        Ok(printed) => output::edited::report(&printed, solution),
        Err(why) => Report::default().line(format!("The edited listings run; as printed: {why}")),
    }
}

/// Returns the exit status, and says why it is not the equilibrium of the scene; the result says so too.
fn status(solution: &Solution) -> ExitStatus {
    if let Some(doubt) = solution.doubt() {
        report_error(&doubt.into());
    }
    solution.exit_status()
}

/// Returns the solution, and under `--accuracy` how its precision was found.
fn solve(args: &Args, request: &Request) -> Result<(Solution, Report)> {
    if let Some(asked) = args.accuracy {
        let reached = solve_to(request, asked)?;
        let words = crate::trade::trial_tables::reached(&reached, asked);
        return Ok((reached.solution, words));
    }
    let progress = match request.variant {
        // How many there will be is not known.
        Variant::Unilateral => progress("solving", 0, "iteration {pos} {elapsed}"),
        Variant::Printed | Variant::Tied | Variant::Stepped => {
            progress("solving", request.iterations, "iteration {pos} of {len} {wide_bar} {eta}")
        }
    };
    let solution = engine::solve(request, &mut |_: &Step| progress.inc(1))?;
    progress.finish();
    Ok((solution, Report::default()))
}
