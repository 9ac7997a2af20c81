//! `plane-contact listing run`.

use std::path::PathBuf;
use std::sync::Arc;

use base::error::InputError;
use base::files::PER_CENT;
use base::limits;
use base::plain::shown;
use engine::Request;
use engine::error::Result;
use numbers::square::SparseSquare;
use output::{json, matrix_market, tables};
use paper::door::{Call, check_restraints, node_n};
use paper::edited::{Edited, Interpreter};
use paper::listings;
use paper::mirror::Reading;
use problem::model::Model;
use problem::modelling::Variant;
use problem::scene::Scene;

use commands::{ReadingArg, TablesArgs, read_listing, write_or_print};

commands::group! {
    /// Run a listing once, at the initial shape of a scene.
    #[command(after_help = "\
Examples:
  plane-contact listing run c_cnt fig1
  plane-contact listing run Km fig1")]
    Command {
        #[command(name = "c_cnt")]
        CCnt(CCntArgs): c_cnt,
        #[command(name = "Km")]
        Km(KmArgs): km,
    }
}

/// Find the contact pairs.
#[derive(clap::Args)]
#[command(after_help = "\
Prints, by contact node, ct (elem number of the target edge), yt (vertical distance), dy (1 = in \
contact), then the rows of k_cnt that are not zero. --json: {\"cnt\": [...], \"ct\": [...], \
\"yt\": [...], \"dy\": [...], \"k_cnt\": [[master, weight, master, weight], ...]}; cnt is as the \
scene lists it.

Examples:
  plane-contact listing run c_cnt fig1
  plane-contact listing run c_cnt fig1 --reading R4=left-to-right    the listing stops
  plane-contact listing run c_cnt fig1 --listing my-c_cnt.txt        as edited, also in a lesson
  plane-contact listing run c_cnt my/scene.json --json")]
pub struct CCntArgs {
    /// Path of a scene, or the name of an embedded one.
    #[arg(value_name = "SCENE")]
    scene: PathBuf,
    /// Run this edited listing in place of the printed one (notation: plane-contact guide notation).
    #[arg(long, value_name = "FILE")]
    listing: Option<PathBuf>,
    #[command(flatten)]
    reading: ReadingArg,
    #[command(flatten)]
    tables: TablesArgs,
}

/// Assemble the stiffness matrix MJS.
#[derive(clap::Args)]
#[command(after_help = "\
Writes MJS in Matrix Market coordinate format, 17 significant digits, zeros left out.

Examples:
  plane-contact listing run Km fig1
  plane-contact listing run Km fig1 --coupled-by none
  plane-contact listing run Km strand --matrix-market MJS.mtx --reading R3=nested")]
pub struct KmArgs {
    /// Path of a scene, or the name of an embedded one.
    #[arg(value_name = "SCENE")]
    scene: PathBuf,
    /// Write to a file in place of standard output.
    #[arg(long, value_name = "FILE")]
    matrix_market: Option<PathBuf>,
    /// The contact pairs that enter. c-cnt: those of c_cnt at the initial shape; none: no pair.
    #[arg(long, value_name = "PAIRS", default_value = "c-cnt")]
    coupled_by: CoupledBy,
    /// Run this edited listing in place of the printed one (notation: plane-contact guide notation).
    #[arg(long, value_name = "FILE")]
    listing: Option<PathBuf>,
    #[command(flatten)]
    reading: ReadingArg,
}

#[derive(Clone, Copy, clap::ValueEnum)]
enum CoupledBy {
    CCnt,
    None,
}

/// Returns the model with the scene's contact nodes as it lists them, whatever its variant.
fn model(scene: &Scene, reading: Reading) -> Result<Arc<Model>> {
    Ok(Request::new(scene).variant(Variant::Printed).reading(reading).model()?)
}

fn c_cnt(args: &CCntArgs) -> Result<()> {
    let reading = args.reading.reading;
    let scene = Scene::open(&args.scene)?;
    let model = model(&scene, reading)?;
    let call = match interpreter(&args.listing, listings::Which::CCnt, &model, &reading)? {
        None => Call::c_cnt(&model, &reading, &model.nodes)?,
        Some(edited) => {
            let found = edited.c_cnt(&node_n(&model, &model.nodes));
            Call::of_pairs(&model, found.expect("c_cnt is edited")?)
        }
    };
    let report = || tables::pairs(&scene, &model, &reading, &call);
    args.tables.print_either(Some(&scene), &json::found(&call), report)
}

fn km(args: &KmArgs) -> Result<()> {
    write_or_print(&args.matrix_market, PER_CENT, || matrix(args))
}

/// Returns the matrix, as Matrix Market.
fn matrix(args: &KmArgs) -> Result<String> {
    let reading = args.reading.reading;
    let scene = Scene::open(&args.scene)?;
    let model = model(&scene, reading)?;
    limits::DENSE.check(model.dofs(), "the mesh")?;
    check_restraints(&model)?;
    let call = match args.coupled_by {
        CoupledBy::CCnt => Call::c_cnt(&model, &reading, &model.nodes)?,
        CoupledBy::None => Call::without_contact(&model),
    };
    let matrix = match interpreter(&args.listing, listings::Which::Km, &model, &reading)? {
        None => call.km(&reading)?,
        Some(edited) => {
            let table = edited.km(&call.pairs.k_cnt).expect("Km is edited")?;
            SparseSquare::from_dense(table.as_matrix())
        }
    };
    let comment = format!("MJS of scene {}: equation 2n-1 is x of node n, 2n is y", scene.name);
    Ok(matrix_market::matrix_market(&matrix, &comment))
}

/// Returns what executes an edited listing; nothing where the printed one is run.
fn interpreter(
    file: &Option<PathBuf>,
    which: listings::Which,
    model: &Model,
    reading: &Reading,
) -> Result<Option<Interpreter>> {
    let Some(file) = file else { return Ok(None) };
    let edited = Edited::new(&shown(file), &read_listing(file)?)?;
    if edited.which != which {
        let what = format!("it is the listing {}, not {which}", edited.which);
        let fix = format!("run it by listing run {}", edited.which);
        return Err(InputError::new(shown(file), what, fix).into());
    }
    Ok(Some(Interpreter::new(model, reading, &[edited])))
}
