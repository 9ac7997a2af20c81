//! `plane-contact sweep`.

use std::io;
use std::path::{Path, PathBuf};

use crate::sweep::engines::{self as report, Engine};
use crate::sweep::{Job, Jobs, Row};
use base::error::InputError;
use base::files;
use base::plain::shown;
use engine::error::Result;

use commands::{note, offered, print, print_fitted, progress};

/// The most bytes of a sweep.
const MOST: u64 = 1 << 22;

/// The most bytes of a result; one has some 2,000.
const RESULT: u64 = 1 << 20;

/// Run a scene under many values of its fields and of options.
#[derive(clap::Subcommand)]
#[command(after_help = "\
SWEEP is a file of JSON: format, scene (a name or a path beside it), options, and the values that \
take turns by JSON pointer: grid (every combination) or list. Each combination is a job. Its result \
is a file named by its key, a hash of all that it reads (scene, mesh, options) and of the version: a \
job whose result is there does not run again. One that fails has a result too.

Examples:
  plane-contact sweep run sweep.json
  plane-contact sweep table sweep.json > table.csv
  plane-contact sweep export sweep.json --to make > jobs.mk && make -j 4 -f jobs.mk

  {\"format\": 1, \"scene\": \"fig1\",
   \"grid\": {\"/options/variant\": [\"tied\", \"stepped\"],
            \"/scene/contact/c_tll\": {\"from\": 1e-4, \"to\": 1e-2, \"count\": 21, \"log\": true}}}")]
pub enum Command {
    /// Run the jobs that have no result yet, one after another.
    #[command(after_help = "\
Examples:
  plane-contact sweep run sweep.json
  plane-contact sweep run sweep.json --only 3")]
    Run {
        #[command(flatten)]
        sweep: SweepArgs,
        /// Run this job alone, from zero.
        #[arg(long, value_name = "JOB")]
        only: Option<usize>,
    },
    /// Print the job file of an engine that runs the jobs side by side, or on many machines.
    #[command(after_help = "\
Examples:
  plane-contact sweep export sweep.json --to make > jobs.mk
  plane-contact sweep export sweep.json --to snakemake > Snakefile")]
    Export {
        #[command(flatten)]
        sweep: SweepArgs,
        #[arg(long, value_name = "ENGINE", help = Engine::help(), value_parser = offered::<Engine>(Engine::ALL))]
        to: Engine,
    },
    /// Print the results as CSV, a row for each job, in order.
    #[command(after_help = "\
Examples:
  plane-contact sweep table sweep.json > table.csv
  plane-contact sweep table sweep.json --json")]
    Table {
        #[command(flatten)]
        sweep: SweepArgs,
        /// Print JSON.
        #[arg(long)]
        json: bool,
    },
}

#[derive(clap::Args)]
pub struct SweepArgs {
    /// File of the sweep.
    #[arg(value_name = "SWEEP")]
    file: PathBuf,
    /// Folder of the results [default: out/<sweep>].
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
}

impl SweepArgs {
    fn out(&self) -> PathBuf {
        let stem = || Path::new("out").join(self.file.file_stem().unwrap_or_default());
        self.out.clone().unwrap_or_else(stem)
    }

    fn jobs(&self) -> Result<Jobs> {
        let place = shown(&self.file);
        let text = files::read_most(&self.file, MOST).map_err(|why| {
            let what = format!("the sweep cannot be read: {why}");
            InputError::new(&place, what, "see `plane-contact sweep --help`")
        })?;
        let folder = self.file.parent().unwrap_or(Path::new(""));
        Ok(Jobs::read(&text, folder).map_err(|error| error.within(&place))?)
    }
}

pub fn run(command: &Command) -> Result<()> {
    match command {
        Command::Run { sweep, only } => run_jobs(sweep, *only),
        Command::Export { sweep, to } => {
            let program = std::env::current_exe().unwrap_or_else(|_| "plane-contact".into());
            let words = [&*program, &sweep.file, &sweep.out()];
            print(&report::job_file(*to, &sweep.jobs()?.all()?, words)?)
        }
        Command::Table { sweep, json } => {
            let (jobs, out) = (sweep.jobs()?.all()?, sweep.out());
            let rows = jobs.iter().map(|job| result(&out, job)).collect::<Result<Vec<_>>>()?;
            let missing = rows.iter().filter(|row| row.is_none()).count();
            if missing > 0 {
                note(&format!("{missing} of {} jobs have not run\n", rows.len()));
            }
            print(&report::table(&jobs, &rows, *json))
        }
    }
}

fn run_jobs(sweep: &SweepArgs, only: Option<usize>) -> Result<()> {
    let (jobs, out) = (sweep.jobs()?, sweep.out());
    let chosen = match only {
        None => jobs.all()?,
        Some(job) if job < jobs.count => vec![jobs.job(job)?],
        Some(_) => {
            let what = format!("there are {} jobs, counted from 0", jobs.count);
            return Err(InputError::new("--only", what, "give the number of one").into());
        }
    };
    let (mut ran, mut failed) = (0, 0);
    let bar = progress("running the jobs", chosen.len(), "job {pos} of {len} {wide_bar} {eta}");
    for job in &chosen {
        let row = match result(&out, job)? {
            Some(row) => row,
            None => {
                let row = jobs.run(job)?;
                let file = out.join(report::result_name(job));
                // Where another run was quicker, its result, which is the same, stays.
                files::write_new(&file, &report::result(job, &row))?;
                ran += 1;
                row
            }
        };
        failed += usize::from(row["exit_status"] != 0);
        bar.inc(1);
    }
    bar.finish();
    let (all, out) = (chosen.len(), shown(&out));
    print_fitted(&format!("{all} jobs: {ran} ran, {failed} failed\nWritten to {out}\n"))
}

/// Returns the result of a job that is in the folder of the results.
fn result(out: &Path, job: &Job) -> Result<Option<Row>> {
    let name = report::result_name(job);
    let place = shown(&out.join(&name));
    let text = match files::read_in(out, Path::new(&name), RESULT) {
        Err(why) if why.kind() == io::ErrorKind::NotFound => return Ok(None),
        read => read.map_err(|why| {
            let what = format!("the result cannot be read: {why}");
            InputError::new(&place, what, "move what is there")
        })?,
    };
    Ok(Some(report::read_result(job, &text).map_err(|error| error.within(&place))?))
}
