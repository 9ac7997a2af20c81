//! The most memory that a process took.

/// Most bytes that this process had in memory at once, its program included; nothing where the
/// system (Linux: `VmHWM` of `/proc/self/status`) does not report it.
pub fn of_this_process() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    let kilobytes: u64 = line.trim().strip_suffix("kB")?.trim().parse().ok()?;
    Some(1024 * kilobytes)
}
