//! `plane-contact compare`.

use std::path::PathBuf;

use plane_contact::calculix::{self, Comparison, Fields, Model, Ran, deck, reference};
use plane_contact::contact::Outcome;
use plane_contact::error::Error;
use plane_contact::report::comparison::{self as report, Compared};
use plane_contact::scene::Scene;

use super::export::{Code, DeckArgs};
use super::{print, waiting};

/// Run a scene here and in another code, and show the differences.
#[derive(clap::Args)]
#[command(after_help = "\
Exports the scene to a temporary folder, runs ccx there and reads its results. Writes to --out: compare.json, nodes.csv, elements.csv,
von_mises_stress.svg (this program), von_mises_stress_calculix.svg, difference.svg.

--contact equation: one linear system, the last iteration's ties and the whole load, solved by both. --contact pair: the variant's own
result beside CalculiX's own contact; they differ by the penalty and by what each takes for contact.

Examples:
  plane-contact compare strand --with calculix --variant tied
  plane-contact compare strand --with calculix --contact pair --penalty 1e8 --json")]
pub struct Args {
    /// The code.
    #[arg(long, value_name = "CODE")]
    with: Code,
    #[command(flatten)]
    deck: DeckArgs,
    /// The program of CalculiX.
    #[arg(long, value_name = "PROGRAM", default_value = "ccx")]
    ccx: String,
    /// Folder for data and pictures [default: out/<scene>-<variant>-calculix-<contact>].
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Print compare.json in place of the tables.
    #[arg(long)]
    json: bool,
}

pub fn run(args: &Args) -> Result<(), Error> {
    let Code::Calculix = args.with;
    let scene = Scene::open(&args.deck.scene)?;
    let outcome = args.deck.solve(&scene)?;
    let contact = args.deck.contact(&outcome)?;
    let ran = ccx(args, &Model { scene: &scene, sheet: &outcome.sheet, contact: &contact })?;
    let ours = reference(&scene, &outcome, args.deck.contact)?;
    let compared = Compared {
        scene: &scene,
        sheet: &outcome.sheet,
        variant: outcome.variant,
        contact: &contact,
        version: &ran.version,
        from_variant: from_variant(&outcome, &ours),
        comparison: &Comparison::new(&scene, ours, ran.fields),
    };
    finish(args, &compared)
}

fn ccx(args: &Args, model: &Model) -> Result<Ran, Error> {
    let text = deck(model)?;
    let spinner = waiting("running ccx");
    let ran = calculix::run(&args.ccx, &text, model.sheet.R(), model.sheet.M());
    spinner.finish_and_clear();
    Ok(ran?)
}

/// Largest displacement between what the deck is compared with and the variant's own result.
fn from_variant(outcome: &Outcome, ours: &Fields) -> f64 {
    let own = outcome.u.as_slice().chunks(2);
    own.zip(&ours.u).map(|(a, b)| (a[0] - b[0]).hypot(a[1] - b[1])).fold(0.0, f64::max)
}

fn finish(args: &Args, compared: &Compared) -> Result<(), Error> {
    let default = || {
        let (scene, kind) = (&compared.scene.name, args.deck.contact);
        PathBuf::from("out").join(format!("{scene}-{}-calculix-{kind}", compared.variant))
    };
    let out = args.out.clone().unwrap_or_else(default);
    let json = report::write(&out, compared)?;
    if args.json {
        return print(&json);
    }
    print(&format!("{}\nWritten to {}\n", report::text(compared), out.display()))
}
