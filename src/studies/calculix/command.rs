//! `plane-contact compare`.

use std::path::PathBuf;

use crate::calculix::table::{self as report, Compared};
use crate::calculix::{self, Comparison, ContactKind, Fields};
use crate::field;
use base::error::InputError;
use base::exit::ExitStatus;
use base::files;
use base::plain::shown;
use engine::error::Result;
use engine::estimates::certain;
use problem::scene::Scene;

use super::arguments::{Code, DeckArgs};
use commands::{TablesArgs, folder, folder_name, print, waiting};

/// Run a scene here and in another code, or take that one's field, and show the differences.
#[derive(clap::Args)]
#[command(after_help = "\
--with FIELD: displacements on the scene's mesh, as CSV (columns node or x, y, then ux, uy, as the
nodes.csv of solve --csv), in the scene's unit, beside the contact solution: unilateral with mortar
and the scene's friction, or the run of --variant. Other files go through Python (guide scenes).
Penetration, traction and forces are those that the displacements imply. The exit status tells a
difference beyond --rtol. Nothing is written but --csv.

--with calculix: exports the scene to a temporary folder, runs ccx there and reads its results. Writes to --out:
compare.json, nodes.csv, elements.csv, von_mises_stress.svg (this program),
von_mises_stress_calculix.svg, difference.svg.

Where rounding in f64 may decide who is in contact, the run in double-doubles is compared.
--contact equation: the same linear systems solved by both; where the load is stepped, a deck for
each contact state, summed.
--contact pair: CalculiX's own contact; the two differ by the penalty and by what each takes for
contact.

Examples:
  plane-contact compare my/block.json --with other.csv
  plane-contact compare strand --friction 0 --with csv/nodes.csv --rtol 0.1
  plane-contact compare strand --variant tied
  plane-contact compare strand --variant unilateral --coupling mortar --friction 0
  plane-contact compare strand --variant unilateral --friction 0 --contact pair --penalty 1e7")]
#[command(mut_arg("json", |json| json.help("Print compare.json in place of the tables; files are written only to a folder that --out names")))]
pub struct Args {
    /// Path of a scene, or the name of an embedded one.
    #[arg(value_name = "SCENE")]
    scene: PathBuf,
    /// calculix, which is run, or a .csv file of displacements.
    #[arg(long, value_name = "CODE|FIELD", default_value = "calculix", value_parser = other)]
    with: Other,
    /// With a field, the largest difference that is none, over the largest displacement and in the energy
    /// norm [default: 1e-3].
    #[arg(long, value_name = "R", value_parser = tolerance)]
    rtol: Option<f64>,
    #[command(flatten)]
    deck: DeckArgs,
    /// The program of CalculiX [default: ccx].
    #[arg(long, value_name = "PROGRAM")]
    ccx: Option<String>,
    /// Folder for data and pictures [default: out/<scene>-<variant>-calculix-<contact>, and every
    /// option that differs from the scene's own].
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    #[command(flatten)]
    tables: TablesArgs,
}

/// What a scene is compared with.
#[derive(Clone)]
enum Other {
    Code(Code),
    Field(PathBuf),
}

fn other(text: &str) -> Result<Other, String> {
    let path = PathBuf::from(text);
    if path.extension().is_some() {
        return Ok(Other::Field(path));
    }
    text.parse().map(Other::Code).map_err(|why| format!("{why}, and no .csv file"))
}

fn tolerance(text: &str) -> Result<f64, String> {
    let tolerance: f64 = text.parse().map_err(|_| "it is no number".to_string())?;
    let possible = Some(tolerance).filter(|x| *x >= 0.0 && x.is_finite());
    possible.ok_or_else(|| "it is negative or not finite".into())
}

/// Compares a scene; returns whether it differs from a field.
pub fn run(args: &Args) -> Result<ExitStatus> {
    args.tables.check()?;
    match &args.with {
        Other::Code(Code::Calculix) => beside_calculix(args).map(|()| ExitStatus::Done),
        Other::Field(path) => {
            let Args { ccx, out, deck, .. } = args;
            let is_deck = deck.penalty.is_some() || deck.contact != ContactKind::default();
            if ccx.is_some() || out.is_some() || is_deck {
                let what = "--contact, --penalty, --ccx and --out belong to --with calculix";
                return Err(InputError::new("--with", what, "leave them out").into());
            }
            let scene = Scene::open(&args.scene)?;
            field::command::run(path, &deck.reference(&scene)?, args.rtol, &args.tables)
        }
    }
}

fn beside_calculix(args: &Args) -> Result<()> {
    if args.rtol.is_some() {
        let what = "a tolerance belongs to --with FIELD";
        return Err(InputError::new("--rtol", what, "leave it out").into());
    }
    let ccx = args.ccx.as_deref().unwrap_or("ccx");
    if let Some(out) = &args.out {
        files::check_folder(out, &["nodes.csv", "elements.csv", "compare.json"])?;
    }
    calculix::check(ccx)?;
    let solution = args.deck.solve(&args.scene)?;
    let request = solution.request.clone();
    let (solution, certainty) = certain(solution);
    let parts = args.deck.parts(&solution)?;
    let (scene, model) = (&solution.request.scene, &solution.model);
    let ran = waiting("running ccx", || calculix::run(ccx, scene, model, &parts))?;
    let compared = Compared {
        scene,
        model,
        variant: request.variant,
        certainty,
        contact: &parts.last().expect("a run has an iteration").contact,
        decks: parts.len(),
        version: &ran.version,
        comparison: &Comparison::new(model, Fields::from_solution(&solution), ran.fields),
    };
    let mut asked = vec![format!("calculix-{}", args.deck.contact)];
    asked.extend(args.deck.penalty.map(|penalty| format!("penalty-{penalty:e}")));
    let start = format!("{}-{}", scene.name, request.variant);
    let out = folder(&args.out, folder_name(start, &request, &asked));
    if args.tables.json && args.out.is_none() {
        return print(&report::json(&compared));
    }
    let json = report::write(&out, &compared)?;
    if args.tables.json {
        return print(&json);
    }
    let report = report::report(&compared).line(format!("Written to {}", shown(&out)));
    args.tables.print(report)
}
