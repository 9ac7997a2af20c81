//! `plane-contact snapshot accept`.

use std::path::PathBuf;

use crate::snapshot::table::{self as report, VerifiedFile};
use crate::snapshot::{accept, difference};
use base::files;
use base::plain::shown;
use engine::error::Result;
use problem::scene::{Scene, SceneFile};

use super::record::from_folder_of;
use super::verify::{scene_of, snapshot_of};
use commands::{print_report, waiting, within};

/// Record a snapshot again, and print what changed.
#[derive(clap::Args)]
#[command(after_help = "\
Its runs, what is recorded of each, and its tolerances stay. What changed is printed as verify prints
it; see it before by verify.

Examples:
  plane-contact snapshot accept out/fig1.snapshot.json
  plane-contact snapshot accept my/block.snapshot.json --scene my/other.json")]
pub struct Args {
    /// A snapshot.
    #[arg(value_name = "FILE")]
    file: PathBuf,
    /// Record this scene [default: the file that it was recorded from, else the scene in the snapshot].
    #[arg(long, value_name = "SCENE")]
    scene: Option<PathBuf>,
}

pub fn run(args: &Args) -> Result<()> {
    let file = shown(&args.file);
    let given_file = args.scene.as_deref().map(SceneFile::read).transpose()?;
    let given = given_file.as_ref().map(Scene::of_file).transpose()?;
    let text = files::read(&args.file);
    // What cannot be read is named below.
    let was = text.as_ref().ok().cloned().unwrap_or_default();
    let old = snapshot_of(&args.file, text)?;
    let (scene, said) = scene_of(&args.file, &old, given.as_ref())?;
    let new = waiting("recording", || accept(&old, scene.as_ref()));
    let mut new = new.map_err(|error| within(error, &file))?;
    if let Some(scene) = given_file {
        new.scene_file = scene.path().and_then(|scene| from_folder_of(&args.file, scene));
    }
    let text = report::file(&new);
    files::rewrite(&args.file, &was, &text)?;
    let done = match text.as_bytes() == was {
        true => format!("Nothing changed: {file} stays as it was"),
        false => format!("Recorded again: {file}"),
    };
    let verified = Ok(difference(&old, &new));
    print_report(report::report(&[VerifiedFile { file, scene: said, verified }]).line(done))
}
