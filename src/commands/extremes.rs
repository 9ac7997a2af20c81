//! `plane-contact extremes`.

use std::path::PathBuf;

use plane_contact::engine::error::Result;
use plane_contact::error::InputError;
use plane_contact::files;
use plane_contact::report::extremes as report;
use plane_contact::studies::extremes::{GENERATORS, Generator, measure};

use super::{TablesArgs, folder, print, print_report, waiting};

/// Find where a method breaks down, every answer compared with exact numbers.
#[derive(clap::Args)]
#[command(after_help = "\
Each generator sweeps one magnitude. A cell is exact, a number of right digits, WRONG (an answer
without a right digit, or another contact), or refused (and by which error). A method breaks down
where it is refused or keeps fewer than 3 digits; that point is bisected. It takes 300 times as
long as solve on fig1.

Examples:
  plane-contact extremes
  plane-contact extremes offset steep-edge
  plane-contact extremes --list
  plane-contact extremes lengths --json --out out/lengths")]
pub struct Args {
    /// Generators [default: all].
    #[arg(value_name = "NAME")]
    names: Vec<String>,
    /// List the generators.
    #[arg(long)]
    list: bool,
    /// Print JSON.
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    tables: TablesArgs,
    /// Folder for extremes.txt, extremes.json and a picture for each generator, or more where
    /// its curves are too many for one [default: out/extremes, with --json none].
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
}

pub fn run(args: &Args) -> Result<()> {
    let chosen = chosen(&args.names)?;
    if args.list {
        return print_report(report::list(&chosen));
    }
    args.tables.check()?;
    let out = folder(&args.out, "extremes".into());
    let is_written = !args.json || args.out.is_some();
    if is_written {
        files::check_folder(&out, &["extremes.txt", "extremes.json"])?;
    }
    let measured = waiting("sweeping", || measure(&chosen));
    let json = report::json(&measured);
    if !is_written {
        return print(&json);
    }
    let pictures: Vec<_> = measured.iter().map(|of| (of.name, report::pictures(of))).collect();
    let report = report::report(&measured);
    let text = report.text(usize::MAX);
    let mut written = vec![("extremes.txt".into(), &text)];
    for (name, pictures) in &pictures {
        for (picture, k) in pictures.iter().zip(1..) {
            let more = if k == 1 { String::new() } else { format!("-{k}") };
            written.push((format!("{name}{more}.svg"), picture));
        }
    }
    written.push(("extremes.json".into(), &json));
    files::write_all(&out, &written)?;
    if args.json { print(&json) } else { args.tables.print(report) }
}

/// The generators of these names, in the order of the list; all of them where no name is given.
fn chosen(names: &[String]) -> Result<Vec<&'static Generator>, InputError> {
    let all = &GENERATORS;
    if let Some(unknown) = names.iter().find(|name| all.iter().all(|g| g.name != **name)) {
        let known: Vec<&str> = all.iter().map(|g| g.name).collect();
        let what = format!("there is no generator {unknown:?}");
        let fix = format!("the generators are {}", known.join(", "));
        return Err(InputError::new("NAME", what, fix));
    }
    let is_chosen = |g: &&Generator| names.is_empty() || names.iter().any(|name| name == g.name);
    Ok(all.iter().filter(is_chosen).collect())
}
