//! `plane-contact scene plan`.

use std::path::PathBuf;

use engine::error::Result;
use engine::plan::Plan;
use output::plan::report;
use problem::scene::Scene;

use commands::{RunArgs, TablesArgs};

/// What solve will build and what not, and why; nothing is solved.
#[derive(clap::Args)]
#[command(after_help = "\
Bodies and their size, the load and its nominal strain, by which a mesh in metres or E in GPa shows; \
free equations, contact candidates after a test of boxes, the solver, dense or sparse, and what is \
left out or could be: orphan nodes, restrained equations, bodies that nothing moves, half of a \
symmetric scene.

Examples:
  plane-contact scene plan
  plane-contact scene plan strand --variant tied --solver sparse-cholesky
  plane-contact scene plan fig1 --json")]
pub struct Args {
    /// Path of a scene, or the name of an embedded one: strand, fig1, two-blocks.
    #[arg(value_name = "SCENE", default_value = "strand")]
    scene: PathBuf,
    #[command(flatten)]
    run: RunArgs,
    #[command(flatten)]
    tables: TablesArgs,
}

pub fn run(args: &Args) -> Result<()> {
    let scene = Scene::open(&args.scene)?;
    let plan = Plan::new(&args.run.request(&scene)?)?;
    args.tables.print_either(Some(&scene), &plan, || report(&plan, &scene))
}
