//! `plane-contact scene new`.

use std::path::{Path, PathBuf};

use base::error::InputError;
use base::files;
use base::plain::{shell_word, shown};
use engine::error::Result;
use output::model::Report;
use problem::scene::first;

use commands::print_report;

/// Write a first scene for a mesh of Gmsh, to be edited.
#[derive(clap::Args)]
#[command(after_help = "\
Groups of triangles become bodies; of the groups of edges the two that face each other closest become the \
contact, the lowest of the others a restraint, the highest a load. What only you know is null: moduli, pressure, \
friction; solve names what is still to be chosen. A body that nothing holds is named. A mesh of which a triangle \
is in no group is refused with the lines to add.

Examples:
  plane-contact scene new my/block.msh
  plane-contact scene new my/block.msh --out my/pressed.json")]
pub struct Args {
    /// A mesh of Gmsh.
    #[arg(value_name = "MESH")]
    mesh: PathBuf,
    /// The scene file, in the mesh's folder or above it [default: the mesh's name with .json].
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
}

pub fn run(args: &Args) -> Result<()> {
    let out = args.out.clone().unwrap_or_else(|| args.mesh.with_extension("json"));
    let file = files::read(&args.mesh).map_err(|why| {
        let what = format!("the mesh cannot be read: {why}");
        InputError::new(shown(&args.mesh), what, "give the path of a mesh that Gmsh saved")
    })?;
    let scene = first(&name_beside(&args.mesh, &out)?, &file)?;
    if !files::write_new(&out, &scene.text)? {
        let fix = "choose another file with --out";
        return Err(InputError::new(shown(&out), "it exists already", fix).into());
    }
    let out = shell_word(&shown(&out));
    print_report(
        Report::default().heading("Guessed from the groups of the mesh").notes(scene.notes).line(
            format!(
                "Written to {out}: give each null a value; plane-contact solve {out} then runs it"
            ),
        ),
    )
}

/// Returns the path of the mesh as the scene file names it: from its own folder downwards.
fn name_beside(mesh: &Path, out: &Path) -> Result<String, InputError> {
    let below = files::from_folder_of(out, mesh).filter(|name| !name.starts_with("../"));
    below.ok_or_else(|| {
        let what = format!(
            "a scene reads a mesh in its own folder or below, and {} is not there",
            shown(mesh)
        );
        InputError::new("--out", what, "name a file in the mesh's folder")
    })
}
