//! `plane-contact snapshot verify`.

use std::path::{Path, PathBuf};

use super::given_files::{read_all, scene_of};
use crate::snapshot::verified_file::{self as report, VerifiedFile};
use crate::snapshot::{self, Snapshot};
use base::error::InputError;
use base::exit::ExitStatus;
use base::files::{self, JUNIT, MARKDOWN};
use base::plain::shown;
use engine::error::{Error, Result};
use problem::scene::Scene;

use commands::{print_either, progress, report_error, within};

/// Run what snapshots recorded again and compare.
#[derive(clap::Args)]
#[command(after_help = "\
Runs the scene file that a snapshot was recorded from, as it is today, where that is still there, else the scene \
in the snapshot. Among several files scenes are skipped.
Facts and units are the same or not; numbers agree but for rounding, which is measured, or within the \
tolerance that the snapshot gives. What is new or missing and other lengths are differences. \
Of a difference it says what went in and differs too, where the runs first differ, and the printed \
condition that gave the first status that differs. The exit status also tells a difference, that nothing was compared, and that a snapshot cannot be read; the others are verified \
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
    /// Fail where the scene file that a snapshot was recorded from is gone.
    #[arg(long, conflicts_with = "scene")]
    require_scenes: bool,
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
    let given = read_all(&args.files).into_iter();
    let snapshots = given.map(|file| (file.path, Snapshot::of_file(file.path, &file.text)));
    let snapshots = snapshots.collect();
    args.junit.as_deref().map_or(Ok(()), |file| files::check_file(file, JUNIT))?;
    args.report.as_deref().map_or(Ok(()), |file| files::check_file(file, MARKDOWN))?;
    if let (Some(junit), Some(report)) = (&args.junit, &args.report)
        && files::is_same_place(junit, report)
    {
        let what = "both --junit and --report write this file";
        return Err(InputError::new("--report", what, "name another file").into());
    }
    let checked = check(snapshots, scene.as_ref(), args.require_scenes);
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

/// Verifies snapshots one by one, with a progress bar over their runs.
fn check(
    snapshots: Vec<(&Path, Result<Snapshot, InputError>)>,
    given: Option<&Scene>,
    is_required: bool,
) -> Vec<VerifiedFile> {
    let read = snapshots.iter().filter_map(|(_, snapshot)| snapshot.as_ref().ok());
    let runs = read.map(|snapshot| snapshot.runs.len()).sum();
    let bar = progress("verifying", runs, "run {pos} of {len} {wide_bar} {eta}");
    let check = |(path, snapshot): (&Path, Result<Snapshot, InputError>)| {
        let file = shown(path);
        let verified = snapshot.map_err(Error::from).and_then(|snapshot| {
            let (scene, said) = scene_of(path, &snapshot, given, is_required)?;
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
