//! `plane-contact report`.

use std::fs::File;
use std::path::{Path, PathBuf};

use crate::audit::prices::{self, Price};
use crate::audit::{Audit, Case, audit, steps};
use crate::calculix::{self, Pair};
use crate::compare;
use crate::report::Contents;
use crate::report::page;
use base::error::InputError;
use base::files::{self, HTML};
use base::plain::{shell_word, shown};
use engine::error::Result;
use engine::estimates::Certainty;
use engine::{Assessment, Solution};
use paper::mirror::Reading;
use problem::modelling::Variant;
use problem::scene::{Scene, sha256_of};

use commands::{folder, progress, report_written, waiting};

/// The most nodes of a mesh on which the print is repaired one finding at a time unasked: it takes some
/// hundred runs, half a second on fig1 and minutes on strand, with 1,111 nodes.
const MOST_NODES: usize = 500;

/// Write an audit report, ready to be handed in.
#[derive(clap::Args)]
#[command(after_help = "\
The first screen, and page 1 in print: a verdict, the runs beside the equilibrium, pressure \
and von Mises stress, the claims by how far they reach, the faults by what they cost. Below, parts \
unfold: what the verdict leaves out, each claim and finding in full, readings and variants, figures, \
differences from CalculiX, a glossary, and the command that makes it again, versions and hashes. \
The page is one file that opens offline, with tables that copy as CSV; it prints on A4. It takes a \
minute on strand, more with --repairs.

Examples:
  plane-contact report
  plane-contact report fig1 --out fig1.html
  plane-contact report --ccx                               CalculiX beside it")]
pub struct Args {
    /// Path of a scene, or the name of an embedded one.
    #[arg(value_name = "SCENE", default_value = "strand")]
    scene: PathBuf,
    /// Repair the print one finding at a time on a mesh of more than 500 nodes too, in minutes on strand.
    #[arg(long)]
    repairs: bool,
    /// Run CalculiX too, by its own contact, beside unilateral.
    #[arg(long, value_name = "PROGRAM", num_args = 0..=1, default_missing_value = "ccx")]
    ccx: Option<String>,
    /// The file [default: out/report.html].
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
}

pub fn run(args: &Args) -> Result<()> {
    let out = folder(&args.out, "report.html".into());
    files::check_file(&out, HTML)?;
    args.ccx.as_deref().map_or(Ok(()), calculix::check)?;
    let scene = Scene::open(&args.scene)?;
    scene.check_friction()?;
    let case = Case::within_memory(&scene, Reading::default())?;
    let bar = progress("auditing", steps(), "auditing {pos} of {len} {wide_bar} {eta}").logged();
    let found = audit(&case, &Vec::new(), true, &|| bar.inc(1));
    bar.finish();
    waiting("writing", || write(args, &case, &found, &out))?;
    report_written(&out);
    Ok(())
}

/// Computes a report and writes it to a file.
fn write(args: &Args, case: &Case, found: &Audit, out: &Path) -> Result<()> {
    let calculix = args.ccx.as_deref().map(|program| calculix(program, case)).transpose()?;
    let runs = runs(case);
    let contents = Contents {
        command: command(args),
        asked: asked(&case.scene),
        audit: found,
        repairs: repairs(args, case, found),
        assessment: runs.last().map(|last| assessed(case, found, last)),
        runs,
        calculix,
    };
    Ok(files::write(out, &page::html(&contents))?)
}

/// Returns the print repaired one finding at a time; nothing where that takes long and was not asked for, or
/// there is no solution to compare with.
fn repairs(args: &Args, case: &Case, audit: &Audit) -> Vec<Price> {
    let Ok(alone) = &audit.prices else { return Vec::new() };
    if case.model().nodes.len() > MOST_NODES && !args.repairs {
        return Vec::new();
    }
    prices::repairs(case, alone, &|| ()).unwrap_or_default()
}

/// Returns the runs that are shown: those of the variants that do not fail, then the reference solution and
/// the equilibrium.
fn runs(case: &Case) -> Vec<&Solution> {
    let ran = Variant::ALL.iter().filter_map(|v| case.run(*v).ok());
    ran.chain(case.reference()).chain(case.equilibrium()).collect()
}

/// Assesses a run, with what the audit measured rounding to do to the reference solution and the equilibrium.
fn assessed<'a>(case: &'a Case, audit: &Audit, solution: &'a Solution) -> Assessment<'a> {
    let others = [case.reference(), case.equilibrium()];
    let measured = [&audit.reference, &audit.equilibrium];
    let rounding = others.iter().zip(measured).find_map(|(other, measured)| {
        let same = solution.request.is_same_equilibrium(&(*other)?.request);
        measured.as_ref().filter(|_| same)?.rounding.clone()
    });
    let assessment = Assessment::against(solution, others);
    Assessment { rounding: rounding.or(assessment.rounding), ..assessment }
}

/// Returns the command that makes the report again, but for the place of its file.
fn command(args: &Args) -> String {
    let mut command = format!("plane-contact report {}", shell_word(&shown(&args.scene)));
    if args.repairs {
        command += " --repairs";
    }
    if let Some(program) = &args.ccx {
        command += &format!(" --ccx {}", shell_word(program));
    }
    command
}

/// Says what was asked, without the place of any file.
fn asked(scene: &Scene) -> Vec<(&'static str, String)> {
    let model = &scene.model;
    let size = format!("{} nodes, {} triangles", model.nodes.len(), model.triangles.len());
    let program = std::env::current_exe().and_then(File::open).and_then(sha256_of);
    vec![
        ("program", format!("plane-contact {}", env!("CARGO_PKG_VERSION"))),
        ("program, SHA-256", program.unwrap_or_else(|why| why.to_string())),
        ("scene", format!("{} ({})", scene.name, scene.title)),
        ("mesh", size),
        ("plane problem", model.plane.to_string()),
        ("variants", "all".into()),
        ("readings", "the default of each".into()),
        ("iterations of the paper's variants", scene.iterations.to_string()),
        ("contact", format!("{}, friction {}", scene.contact.coupling, scene.contact.friction)),
        ("c_tll", model.contact.tolerance.to_string()),
    ]
}

/// Runs CalculiX's own contact beside `unilateral`.
fn calculix<'a>(program: &str, case: &'a Case) -> Result<compare::Compared<'a>> {
    let solution: &Solution = case.run(Variant::Unilateral).map_err(|why| {
        let what = format!("unilateral, which stands beside CalculiX, does not run: {why}");
        InputError::new("--ccx", what, "leave --ccx out")
    })?;
    let pair = Pair::new(&solution.model, None, solution.request.contact.friction);
    let parts = [pair.into()];
    let ran = calculix::run(program, &case.scene.title, &solution.model, &parts)?;
    let certainty = Certainty::Unchecked;
    Ok(compare::Compared::with_calculix(solution, certainty, &parts, ran, None)?)
}
