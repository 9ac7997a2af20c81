//! How a command prints, and shows that it is at work.

use std::io::{self, BufWriter, IsTerminal, Write};
use std::ops::Deref;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;
use std::sync::mpsc::{self, RecvTimeoutError, Sender};
use std::thread::Builder;
use std::time::{Duration, Instant};

use base::error::InputError;
use base::exit::ExitStatus;
use base::files;
use base::plain::{shell_word, shown};
use engine::error::{Error, Result};
use indicatif::{ProgressBar, ProgressStyle};
use output::failure::failure;
use output::model::Report;
use output::text::{COLUMNS, fitted};

/// What is said on standard error beside errors.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verbosity {
    /// Nothing (-q).
    Quiet,
    /// Notes, and in a terminal progress.
    Usual,
    /// Each stage too, at its start and with its time at its end (-v).
    Verbose,
}

static VERBOSITY: OnceLock<Verbosity> = OnceLock::new();

impl Verbosity {
    /// Has all that follows say so much.
    pub fn choose(self) {
        VERBOSITY.get_or_init(|| self);
    }

    fn chosen() -> Self {
        VERBOSITY.get().copied().unwrap_or(Verbosity::Usual)
    }
}

/// Prints a document or a file to standard output, as it is; a reader that has gone away (`| head`)
/// is no error. Text for people goes through [`print_fitted`].
///
/// # Errors
/// Standard output cannot be written.
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
    note(&format!("Written to {}\n", shown(folder)));
}

/// Prints to standard error what is no error, unless -q asks for none.
pub fn note(text: &str) {
    if Verbosity::chosen() != Verbosity::Quiet {
        print_stderr(text);
    }
}

/// Prints to standard error, for people; where that cannot be written, results and exit status are as
/// if it could.
pub fn print_stderr(text: &str) {
    let _ = std::io::stderr().write_all(fitted(text, width()).as_bytes());
}

/// Shows the help that was asked for, with the styles of a terminal where it fits.
///
/// # Errors
/// Standard output cannot be written.
pub fn help(asked: &clap::Error) -> Result<()> {
    let text = asked.render().to_string();
    let fits = text.lines().all(|line| line.chars().count() <= width());
    if fits { print_by(|_| asked.print()) } else { print_fitted(&text) }
}

/// Returns what was typed, as a shell takes it, but for the place of what is written.
pub fn command_line() -> String {
    let mut words = std::env::args_os().skip(1);
    let mut line = "plane-contact".to_string();
    while let Some(word) = words.next() {
        match &*word.to_string_lossy() {
            "--out" => drop(words.next()),
            word if word.starts_with("--out=") => {}
            word => line += &format!(" {}", shell_word(word)),
        }
    }
    line
}

/// Prints an error to standard error; returns its exit status.
pub fn report_error(error: &Error) -> ExitStatus {
    print_stderr(&format!("error: {error}\n"));
    error.exit_status()
}

/// Prints the error that ends a command, where `json` asks for it to standard output too; returns its exit
/// status.
pub fn report_failure(error: &Error, json: bool) -> ExitStatus {
    print_failure(error, json);
    report_error(error)
}

/// Prints to standard output the error that ends a command, where `json` asks for it.
pub(crate) fn print_failure(error: &Error, json: bool) {
    if json {
        // The error itself counts, not that its JSON could not be printed.
        let _ = print(&failure(error));
    }
}

/// Does `work`, with a sign of life on standard error for what may take over two seconds; it shows
/// only in a terminal.
pub fn waiting<R>(what: &'static str, work: impl FnOnce() -> R) -> R {
    let progress = Progress::start(what, ProgressBar::new_spinner().with_message(what));
    let result = work();
    progress.finish();
    result
}

/// A part of a command's work: -v names it at its start, and with its time at its end.
pub struct Progress {
    what: &'static str,
    start: Instant,
    bar: ProgressBar,
    /// Ends the lines of a log when it goes.
    _log: Option<Sender<()>>,
}

