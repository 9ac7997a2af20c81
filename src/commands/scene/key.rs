//! `plane-contact scene key`.

use plane_contact::engine::error::Result;
use plane_contact::problem::scene::{Scene, SceneFile};
use plane_contact::studies::snapshot::Options;
use plane_contact::studies::sweep::key_of;

use crate::commands::{RunArgs, print};

/// Print the key of a scene under options: the hash by which a sweep knows a case.
#[derive(clap::Args)]
#[command(after_help = "\
Examples:
  plane-contact scene key fig1
  plane-contact scene key my/scene.json --variant tied")]
pub struct Args {
    /// Path of a scene, or the name of an embedded one.
    #[arg(value_name = "SCENE")]
    scene: String,
    #[command(flatten)]
    run: RunArgs,
}

pub fn run(args: &Args) -> Result<()> {
    let file = SceneFile::read(&args.scene)?;
    let scene = Scene::of_file(&file)?;
    let options = Options::from_request(&args.run.request(&scene));
    let options = Options { variant: args.run.variant, ..options };
    print(&(key_of(file, &options)? + "\n"))
}
