//! Other programs that this one starts. Each leads a process group, so that what it starts ends with it.

use std::io::{self, Read};
use std::process::{Child, Command, ExitStatus, Stdio};
use std::sync::{Mutex, MutexGuard, PoisonError};

use crate::files::read_from;

/// The programs that run.
static RUNNING: Mutex<Vec<u32>> = Mutex::new(Vec::new());

/// Returns the list of what runs; nothing starts for who holds it.
fn running() -> MutexGuard<'static, Vec<u32>> {
    RUNNING.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Ends all programs that run, and lets no other start while what is returned is held.
pub(crate) fn end_all() -> impl Drop {
    let running = running();
    running.iter().for_each(|id| kill(*id));
    running
}

/// A program that runs.
pub struct Running {
    child: Child,
    output: io::PipeReader,
}

/// Starts a program without input. It ends with this one, be it by a signal.
///
/// # Errors
/// It cannot be started.
pub fn start(mut command: Command) -> io::Result<Running> {
    let (output, input) = io::pipe()?;
    command.stdin(Stdio::null()).stdout(input.try_clone()?).stderr(input);
    #[cfg(unix)]
    std::os::unix::process::CommandExt::process_group(&mut command, 0);
    let mut running = running();
    let child = command.spawn()?;
    running.push(child.id());
    Ok(Running { child, output })
}

impl Running {
    /// Waits for its end; returns how it ended, and what it printed to both of its outputs. One that prints
    /// more than `most` bytes is killed.
    ///
    /// # Errors
    /// What it prints cannot be read, or is more.
    pub fn end(mut self, most: u64) -> io::Result<(ExitStatus, Vec<u8>)> {
        let printed = read_from(self.output.by_ref(), most);
        if printed.is_err() {
            kill(self.child.id());
            // Where there are no groups; one that has ended by itself cannot be killed.
            let _ = self.child.kill();
        }
        let status = self.child.wait();
        running().retain(|id| *id != self.child.id());
        Ok((status?, printed?))
    }
}

/// Kills a program with all that it started.
#[cfg(unix)]
fn kill(id: u32) {
    use rustix::process::{Pid, Signal, kill_process_group};
    let id = i32::try_from(id).ok().and_then(Pid::from_raw);
    // One that has ended by itself cannot be killed.
    let _ = id.map(|id| kill_process_group(id, Signal::KILL));
}

#[cfg(not(unix))]
fn kill(_: u32) {}
