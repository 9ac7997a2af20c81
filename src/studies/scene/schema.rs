//! `plane-contact scene schema`.

use engine::error::Result;
use problem::scene::schema;

use commands::print;

/// Print the JSON Schema of a scene file, for an editor that completes and checks one.
#[derive(clap::Args)]
#[command(after_help = "\
Examples:
  plane-contact scene schema > scene.schema.json")]
pub struct Args {}

pub fn run(_: &Args) -> Result<()> {
    print(&schema())
}
