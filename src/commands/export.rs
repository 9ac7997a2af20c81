//! `plane-contact export`.

use std::path::PathBuf;

use plane_contact::answer::error::Result;
use plane_contact::answer::{self, Solution};
use plane_contact::problem::modelling::Variant;
use plane_contact::problem::scene::Scene;
use plane_contact::studies::calculix::{Contact, ContactKind, Pair, Part, Problem, deck};

use super::{ModelArgs, ReadingArg, waiting, write_or_print};

plane_contact::choices! {
    /// A code that a scene can be exported to.
    Code {
        /// CalculiX.
        Calculix = "calculix",
    }
}

/// Write a scene as the input deck of another code.
#[derive(clap::Args)]
#[command(after_help = "\
The deck runs as it is: ccx FILE without .inp. --contact equation writes eq. (1) as the variant's
last iteration has it, with the whole load; --contact pair lets CalculiX look for contact itself,
from the initial shape.

Examples:
  plane-contact export fig1 --to calculix
  plane-contact export strand --to calculix --variant tied --out strand.inp
  plane-contact export strand --to calculix --variant unilateral --coupling mortar --friction 0
  plane-contact export strand --to calculix --contact pair --penalty 1e7 --friction 0 \
                       --out strand.inp")]
pub struct Args {
    /// The code.
    #[arg(long, value_name = "CODE")]
    to: Code,
    #[command(flatten)]
    deck: DeckArgs,
    /// Write to a file in place of standard output.
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
}

/// What `export` and `compare` share.
#[derive(clap::Args)]
pub struct DeckArgs {
    /// Path of a scene, or the name of an embedded one.
    #[arg(value_name = "SCENE")]
    pub scene: String,
    /// equation: the constraints of the last iteration; pair: the other code's own contact, by
    /// penalty.
    #[arg(long, default_value_t = ContactKind::Equation)]
    pub contact: ContactKind,
    /// tied, stepped or unilateral; with --contact pair also printed [default: the scene's].
    #[arg(long)]
    pub variant: Option<Variant>,
    #[command(flatten)]
    pub reading: ReadingArg,
    /// Pressure over penetration of a pair, stress/length [default: 10 times the largest E over the
    /// target's mean edge].
    #[arg(long, value_name = "K", value_parser = penalty)]
    pub penalty: Option<f64>,
    #[command(flatten)]
    pub model: ModelArgs,
}

fn penalty(text: &str) -> Result<f64, String> {
    let penalty: f64 = text.parse().map_err(|_| "it is no number".to_string())?;
    let positive = Some(penalty).filter(|x| *x > 0.0 && x.is_finite());
    positive.ok_or_else(|| "it is not positive".into())
}

impl DeckArgs {
    /// The run that is compared.
    pub fn solve(&self) -> Result<Solution> {
        let scene = Scene::open(&self.scene)?;
        let request = self.model.request(&scene, self.variant, &self.reading);
        waiting("solving", || answer::solve(&request, &mut |_| ()))
    }

    /// The problems whose sum is the run; the last iteration's comes last.
    pub fn parts(&self, solution: &Solution) -> Result<Vec<Part>> {
        match self.contact {
            ContactKind::Equation => Ok(Contact::parts(solution)?),
            ContactKind::Pair => {
                let friction = solution.request.contact.friction;
                let pair = Pair::new(&solution.model, self.penalty, friction);
                Ok(vec![Part { contact: Contact::Pair(pair), share: 1.0 }])
            }
        }
    }
}

pub fn run(args: &Args) -> Result<()> {
    let Code::Calculix = args.to;
    let solution = args.deck.solve()?;
    let parts = args.deck.parts(&solution)?;
    let last = parts.last().expect("a run has an iteration");
    let (scene, model) = (&solution.request.scene, &solution.model);
    let text = deck(&Problem { scene, model, contact: &last.contact })?;
    write_or_print(&args.out, &text)
}
