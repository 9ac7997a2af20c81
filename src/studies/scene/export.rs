//! `plane-contact scene export`.

use std::path::PathBuf;

use crate::calculix::arguments::DeckArgs;
use crate::calculix::deck;
use base::files::DECK;
use engine::error::Result;
use problem::scene::Scene;

use commands::write_or_print;

/// Write a scene as an input deck of CalculiX.
#[derive(clap::Args)]
#[command(after_help = "\
The deck runs as it is: ccx FILE without .inp. --contact equation writes eq. (1) as the variant's \
last iteration has it, with the whole load; --contact pair lets CalculiX look for contact itself, \
from the initial shape. Mathcad and Octave: see mathcad export.

Examples:
  plane-contact scene export fig1
  plane-contact scene export strand --variant tied --out strand.inp
  plane-contact scene export strand --variant unilateral --coupling mortar --friction 0
  plane-contact scene export strand --contact pair --penalty 1e7 --friction 0 --out strand.inp")]
pub struct Args {
    /// Path of a scene, or the name of an embedded one.
    #[arg(value_name = "SCENE")]
    scene: PathBuf,
    #[command(flatten)]
    deck: DeckArgs,
    /// Write to a file in place of standard output.
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
}

pub fn run(args: &Args) -> Result<()> {
    write_or_print(&args.out, DECK, || {
        let scene = Scene::open(&args.scene)?;
        let solution = args.deck.solve(&scene)?;
        let parts = args.deck.parts(&solution)?;
        let last = parts.last().expect("a run has an iteration");
        Ok(deck(&scene.title, &solution.model, &last.contact)?)
    })
}
