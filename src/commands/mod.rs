//! The commands: one module for each, one folder for each group.

mod arithmetic;
mod audit;
mod calculix;
mod compare;
mod extremes;
mod lesson;
mod listing;
mod mathcad;
mod report;
mod scene;
mod snapshot;
mod solve;
mod sweep;
mod trade;

use std::collections::BTreeMap;
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};
use std::time::Duration;

use arithmetic::ArithmeticArgs;
use clap::Subcommand;
use clap::error::{ContextKind, ContextValue, ErrorKind};
use indicatif::{ProgressBar, ProgressStyle};
use plane_contact::engine::Request;
use plane_contact::engine::error::{Error, Result};
use plane_contact::error::InputError;
use plane_contact::files;
use plane_contact::numbers::solve::Arithmetic;
use plane_contact::paper::mirror::Reading;
use plane_contact::plain::shown;
use plane_contact::plain::six_digits;
use plane_contact::problem::modelling::{
    ContactModel, Coupling, Friction, Geometry, StatusRule, Variant, check_iterations,
    check_tolerance,
};
use plane_contact::problem::scene::{Scene, SceneBuilder};
use plane_contact::report::json;
use plane_contact::report::model::Report;
use plane_contact::report::text::fitted;

#[derive(Subcommand)]
pub enum Command {
    Solve(solve::Args),
    Extremes(extremes::Args),
    Trade(trade::Args),
    #[command(subcommand)]
    Sweep(sweep::Command),
    Audit(audit::Args),
    Report(report::Args),
    Lesson(lesson::Args),
    Compare(compare::Args),
    #[command(subcommand)]
    Listing(listing::Command),
    #[command(subcommand)]
    Mathcad(mathcad::Command),
    #[command(subcommand)]
    Snapshot(snapshot::Command),
    #[command(subcommand)]
    Scene(scene::Command),
}

impl Command {
    /// Runs the command; returns the exit status.
    pub fn run(self) -> Result<u8> {
        let done = |()| 0;
        match self {
            Command::Solve(args) => solve::run(&args),
            Command::Extremes(args) => extremes::run(&args).map(done),
            Command::Trade(args) => trade::run(&args).map(done),
            Command::Sweep(command) => sweep::run(&command).map(done),
            Command::Audit(args) => audit::run(&args).map(done),
            Command::Report(args) => report::run(&args).map(done),
            Command::Lesson(args) => lesson::run(&args).map(done),
            Command::Compare(args) => compare::run(&args).map(done),
            Command::Listing(command) => listing::run(&command),
            Command::Mathcad(command) => mathcad::run(&command),
            Command::Snapshot(command) => snapshot::run(&command),
            Command::Scene(command) => scene::run(&command).map(done),
        }
    }
}

/// The commands as the first page of help groups them.
const GROUPS: [(&str, &[&str]); 5] = [
    ("Compute", &["solve", "compare", "trade", "extremes", "sweep"]),
    ("Audit and teach", &["audit", "report", "lesson"]),
    ("Listings and Mathcad", &["listing", "mathcad"]),
    ("Snapshots", &["snapshot"]),
    ("Scenes", &["scene"]),
];

/// Returns the list of the commands by group, each with what it does.
pub fn grouped(grammar: &clap::Command) -> String {
    let row = |name: &&str| {
        let command = grammar.find_subcommand(name).expect("a group has commands that exist");
        let about = command.get_about().expect("a command says what it does");
        format!("  {name:<9} {about}\n")
    };
    let group = |(heading, names): &(&str, &[&str])| {
        format!("{heading}:\n{}", names.iter().map(row).collect::<String>())
    };
    GROUPS.iter().map(group).collect::<Vec<_>>().join("\n").trim_end().to_string()
}

