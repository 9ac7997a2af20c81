//! `plane-contact solve`.

use std::path::PathBuf;
use std::time::Duration;

use indicatif::{ProgressBar, ProgressStyle};
use plane_contact::contact::{self, Outcome, Variant};
use plane_contact::error::Error;
use plane_contact::mirror::Reading;
use plane_contact::report::{folder, tables, trade as accuracy};
use plane_contact::scene::Scene;
use plane_contact::solve::{Arithmetic, Inputs, ScalarName, Solver};
use plane_contact::trade::solve_to;

use super::{ModelArgs, ReadingArg, print};

/// Run the iterations and write pictures and data.
#[derive(clap::Args)]
#[command(after_help = "\
Prints a table of the iterations, one of the bodies, one of the contact nodes, and how far this is from the converged answer. Writes to --out:
mesh.svg (the paper's fig. 4), von_mises_stress.svg and von_mises_strain.svg (fig. 5), pressure.svg, fields.vtu (ParaView), result.json.

Examples:
  plane-contact solve
  plane-contact solve strand --variant tied --out out/tied
  plane-contact solve fig1 --variant printed --reading R3=nested --json
  plane-contact solve strand --variant unilateral --coupling mortar --friction 0
  plane-contact solve fig1 --scalar exact --inputs decimal
  plane-contact solve strand --variant tied --scalar f64x2 --solver refined --tol 1e-28
  plane-contact solve strand --accuracy 1e-3
  plane-contact solve my/scene.json --reading R6=stress,R8=m")]
pub struct Args {
    /// Path of a scene, or the name of an embedded one: strand, fig1, two-blocks.
    #[arg(value_name = "SCENE", default_value = "strand")]
    scene: String,
    /// printed: Km as printed; tied: eq. (1) on total displacements; stepped: eq. (1) on increments; unilateral: gaps closed along the
    /// normal, the converged answer [default: the scene's].
    #[arg(long)]
    variant: Option<Variant>,
    #[command(flatten)]
    model: ModelArgs,
    #[command(flatten)]
    arithmetic: ArithmeticArgs,
    /// Take the cheapest arithmetic whose rounding moves displacements by at most this part of the largest, and say what was done; the
    /// mesh's own error is told beside it.
    #[arg(long, value_name = "A", conflicts_with_all = ["scalar", "solver", "tol", "inputs"])]
    accuracy: Option<f64>,
    #[command(flatten)]
    reading: ReadingArg,
    /// Folder for pictures and data [default: out/<scene>-<variant>].
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Print result.json in place of the tables.
    #[arg(long)]
    json: bool,
}

/// In which numbers a run computes, and how it solves.
#[derive(clap::Args)]
struct ArithmeticArgs {
    /// f64, f32, f64x2 (31 digits), f64-bounded (f64 with a bound on the error of the displacements), exact (rational numbers, for some
    /// hundred equations).
    #[arg(long, value_name = "NAME", default_value = "f64")]
    scalar: ScalarName,
    /// dense-lu, dense-cholesky, sparse-cholesky, cg (conjugate gradients to --tol), refined (factors in the scalar below, refined to --tol)
    /// [default: dense-lu; sparse-cholesky in f64x2, exact and under unilateral].
    #[arg(long, value_name = "NAME")]
    solver: Option<Solver>,
    /// Largest relative residual |A x - b| / (|A| |x| + |b|) at which cg and refined stop [default: 16 eps of the scalar].
    #[arg(long, value_name = "T")]
    tol: Option<f64>,
    /// What the numbers of the scene stand for: binary, the exact value of their f64; decimal, the shortest decimal that reads back to it.
    #[arg(long, value_name = "NAME", default_value = "binary")]
    inputs: Inputs,
}

impl ArithmeticArgs {
    fn arithmetic(&self) -> Arithmetic {
        let ArithmeticArgs { scalar, solver, tol, inputs } = *self;
        Arithmetic { scalar, solver, tol, inputs }
    }
}

pub fn run(args: &Args) -> Result<(), Error> {
    let mut scene = Scene::open(&args.scene)?;
    args.model.apply(&mut scene.contact);
    let variant = args.variant.unwrap_or(scene.variant);
    let progress = progress(scene.iterations);
    let (reading, arithmetic) = (&args.reading.reading.0, args.arithmetic.arithmetic());
    let (outcome, accuracy) = match args.accuracy {
        None => {
            let watch = |_: &contact::Iteration| progress.inc(1);
            (contact::run_in(&scene, variant, reading, arithmetic, watch)?, String::new())
        }
        Some(asked) => {
            let reached = solve_to(&scene, variant, reading, asked)?;
            let words = accuracy::reached(&reached, asked);
            (reached.outcome, words)
        }
    };
    progress.finish_and_clear();
    let default = || PathBuf::from("out").join(format!("{}-{variant}", scene.name));
    let out = args.out.clone().unwrap_or_else(default);
    let converged = converged(&scene, &args.reading.reading.0);
    let found = converged.as_ref().and_then(|converged| converged.as_ref().ok());
    let result = folder::write(&out, &scene, &outcome, found)?;
    if args.json {
        eprint!("{accuracy}");
        return print(&result);
    }
    let tables = tables::solution(&scene, &outcome) + &distance(&scene, &outcome, &converged);
    print(&format!("{tables}{accuracy}\nWritten to {}\n", out.display()))
}

/// The converged answer, or why there is none; nothing without contact.
fn converged(scene: &Scene, reading: &Reading) -> Option<Result<Outcome, Error>> {
    scene.target().map(|_| contact::reference(scene, reading))
}

fn distance(
    scene: &Scene,
    outcome: &Outcome,
    converged: &Option<Result<Outcome, Error>>,
) -> String {
    match converged {
        None => String::new(),
        Some(Ok(converged)) => tables::distance(scene, outcome, converged),
        Some(Err(why)) => format!("\nNo converged answer to measure this against: {why}\n"),
    }
}

/// A bar on standard error; it shows only in a terminal.
fn progress(iterations: usize) -> ProgressBar {
    let style = ProgressStyle::with_template("iteration {pos} of {len} {wide_bar} {eta}");
    let bar = ProgressBar::new(iterations as u64).with_style(style.expect("the template is sound"));
    bar.enable_steady_tick(Duration::from_millis(500));
    bar
}
