//! The process: its threads, and the signals that end it.

use std::io;
use std::num::NonZero;
use std::sync::mpsc::channel;
use std::thread::{Builder, available_parallelism};

/// Bytes of the stack of each thread, whatever the environment (RUST_MIN_STACK) says; the default of Rust.
const STACK: usize = 1 << 21;

/// Starts the threads of the pool, one for each processor unless RAYON_NUM_THREADS says otherwise. Where the
/// system does not start so many, this thread alone is the pool: rayon, which fails then, builds no second
/// one.
pub fn start_pool() {
    let asked = std::env::var("RAYON_NUM_THREADS").ok().and_then(|count| count.parse().ok());
    let count = asked.or_else(|| available_parallelism().ok()).map_or(1, NonZero::get);
    let start = |_| {
        let (give, given) = channel::<rayon::ThreadBuilder>();
        let work = move || given.iter().for_each(rayon::ThreadBuilder::run);
        Builder::new().stack_size(STACK).spawn(work).map(|_| give)
    };
    let pool = rayon::ThreadPoolBuilder::new();
    let built = match (0..count).map(start).collect::<io::Result<Vec<_>>>() {
        Ok(started) => {
            let mut started = started.into_iter();
            let hand_over = move |work| {
                let thread = started.next().expect("one was started for each");
                thread.send(work).map_err(|_| io::ErrorKind::BrokenPipe.into())
            };
            pool.num_threads(count).spawn_handler(hand_over).build_global()
        }
        // Those that were started end, as nothing is given to them.
        Err(_) => pool.num_threads(1).use_current_thread().build_global(),
    };
    built.expect("nothing used the pool before");
}

/// Has SIGHUP, SIGINT, SIGQUIT and SIGTERM end the process as they do by themselves, once nothing temporary
/// and no program that it started is left; and has a file that may not grow further be an error of its
/// writing, not the end of the process.
#[cfg(unix)]
pub fn heed_signals() {
    use signal_hook::consts::{SIGHUP, SIGINT, SIGQUIT, SIGTERM, SIGXFSZ};
    use signal_hook::{flag, iterator::Signals, low_level::emulate_default_handler};
    // Where one of these cannot be had, signals end the process at once.
    let _ = flag::register(SIGXFSZ, Default::default());
    let ending =
        [SIGHUP, SIGINT, SIGQUIT, SIGTERM].into_iter().filter(|signal| !is_ignored(*signal));
    let end = |signal| base::files::abandon(|| emulate_default_handler(signal).unwrap_or_default());
    let (give, given) = channel::<Signals>();
    let wait = move || given.iter().for_each(|mut signals| signals.forever().for_each(end));
    // No signal is caught before there is a thread that waits for it.
    if Builder::new().stack_size(STACK).spawn(wait).is_ok() {
        let _ = Signals::new(ending).map(|signals| give.send(signals));
    }
}

/// Returns whether a signal is ignored from the start, as SIGINT is in the background of a shell's
/// script. Only Linux says so.
#[cfg(unix)]
fn is_ignored(signal: i32) -> bool {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let ignored = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    let set = ignored.and_then(|digits| u64::from_str_radix(digits.trim(), 16).ok());
    set.is_some_and(|set| set >> (signal - 1) & 1 == 1)
}
