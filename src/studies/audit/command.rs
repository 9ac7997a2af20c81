//! `plane-contact audit`.

use std::io::IsTerminal;
use std::path::{Path, PathBuf};

use crate::audit::claims::{Claim, ClaimId, by_reading};
use crate::audit::findings::{Finding, FindingId};
use crate::audit::prices;
use crate::audit::range::{Range, range};
use crate::audit::words::{self, Depth};
use crate::audit::{Audit, Case, audit, steps, tables};
use crate::audit::{claims::claim_tables as claims, prices::price_tables as price_report};
use base::error::InputError;
use engine::error::Result;
use output::json;
use paper::mirror::Reading;
use problem::scene::Scene;

use commands::{ReadingArg, TablesArgs, note, offered, print, progress, waiting, width};

/// Show what every ambiguity and every finding does on a scene.
#[derive(clap::Args)]
#[command(after_help = "\
One screen: the verdict, the paper's runs beside the equilibrium, the verdicts on its \
claims, what each fault costs, what was assumed. --full prints the whole: what the verdict \
leaves out, the claims of the paper in full, the readings (what each other value changes), the \
findings (present, not triggered here, contradicted; with a number), and the variants side by side. \
--finding explains one on its smallest scene, or on SCENE where that is given; --claim judges one: \
the paper's sentence, what is judged, threshold, value, and the verdict under each other reading. \
--reading audits under another reading than the default, to see whether it rescues a claim. All \
figures are repeated on inputs that mean the same; one that moves by more than a millionth is \
'decided by rounding', and left out. The whole takes 150 to 300 times as long as solve.

A variant that runs to its end and passes no load on, as printed does, is an audit result, no \
failure: solve and audit say 'nothing transmitted', their JSON transmits_nothing.

Examples:
  plane-contact audit
  plane-contact audit fig1 --json
  plane-contact audit fig1 --full
  plane-contact audit --range
  plane-contact audit --finding C4
  plane-contact audit strand --finding K1
  plane-contact audit fig1 --prices
  plane-contact audit fig1 --prices --repairs
  plane-contact audit --claim P12
  plane-contact audit --reading R1=inside,R5=node_n")]
pub struct Args {
    /// Path of a scene, or the name of an embedded one [default: strand; with --finding, the
    /// finding's own].
    #[arg(value_name = "SCENE")]
    scene: Option<PathBuf>,
    /// Explain one finding.
    #[arg(long, value_name = "ID", value_parser = offered::<FindingId>(FindingId::ALL))]
    finding: Option<FindingId>,
    /// Explain and judge one claim of the paper.
    #[arg(long, value_name = "ID", conflicts_with = "finding",
        value_parser = offered::<ClaimId>(ClaimId::ALL))]
    claim: Option<ClaimId>,
    /// Judge the claims over the range of what the paper leaves open too: clearance, radius, mesh,
    /// shape of the stamp, unit of c_tol; takes several times as long.
    #[arg(long, conflicts_with_all = ["scene", "finding", "claim", "prices"])]
    range: bool,
    /// Run the corrected algorithm (plane-contact guide corrected), and the same with each printed fault
    /// reintroduced, and show what each costs. It takes half a minute on strand. Of --reading only what
    /// changes the model matters (R6, R8).
    #[arg(long, conflicts_with_all = ["finding", "claim"])]
    prices: bool,
    /// Then repair the print one finding after the other. The order is found from the end: faults are
    /// reintroduced, each time the one that leaves the least error. It takes a few minutes on strand.
    #[arg(long, requires = "prices")]
    repairs: bool,
    /// Print everything: verdict, claims, prices, readings, findings and variants.
    #[arg(long, conflicts_with_all = ["finding", "claim", "prices"])]
    full: bool,
    #[command(flatten)]
    reading: ReadingArg,
    #[command(flatten)]
    tables: TablesArgs,
}

