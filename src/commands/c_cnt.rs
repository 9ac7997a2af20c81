//! `plane-contact c-cnt`.

use plane_contact::engine::Request;
use plane_contact::engine::error::Result;
use plane_contact::paper::door::Call;
use plane_contact::problem::scene::Scene;
use plane_contact::report::{json, tables};

use super::{ReadingArg, TablesArgs, print};

/// Call the listing c_cnt once, at the initial shape.
#[derive(clap::Args)]
#[command(after_help = "\
Prints, by contact node, ct (elem number of the target edge), yt (vertical distance), dy (1 = in
contact), then the rows of k_cnt that are not zero. --json: {\"ct\": [...], \"yt\": [...], \"dy\":
[...], \"k_cnt\": [[mate, weight, mate, weight], ...]}.

Examples:
  plane-contact c-cnt fig1
  plane-contact c-cnt fig1 --reading R4=left-to-right    the listing stops: exit status 3
  plane-contact c-cnt my/scene.json --json")]
pub struct Args {
    /// Path of a scene, or the name of an embedded one.
    #[arg(value_name = "SCENE")]
    scene: String,
    #[command(flatten)]
    reading: ReadingArg,
    /// Print JSON.
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    tables: TablesArgs,
}

pub fn run(args: &Args) -> Result<()> {
    let reading = args.reading.reading;
    let scene = Scene::open(&args.scene)?;
    let model = Request::new(&scene).reading(reading).model()?;
    let call = Call::c_cnt(&model, &reading, &model.nodes)?;
    if args.json {
        return print(&json::of_scene(&scene, &json::Found::from(&call.pairs)));
    }
    args.tables.print("c-cnt", &tables::pairs(&scene, &model, &reading, &call))
}
