//! `plane-contact compare`.

use std::path::PathBuf;

use crate::calculix::table::{self as report, Compared};
use crate::calculix::{self, Comparison, Fields};
use base::files;
use base::plain::shown;
use engine::error::Result;
use engine::estimates::certain;

use super::arguments::{Code, DeckArgs};
use commands::{TablesArgs, folder, folder_name, offered, print, waiting};

/// Run a scene here and in another code, and show the differences.
#[derive(clap::Args)]
#[command(after_help = "\
Exports the scene to a temporary folder, runs ccx there and reads its results. Writes to --out:
compare.json, nodes.csv, elements.csv, von_mises_stress.svg (this program),
von_mises_stress_calculix.svg, difference.svg.

Where rounding in f64 may decide who is in contact, the run in double-doubles is compared.
--contact equation: the same linear systems solved by both; where the load is stepped, a deck for
each contact state, summed.
--contact pair: CalculiX's own contact; the two differ by the penalty and by what each takes for
contact.

Examples:
  plane-contact compare strand --variant tied
  plane-contact compare strand --variant unilateral --coupling mortar --friction 0
  plane-contact compare strand --variant unilateral --friction 0 --contact pair --penalty 1e7")]
#[command(mut_arg("json", |json| json.help("Print compare.json in place of the tables; files are written only to a folder that --out names")))]
pub struct Args {
    /// Path of a scene, or the name of an embedded one.
    #[arg(value_name = "SCENE")]
    scene: PathBuf,
    /// The code.
    #[arg(long, value_name = "CODE", default_value = "calculix", value_parser = offered::<Code>(Code::ALL))]
    with: Code,
    #[command(flatten)]
    deck: DeckArgs,
    /// The program of CalculiX.
    #[arg(long, value_name = "PROGRAM", default_value = "ccx")]
    ccx: String,
    /// Folder for data and pictures [default: out/<scene>-<variant>-calculix-<contact>, and every
    /// option that differs from the scene's own].
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    #[command(flatten)]
    tables: TablesArgs,
}

pub fn run(args: &Args) -> Result<()> {
    args.tables.check()?;
    if let Some(out) = &args.out {
        files::check_folder(out, &["nodes.csv", "elements.csv", "compare.json"])?;
    }
    let Code::Calculix = args.with;
    calculix::check(&args.ccx)?;
    let solution = args.deck.solve(&args.scene)?;
    let request = solution.request.clone();
    let (solution, certainty) = certain(solution);
    let parts = args.deck.parts(&solution)?;
    let (scene, model) = (&solution.request.scene, &solution.model);
    let ran = waiting("running ccx", || calculix::run(&args.ccx, scene, model, &parts))?;
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
