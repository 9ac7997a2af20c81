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
pub fn check_stacks(threads: usize) -> Result<()> {
    /// Rust's own size of a thread's stack, bytes.
    const STACK: f64 = 2_097_152.0;
    let (needed, free) =
        (threads as f64 * STACK, address_space().map_or(f64::MAX, |free| free as f64));
    if needed <= free {
        return Ok(());
    }
    let what = format!(
        "its threads cannot start: their stacks need {}; {} are free",
        readable(needed),
        readable(free)
    );
    Err(InputError::new("the process", what, FIX_THREADS))
}

/// Checks that `needed` bytes fit in those that are free; `place` and `fix` are those of the error.
pub fn check_bytes(needed: f64, place: &str, whose: &str, fix: &str) -> Result<()> {
    if needed <= LITTLE {
        return Ok(());
    }
    let free = free().unwrap_or(u128::MAX) as f64;
    if needed <= free {
        return Ok(());
    }
    let what = format!("{whose} need {}; {} are free", readable(needed), readable(free));
    Err(InputError::new(place, what, fix))
}

/// Returns bytes in words: of less than 0.1 GB, in MB.
pub fn readable(bytes: f64) -> String {
    if bytes < 1e8 { format!("{:.0} MB", bytes / 1e6) } else { format!("{:.1} GB", bytes / 1e9) }
}

/// Checks that `matrices` dense 2r x 2r matrices fit in `free` bytes.
/// Errors: says how much they need where they do not.
pub fn check(r: usize, matrices: usize, free: Option<u128>) -> Result<()> {
    let free = free.unwrap_or(u128::MAX);
    if needed(r, matrices) <= free {
        return Ok(());
    }
    Err(InputError::new(
        "the mesh",
        format!(
            "R = {r} nodes need {:.1} GB for {matrices} dense matrices of {} x {}; \
             {:.1} GB are free",
            needed(r, matrices) as f64 / 1e9,
            2 * r,
            2 * r,
            free as f64 / 1e9
        ),
        FIX,
    ))
}
