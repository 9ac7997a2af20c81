//! The reference solution of a scene of one's own: its fields, a file for ParaView, and what may go wrong.
//!
//! `cargo run --release --example own_scene -- my/scene.json`

use std::path::{Path, PathBuf};

use plane_contact::engine::Assessment;
use plane_contact::output::picture::Drawing;
use plane_contact::output::vtu::vtu;
use plane_contact::{Error, Request, Scene, files, solve};

/// Solves the scene and writes `fields.vtu` to a folder.
///
/// # Errors
/// Those of the scene and of its solution, or the file cannot be written.
pub fn own_scene(path: &Path, out: &Path) -> Result<(), Error> {
    let scene = Scene::open(path)?;
    let reference = solve(&Request::new(&scene).reference(), &mut |_| ())?;
    for node in reference.in_contact() {
        let [ux, uy] = reference.displacement(node.node.number()).expect("a node of the mesh");
        println!("node {}: displaced by {ux:e}, {uy:e}", node.node);
    }
    let drawing = Drawing::new(&scene, &scene.name);
    let fields = vtu(&drawing, &reference, &Assessment::none(&reference));
    Ok(files::write(&out.join("fields.vtu"), &fields)?)
}

/// Says what went wrong: the input, the listing as printed, or that there is no equilibrium.
pub fn explained(error: &Error) -> String {
    match error {
        Error::Input(why) => format!("{}: {}; {}", why.place, why.what, why.fix),
        other => format!("exit status {}: {other}", other.exit_status().number()),
    }
}

/// Solves the scene that the command line names.
#[allow(dead_code, reason = "a test calls the function above")]
fn main() {
    let path = std::env::args_os().nth(1).map_or_else(|| "fig1".into(), PathBuf::from);
    if let Err(error) = own_scene(&path, Path::new("out")) {
        eprintln!("{}", explained(&error));
    }
}
