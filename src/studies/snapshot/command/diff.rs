//! `plane-contact snapshot diff`.

use std::path::PathBuf;

use crate::snapshot::verified_file::{self as report, VerifiedFile};
use crate::snapshot::{Options, Snapshot, accept, difference};
use base::error::InputError;
use base::exit::ExitStatus;
use base::files;
use base::plain::shown;
use engine::error::Result;
use engine::linear::{ScalarName, Solver};
use paper::mirror::Reading;
use problem::modelling::Variant;
use problem::scene::{Scene, SceneFile};

use commands::{offered, offered_readings, print_either, waiting};

/// Compare two snapshots, or a scene under two sets of options.
#[derive(clap::Args)]
#[command(after_help = "\
Each side is a snapshot or a scene; a scene is run, beside a snapshot as that was. With one side alone, some option names two \
values, one for each run. A difference is printed as by verify.

Examples:
  plane-contact snapshot diff strand --variant stepped,tied
  plane-contact snapshot diff old.json new.json
  plane-contact snapshot diff my/snapshot.json my/scene.json
  plane-contact snapshot diff fig1 --reading R5=node --reading R5=node_n")]
pub struct Args {
    /// A snapshot or a scene, and another one.
    #[arg(value_name = "A [B]", num_args = 1..=2, required = true)]
    sides: Vec<PathBuf>,
    /// The variants of both sides, or one for both [default: the scene's].
    #[arg(long, value_name = "V,...", value_delimiter = ',', value_parser = offered::<Variant>(Variant::ALL))]
    variant: Vec<Variant>,
    /// The solvers of both sides, or one for both.
    #[arg(long, value_name = "NAME,...", value_delimiter = ',', value_parser = offered::<Solver>(Solver::ALL))]
    solver: Vec<Solver>,
    /// The scalars of both sides, or one for both.
    #[arg(long, value_name = "NAME,...", value_delimiter = ',', value_parser = offered::<ScalarName>(ScalarName::ALL))]
    scalar: Vec<ScalarName>,
    /// The readings of a side, as elsewhere; twice for both sides.
    #[arg(long, value_name = "LIST", value_parser = offered_readings())]
    reading: Vec<Reading>,
    /// Print JSON in place of text.
    #[arg(long)]
    json: bool,
}

/// The value of a side: that of two, or the one of both.
fn of_side<T: Copy>(values: &[T], side: usize, option: &str) -> Result<Option<T>> {
    match values.len() {
        0 => Ok(None),
        1 => Ok(Some(values[0])),
        2 => Ok(Some(values[side])),
        _ => Err(InputError::new(option, "there are two sides", "give one value, or two").into()),
    }
}

pub fn run(args: &Args) -> Result<ExitStatus> {
    let names = [&args.sides[0], args.sides.last().expect("one is required")];
    let varied = [args.variant.len(), args.solver.len(), args.scalar.len(), args.reading.len()];
    if args.sides.len() == 1 && !varied.contains(&2) {
        let what = "one side and no option with two values: there is nothing to compare";
        let fix = "give another snapshot or scene, or two values, as --variant stepped,tied";
        return Err(InputError::new("diff", what, fix).into());
    }
    // What is one for both sides is read once: it may come through a pipe.
    let first = SceneFile::read(names[0])?;
    let second = if names[0] == names[1] { first.clone() } else { SceneFile::read(names[1])? };
    let sides = waiting("running", || -> Result<_> {
        let there = [read(&first)?, read(&second)?];
        let [own, other] = &there;
        Ok([side(args, 0, &first, [own, other])?, side(args, 1, &second, [other, own])?])
    })?;
    let verified = difference(&sides[0], &sides[1]);
    let status = ExitStatus::compared(verified.is_same());
    let file = format!("{} and {}", shown(names[0]), shown(names[1]));
    let checked = [VerifiedFile { file, scene: None, verified: Ok(verified) }];
    print_either(args.json, || report::json(&checked), || report::report(&checked, false))?;
    Ok(status)
}

/// Returns the snapshot in a file; nothing of a scene.
fn read(file: &SceneFile) -> Result<Option<Snapshot>> {
    if files::fields(&file.text).iter().all(|name| name != "format") {
        return Ok(None);
    }
    let snapshot = Snapshot::read(&file.text);
    // What it says of its scene must be true.
    let checked = snapshot.and_then(|snapshot| snapshot.scene().map(|_| snapshot));
    let place = file.path().unwrap_or(&file.name);
    Ok(Some(checked.map_err(|error| error.within(place))?))
}

/// Returns the snapshot of a side, or runs its scene: as asked, or else the runs of the snapshot on the other side.
fn side(
    args: &Args,
    side: usize,
    file: &SceneFile,
    [own, other]: [&Option<Snapshot>; 2],
) -> Result<Snapshot> {
    if let Some(snapshot) = own {
        return Ok(snapshot.clone());
    }
    let scene = Scene::of_file(file)?;
    let is_asked = args.variant.len() + args.solver.len() + args.scalar.len() + args.reading.len();
    if is_asked == 0
        && let Some(snapshot) = other
    {
        return accept(snapshot, Some(&scene));
    }
    let options = Options {
        variant: of_side(&args.variant, side, "--variant")?,
        reading: of_side(&args.reading, side, "--reading")?.unwrap_or_default(),
        scalar: of_side(&args.scalar, side, "--scalar")?,
        solver: of_side(&args.solver, side, "--solver")?,
        ..Options::default()
    };
    let request = options.request(&scene)?;
    Snapshot::record(&scene, &[request])
}
