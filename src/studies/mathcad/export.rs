//! `plane-contact mathcad export`.

use std::path::PathBuf;

use base::error::InputError;
use base::files;
use engine::error::{Error, Result};
use engine::{self, Request};
use output::exports::{CorrectedExport, Export, Iterated, mathcad, octave};
use paper::corrected::{Bound, STEPS, Worksheet, check};
use paper::door;
use problem::model::Model;
use problem::modelling::Variant;
use problem::scene::Scene;

use commands::{ReadingArg, offered, print_stderr, waiting, write_or_print};

base::choices! {
    /// What executes the listings.
    Target {
        /// Mathcad 14 and 15: a worksheet.
        Mathcad = "mathcad",
        /// Octave and MATLAB: a script.
        Octave = "octave",
    }
}

/// Write the listings with a scene's tables: a worksheet, or a program for Octave and MATLAB.
#[derive(clap::Args)]
#[command(after_help = "\
The listings are those printed, with the iterations of the variant printed and our results beside them. \
octave FILE.m executes the program, from any folder; MATLAB does from R2024a on, where FILE is a name \
of MATLAB's. --corrected writes the corrected algorithm of plane-contact guide corrected in place of the \
listings: no friction, in the initial geometry.

Examples:
  plane-contact mathcad export fig1 --out fig1.xmcd
  plane-contact mathcad export fig1 --to octave --out fig1.m
  plane-contact mathcad export fig1 --corrected --out corrected.xmcd")]
pub struct Args {
    /// Path of a scene, or the name of an embedded one.
    #[arg(value_name = "SCENE")]
    scene: String,
    /// mathcad or octave.
    #[arg(long, value_name = "PROGRAM", default_value = "mathcad", value_parser = offered::<Target>(Target::ALL))]
    to: Target,
    /// Write the corrected algorithm.
    #[arg(long, conflicts_with = "reading")]
    corrected: bool,
    #[command(flatten)]
    reading: ReadingArg,
    /// Write to a file in place of standard output.
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
}

pub fn run(args: &Args) -> Result<()> {
    let mark = match args.to {
        Target::Mathcad => files::WORKSHEET,
        Target::Octave => files::PER_CENT,
    };
    write_or_print(&args.out, mark, || match (args.to, args.corrected) {
        (Target::Mathcad, false) => listings(args, mathcad::worksheet),
        (Target::Mathcad, true) => corrected(args, mathcad::corrected),
        (Target::Octave, false) => listings(args, octave::program),
        (Target::Octave, true) => corrected(args, octave::corrected),
    })
}

/// Writes the listings with the scene's tables, and the variant `printed` if it can be solved.
fn listings(args: &Args, write: impl Fn(&Export) -> String) -> Result<String> {
    let scene = Scene::open(&args.scene)?;
    let reading = args.reading.reading;
    let request = Request::new(&scene).variant(Variant::Printed).reading(reading);
    let model = request.model()?;
    check_size(&scene, &model)?;
    door::check_restraints(&model)?;
    if let Some(n) = model.dropped.first() {
        let what =
            format!("node {n} belongs to no triangle: Km as printed is singular (finding K4)");
        return Err(InputError::new(&scene.name, what, "remove it from the mesh file").into());
    }
    let sheet = door::worksheet(&model, |x| x);
    // Where the published algorithm stops, the worksheet has the listings alone.
    let solved = waiting("solving", || engine::solve(&request, &mut |_| ()));
    let run = Error::found(solved)?.map(|solution| Iterated {
        force: model.free_part(&solution.model.load_in(|x| x)).as_slice().to_vec(),
        iterations: solution.steps.len(),
        pairs: door::Call::c_cnt(&model, &reading, &model.nodes).expect("the run called it").pairs,
        u: solution.u.iter().copied().collect(),
        stress: solution.elements.iter().map(|state| state.von_mises_stress).collect(),
    });
    Ok(write(&Export {
        title: &scene.title,
        sheet: &sheet,
        reading: &reading,
        node_n: &sheet.node,
        thickness: model.thickness,
        run,
    }))
}

/// Writes the corrected algorithm with the scene's tables and load, and its displacements.
fn corrected(args: &Args, write: impl Fn(&CorrectedExport) -> String) -> Result<String> {
    let scene = Scene::open(&args.scene)?;
    let model = &*scene.model;
    check_size(&scene, model)?;
    check(model)?;
    let ending = waiting("executing", || Worksheet::new(model, Bound::Normal).iterate(&[], STEPS));
    let ending = ending.map_err(|failure| {
        let fix = "restrain the bodies; contact alone leaves one free to move";
        InputError::new(&scene.name, failure.to_string(), fix)
    })?;
    if !ending.is_settled {
        print_stderr(&format!(
            "warning: on {} the contact pairs do not come back within {STEPS} iterations: u is that of the \
             last one, no solution\n",
            scene.name
        ));
    }
    Ok(write(&CorrectedExport {
        title: &scene.title,
        sheet: &door::worksheet(model, |x| x),
        thickness: model.thickness,
        force: model.load_in(|x| x).iter().copied().collect(),
        u: ending.u,
    }))
}

fn check_size(scene: &Scene, model: &Model) -> Result<(), InputError> {
    if model.nodes.len() <= MOST_NODES {
        return Ok(());
    }
    let what =
        format!("the scene has {} nodes, at most {MOST_NODES} are written", model.nodes.len());
    Err(InputError::new(&scene.name, what, "make a coarser mesh"))
}

/// The most nodes of a scene that Mathcad is given: its matrix has twice as many rows.
const MOST_NODES: usize = 300;