/// Adds to the error about a command that is not there the names of those that are, where none of
/// them is similar.
pub fn name_subcommands(why: &mut clap::Error, grammar: &clap::Command) {
    let is_unlike = why.kind() == ErrorKind::InvalidSubcommand
        && why.get(ContextKind::SuggestedSubcommand).is_none();
    if !is_unlike {
        return;
    }
    let group = std::env::args_os()
        .skip(1)
        .fold(grammar, |group, word| group.find_subcommand(&word).unwrap_or(group));
    let names = group.get_subcommands().map(clap::Command::get_name);
    let names: Vec<&str> = names.filter(|name| *name != "help").collect();
    let tip = format!("there are {}", names.join(", "));
    why.insert(ContextKind::Suggested, ContextValue::StyledStrs(vec![tip.into()]));
}

/// The option of the commands that execute or mirror a listing.
#[derive(clap::Args)]
pub struct ReadingArg {
    #[arg(long, value_name = "LIST", default_value = "", hide_default_value = true,
        help = Reading::help())]
    pub reading: Reading,
}

/// How a scene is run.
#[derive(clap::Args)]
pub struct RunArgs {
    #[arg(long, help = format!("{} [default: the scene's]", Variant::help()))]
    variant: Option<Variant>,
    #[command(flatten)]
    model: ModelArgs,
    #[command(flatten)]
    arithmetic: ArithmeticArgs,
    #[command(flatten)]
    reading: ReadingArg,
}

impl RunArgs {
    /// Returns what is asked of a scene.
    pub fn request(&self, scene: &Scene) -> Request {
        let request = self.model.request(scene, self.variant, &self.reading);
        request.arithmetic(self.arithmetic.into())
    }
}

/// How contact is modelled beyond what the paper prints, in place of what the scene says.
#[derive(clap::Args)]
pub struct ModelArgs {
    #[arg(long, help = format!("{} [default: the scene's]", Coupling::help()))]
    coupling: Option<Coupling>,
    /// Under unilateral: Coulomb's coefficient, 0 (contact nodes slide freely), or stick (they never
    /// slide); under printed, tied and stepped it changes only the equilibrium that they are
    /// compared with [default: the scene's].
    #[arg(long, value_name = "MU")]
    friction: Option<Friction>,
    #[arg(long, help = format!(
        "Under unilateral, the shape in which contact is measured. {} [default: the scene's]",
        Geometry::help()
    ))]
    geometry: Option<Geometry>,
    /// Under unilateral with friction, the number of equal steps in which the load of a stage grows
    /// [default: the scene's, or 16].
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=100_000))]
    load_steps: Option<u32>,
    #[arg(long, value_name = "RULE", help = format!(
        "Under tied and stepped, who is in contact. {} [default: the scene's]",
        StatusRule::help()
    ))]
    status: Option<StatusRule>,
}

impl ModelArgs {
    /// Asks for what is given, and for the rest what `scene` has.
    pub fn request(
        &self,
        scene: &Scene,
        variant: Option<Variant>,
        reading: &ReadingArg,
    ) -> Request {
        let contact = ContactModel {
            coupling: self.coupling.unwrap_or(scene.contact.coupling),
            friction: self.friction.unwrap_or(scene.contact.friction),
            geometry: self.geometry.unwrap_or(scene.contact.geometry),
            load_steps: self.load_steps.map_or(scene.contact.load_steps, |n| n as usize),
            status: self.status.unwrap_or(scene.contact.status),
        };
        Request::new(scene)
            .contact(contact)
            .variant(variant.unwrap_or(scene.variant))
            .reading(reading.reading)
    }
}

