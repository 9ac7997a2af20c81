//! `plane-contact scene mesh`.

use std::path::PathBuf;

use crate::benchmark::Kind;
use base::error::InputError;
use base::plain::shown;
use engine::error::Result;

use commands::{folder, print_fitted};

/// Generate a mesh and its scene: a benchmark, or the paper's example.
#[derive(clap::Args)]
#[command(after_help = "\
Writes scene.json and KIND.msh (Gmsh MSH 2.2, text, with named physical groups) to --out; solve \
runs that folder. scene mesh KIND --help says what is known of its solution.

Examples:
  plane-contact scene mesh hertz --size 40 --out hertz
  plane-contact solve hertz
  plane-contact scene mesh blocks --upper 7 --lower 10")]
pub struct Args {
    #[command(subcommand)]
    kind: Kind,
    /// Folder for the two files [default: out/mesh-KIND].
    #[arg(long, value_name = "DIR", global = true)]
    out: Option<PathBuf>,
}

pub fn run(args: &Args) -> Result<()> {
    let benchmark = args.kind.generate().map_err(|why| {
        InputError { place: format!("--{}", why.place), ..why } // a parameter is an option
    })?;
    let out = folder(&args.out, format!("mesh-{}", benchmark.name));
    benchmark.write(&out)?;
    let mesh = &benchmark.mesh;
    let (nodes, triangles) = (mesh.nodes.len(), mesh.of_dimension(2).count());
    let groups: Vec<&str> =
        mesh.names.iter().filter(|n| n.dim == 1).map(|n| n.name.as_str()).collect();
    print_fitted(&format!(
        "{nodes} nodes, {triangles} triangles, edges {}\nWritten to {}\n",
        groups.join(", "),
        shown(&out)
    ))
}
