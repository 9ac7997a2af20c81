//! `plane-contact export`.

use std::path::{Path, PathBuf};

use plane_contact::engine::error::Result;
use plane_contact::engine::{self, Solution};
use plane_contact::error::InputError;
use plane_contact::files;
use plane_contact::paper::door;
use plane_contact::problem::modelling::Variant;
use plane_contact::problem::scene::Scene;
use plane_contact::report::exports::{Export, Run, mathcad, octave, probe};
use plane_contact::studies::calculix::{Contact, ContactKind, Pair, Part, Problem, deck};

use super::{ModelArgs, ReadingArg, waiting, write_or_print};

plane_contact::choices! {
    /// A code that a scene can be exported to.
    Code {
        /// Mathcad 14 and 15: a worksheet.
        Mathcad = "mathcad",
        /// Octave and MATLAB: a function file.
        Octave = "octave",
        /// CalculiX: an input deck.
        Calculix = "calculix",
    }
}

/// Write a scene for another program: a worksheet of Mathcad, a program for Octave and MATLAB, or
/// an input deck of CalculiX.
#[derive(clap::Args)]
#[command(after_help = "\
mathcad and octave write the listings as printed with the scene's tables, and the iterations of the
variant printed with our results beside; --probe writes questions to Mathcad that no source answers.
Octave wants the file called as its function: NAME.m.

calculix: the deck runs as it is: ccx FILE without .inp. --contact equation writes eq. (1) as the variant's
last iteration has it, with the whole load; --contact pair lets CalculiX look for contact itself,
from the initial shape.

Examples:
  plane-contact export fig1 --to mathcad --out fig1.xmcd
  plane-contact export --to mathcad --probe --out probe.xmcd
  plane-contact export fig1 --to octave --out fig1.m
  plane-contact export fig1 --to calculix
  plane-contact export strand --to calculix --variant tied --out strand.inp
  plane-contact export strand --to calculix --variant unilateral --coupling mortar --friction 0
  plane-contact export strand --to calculix --contact pair --penalty 1e7 --friction 0 \
                       --out strand.inp")]
pub struct Args {
    /// Path of a scene, or the name of an embedded one.
    #[arg(value_name = "SCENE", required_unless_present = "probe")]
    scene: Option<String>,
    /// The code.
    #[arg(long, value_name = "CODE")]
    to: Code,
    #[command(flatten)]
    deck: DeckArgs,
    /// With --to mathcad: a worksheet of questions in place of a scene.
    #[arg(long)]
    probe: bool,
    /// Write to a file in place of standard output.
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
}

/// What `export` and `compare` share.
#[derive(clap::Args)]
pub struct DeckArgs {
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
    pub fn solve(&self, scene: &str) -> Result<Solution> {
        let scene = Scene::open(scene)?;
        let request = self.model.request(&scene, self.variant, &self.reading);
        if self.contact == ContactKind::Equation {
            Contact::check_equations(request.variant)?;
        }
        waiting("solving", || engine::solve(&request, &mut |_| ()))
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
    args.out.as_deref().map_or(Ok(()), files::check_file)?;
    let text = match args.to {
        Code::Mathcad if args.probe => probe::worksheet(),
        _ if args.probe => {
            let what = "questions are written for Mathcad alone";
            return Err(InputError::new("--probe", what, "add --to mathcad").into());
        }
        Code::Mathcad => listings(args, mathcad::worksheet)?,
        Code::Octave => {
            let name = function_name(args);
            listings(args, |export| octave::program(export, &name))?
        }
        Code::Calculix => calculix(args)?,
    };
    write_or_print(&args.out, &text)
}

/// The scene, which only a worksheet of questions goes without.
fn scene(args: &Args) -> &str {
    args.scene.as_deref().unwrap_or_default()
}

fn calculix(args: &Args) -> Result<String> {
    let solution = args.deck.solve(scene(args))?;
    let parts = args.deck.parts(&solution)?;
    let last = parts.last().expect("a run has an iteration");
    let (scene, model) = (&solution.request.scene, &solution.model);
    Ok(deck(&Problem { scene, model, contact: &last.contact })?)
}

/// Writes the listings with the scene's tables, and the variant `printed` if it can be solved.
fn listings(args: &Args, write: impl Fn(&Export) -> String) -> Result<String> {
    let scene = Scene::open(scene(args))?;
    if args.deck.variant.is_some_and(|variant| variant != Variant::Printed) {
        let what = "the listings as printed are the variant printed";
        return Err(InputError::new("--variant", what, "leave it out, or ask for printed").into());
    }
    let reading = args.deck.reading.reading;
    let request = args.deck.model.request(&scene, Some(Variant::Printed), &args.deck.reading);
    let model = request.model()?;
    if model.nodes.len() > MOST_NODES {
        let what =
            format!("the scene has {} nodes, at most {MOST_NODES} are written", model.nodes.len());
        let fix = "make a coarser mesh";
        return Err(InputError::new(&scene.name, what, fix).into());
    }
    if let Some(n) = model.dropped.first() {
        let what =
            format!("node {n} belongs to no triangle: Km as printed is singular (finding K4)");
        return Err(InputError::new(&scene.name, what, "remove it from the mesh file").into());
    }
    let sheet = door::worksheet(&model, |x| x);
    // Where the run stops, the worksheet has the listings alone.
    let run =
        waiting("solving", || engine::solve(&request, &mut |_| ())).ok().map(|solution| Run {
            force: solution
                .model
                .load_in(|x| x)
                .iter()
                .zip(&model.restrained)
                .map(|(f, restrained)| if *restrained { 0.0 } else { *f })
                .collect(),
            iterations: solution.steps.len(),
            pairs: door::Call::c_cnt(&model, &reading, &model.nodes)
                .expect("the run called it")
                .pairs,
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

/// The most nodes of a scene that Mathcad is given: its matrix has twice as many rows.
const MOST_NODES: usize = 300;

/// The function that the file is called after.
fn function_name(args: &Args) -> String {
    let stem = args.out.as_deref().unwrap_or(Path::new(scene(args))).file_stem();
    let stem = stem.map_or_else(String::new, |stem| stem.to_string_lossy().into_owned());
    let plain = |c: char| if c.is_ascii_alphanumeric() { c } else { '_' };
    let name: String = stem.chars().map(plain).collect();
    if name.starts_with(|c: char| c.is_ascii_alphabetic()) { name } else { format!("scene_{name}") }
}