/// What a run changes of its scene; the result is that of a scene file edited so.
#[derive(clap::Args)]
pub struct SceneArgs {
    /// The tolerance of the contact search in place of the scene's, length.
    #[arg(long, value_name = "LENGTH", allow_negative_numbers = true)]
    c_tll: Option<f64>,
    /// The number of iterations of printed, tied and stepped in place of the scene's.
    #[arg(long, value_name = "N")]
    iterations: Option<usize>,
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
        let Some((description, mesh)) = scene.source().filter(|_| !self.names().is_empty()) else {
            return Ok(scene);
        };
        let (mut description, mesh) = (description.clone(), mesh.clone());
        let at = |option: &'static str| move |why| InputError { place: option.into(), ..why };
        if let Some(tolerance) = self.c_tll {
            check_tolerance(tolerance).map_err(at("--c-tll"))?;
            let contact = description.contact.as_mut().ok_or_else(|| {
                InputError::new("--c-tll", "the scene has no contact", "leave it out")
            })?;
            contact.tolerance = tolerance;
        }
        if let Some(iterations) = self.iterations {
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

    /// Returns the changes as parts of a folder's name.
    pub fn names(&self) -> Vec<String> {
        let c_tll = self.c_tll.map(|x| format!("c-tll-{x:e}"));
        let iterations = self.iterations.map(|n| format!("iterations-{n}"));
        let factor = self.load_factor.map(|x| format!("load-factor-{x}"));
        [c_tll, iterations, factor].into_iter().flatten().collect()
    }
}

/// The most bytes of a file of listings; the paper's two have 5,000.
pub const LARGEST_LISTING: u64 = 1 << 24;

/// Reads a file of listings.
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
    let Request { scene, contact, arithmetic, reading, .. } = request;
    let (own, plain) = (scene.contact, Arithmetic::default());
    let mut name = start;
    let mut add = |differs: bool, option: String| {
        if differs {
            name += &format!("-{option}");
        }
    };
    add(contact.coupling != own.coupling, contact.coupling.to_string());
    add(contact.friction != own.friction, format!("friction-{}", contact.friction));
    add(contact.geometry != own.geometry, contact.geometry.to_string());
    add(contact.load_steps != own.load_steps, format!("load-steps-{}", contact.load_steps));
    add(contact.status != own.status, contact.status.to_string());
    add(arithmetic.scalar != plain.scalar, arithmetic.scalar.to_string());
    add(arithmetic.solver != plain.solver, request.solver().to_string());
    add(arithmetic.inputs != plain.inputs, arithmetic.inputs.to_string());
    add(*reading != Reading::default(), reading.to_string());
    more.iter().for_each(|option| add(true, option.clone()));
    name
}

/// Prints a document or a file to standard output, as it is; a reader that has gone away (`| head`)
/// is no error. Text for people goes through [`print_fitted`].
pub fn print(text: &str) -> Result<()> {
    print_by(|out| out.write_all(text.as_bytes()))
}

