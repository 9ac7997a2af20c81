//! The processes that run a sweep's cases, one for each core. A process that ends before its row is
//! a crashed case; one that was killed from outside gets another try.

use std::collections::VecDeque;
use std::io::{BufRead, BufReader, Write};
use std::path::Path;
use std::process::{Child, ChildStdin, ChildStdout, Command, ExitStatus, Stdio};
use std::sync::{Mutex, mpsc};

use plane_contact::engine::error::Result;
use plane_contact::error::InputError;
use plane_contact::studies::sweep::{Row, crashed};

use crate::commands::progress;

/// How often a case is tried again whose process was killed from outside.
const TRIES: usize = 2;

/// A case and its row, or why no process was started.
type CaseRow = std::result::Result<(usize, Row), InputError>;

/// Runs `cases` of the sweep in `file`, and hands each row to `done` as it comes.
///
/// # Errors
/// A process cannot be started, or `done` fails; the processes are ended first.
pub fn run(
    file: &Path,
    cases: &[usize],
    mut done: impl FnMut(usize, Row) -> Result<()>,
) -> Result<()> {
    if cases.is_empty() {
        return Ok(());
    }
    let cores = std::thread::available_parallelism().map_or(1, usize::from).min(cases.len());
    let queue = Mutex::new(cases.iter().copied().collect::<VecDeque<usize>>());
    let bar = progress(cases.len(), "case {pos} of {len} {wide_bar} {eta}");
    let (send, rows) = mpsc::channel();
    std::thread::scope(|scope| {
        for _ in 0..cores {
            let (send, queue) = (send.clone(), &queue);
            scope.spawn(move || serve(file, queue, &send));
        }
        drop(send);
        let taken: Result<()> = rows.iter().try_for_each(|row: CaseRow| {
            let (case, row) = row?;
            bar.inc(1);
            done(case, row)
        });
        // After a fault no further case is begun.
        queue.lock().expect("no thread panics with it").clear();
        taken
    })?;
    bar.finish_and_clear();
    Ok(())
}

/// Runs cases of the queue until there is none.
fn serve(file: &Path, queue: &Mutex<VecDeque<usize>>, send: &mpsc::Sender<CaseRow>) {
    let next = || queue.lock().expect("no thread panics with it").pop_front();
    let mut worker: Option<Worker> = None;
    while let Some(case) = next() {
        let mut tries = 0;
        let row = loop {
            let ready = match worker.take().map_or_else(|| Worker::start(file), Ok) {
                Ok(ready) => ready,
                Err(why) => break Err(why),
            };
            match ready.run(case) {
                Ok((ready, row)) => {
                    worker = Some(ready);
                    break Ok(row);
                }
                Err(status) if was_killed(status) && tries < TRIES => tries += 1,
                Err(status) => break Ok(crashed(status.code(), &status.to_string())),
            }
        };
        if send.send(row.map(|row| (case, row))).is_err() {
            return;
        }
    }
}

/// Returns whether a process was ended by a signal from outside.
fn was_killed(status: ExitStatus) -> bool {
    #[cfg(unix)]
    {
        use std::os::unix::process::ExitStatusExt;
        const FROM_OUTSIDE: [i32; 4] = [1, 2, 9, 15];
        status.signal().is_some_and(|signal| FROM_OUTSIDE.contains(&signal))
    }
    #[cfg(not(unix))]
    {
        let _ = status;
        false
    }
}

struct Worker {
    child: Child,
    input: ChildStdin,
    output: BufReader<ChildStdout>,
}

impl Worker {
    fn start(file: &Path) -> std::result::Result<Self, InputError> {
        let fault = |why: std::io::Error| {
            let what = format!("a process cannot be started: {why}");
            InputError::new("sweep", what, "see that the program may run itself")
        };
        let program = std::env::current_exe().map_err(fault)?;
        let mut child = Command::new(program)
            .args(["sweep", "--worker", "--"])
            .arg(file)
            // A case computes on one core: the others have cases of their own.
            .env("RAYON_NUM_THREADS", "1")
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn()
            .map_err(fault)?;
        let input = child.stdin.take().expect("it is piped");
        let output = BufReader::new(child.stdout.take().expect("it is piped"));
        Ok(Worker { child, input, output })
    }

    /// Runs a case, or says how the process ended.
    fn run(mut self, case: usize) -> std::result::Result<(Self, Row), ExitStatus> {
        let mut text = String::new();
        let answered = writeln!(self.input, "{case}").and_then(|()| self.input.flush()).is_ok()
            && self.output.read_line(&mut text).is_ok()
            && text.ends_with('\n');
        match serde_json::from_str(&text) {
            Ok(row) if answered => Ok((self, row)),
            _ => {
                let Worker { mut child, input, output } = self;
                drop((input, output));
                Err(child.wait().expect("a child can be waited for"))
            }
        }
    }
}
