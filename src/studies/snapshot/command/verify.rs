//! `plane-contact snapshot verify`.

use std::io;
use std::path::{Path, PathBuf};

use crate::snapshot::table::{self as report, VerifiedFile};
use crate::snapshot::{self, Snapshot};
use base::error::InputError;
use base::exit::ExitStatus;
use base::files::{self, JUNIT, MARKDOWN, kind_of};
use base::plain::shown;
use engine::error::Result;
use problem::scene::{Scene, SceneFile};

use commands::{note, print_either, progress, report_error, within};

/// Run what snapshots recorded again and compare.
#[derive(clap::Args)]
#[command(after_help = "\
Runs the scene file that a snapshot was recorded from, as it is today, where that is still there, else the scene
in the snapshot. Among several files scenes are skipped.
Facts and units are the same or not; numbers agree within the bounds on both runs' rounding errors, or
within the tolerance that the snapshot gives. What is new or missing and other lengths are differences.
Of a difference it says what went in and differs too, where the runs first differ, and the printed
condition that gave the first status that differs. The exit status also tells a difference, that nothing was compared, and that a snapshot cannot be read; the others are verified
all the same.

Examples:
  plane-contact snapshot verify out/fig1.snapshot.json
  plane-contact snapshot verify my/*.snapshot.json --junit verify.xml --report summary.markdown
  plane-contact snapshot verify my/block.snapshot.json --scene my/other.json")]
pub struct Args {
    /// Snapshots.
    #[arg(value_name = "FILE", required = true)]
    files: Vec<PathBuf>,
    /// Run this scene [default: the file that a snapshot was recorded from, else the scene in it].
    #[arg(long, value_name = "SCENE")]
    scene: Option<PathBuf>,
    /// Print JSON in place of text.
    #[arg(long)]
    json: bool,
    /// Write a file of JUnit XML.
    #[arg(long, value_name = "FILE")]
    junit: Option<PathBuf>,
    /// Write a page of Markdown.
    #[arg(long, value_name = "FILE")]
    report: Option<PathBuf>,
}

pub fn run(args: &Args) -> Result<ExitStatus> {
    let scene = args.scene.as_deref().map(Scene::open).transpose()?;
    let texts = args.files.iter().map(|file| (file, files::read(file)));
    let (scenes, mut snapshots): (Vec<_>, Vec<_>) = texts.partition(|(_, text)| is_scene(text));
    if snapshots.is_empty() {
        snapshots = scenes;
    } else {
        scenes.iter().for_each(|(file, _)| note_skipped(file));
    }
    let snapshots = snapshots.into_iter().map(|(file, text)| (&**file, snapshot_of(file, text)));
    let snapshots = snapshots.collect();
    args.junit.as_deref().map_or(Ok(()), |file| files::check_file(file, JUNIT))?;
    args.report.as_deref().map_or(Ok(()), |file| files::check_file(file, MARKDOWN))?;
    if let (Some(junit), Some(report)) = (&args.junit, &args.report)
        && files::is_same_place(junit, report)
    {
        let what = "both --junit and --report write this file";
        return Err(InputError::new("--report", what, "name another file").into());
    }
    let checked = check(snapshots, scene.as_ref());
    if let Some(file) = &args.junit {
        files::write(file, &report::junit(&checked))?;
    }
    if let Some(file) = &args.report {
        let page = MARKDOWN.to_string() + &report::report(&checked, true).markdown();
        files::write(file, &page)?;
    }
    report(&checked, args.json)
}

/// Prints what verifying found, and returns the exit status: that of the first file that could not be
/// verified, else whether all is the same.
fn report(checked: &[VerifiedFile], json: bool) -> Result<ExitStatus> {
    print_either(json, || report::json(checked), || report::report(checked, false))?;
    let failures = checked.iter().filter_map(|checked| checked.verified.as_ref().err());
    let statuses: Vec<ExitStatus> = failures.map(report_error).collect();
    let is_same = checked.iter().all(VerifiedFile::is_same);
    Ok(statuses.first().copied().unwrap_or(ExitStatus::compared(is_same)))
}

/// Says that a scene among snapshots is skipped.
pub fn note_skipped(scene: &Path) {
    note(&format!("note: {} is a scene, and skipped\n", shown(scene)));
}

/// Returns whether a file, as it was read, is a scene.
pub fn is_scene(text: &io::Result<Vec<u8>>) -> bool {
    text.as_ref().is_ok_and(|text| kind_of(text) == Some("a scene file"))
}

/// Returns the scene that a snapshot's runs are made of where it is not the one in the snapshot: a `given` one, or
/// the file from which it was recorded; and what is to be said of it.
///
/// # Errors
/// The scene is at fault.
pub fn scene_of(
    file: &Path,
    snapshot: &Snapshot,
    given: Option<&Scene>,
) -> Result<(Option<Scene>, Option<String>)> {
    let (None, Some(path)) = (given, snapshot.scene_file.as_deref().map(Path::new)) else {
        return Ok((given.cloned(), None));
    };
    let today = SceneFile::of_snapshot(file.parent().unwrap_or(Path::new("")), path);
    let scene = today.map_err(|error| error.within(&shown(file)))?;
    let scene = scene.as_ref().map(Scene::of_file).transpose()?;
    let path = shown(path);
    let said = match &scene {
        None => Some(format!("scene file {path} is not there: the scene in the snapshot is run")),
        Some(scene) => {
            let [scene_sha256, mesh_sha256] = scene.hashes().expect("it is whole");
            let own = &snapshot.input;
            let is_same = *scene_sha256 == own.scene_sha256 && *mesh_sha256 == own.mesh_sha256;
            (!is_same).then(|| format!("scene file {path}, or its mesh, was edited since"))
        }
    };
    Ok((scene, said))
}

/// Reads the snapshot in the text of a file.
pub fn snapshot_of(file: &Path, text: io::Result<Vec<u8>>) -> Result<Snapshot> {
    let place = shown(file);
    let text = text.map_err(|why| {
        let what = format!("the snapshot cannot be read: {why}");
        InputError::new(&place, what, "give a file as `plane-contact snapshot record` writes it")
    })?;
    Ok(Snapshot::read(&text).map_err(|error| error.within(&place))?)
}

/// Verifies snapshots one by one, with a progress bar over their runs.
fn check(snapshots: Vec<(&Path, Result<Snapshot>)>, given: Option<&Scene>) -> Vec<VerifiedFile> {
    let read = snapshots.iter().filter_map(|(_, snapshot)| snapshot.as_ref().ok());
    let runs = read.map(|snapshot| snapshot.runs.len()).sum();
    let bar = progress("verifying", runs, "run {pos} of {len} {wide_bar} {eta}");
    let check = |(path, snapshot): (&Path, Result<Snapshot>)| {
        let file = shown(path);
        let verified = snapshot.and_then(|snapshot| {
            let (scene, said) = scene_of(path, &snapshot, given)?;
            let verified = snapshot::verify(&snapshot, scene.as_ref(), &|| bar.inc(1));
            Ok((verified.map_err(|error| within(error, &file))?, said))
        });
        match verified {
            Ok((verified, scene)) => VerifiedFile { file, scene, verified: Ok(verified) },
            Err(why) => VerifiedFile { file, scene: None, verified: Err(why) },
        }
    };
    let checked = snapshots.into_iter().map(check).collect();
    bar.finish();
    checked
}
