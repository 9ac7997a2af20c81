//! Whether the dense matrices fit in the memory that is free.

use sysinfo::{MemoryRefreshKind, RefreshKind, System};

use crate::error::{InputError, Result};

/// Returns the bytes of `matrices` dense 2r x 2r matrices, `r` being the number of nodes.
pub fn needed(r: usize, matrices: usize) -> u128 {
    let equations = 2 * r as u128;
    matrices as u128 * equations * equations * 8
}

/// Returns the bytes of memory that are free now, a control group's limit included, or nothing
/// where the system does not tell.
pub fn free() -> Option<u128> {
    let memory = RefreshKind::nothing().with_memory(MemoryRefreshKind::nothing().with_ram());
    let system = System::new_with_specifics(memory).ok()?;
    let limit = system.cgroup_limits().map_or(u64::MAX, |limits| limits.free_memory);
    Some(u128::from(system.available_memory().min(limit)))
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
        "use a coarser mesh or a machine with more memory",
    ))
}
