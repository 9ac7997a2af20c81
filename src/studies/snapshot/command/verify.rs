//! `plane-contact snapshot verify`.

use std::io;
use std::path::{Path, PathBuf};

use crate::snapshot::table::{self as report, VerifiedFile};
use crate::snapshot::{self, Snapshot};
use base::error::InputError;
use base::exit::ExitStatus;
use base::files;
use base::plain::shown;
use engine::error::Result;
use problem::scene::Scene;

use commands::{print_either, progress, report_error, within};

/// Run what snapshots recorded again and compare.
#[derive(clap::Args)]
#[command(after_help = "\
Facts and units are the same or not; numbers agree within the bounds on both runs' rounding errors, or
within the tolerance that the snapshot gives. What is new or missing and other lengths are differences.
Of a difference it says what went in and differs too, where the runs first differ, and the printed
condition that gave the first status that differs. The exit status also tells a difference, that nothing was compared, and that a snapshot cannot be read; the others are verified
all the same.

Examples:
  plane-contact snapshot verify out/fig1.snapshot.json
  plane-contact snapshot verify my/*.json --junit verify.xml --report summary.markdown
  plane-contact snapshot verify my/snapshot.json --scene my/scene.json    the scene as it is today")]
pub struct Args {
    /// Snapshots.
    #[arg(value_name = "FILE", required = true)]
    files: Vec<PathBuf>,
    /// Run this scene in place of the one in the snapshot.
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
    let snapshots = args.files.iter().map(|file| snapshot_of(file, files::read(file)));
    let snapshots = snapshots.collect();
    let written = [&args.junit, &args.report].into_iter().flatten();
    written.clone().try_for_each(|file| files::check_file(file))?;
    if let (Some(junit), Some(report)) = (&args.junit, &args.report)
        && files::is_same_place(junit, report)
    {
        let what = "both --junit and --report write this file";
        return Err(InputError::new("--report", what, "name another file").into());
    }
    let checked = check(&args.files, snapshots, scene.as_ref());
    if let Some(file) = &args.junit {
        files::write(file, &report::junit(&checked))?;
    }
    if let Some(file) = &args.report {
        files::write(file, &report::report(&checked).markdown())?;
    }
    report(&checked, args.json)
}

/// Prints what verifying found, and returns the exit status: that of the first file that could not be
/// verified, else whether all is the same.
fn report(checked: &[VerifiedFile], json: bool) -> Result<ExitStatus> {
    print_either(json, || report::json(checked), || report::report(checked))?;
    let failures = checked.iter().filter_map(|checked| checked.verified.as_ref().err());
    let statuses: Vec<ExitStatus> = failures.map(report_error).collect();
    let is_same = checked.iter().all(VerifiedFile::is_same);
    Ok(statuses.first().copied().unwrap_or(ExitStatus::compared(is_same)))
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
fn check(
    files: &[PathBuf],
    snapshots: Vec<Result<Snapshot>>,
    scene: Option<&Scene>,
) -> Vec<VerifiedFile> {
    let runs = snapshots.iter().flatten().map(|snapshot| snapshot.runs.len()).sum();
    let bar = progress(runs, "run {pos} of {len} {wide_bar} {eta}");
    let check = |(file, snapshot): (&PathBuf, Result<Snapshot>)| {
        let file = shown(file);
        let verified = snapshot.and_then(|snapshot| {
            let verified = snapshot::verify(&snapshot, scene, &|| bar.inc(1));
            verified.map_err(|error| within(error, &file))
        });
        VerifiedFile { file, verified }
    };
    let checked = files.iter().zip(snapshots).map(check).collect();
    bar.finish_and_clear();
    checked
}
