//! `plane-contact km`.

use std::path::PathBuf;

use plane_contact::engine::Request;
use plane_contact::engine::error::Result;
use plane_contact::memory;
use plane_contact::paper::door::Call;
use plane_contact::problem::scene::Scene;
use plane_contact::report::matrix_market;

use super::{ReadingArg, write_or_print};

/// Assemble MJS by the listing Km at the initial shape.
#[derive(clap::Args)]
#[command(after_help = "\
Writes MJS in Matrix Market coordinate format, 17 significant digits, zeros left out.

Examples:
  plane-contact km fig1
  plane-contact km fig1 --coupled-by none
  plane-contact km strand --matrix-market MJS.mtx --reading R3=nested")]
pub struct Args {
    /// Path of a scene, or the name of an embedded one.
    #[arg(value_name = "SCENE")]
    scene: String,
    /// Write to a file in place of standard output.
    #[arg(long, value_name = "FILE")]
    matrix_market: Option<PathBuf>,
    /// The contact pairs that enter: those of c_cnt at the initial shape, or none.
    #[arg(long, value_name = "PAIRS", default_value = "c-cnt")]
    coupled_by: CoupledBy,
    #[command(flatten)]
    reading: ReadingArg,
}

#[derive(Clone, Copy, clap::ValueEnum)]
enum CoupledBy {
    CCnt,
    None,
}

pub fn run(args: &Args) -> Result<()> {
    let reading = args.reading.reading;
    let scene = Scene::open(&args.scene)?;
    let model = Request::new(&scene).reading(reading).model()?;
    memory::check(model.nodes.len(), 1, memory::free())?;
    let call = match args.coupled_by {
        CoupledBy::CCnt => Call::c_cnt(&model, &reading, &model.nodes)?,
        CoupledBy::None => Call::without_contact(&model),
    };
    let matrix = call.km(&reading)?;
    let comment = format!("MJS of scene {}: equation 2n-1 is x of node n, 2n is y", scene.name);
    let text = matrix_market::matrix_market(&matrix, &comment);
    write_or_print(&args.matrix_market, &text)
}
