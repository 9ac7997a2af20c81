//! `plane-contact mathcad run`.

use std::io;
use std::path::{Path, PathBuf};

use base::error::InputError;
use base::exit::ExitStatus;
use base::files;
use base::plain::shown;
use engine::error::Result;
use flate2::read::MultiGzDecoder;
use mathcad::worksheet::{self, Agreement};
use mathcad::{Limits, xmcd::document};
use output::worksheet as report;

use commands::{print_either, progress};

/// Execute a worksheet of Mathcad 13 to 15 beside the results that it saved.
#[derive(clap::Args)]
#[command(after_help = "\
Regions are executed in the worksheet's order and settings, and each result is compared with the one \
that Mathcad saved: same to the last bit, to so many digits, or differing. Units, symbolics, plots, \
solve blocks, derivatives, integrals and random numbers are named as unsupported. Where the worksheet \
shows a name's value and ours is not the same to the last bit, or unsupported, the saved value goes on \
as input, so that each result is judged for itself; results that rest on it say so.

The exit status also tells a difference: a result, a region that fails here alone, or that nothing could \
be compared.

Examples:
  plane-contact mathcad run worksheet.xmcd
  plane-contact mathcad run worksheet.xmcdz --json")]
pub struct Args {
    /// The worksheet, .xmcd or .xmcdz.
    #[arg(value_name = "FILE.xmcd")]
    file: PathBuf,
    /// The most steps of all regions together, as those of `listing evaluate`; one region may take half of
    /// those that are left.
    #[arg(long, value_name = "STEPS", default_value_t = Limits::default().steps)]
    limit: u64,
    /// Print JSON.
    #[arg(long)]
    json: bool,
}

/// Executes the worksheet; returns the exit status.
pub fn run(args: &Args) -> Result<ExitStatus> {
    let sheet = open(&args.file)?;
    let limits = Limits { steps: args.limit, ..limits() };
    let bar = progress("executing", 0, "region {pos} of {len} {wide_bar} {elapsed}");
    let checked = worksheet::execute_watched(&sheet, &limits, &mut |done, of| {
        bar.set_length(of as u64);
        bar.set_position(done as u64);
    });
    bar.finish();
    let json = || report::json(&shown(&args.file), &checked);
    print_either(args.json, json, || report::report(&checked))?;
    let some = |is: fn(&Agreement) -> bool| checked.iter().any(|region| is(&region.agreement));
    let differs =
        some(|agreement| matches!(agreement, Agreement::Differs { .. } | Agreement::Fails { .. }));
    Ok(ExitStatus::compared(!differs && some(Agreement::agrees)))
}

/// Reads a worksheet's file.
fn open(file: &Path) -> Result<document::Worksheet, InputError> {
    let place = shown(file);
    let bytes = files::read_most(file, document::LARGEST as u64);
    if let Ok(bytes) = &bytes {
        document::check_kind(bytes, &place)?;
    }
    let text = bytes.and_then(read_text).map_err(|why| {
        let what = format!("the file cannot be read: {why}");
        InputError::new(&place, what, "give an .xmcd file, which is text in UTF-8, or an .xmcdz")
    })?;
    document::read(&text, &place)
}

/// Reads the text of a worksheet, packed or not.
fn read_text(bytes: Vec<u8>) -> io::Result<String> {
    let bytes = match bytes.starts_with(&[0x1f, 0x8b]) {
        true => files::read_from(MultiGzDecoder::new(&*bytes), document::LARGEST as u64)
            .map_err(unpacked)?,
        false => bytes,
    };
    files::text(bytes)
}

/// Says what is wrong with a packed file.
fn unpacked(why: io::Error) -> io::Error {
    let what = match why.kind() {
        io::ErrorKind::FileTooLarge => return why,
        io::ErrorKind::UnexpectedEof => "the packed file is cut short",
        _ => "the packed file is damaged: it cannot be unpacked",
    };
    io::Error::new(why.kind(), what)
}

/// The limits of a region: arrays that are spelled out make long lines.
fn limits() -> Limits {
    Limits { lines: 10_000, characters: 1 << 20, entries: 1 << 22, ..Limits::default() }
}
