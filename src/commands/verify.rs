//! `plane-contact verify` and `plane-contact explain`.

use std::path::{Path, PathBuf};

use plane_contact::answer::error::Result;
use plane_contact::error::InputError;
use plane_contact::files;
use plane_contact::problem::scene::Scene;
use plane_contact::report::snapshot::{self as report, Checked};
use plane_contact::studies::snapshot::{self, Snapshot};

use super::{answers, print_either, progress};

/// The exit status where what was compared differs, or nothing was compared.
pub const DIFFERS: u8 = 1;

/// Run what snapshots recorded again and compare.
#[derive(clap::Args)]
#[command(after_help = "\
Facts are the same or not; numbers agree within the bounds on both runs' rounding errors, or within
the tolerance that the snapshot gives. What is missing or added, other lengths and what is no number
are differences. A difference is explained: its first cause, and how that is known. The exit status
also tells a difference, and that nothing was compared.

Files that the page of an exercise saved (`lesson --exercise`) are marked: how many answers are right,
and what the others should be.

Examples:
  plane-contact verify out/fig1.snapshot.json
  plane-contact verify my/*.json --junit verify.xml --report summary.markdown
  plane-contact verify my/snapshot.json --scene my/scene.json    the scene as it is today
  plane-contact verify answers/*.json                            a class")]
pub struct Args {
    /// Snapshots; or answers to exercises.
    #[arg(value_name = "FILE", required = true)]
    files: Vec<PathBuf>,
    /// Run this scene in place of the one in the snapshot.
    #[arg(long, value_name = "SCENE")]
    scene: Option<String>,
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

pub fn run(args: &Args) -> Result<u8> {
    if args.files.iter().any(|file| answers::are_in(file)) {
        let all_right = answers::verify(&args.files, args.json)?;
        return Ok(if all_right { 0 } else { DIFFERS });
    }
    let scene = args.scene.as_deref().map(Scene::open).transpose()?;
    let checked = check(&args.files, scene.as_ref())?;
    if let Some(file) = &args.junit {
        files::write(file, &report::junit(&checked))?;
    }
    if let Some(file) = &args.report {
        files::write(file, &report::markdown(&checked))?;
    }
    print_either(args.json, || report::json(&checked), || report::text(&checked))?;
    let is_same = checked.iter().all(|checked| checked.verified.is_same());
    Ok(if is_same { 0 } else { DIFFERS })
}

/// Reads a snapshot.
pub fn read(file: &Path) -> Result<Snapshot> {
    let place = file.display().to_string();
    let text = files::read(file).map_err(|why| {
        let what = format!("the snapshot cannot be read: {why}");
        InputError::new(&place, what, "give a file as `plane-contact record` writes it")
    })?;
    Ok(Snapshot::read(&text).map_err(|error| error.within(&place))?)
}

/// Verifies snapshots one by one, with a progress bar over their runs.
fn check(files: &[PathBuf], scene: Option<&Scene>) -> Result<Vec<Checked>> {
    let snapshots: Vec<Snapshot> = files.iter().map(|file| read(file)).collect::<Result<_>>()?;
    let runs = snapshots.iter().map(|snapshot| snapshot.runs.len()).sum();
    let bar = progress(runs, "run {pos} of {len} {wide_bar} {eta}");
    let check = |(file, snapshot): (&PathBuf, &Snapshot)| {
        let file = file.display().to_string();
        let verified = snapshot::verify(snapshot, scene, &|| bar.inc(1));
        let verified = verified.map_err(|error| super::within(error, &file))?;
        Ok(Checked { file, verified })
    };
    let checked = files.iter().zip(&snapshots).map(check).collect();
    bar.finish_and_clear();
    checked
}

/// Explain why a scene no longer gives what its snapshot recorded.
#[derive(clap::Args)]
#[command(after_help = "\
Follows both runs in the order of computation (scene, mesh, worksheet; then in each iteration target
edges, distances, statuses, pairs, matrix, displacements) and names the first difference, with the
line of the listing that decides it, its cause, and how that is known.

Examples:
  plane-contact explain out/fig1.snapshot.json
  plane-contact explain my/snapshot.json --scene my/scene.json --out why")]
pub struct ExplainArgs {
    /// A snapshot.
    #[arg(value_name = "FILE")]
    file: PathBuf,
    /// Run this scene in place of the one in the snapshot.
    #[arg(long, value_name = "SCENE")]
    scene: Option<String>,
    /// Print JSON in place of text.
    #[arg(long)]
    json: bool,
    /// Folder for the difference of the displacements of the first run that differs:
    /// difference.vtu and difference.svg.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
}

pub fn run_explain(args: &ExplainArgs) -> Result<u8> {
    let scene = args.scene.as_deref().map(Scene::open).transpose()?;
    let checked = check(std::slice::from_ref(&args.file), scene.as_ref())?;
    let snapshot = read(&args.file)?;
    let verified = &checked[0].verified;
    print_either(args.json, || report::json(&checked), || report::text(&checked))?;
    let differing = verified.runs.iter().find(|run| !run.differences.is_empty());
    if let (Some(folder), Some(run)) = (&args.out, differing) {
        let old = snapshot.runs.get(&run.name).expect("the run was read from there");
        let scene = verified.input.build()?;
        let written = report::difference_files(folder, &scene, [old, &run.run])?;
        super::say_written(folder, written);
    }
    Ok(if verified.is_same() { 0 } else { DIFFERS })
}