impl Progress {
    fn start(what: &'static str, bar: ProgressBar) -> Self {
        let bar = match Verbosity::chosen() {
            Verbosity::Quiet => ProgressBar::hidden(),
            Verbosity::Usual => bar,
            Verbosity::Verbose => {
                print_stderr(&format!("{what} ...\n"));
                bar
            }
        };
        tick(&bar);
        Progress { what, start: Instant::now(), bar, _log: None }
    }

    /// Says in a log too how far the work is.
    pub fn logged(self) -> Self {
        Progress { _log: log(self.what, self.bar.clone()), ..self }
    }

    /// Takes the bar away.
    pub fn finish(self) {
        self.bar.finish_and_clear();
        if Verbosity::chosen() == Verbosity::Verbose {
            let seconds = self.start.elapsed().as_secs_f64();
            print_stderr(&format!("{}: {seconds:.2} s\n", self.what));
        }
    }
}

impl Deref for Progress {
    type Target = ProgressBar;

    fn deref(&self) -> &ProgressBar {
        &self.bar
    }
}

/// Prints a report, fitted to the terminal.
///
/// # Errors
/// Standard output cannot be written.
pub fn print_report(report: Report) -> Result<()> {
    print(&report.text(width()))
}

/// Prints lines of prose, fitted to the terminal.
///
/// # Errors
/// Standard output cannot be written.
pub fn print_fitted(text: &str) -> Result<()> {
    print(&fitted(text, width()))
}

/// Prints a document, or in its place a report.
///
/// # Errors
/// Standard output cannot be written.
pub fn print_either(
    json: bool,
    document: impl FnOnce() -> String,
    report: impl FnOnce() -> Report,
) -> Result<()> {
    if json { print(&document()) } else { print_report(report()) }
}

/// Returns the characters of a line: those of the terminal, at most those of a table; where there is none, of
/// the variable COLUMNS, else any number, so that files and pipes have whole lines. Below 40 they are 40.
pub fn width() -> usize {
    let columns = || std::env::var("COLUMNS").ok().and_then(|columns| columns.parse().ok());
    let terminal = terminal_size::terminal_size().map(|(width, _)| width.0.into());
    let terminal = terminal.map(|width: usize| width.min(COLUMNS));
    terminal.or_else(columns).map_or(usize::MAX, |width: usize| width.max(40))
}

/// Writes what `text` returns, which has a `mark`, to the file that is asked for, else to standard output.
///
/// # Errors
/// Those of `text`; or the file, which is looked at before, or standard output cannot be written.
pub fn write_or_print(
    file: &Option<PathBuf>,
    mark: &str,
    text: impl FnOnce() -> Result<String>,
) -> Result<()> {
    let Some(path) = file else { return print(&text()?) };
    files::check_file(path, mark)?;
    Ok(files::write(path, &text()?)?)
}

/// A progress bar on standard error; it shows only in a terminal.
pub fn progress(what: &'static str, steps: usize, template: &str) -> Progress {
    let style = ProgressStyle::with_template(template).expect("the template is sound");
    Progress::start(what, ProgressBar::new(steps as u64).with_style(style))
}

/// Says every so often in a log, where no bar shows, how far a part of a command's work is, until what it returns is
/// dropped.
fn log(what: &'static str, bar: ProgressBar) -> Option<Sender<()>> {
    if io::stderr().is_terminal() || Verbosity::chosen() == Verbosity::Quiet {
        return None;
    }
    let (end, ended) = mpsc::channel();
    let say = move || {
        while ended.recv_timeout(LOG) == Err(RecvTimeoutError::Timeout) {
            let steps = bar.length().filter(|steps| *steps > 0);
            let steps = steps.map_or(String::new(), |n| format!(", {} of {n}", bar.position()));
            note(&format!("{what}: {:.0} s{steps}\n", bar.elapsed().as_secs_f64()));
        }
    };
    Builder::new().stack_size(1 << 17).spawn(say).ok().map(|_| end)
}

/// How often a log says how far work is.
const LOG: Duration = Duration::from_secs(5);

/// Moves a bar by a thread of its own: none for one that nobody sees, nor where no thread can be started.
fn tick(bar: &ProgressBar) {
    if !bar.is_hidden() && Builder::new().spawn(|| ()).is_ok() {
        bar.enable_steady_tick(Duration::from_millis(500));
    }
}
