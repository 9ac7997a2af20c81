//! Whether what a run needs fits in the memory that is free.

use sysinfo::{MemoryRefreshKind, RefreshKind, System};

use crate::error::{InputError, Result};

/// What to do about a mesh that does not fit.
pub const FIX: &str = "use a coarser mesh or a machine with more memory";

/// Bytes that are taken without a look at what is free, which takes longer than to use them.
const LITTLE: f64 = 1e6;

/// Returns the bytes of `matrices` dense 2r x 2r matrices, `r` being the number of nodes.
pub fn needed(r: usize, matrices: usize) -> u128 {
    let equations = 2 * r as u128;
    matrices as u128 * equations * equations * 8
}

/// Returns the bytes of memory that are free now, the limits of a control group and of the process
/// included, or nothing where the system does not tell.
pub fn free() -> Option<u128> {
    let memory = RefreshKind::nothing().with_memory(MemoryRefreshKind::nothing().with_ram());
    let system = System::new_with_specifics(memory).ok()?;
    let limit = system.cgroup_limits().map_or(u64::MAX, |limits| limits.free_memory);
    let of_process = address_space().unwrap_or(u64::MAX);
    Some(u128::from(system.available_memory().min(limit).min(of_process)))
}

/// Returns the bytes of addresses that the process may still ask for (`ulimit -v`), without those that the
/// allocator will leave between what it uses; nothing where there is no limit, or the system does not
/// tell as Linux does.
fn address_space() -> Option<u64> {
    /// The most bytes between what is used.
    const BETWEEN: u64 = 128 << 20;
    let read = |file| std::fs::read_to_string(file).ok();
    let number = |text: &str, line: &str| {
        let rest = text.lines().find_map(|text| text.strip_prefix(line))?;
        rest.split_whitespace().next()?.parse::<u64>().ok()
    };
    let limit = number(&read("/proc/self/limits")?, "Max address space")?;
    let free = limit.saturating_sub(1024 * number(&read("/proc/self/status")?, "VmSize:")?);
    Some(free - (free / 4).min(BETWEEN))
}

/// What to do about threads that do not fit.
pub const FIX_THREADS: &str = "give it more memory, or fewer threads (RAYON_NUM_THREADS)";

/// Checks that the stacks of `threads` threads fit in the addresses that the process may still ask for:
/// a thread that starts where none are left cannot allocate, and aborts the process.
///
/// # Errors
/// There is no room for the stacks: says how much is free.
pub fn check_stacks(threads: usize) -> Result<()> {
    /// Rust's own size of a thread's stack, bytes.
    const STACK: f64 = 2_097_152.0;
    let whose = "its threads cannot start: their stacks";
    let free = address_space().map_or(f64::MAX, |free| free as f64);
    compare(threads as f64 * STACK, free, "the process", whose, FIX_THREADS)
}

/// Checks that `needed` bytes fit in those that are free; `place` and `fix` are those of the error.
///
/// # Errors
/// More is needed than is free: says how much.
pub fn check_bytes(needed: f64, place: &str, whose: &str, fix: &str) -> Result<()> {
    if needed <= LITTLE {
        return Ok(());
    }
    compare(needed, free().map_or(f64::MAX, |free| free as f64), place, whose, fix)
}

/// Checks that `matrices` dense 2r x 2r matrices fit in `free` bytes.
///
/// # Errors
/// Says how much they need where they do not.
pub fn check(r: usize, matrices: usize, free: Option<u128>) -> Result<()> {
    let n = 2 * r;
    let whose = format!("R = {r} nodes, with {matrices} dense matrices of {n} x {n},");
    let free = free.map_or(f64::MAX, |free| free as f64);
    compare(needed(r, matrices) as f64, free, "the mesh", &whose, FIX)
}

fn compare(needed: f64, free: f64, place: &str, whose: &str, fix: &str) -> Result<()> {
    if needed <= free {
        return Ok(());
    }
    // With as many digits as tell the two apart.
    let words = (0..9).map(|digits| [needed, free].map(|bytes| in_words(bytes, digits)));
    let [needed, free] = words.reduce(|a, b| if a[0] == a[1] { b } else { a }).expect("nine");
    Err(InputError::new(place, format!("{whose} need {needed}; {free} are free"), fix))
}

/// Returns bytes in words: of less than 0.1 GB, in MB.
pub fn readable(bytes: f64) -> String {
    in_words(bytes, 0)
}

/// Returns the same with `more` digits.
fn in_words(bytes: f64, more: usize) -> String {
    if bytes < 1e8 {
        format!("{:.more$} MB", bytes / 1e6)
    } else {
        format!("{:.*} GB", 1 + more, bytes / 1e9)
    }
}
