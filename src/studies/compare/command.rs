//! `plane-contact compare`.

use std::path::{Path, PathBuf};

use clap::ValueHint;
use nalgebra::DVector;

use super::comparison::{self, Compared};
use super::{Beside, Rows};
use crate::calculix::arguments::DeckArgs;
use crate::calculix::{self, ContactKind};
use base::error::InputError;
use base::exit::ExitStatus;
use base::plain::six_digits;
use engine::error::{Error, Result};
use engine::estimates::certain;
use engine::{self, Request, max_displacement};
use problem::scene::Scene;

use commands::{TablesArgs, print, waiting};

/// The tolerance where none is asked for: that of another code's contact by penalty.
const TOLERANCE: f64 = 1e-3;

/// The largest displacement over the size of the mesh: more is no slip of units, of metres for nanometres.
const FARTHEST: f64 = 1e9;

/// Put displacements from another code beside a solution, and show the differences.
#[derive(clap::Args)]
#[command(after_help = "\
--with FIELD: displacements on the scene's mesh, in its unit of length, as CSV (columns node or \
x, y, then ux, uy, as the nodes.csv of solve --csv), beside the equilibrium (unilateral with mortar \
and the scene's friction), or the run of --variant. Other files go through Python (guide scenes).

--with calculix: exports the scene to a temporary folder, runs ccx there, and puts its displacements \
beside the run of --variant, else of the scene's. Where the last digit decides who is in contact \
in f64, it is the run in double-doubles.
--contact equation: the same linear systems solved by both; where the load is stepped, a deck for \
each contact state, summed.
--contact pair: CalculiX's own contact; the two differ by the penalty and by what each takes for \
contact.

Stresses, penetration, traction and forces are those that the displacements imply. The exit status \
tells a difference beyond --rtol. Nothing is written but --csv.

Examples:
  plane-contact compare my/block.json --with other.csv
  plane-contact compare strand --friction 0 --with csv/nodes.csv --rtol 0.1
  plane-contact compare strand --variant tied
  plane-contact compare strand --variant unilateral --coupling mortar --friction 0
  plane-contact compare strand --variant unilateral --friction 0 --contact pair --penalty 1e7")]
pub struct Args {
    /// Path of a scene, or the name of an embedded one.
    #[arg(value_name = "SCENE")]
    scene: PathBuf,
    /// calculix, which is run, or a .csv file of displacements.
    #[arg(long, value_name = "CODE|FIELD", default_value = "calculix", value_parser = source, value_hint = ValueHint::FilePath)]
    with: Source,
    /// The largest difference that is none, over the largest displacement and in the energy norm [default:
    /// with a field 1e-3, with calculix any].
    #[arg(long, value_name = "R", value_parser = tolerance)]
    rtol: Option<f64>,
    #[command(flatten)]
    deck: DeckArgs,
    /// The program of CalculiX [default: ccx].
    #[arg(long, value_name = "PROGRAM")]
    ccx: Option<String>,
    #[command(flatten)]
    tables: TablesArgs,
}

/// Where displacements come from.
#[derive(Clone)]
enum Source {
    Calculix,
    File(PathBuf),
}

fn source(text: &str) -> Result<Source, String> {
    match Path::new(text).extension() {
        Some(_) => Ok(Source::File(text.into())),
        None if text == "calculix" => Ok(Source::Calculix),
        None => Err("it is neither calculix nor a .csv file".into()),
    }
}

fn tolerance(text: &str) -> Result<f64, String> {
    let tolerance: f64 = text.parse().map_err(|_| "it is no number".to_string())?;
    let possible = Some(tolerance).filter(|x| *x >= 0.0 && x.is_finite());
    possible.ok_or_else(|| "it is negative or not finite".into())
}

/// Compares a scene; returns whether the field differs beyond the tolerance.
pub fn run(args: &Args) -> Result<ExitStatus> {
    args.tables.check()?;
    match &args.with {
        Source::Calculix => beside_calculix(args),
        Source::File(path) => beside_file(args, path),
    }
}

fn beside_calculix(args: &Args) -> Result<ExitStatus> {
    let ccx = args.ccx.as_deref().unwrap_or("ccx");
    calculix::check(ccx)?;
    let scene = Scene::open(&args.scene)?;
    let (solution, certainty) = certain(args.deck.solve(&scene)?);
    let parts = args.deck.parts(&solution)?;
    let ran = waiting("running ccx", || calculix::run(ccx, &scene.title, &solution.model, &parts))?;
    finish(args, &Compared::with_calculix(&solution, certainty, &parts, ran, args.rtol)?)
}

fn beside_file(args: &Args, path: &Path) -> Result<ExitStatus> {
    if args.ccx.is_some()
        || args.deck.penalty.is_some()
        || args.deck.contact != ContactKind::default()
    {
        let what = "--contact, --penalty and --ccx belong to --with calculix";
        return Err(InputError::new("--with", what, "leave them out").into());
    }
    let request = args.deck.reference(&Scene::open(&args.scene)?)?;
    let rows = Rows::read(path)?;
    engine::check(&request)?;
    let (u, how) = rows.on_mesh(&request.scene, &request.scene.model)?;
    let too_large = |what: String| {
        InputError::new(&rows.place, what, "give them in the scene's unit of length")
    };
    check_size(&request, &u).map_err(too_large)?;
    let reference = waiting("solving", || engine::solve(&request, &mut |_| ()));
    let reference = reference.map_err(|why| without_reference(why, &request))?;
    let beside = Beside::new(&reference, u)?;
    if max_displacement(&reference.u) > 0.0 && !beside.distance.energy_relative.is_finite() {
        let what = "the displacements are too large for their energy to be a number";
        return Err(too_large(what.into()).into());
    }
    let about = format!("{}; {} nodes, found {how}", rows.taken, reference.model.nodes.len());
    let compared = Compared {
        other: rows.place,
        about: vec![about],
        calculix: None,
        tolerance: Some(args.rtol.unwrap_or(TOLERANCE)),
        beside,
    };
    finish(args, &compared)
}

/// Prints what was compared.
fn finish(args: &Args, compared: &Compared) -> Result<ExitStatus> {
    match args.tables.json {
        true => print(&comparison::json(compared))?,
        false => args.tables.print(comparison::report(compared))?,
    }
    Ok(ExitStatus::compared(compared.is_same() != Some(false)))
}

/// Checks that no displacement is beyond what a slip of units makes.
fn check_size(request: &Request, u: &DVector<f64>) -> Result<(), String> {
    let size = request.scene.model.bounds().larger_side();
    match u.amax() > FARTHEST * size {
        true => Err(format!(
            "a displacement of {} in a mesh of {}",
            six_digits(u.amax()),
            six_digits(size)
        )),
        false => Ok(()),
    }
}

/// Says that there is nothing to compare with where the published algorithm fails: that is no verdict on it
/// here.
fn without_reference(why: Error, request: &Request) -> Error {
    match why {
        Error::Listing(_) | Error::Execution(_) | Error::Singular(_) => {
            let what = format!("the run of {} does not finish: {why}", request.variant);
            let fix = "leave it out, which compares with the equilibrium, or name another variant";
            InputError::new("--variant", what, fix).into()
        }
        Error::Input(_) | Error::Equilibrium(_) => why,
    }
}
