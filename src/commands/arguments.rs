//! The arguments that several commands have.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use crate::{offered, offered_readings, print, print_report};
use base::error::InputError;
use base::files;
use base::plain::{shown, six_digits};
use engine::Request;
use engine::error::Result;
use engine::linear::{Inputs, ScalarName, Solver};
use engine::options::Options;
use output::json;
use output::model::Report;
use paper::mirror::Reading;
use problem::modelling::{
    Coupling, Friction, Geometry, StatusRule, Variant, check_iterations, check_tolerance,
};
use problem::scene::{Scene, SceneBuilder};
use serde::Serialize;

/// The option of the commands that execute or mirror a listing.
#[derive(clap::Args)]
pub struct ReadingArg {
    /// The readings that differ from the default.
    #[arg(long, value_name = "LIST", default_value = "", hide_default_value = true, value_parser = offered_readings(),
        help = Reading::help())]
    pub reading: Reading,
}

/// How a scene is run.
#[derive(clap::Args)]
pub struct RunArgs {
    #[arg(long, help = format!("{} [default: the scene's]", Variant::help()), value_parser = offered::<Variant>(Variant::ALL))]
    variant: Option<Variant>,
    /// Run the reference solution: unilateral with mortar, without friction, in small displacements.
    #[arg(long, conflicts_with_all = ["variant", "coupling", "friction", "geometry", "load_steps", "status",
        "scalar", "solver"])]
    reference: bool,
    #[command(flatten)]
    method: MethodArgs,
}

impl RunArgs {
    /// Returns what is asked of a scene.
    ///
    /// # Errors
    /// Those of [`Options::request`].
    pub fn request(&self, scene: &Scene) -> Result<Request> {
        if self.reference {
            return Ok(Request::new(scene).reading(self.method.reading.reading).reference());
        }
        Ok(self.method.options(self.variant).request(scene)?)
    }
}

/// How a variant of a scene is run.
#[derive(clap::Args)]
pub struct MethodArgs {
    #[command(flatten)]
    model: ModelArgs,
    #[arg(long, value_name = "NAME", default_value = "f64", help = ScalarName::help(),
        value_parser = offered::<ScalarName>(ScalarName::ALL))]
    scalar: ScalarName,
    #[arg(long, value_name = "NAME", value_parser = offered::<Solver>(Solver::ALL), help = format!(
        "{} [default: sparse-cholesky; sparse-lu under printed in f64]",
        Solver::help()
    ))]
    solver: Option<Solver>,
    #[arg(long, value_name = "NAME", default_value = "binary", value_parser = offered::<Inputs>(Inputs::ALL), help = format!(
        "What the numbers of the scene stand for. {}",
        Inputs::help()
    ))]
    inputs: Inputs,
    #[command(flatten)]
    reading: ReadingArg,
}

impl MethodArgs {
    /// Returns what is asked of a variant of a scene, of the scene's own where none is given.
    pub fn options(&self, variant: Option<Variant>) -> Options {
        Options {
            scalar: Some(self.scalar),
            solver: self.solver,
            inputs: Some(self.inputs),
            ..self.model.options(variant, &self.reading)
        }
    }
}

/// How contact is modelled beyond what the paper prints, in place of what the scene says.
#[derive(clap::Args)]
pub struct ModelArgs {
    #[arg(long, help = format!("{} [default: the scene's]", Coupling::help()), value_parser = offered::<Coupling>(Coupling::ALL))]
    coupling: Option<Coupling>,
    /// Under unilateral: Coulomb's coefficient, 0 (contact nodes slide freely), or stick (they never
    /// slide); under printed, tied and stepped it changes only the equilibrium that they are
    /// compared with [default: the scene's].
    #[arg(long, value_name = "MU")]
    friction: Option<Friction>,
    #[arg(long, value_parser = offered::<Geometry>(Geometry::ALL), help = format!(
        "Under unilateral, the shape in which contact is measured. {} [default: the scene's]",
        Geometry::help()
    ))]
    geometry: Option<Geometry>,
    /// Under unilateral with friction, the number of equal steps in which the load of a stage grows
    /// [default: the scene's, or 16].
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=100_000))]
    load_steps: Option<u32>,
    #[arg(long, value_name = "RULE", value_parser = offered::<StatusRule>(StatusRule::ALL), help = format!(
        "Under tied and stepped, who is in contact. {} [default: the scene's]",
        StatusRule::help()
    ))]
    status: Option<StatusRule>,
}

impl ModelArgs {
    /// Returns what is given.
    pub fn options(&self, variant: Option<Variant>, reading: &ReadingArg) -> Options {
        Options {
            variant,
            reading: reading.reading,
            coupling: self.coupling,
            friction: self.friction,
            geometry: self.geometry,
            load_steps: self.load_steps.map(|n| n as usize),
            status: self.status,
            ..Options::default()
        }
    }
}

/// What a run changes of its scene; the result is that of a scene file edited so.
#[derive(clap::Args)]
pub struct SceneArgs {
    /// The tolerance of the contact search in place of the scene's, length.
    #[arg(long, value_name = "LENGTH", allow_negative_numbers = true)]
    c_tll: Option<f64>,
    /// Print every iteration, where there are many. With N: make N of them under printed, tied and stepped,
    /// in place of the scene's number.
    #[arg(long, value_name = "N")]
    iterations: Option<Option<usize>>,
    /// Multiply all loads of the scene.
    #[arg(long, value_name = "F", allow_negative_numbers = true)]
    load_factor: Option<f64>,
}