pub fn run(args: &Args) -> Result<()> {
    match (args.finding, args.claim) {
        (Some(id), _) => explain(args, Finding::of(id)),
        (None, Some(id)) => judge_one(args, Claim::of(id)),
        (None, None) if args.prices => prices(args),
        (None, None) => whole(args),
    }
}

fn prices(args: &Args) -> Result<()> {
    args.tables.check()?;
    let reading = args.reading.reading;
    let case = case(args)?;
    let runs_of_repairs = if args.repairs { prices::runs_of_repairs() } else { 0 };
    let runs = prices::runs() + runs_of_repairs;
    let bar = progress("running", runs, "run {pos} of {len} {wide_bar} {eta}");
    let watch = || bar.inc(1);
    let alone = prices::on(&case, &watch)?;
    let repairs = match args.repairs {
        true => prices::repairs(&case, &alone, &watch)?,
        false => Vec::new(),
    };
    bar.finish();
    let document = price_report::PricesOnScene { reading, prices: &alone, repairs: &repairs };
    let report = || price_report::report(&document, &case.scene);
    args.tables.print_either(Some(&case.scene), &document, report)
}

/// Opens the case of the scene that is asked for.
fn case(args: &Args) -> Result<Case> {
    let scene = Scene::open(args.scene.as_deref().unwrap_or(Path::new("strand")))?;
    scene.check_friction()?;
    Ok(Case::within_memory(&scene, args.reading.reading)?)
}

/// Returns the places of the range, none where they are not asked for.
fn places(args: &Args) -> Result<Range> {
    let reading = args.reading.reading;
    if !args.range {
        return Ok(Vec::new());
    }
    if reading.r8 != Reading::default().r8 {
        let what = "R8, the unit of c_tol, is one of the things that the range tries";
        return Err(InputError::new("--reading", what, "leave R8 or --range out").into());
    }
    Ok(range(reading)?)
}

/// Judges one claim on the scene.
fn judge_one(args: &Args, claim: &Claim) -> Result<()> {
    let reading = args.reading.reading;
    let case = case(args)?;
    let (judged, by_reading) = waiting("judging", || {
        (claim.judge(&case, &Vec::new()), by_reading(std::slice::from_ref(claim), &case))
    });
    let document = claims::ClaimOnScene { judged: &judged, by_reading: &by_reading };
    let report = || claims::explanation(&document, &case.scene, &reading);
    args.tables.print_either(Some(&case.scene), &document, report)
}

fn explain(args: &Args, finding: &Finding) -> Result<()> {
    let scene = match &args.scene {
        Some(scene) => Scene::open(scene)?,
        None => finding.scene(),
    };
    let reading = args.reading.reading;
    let case = Case::within_memory(&scene, reading)?;
    let measured = finding.measure(&case);
    let row = tables::FindingRow { finding, measured: &measured };
    let report = || tables::explanation(finding, &measured, &case.scene, &reading);
    args.tables.print_either(Some(&case.scene), &row, report)
}

fn whole(args: &Args) -> Result<()> {
    args.tables.check()?;
    let case = case(args)?;
    let places = places(args)?;
    if !std::io::stderr().is_terminal() {
        note(&format!("auditing {}: it takes from seconds to minutes\n", case.scene.name));
    }
    let bar = progress("auditing", steps(), "auditing {pos} of {len} {wide_bar} {eta}").logged();
    let watch = || bar.inc(1);
    let is_whole = args.full || args.range || args.tables.is_whole();
    let found = audit(&case, &places, is_whole, &watch);
    bar.finish();
    if is_whole {
        if args.tables.json {
            return print(&json::line(Some(&found.scene), &found));
        }
        let report = words::report(&found, Depth::Full);
        if args.full {
            return args.tables.print(report);
        }
        print_screen(&found)?;
        return args.tables.write(&report);
    }
    print_screen(&found)
}

fn print_screen(found: &Audit) -> Result<()> {
    print(&words::report(found, Depth::Screen).text(width().min(words::WIDTH)))
}
