//! `plane-contact scenes` and `plane-contact scene`.

use std::path::PathBuf;

use clap::Subcommand;
use plane_contact::engine::error::Result;
use plane_contact::error::InputError;
use plane_contact::files;
use plane_contact::problem::scene::{Embedded, FINDING_SCENES, SCENES, Scene};
use plane_contact::report::scenes as report;
use plane_contact::studies::audit::findings::FINDINGS;
use plane_contact::studies::benchmark::Kind;
use plane_contact::suggestion::did_you_mean;

use super::{print_fitted, print_report};

/// List the scenes that are part of the program, the findings' own, and the generators.
#[derive(clap::Args)]
#[command(after_help = "\
Examples:
  plane-contact scenes
  plane-contact scene C4 --out my        to edit
  plane-contact mesh strand --help       the parameters of a generator")]
pub struct Args {}

/// Write a scene of the program to a folder, to edit it.
#[derive(clap::Args)]
#[command(after_help = "\
Examples:
  plane-contact scene fig1 --out my
  plane-contact scene C4
  plane-contact solve my")]
pub struct SceneArgs {
    /// A scene of the program, or a finding: plane-contact scenes lists them.
    #[arg(value_name = "NAME")]
    name: String,
    /// Folder for scene.json and its mesh [default: the scene's name].
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
}

pub fn run(_: &Args) -> Result<()> {
    let scenes = SCENES.iter().map(|scene| Ok((scene.name, Scene::open(scene.name)?)));
    let scenes = scenes.collect::<Result<Vec<_>>>()?;
    let findings: Vec<_> = FINDINGS.iter().map(|finding| (finding.id, finding.title)).collect();
    let generators = Kind::augment_subcommands(clap::Command::new("mesh"));
    let about = |command: &clap::Command| command.get_about().map(ToString::to_string);
    let generators = generators.get_subcommands();
    let generators: Vec<_> =
        generators.map(|c| (c.get_name().to_string(), about(c).unwrap_or_default())).collect();
    print_report(report::text(&scenes, &findings, &generators))
}

pub fn run_scene(args: &SceneArgs) -> Result<()> {
    let scene = find(&args.name)?;
    let folder = args.out.clone().unwrap_or_else(|| scene.name.into());
    let file = folder.join("scene.json");
    if file.exists() {
        let fix = "choose another folder with --out";
        return Err(InputError::new(file.display().to_string(), "it exists already", fix).into());
    }
    let mut written = scene.files.to_vec();
    written.push(("scene.json", scene.scene));
    files::write_all(&folder, "scene", &written)?;
    let folder = folder.display();
    print_fitted(&format!("Written to {folder}; plane-contact solve {folder} runs it\n"))
}

/// The scene of that name, or of the finding of that name.
fn find(name: &str) -> Result<&'static Embedded, InputError> {
    let all = || SCENES.iter().chain(FINDING_SCENES);
    let short = |scene: &'static Embedded| scene.name.trim_start_matches("findings/");
    let is =
        |scene: &&'static Embedded| scene.name == name || short(scene).eq_ignore_ascii_case(name);
    all().find(is).ok_or_else(|| {
        let fix = did_you_mean(name, all().map(short)) + "plane-contact scenes lists them";
        InputError::new("NAME", format!("there is no scene {name:?}"), fix)
    })
}
