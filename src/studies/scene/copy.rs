//! `plane-contact scene copy`.

use std::path::PathBuf;

use base::error::InputError;
use base::files;
use base::plain::shown;
use base::suggestion::did_you_mean;
use engine::error::Result;
use problem::scene::{Embedded, FINDING_SCENES, SCENES};

use commands::{offered, print_fitted};

/// Write a scene of the program to a folder, to edit it.
#[derive(clap::Args)]
#[command(after_help = "\
Examples:
  plane-contact scene copy fig1 --out my
  plane-contact scene copy C4
  plane-contact solve my")]
pub struct Args {
    /// A scene of the program, or a finding: plane-contact scene list lists them.
    #[arg(value_name = "NAME", value_parser = offered::<String>(names()))]
    name: String,
    /// Folder for scene.json and its mesh [default: the scene's name].
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
}

pub fn run(args: &Args) -> Result<()> {
    let scene = find(&args.name)?;
    let folder = args.out.clone().unwrap_or_else(|| scene.name.into());
    let file = folder.join("scene.json");
    if file.exists() {
        let fix = "choose another folder with --out";
        return Err(InputError::new(shown(&file), "it exists already", fix).into());
    }
    let mut written = scene.files.to_vec();
    written.push(("scene.json", scene.scene));
    files::write_all(&folder, &written)?;
    let folder = shown(&folder);
    print_fitted(&format!("Written to {folder}; plane-contact solve {folder} runs it\n"))
}

/// The scene of that name, or of the finding of that name.
fn find(name: &str) -> Result<&'static Embedded, InputError> {
    let is =
        |scene: &&'static Embedded| scene.name == name || short(scene).eq_ignore_ascii_case(name);
    SCENES.iter().chain(FINDING_SCENES).find(is).ok_or_else(|| {
        let fix = did_you_mean(name, names()) + "plane-contact scene list lists them";
        InputError::new("NAME", format!("there is no scene {name:?}"), fix)
    })
}

/// The names of all scenes of the program, those of findings short.
fn names() -> impl Iterator<Item = &'static str> {
    SCENES.iter().chain(FINDING_SCENES).map(short)
}

/// The name of a scene; that of a finding's is the finding.
fn short(scene: &'static Embedded) -> &'static str {
    scene.name.trim_start_matches("findings/")
}
