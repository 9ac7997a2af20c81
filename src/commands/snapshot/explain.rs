//! `plane-contact snapshot explain`.

use std::path::PathBuf;

use plane_contact::engine::error::Result;
use plane_contact::report::snapshot::{self as report, VerifiedFile};

use super::verify;
use crate::commands::report_written;

/// Explain why a scene no longer gives what its snapshot recorded.
#[derive(clap::Args)]
#[command(after_help = "\
Follows both runs in the order of computation (scene, mesh, worksheet; then in each iteration target
edges, distances, statuses, pairs, matrix, displacements) and names the first difference, with the
line of the listing that decides it, its cause, and how that is known.

Examples:
  plane-contact snapshot explain out/fig1.snapshot.json
  plane-contact snapshot explain my/snapshot.json --scene my/scene.json --out why")]
pub struct Args {
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

pub fn run(args: &Args) -> Result<u8> {
    let (snapshot, verified) = verify::verify_one(&args.file, args.scene.as_deref())?;
    let file = args.file.display().to_string();
    let differing = verified.runs.iter().find(|run| !run.differences.is_empty()).cloned();
    let input = verified.input.clone();
    let status = verify::report(&[VerifiedFile { file, verified: Ok(verified) }], args.json)?;
    if let (Some(folder), Some(run)) = (&args.out, differing) {
        let old = snapshot.runs.get(&run.name).expect("the run was read from there");
        let written = report::difference_files(folder, &input.build()?, [old, &run.run])?;
        report_written(folder, written);
    }
    Ok(status)
}