/// Prints to standard output what `write` writes, as it comes.
fn print_by(write: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> Result<()> {
    let mut out = BufWriter::new(io::stdout().lock());
    match write(&mut out).and_then(|()| out.flush()) {
        Err(why) if why.kind() != io::ErrorKind::BrokenPipe => {
            let what = format!("cannot be written: {why}");
            let fix = "direct it to a place that can be written";
            Err(InputError::new("standard output", what, fix).into())
        }
        _ => Ok(()),
    }
}

/// Says where an error of the input stands.
pub fn within(error: Error, place: &str) -> Error {
    match error {
        Error::Input(error) => error.within(place).into(),
        other => other,
    }
}

/// Prints to standard error that files were written to `folder`.
pub fn report_written(folder: &Path) {
    print_stderr(&format!("Written to {}\n", shown(folder)));
}

/// Prints to standard error, for people; where that cannot be written, results and exit status are as
/// if it could.
pub fn print_stderr(text: &str) {
    let _ = std::io::stderr().write_all(fitted(text, width()).as_bytes());
}

/// Shows the help that was asked for, with the styles of a terminal where it fits.
pub fn help(asked: &clap::Error) -> Result<()> {
    let text = asked.render().to_string();
    let fits = text.lines().all(|line| line.chars().count() <= width());
    if fits { print_by(|_| asked.print()) } else { print_fitted(&text) }
}

/// Prints an error to standard error; returns its exit status.
pub fn report_error(error: &Error) -> u8 {
    print_stderr(&format!("error: {error}\n"));
    error.exit_status()
}

/// Does `work`, with a sign of life on standard error for what may take over two seconds; it shows
/// only in a terminal.
pub fn waiting<R>(what: &'static str, work: impl FnOnce() -> R) -> R {
    let spinner = ProgressBar::new_spinner().with_message(what);
    spinner.enable_steady_tick(Duration::from_millis(500));
    let result = work();
    spinner.finish_and_clear();
    result
}

/// The folder that is asked for, else `name` in the folder `out`.
pub fn folder(asked: &Option<PathBuf>, name: String) -> PathBuf {
    asked.clone().unwrap_or_else(|| Path::new("out").join(name))
}

/// The file that tells that a folder of tables is this program's: CSV has no place for it.
const TABLES: &str = "tables.json";

/// Where tables go beside standard output.
#[derive(clap::Args)]
pub struct TablesArgs {
    /// Write each table that is printed to a folder too, as CSV.
    #[arg(long, value_name = "DIR", conflicts_with = "json")]
    csv: Option<PathBuf>,
}

impl TablesArgs {
    /// Checks that tables can be written, before they are computed.
    ///
    /// # Errors
    /// Those of [`files::check_folder`].
    pub fn check(&self) -> Result<()> {
        Ok(self.csv.iter().try_for_each(|folder| files::check_folder(folder, &[TABLES]))?)
    }

    /// Prints a report, and writes its tables; [`TABLES`], which names them, marks their folder.
    pub fn print(&self, report: Report) -> Result<()> {
        if let Some(folder) = &self.csv {
            let tables = report.csv().into_iter();
            let mut tables: Vec<_> = tables.map(|(name, csv)| (name + ".csv", csv)).collect();
            let names: Vec<_> = tables.iter().map(|(name, _)| name).collect();
            let mark = json::line(None, &BTreeMap::from([("tables", names)]));
            tables.push((TABLES.into(), mark));
            files::write_all(folder, &tables)?;
        }
        print_report(report)
    }
}

/// Prints a report, fitted to the terminal.
pub fn print_report(report: Report) -> Result<()> {
    print(&report.text(width()))
}

/// Prints lines of prose, fitted to the terminal.
pub fn print_fitted(text: &str) -> Result<()> {
    print(&fitted(text, width()))
}

/// Prints a document, or in its place a report.
pub fn print_either(
    json: bool,
    document: impl FnOnce() -> String,
    report: impl FnOnce() -> Report,
) -> Result<()> {
    if json { print(&document()) } else { print_report(report()) }
}

/// Returns the characters of a line: those of the terminal; where there is none, of the variable
/// COLUMNS, else any number, so that files and pipes have whole lines. Below 40 they are 40.
pub fn width() -> usize {
    let columns = || std::env::var("COLUMNS").ok().and_then(|columns| columns.parse().ok());
    let terminal = terminal_size::terminal_size().map(|(width, _)| width.0.into());
    terminal.or_else(columns).map_or(usize::MAX, |width: usize| width.max(40))
}

/// Writes to the file that is asked for, else to standard output.
pub fn write_or_print(file: &Option<PathBuf>, text: &str) -> Result<()> {
    match file {
        Some(path) => Ok(files::write(path, text)?),
        None => print(text),
    }
}

/// A progress bar on standard error; it shows only in a terminal.
pub fn progress(steps: usize, template: &str) -> ProgressBar {
    let style = ProgressStyle::with_template(template).expect("the template is sound");
    let bar = ProgressBar::new(steps as u64).with_style(style);
    // What nobody sees needs no thread.
    if !bar.is_hidden() {
        bar.enable_steady_tick(Duration::from_millis(500));
    }
    bar
}
