//! `plane-contact scene`.

pub mod benchmark;
mod copy;
mod export;
mod list;
mod mesh;
mod new;
mod plan;
mod schema;

use engine::error::Result;

/// List, copy, begin, mesh, plan, or export a scene, or print the schema of scene files.
#[derive(clap::Subcommand)]
#[command(after_help = "\
Examples:
  plane-contact scene list
  plane-contact scene copy fig1 --out my
  plane-contact scene new my/block.msh
  plane-contact scene mesh hertz --size 40 --out hertz
  plane-contact scene plan strand
  plane-contact scene export strand --out strand.inp")]
pub enum Command {
    List(list::Args),
    Copy(copy::Args),
    New(new::Args),
    Mesh(mesh::Args),
    Plan(plan::Args),
    Export(export::Args),
    Schema(schema::Args),
}

/// Runs the command.
pub fn run(command: &Command) -> Result<()> {
    match command {
        Command::List(args) => list::run(args),
        Command::Copy(args) => copy::run(args),
        Command::New(args) => new::run(args),
        Command::Mesh(args) => mesh::run(args),
        Command::Plan(args) => plan::run(args),
        Command::Export(args) => export::run(args),
        Command::Schema(_) => schema::run(),
    }
}
