//! `plane-contact solve`.

use std::path::PathBuf;
use std::time::Duration;

use indicatif::{ProgressBar, ProgressStyle};
use plane_contact::contact::{self, Variant};
use plane_contact::error::Error;
use plane_contact::report::{folder, tables};
use plane_contact::scene::Scene;

use super::{ModelArgs, ReadingArg, print};

/// Run the iterations and write pictures and data.
#[derive(clap::Args)]
#[command(after_help = "\
Prints a table of the iterations and one of the bodies. Writes to --out: mesh.svg (the paper's fig. 4),
von_mises_stress.svg and von_mises_strain.svg (fig. 5), fields.vtu (ParaView), result.json.

Examples:
  plane-contact solve
  plane-contact solve strand --variant tied --out out/tied
  plane-contact solve fig1 --variant printed --reading R3=nested --json
  plane-contact solve strand --variant unilateral --coupling mortar --friction 0
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
    reading: ReadingArg,
    /// Folder for pictures and data [default: out/<scene>-<variant>].
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Print result.json in place of the tables.
    #[arg(long)]
    json: bool,
}

pub fn run(args: &Args) -> Result<(), Error> {
    let mut scene = Scene::open(&args.scene)?;
    args.model.apply(&mut scene.contact);
    let variant = args.variant.unwrap_or(scene.variant);
    let progress = progress(scene.iterations);
    let outcome = contact::run(&scene, variant, &args.reading.reading.0, |_| progress.inc(1))?;
    progress.finish_and_clear();
    let default = || PathBuf::from("out").join(format!("{}-{variant}", scene.name));
    let out = args.out.clone().unwrap_or_else(default);
    let result = folder::write(&out, &scene, &outcome)?;
    if args.json {
        return print(&result);
    }
    print(&format!("{}\nWritten to {}\n", tables::solution(&scene, &outcome), out.display()))
}

/// A bar on standard error; it shows only in a terminal.
fn progress(iterations: usize) -> ProgressBar {
    let style = ProgressStyle::with_template("iteration {pos} of {len} {wide_bar} {eta}");
    let bar = ProgressBar::new(iterations as u64).with_style(style.expect("the template is sound"));
    bar.enable_steady_tick(Duration::from_millis(500));
    bar
}
