//! `plane-contact scene list`.

use crate::audit::findings::FINDINGS;
use crate::benchmark::Kind;
use clap::Subcommand;
use engine::error::Result;
use output::model::{Report, Table};
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
    let scenes = SCENES.iter().map(|scene| Scene::open(scene.name));
    let scenes = Table::from_rows(scenes.collect::<Result<Vec<_>, _>>()?)
        .column("scene", |scene| scene.name.clone())
        .column("nodes", |scene| scene.model.nodes.len())
        .column("triangles", |scene| scene.model.triangles.len())
        .column("title", |scene| scene.title.clone());
    let findings = Table::from_rows(FINDINGS)
        .column("finding", |finding| finding.id.name())
        .column("what its scene shows", |finding| finding.title);
    let generators = Kind::augment_subcommands(clap::Command::new("mesh"));
    let about = |kind: &clap::Command| kind.get_about().map(ToString::to_string);
    let generators = Table::from_rows(generators.get_subcommands())
        .column("generator", |kind| kind.get_name())
        .column("what it makes", |kind| about(kind).unwrap_or_default());
    print_report(
        Report::default()
            .table("Scenes: plane-contact solve NAME", scenes)
            .table("Findings: plane-contact audit --finding ID; the scene is findings/ID", findings)
            .table("Generators: plane-contact scene mesh KIND", generators),
    )
}
