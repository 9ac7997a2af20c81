//! `plane-contact snapshot record`.

use std::path::{Path, PathBuf};

use crate::snapshot::{Entry, FIELDS, Numbers, Quantity, Snapshot, Tolerance};
use base::error::InputError;
use base::files;
use base::plain::shown;
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use engine::error::Result;
use output::model::Report;
use problem::modelling::Variant;
use problem::scene::{Scene, SceneFile};

use commands::{MethodArgs, folder, offered, print_report, waiting};

/// Record what a scene gives, to be verified later: a regression snapshot.
#[derive(clap::Args)]
#[command(after_help = "\
Writes a file of JSON for each scene: the scene and its mesh, whole; for each run its options, its \
discrete facts (who is in contact, target edges, iterations, a failure and its listing line) and its \
numbers, each array with what rounding does to it, as runs on inputs changed in the last digit show. \
A snapshot of a scene that fails as \
printed is a snapshot like any other. An existing snapshot is not replaced: see \
snapshot accept.

Examples:
  plane-contact snapshot record fig1 --variant printed,tied,stepped,unilateral
  plane-contact snapshot record my/scene.json --out my/snapshot.json
  plane-contact snapshot record fig1 --only u,pressure             a small one: what comes out at the end
  plane-contact snapshot record fig1 --reading R4=left-to-right    an expected failure")]
pub struct Args {
    /// Paths of scenes, or names of embedded ones.
    #[arg(value_name = "SCENE", required = true)]
    scenes: Vec<PathBuf>,
    #[arg(long, value_name = "V,...", value_delimiter = ',', value_parser = offered::<Variant>(Variant::ALL), help = format!(
        "Variants, each of which is run. {} [default: the scene's]",
        Variant::help()
    ))]
    variant: Vec<Variant>,
    #[command(flatten)]
    method: MethodArgs,
    #[arg(long, value_name = "NAME,...", value_delimiter = ',',
        value_parser = PossibleValuesParser::new(FIELDS.map(offered_name)).try_map(|name| name.parse::<Quantity>()), help = format!(
        "Record these numbers of the end alone, and no iterations: {} [default: all, and the iterations]",
        FIELDS.map(Quantity::name).join(", ")
    ))]
    only: Vec<Quantity>,
    /// The relative tolerance of all arrays, in place of what rounding does: the part of an array's largest number.
    #[arg(long, value_name = "REL", value_parser = relative)]
    tolerance: Option<Tolerance>,
    /// File of the snapshot, of one scene alone [default: <scene>.snapshot.json in the folder out].
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
}

pub fn run(args: &Args) -> Result<()> {
    if args.out.is_some() && args.scenes.len() > 1 {
        let what = "one file cannot hold the snapshots of several scenes";
        return Err(InputError::new("--out", what, "leave it out, or record one by one").into());
    }
    args.out.as_deref().map_or(Ok(()), files::check_new)?;
    for name in &args.scenes {
        let scene_file = SceneFile::read(name)?;
        let scene = Scene::of_file(&scene_file)?;
        let variants: Vec<Option<Variant>> = match args.variant.is_empty() {
            true => vec![None],
            false => args.variant.iter().copied().map(Some).collect(),
        };
        let requests =
            variants.into_iter().map(|variant| args.method.options(variant).request(&scene));
        let requests = requests.collect::<Result<Vec<_>, _>>()?;
        let mut snapshot = waiting("recording", || Snapshot::record(&scene, &requests))?;
        snapshot.keep_only(&args.only);
        snapshot.tolerance = args.tolerance;
        let mut snapshot = snapshot.summarised(&scene);
        let file = folder(&args.out, format!("{}.snapshot.json", scene.name));
        snapshot.scene_file =
            scene_file.path().and_then(|scene| files::from_folder_of(&file, scene));
        write_new(&file, &snapshot.readable_text()?)?;
        print_report(recorded(&snapshot).line(format!("Written to {}", shown(&file))))?;
    }
    Ok(())
}

/// Reads a relative tolerance.
fn relative(text: &str) -> Result<Tolerance, String> {
    let part = text.parse().ok().filter(|part| (0.0..1.0).contains(part));
    let part: f64 = part.ok_or("a tolerance is a number from 0 to 1, such as 1e-3")?;
    Ok(Tolerance { relative: Some(part), ..Tolerance::default() })
}

/// Reports what was recorded: a line for each run.
fn recorded(snapshot: &Snapshot) -> Report {
    snapshot.runs.iter().fold(Report::default(), |report, (name, run)| {
        let facts = run.facts.len();
        let numbers: usize = run.numbers.iter().map(|(_, n)| n.places().len()).sum();
        let failure = run.fact(Quantity::Failure).filter(|failure| !failure.is_null());
        let failure = failure.map_or(String::new(), |failure| {
            format!("; exit status {}: {failure}", run.exit_status().unwrap_or_default())
        });
        let unmeasured = match run.numbers.iter().filter(|(_, n)| n.bound.is_none()).count() {
            0 => String::new(),
            count => format!("; what rounding does to {count} arrays is not known"),
        };
        let said = |(entry, numbers): (&Entry, &Numbers)| {
            let most = numbers.most_of_noise().filter(|_| entry.iteration.is_none())?;
            Some(format!("{entry}: no change below {most:.1e} can be seen, as rounding makes it"))
        };
        let nothing = if numbers == 0 { "; none of --only is there" } else { "" };
        let line = format!(
            "{} {name}: {facts} facts, {numbers} numbers{nothing}{unmeasured}{failure}",
            snapshot.input.name
        );
        report.line(line).notes(run.numbers.iter().filter_map(said))
    })
}

/// Writes a snapshot; an existing file with another content is kept.
fn write_new(file: &Path, text: &str) -> Result<()> {
    if files::write_new(file, text)? {
        return Ok(());
    }
    let what = match files::read(file) {
        Ok(there) if there == text.as_bytes() => return Ok(()),
        Ok(_) => "there is another snapshot".into(),
        Err(why) => format!("the file that is there cannot be read: {why}"),
    };
    let fix = "see what differs by `plane-contact snapshot verify`, take new values by \
               `plane-contact snapshot accept`, or delete the file";
    Err(InputError::new(shown(file), what, fix).into())
}

/// Returns the name of a number; a shell would take one of several words apart.
fn offered_name(field: Quantity) -> PossibleValue {
    PossibleValue::new(field.name()).hide(field.name().contains(' '))
}
