//! `plane-contact scene list`.

use crate::audit::findings::FINDINGS;
use crate::benchmark::Kind;
use clap::Subcommand;
use engine::error::Result;
use output::scenes as report;
use problem::scene::{SCENES, Scene};

use commands::print_report;

/// List the scenes of the program, the findings' own, and the generators.
#[derive(clap::Args)]
#[command(after_help = "\
Examples:
  plane-contact scene list
  plane-contact scene copy C4 --out my         to edit
  plane-contact scene mesh strand --help       the parameters of a generator")]
pub struct Args {}

pub fn run(_: &Args) -> Result<()> {
    let scenes = SCENES.iter().map(|scene| Ok((scene.name, Scene::open(scene.name)?)));
    let scenes = scenes.collect::<Result<Vec<_>>>()?;
    let findings: Vec<_> =
        FINDINGS.iter().map(|finding| (finding.id.name(), finding.title)).collect();
    let generators = Kind::augment_subcommands(clap::Command::new("mesh"));
    let about = |command: &clap::Command| command.get_about().map(ToString::to_string);
    let generators = generators.get_subcommands();
    let generators: Vec<_> =
        generators.map(|c| (c.get_name().to_string(), about(c).unwrap_or_default())).collect();
    print_report(report::report(&scenes, &findings, &generators))
}
