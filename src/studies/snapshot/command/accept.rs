//! `plane-contact snapshot accept`.

use std::path::PathBuf;

use super::given_files::{GivenFile, read_all, scene_of};
use crate::snapshot::verified_file::{self as report, VerifiedFile};
use crate::snapshot::{Snapshot, accept, difference};
use base::exit::ExitStatus;
use base::files;
use base::plain::shown;
use engine::error::Result;
use problem::scene::{Scene, SceneFile};

use commands::{print_report, report_error, waiting, within};

/// Record snapshots again, and print what changed.
#[derive(clap::Args)]
#[command(after_help = "\
Their runs, what is recorded of each, and their tolerances stay. What changed is printed as verify prints \
it; see it before by verify. Among several files scenes are skipped; of one that cannot be recorded the \
exit status tells, and the others are recorded all the same.

Examples:
  plane-contact snapshot accept out/fig1.snapshot.json
  plane-contact snapshot accept my/*.json
  plane-contact snapshot accept my/block.snapshot.json --scene my/other.json")]
pub struct Args {
    /// Snapshots.
    #[arg(value_name = "FILE", required = true)]
    files: Vec<PathBuf>,
    /// Record this scene [default: the file that a snapshot was recorded from, else the scene in it].
    #[arg(long, value_name = "SCENE")]
    scene: Option<PathBuf>,
}

pub fn run(args: &Args) -> Result<ExitStatus> {
    let given = args.scene.as_deref().map(SceneFile::read).transpose()?;
    let mut status = ExitStatus::Done;
    for file in read_all(&args.files) {
        if let Err(why) = record(&file, given.as_ref()) {
            let failed = report_error(&why);
            status = if status == ExitStatus::Done { failed } else { status };
        }
    }
    Ok(status)
}

/// Records the snapshot in a file again, on its own scene or on a `given` one.
fn record(GivenFile { path, text }: &GivenFile, given_file: Option<&SceneFile>) -> Result<()> {
    let file = shown(path);
    let given = given_file.map(Scene::of_file).transpose()?;
    let old = Snapshot::of_file(path, text)?;
    let (scene, said) = scene_of(path, &old, given.as_ref(), false)?;
    let new = waiting("recording", || accept(&old, scene.as_ref()));
    let mut new = new.map_err(|error| within(error, &file))?;
    if let Some(scene) = given_file {
        new.scene_file = scene.path().and_then(|scene| files::from_folder_of(path, scene));
    }
    let was = text.as_deref().unwrap_or_default();
    let text = new.readable_text()?;
    files::rewrite(path, was, &text)?;
    let done = match text.as_bytes() == was {
        true => format!("Nothing changed: {file} stays as it was"),
        false => format!("Recorded again: {file}"),
    };
    let verified = Ok(difference(&old, &new));
    print_report(report::report(&[VerifiedFile { file, scene: said, verified }], false).line(done))
}