impl SceneArgs {
    /// Returns the scene as it is with the changes.
    ///
    /// # Errors
    /// A value is out of its range, or the scene has no contact that has a tolerance.
    pub fn change(&self, scene: Scene) -> Result<Scene> {
        if self.names().is_empty() {
            return Ok(scene);
        }
        let (mut description, mesh) = (scene.source().0.clone(), scene.source().1.clone());
        let at = |option: &'static str| move |why| InputError { place: option.into(), ..why };
        if let Some(tolerance) = self.c_tll {
            check_tolerance(tolerance).map_err(at("--c-tll"))?;
            let contact = description.contact.as_mut().ok_or_else(|| {
                InputError::new("--c-tll", "the scene has no contact", "leave it out")
            })?;
            contact.tolerance = tolerance;
        }
        if let Some(iterations) = self.iterations.flatten() {
            check_iterations(iterations).map_err(at("--iterations"))?;
            description.iterations = iterations;
        }
        if let Some(factor) = self.load_factor
            && !description.loads.iter_mut().all(|load| load.scale(factor))
        {
            let what = format!("{} times the loads is no finite number", six_digits(factor));
            let fix = "give a number such as 0.5";
            return Err(InputError::new("--load-factor", what, fix).into());
        }
        Ok(SceneBuilder { name: scene.name.clone(), mesh, description }.build()?)
    }

    /// Returns whether every iteration is to be printed.
    pub fn all_iterations(&self) -> bool {
        self.iterations.is_some()
    }

    /// Returns the changes as parts of a folder's name.
    pub fn names(&self) -> Vec<String> {
        let c_tll = self.c_tll.map(|x| format!("c-tll-{x:e}"));
        let iterations = self.iterations.flatten().map(|n| format!("iterations-{n}"));
        let factor = self.load_factor.map(|x| format!("load-factor-{x}"));
        [c_tll, iterations, factor].into_iter().flatten().collect()
    }
}

/// The most bytes of a file of listings; the paper's two have 5,000.
const LARGEST_LISTING: u64 = 1 << 24;

/// Reads a file of listings.
///
/// # Errors
/// The file cannot be read, is too long, or is no text.
pub fn read_listing(path: &Path) -> Result<String, InputError> {
    let file = files::read_most(path, LARGEST_LISTING);
    file.and_then(files::text).map_err(|why| {
        let what = format!("the listing cannot be read: {why}");
        InputError::new(shown(path), what, "give the path of a text file of listings")
    })
}

/// Returns the name of the default folder of a run: `start`, and every option that differs from what
/// the scene and the program do by themselves, so that no two results share one.
pub fn folder_name(start: String, request: &Request, more: &[String]) -> String {
    let words =
        Options::from_request(request).given().filter_map(|(option, value)| match &*option {
            "variant" | "iterations" | "c_tll" => None,
            "friction" | "load_steps" => Some(format!("{}-{value}", option.replace('_', "-"))),
            _ => Some(value),
        });
    let words = words.chain(more.iter().cloned());
    words.fold(start, |name, word| format!("{name}-{word}"))
}

/// The folder or file that is asked for, else `name` in the folder `out`.
pub fn folder(asked: &Option<PathBuf>, name: String) -> PathBuf {
    asked.clone().unwrap_or_else(|| Path::new("out").join(name))
}

/// The file that tells that a folder of tables is this program's: CSV has no place for it.
const TABLES: &str = "tables.json";

/// What is printed: tables, which go to a folder too, or JSON in their place.
#[derive(clap::Args)]
pub struct TablesArgs {
    /// Print JSON.
    #[arg(long)]
    pub json: bool,
    /// Write each table that is printed to a folder too, as CSV.
    #[arg(long, value_name = "DIR", conflicts_with = "json")]
    csv: Option<PathBuf>,
}

impl TablesArgs {
    /// Returns whether more is asked for than what is printed for people: JSON, or tables as files.
    pub fn is_whole(&self) -> bool {
        self.json || self.csv.is_some()
    }

    /// Checks that tables can be written, before they are computed.
    ///
    /// # Errors
    /// Those of [`files::check_folder`].
    pub fn check(&self) -> Result<()> {
        Ok(self.csv.iter().try_for_each(|folder| files::check_folder(folder, &[TABLES]))?)
    }

    /// Writes the tables of a report where that was asked for; `tables.json`, which names them, marks their
    /// folder.
    ///
    /// # Errors
    /// A file cannot be written.
    pub fn write(&self, report: &Report) -> Result<()> {
        let Some(folder) = &self.csv else { return Ok(()) };
        let tables = report.csv().into_iter();
        let mut tables: Vec<_> = tables.map(|(name, csv)| (name + ".csv", csv)).collect();
        let names: Vec<_> = tables.iter().map(|(name, _)| name).collect();
        let mark = json::line(None, &BTreeMap::from([("tables", names)]));
        tables.push((TABLES.into(), mark));
        Ok(files::write_all(folder, &tables)?)
    }

    /// Prints what was computed on a scene as JSON, where that is asked for, else its report.
    ///
    /// # Errors
    /// Those of [`TablesArgs::print`].
    pub fn print_either(
        &self,
        scene: Option<&Scene>,
        own: &impl Serialize,
        report: impl FnOnce() -> Report,
    ) -> Result<()> {
        if self.json { print(&json::line(scene, own)) } else { self.print(report()) }
    }

    /// Prints a report, and writes its tables.
    ///
    /// # Errors
    /// Standard output or a file cannot be written.
    pub fn print(&self, report: Report) -> Result<()> {
        // What was computed is shown, whatever is in the way of the files.
        print_report(report.clone())?;
        self.write(&report)
    }
}
