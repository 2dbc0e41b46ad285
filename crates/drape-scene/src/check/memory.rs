//! Memory: how much of it there is, and for how many particles that is enough.

use std::fs;

/// Largest number of particles of a scene, whatever memory there is.
pub(crate) const PARTICLES_MAX: usize = 4_000_000;

/// Least memory of a run for each particle, in bytes. Sheets that do not touch took 4.4 kB, a stack
/// on a ball 5.3 kB, and a skirt on its body 8 kB.
pub(crate) const PER_PARTICLE: u64 = 4_000;

/// Memory that a program takes before its first particle, in bytes.
pub(crate) const BASE: u64 = 16 << 20;

/// Returns the number of particles for which there is memory, at most [`PARTICLES_MAX`].
pub(crate) fn particles_max() -> usize {
    particles_in(available())
}

/// Returns for how many particles an amount of memory is enough, in bytes.
fn particles_in(available: Option<u64>) -> usize {
    let held = available.map(|bytes| bytes.saturating_sub(BASE) / PER_PARTICLE);
    let held = held.and_then(|held| usize::try_from(held).ok()).unwrap_or(PARTICLES_MAX);
    held.clamp(1, PARTICLES_MAX)
}

/// Returns the memory that this process can still take, in bytes, where the system says it: that
/// of the machine, of its group of processes, and under its own limit.
fn available() -> Option<u64> {
    let read = |path: &str| fs::read_to_string(path).unwrap_or_default();
    let of_machine = kilobytes(&read("/proc/meminfo"), "MemAvailable:");
    let group = |path: &str| read(path).trim().parse::<u64>().ok();
    let of_group = group("/sys/fs/cgroup/memory.max").map(|limit| {
        let taken = group("/sys/fs/cgroup/memory.current").unwrap_or_default();
        let cached = page_cache(&read("/sys/fs/cgroup/memory.stat"));
        limit.saturating_sub(taken.saturating_sub(cached))
    });
    // The address space that threads reserve for what they will allocate is not taken yet.
    let of_process = address_space(&read("/proc/self/limits")).map(|limit| {
        let taken = kilobytes(&read("/proc/self/status"), "VmRSS:").unwrap_or_default();
        limit.saturating_sub(taken)
    });
    [of_machine, of_group, of_process].into_iter().flatten().min()
}

/// Returns the page cache of a control group, in bytes: memory that the system frees on demand.
fn page_cache(stat: &str) -> u64 {
    let counts = stat.lines().filter_map(|line| line.split_once(' '));
    let files = counts.filter(|(name, _)| matches!(*name, "inactive_file" | "active_file"));
    files.filter_map(|(_, bytes)| bytes.trim().parse::<u64>().ok()).sum()
}

/// Returns the number of a line that begins with a name, in bytes.
fn kilobytes(text: &str, name: &str) -> Option<u64> {
    let line = text.lines().find_map(|line| line.strip_prefix(name))?;
    line.split_whitespace().next()?.parse::<u64>().ok()?.checked_mul(1024)
}

/// Returns the soft limit of the address space, in bytes; none if there is none.
fn address_space(limits: &str) -> Option<u64> {
    let line = limits.lines().find_map(|line| line.strip_prefix("Max address space"))?;
    line.split_whitespace().next()?.parse().ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn memory_bounds_the_particles() {
        assert_eq!(particles_in(None), PARTICLES_MAX);
        assert_eq!(particles_in(Some(0)), 1);
        assert_eq!(particles_in(Some(BASE + 100_000 * PER_PARTICLE)), 100_000);
        assert_eq!(particles_in(Some(u64::MAX)), PARTICLES_MAX);
    }

    #[test]
    fn what_the_system_says_is_understood() {
        let text = "MemTotal:       24684084 kB\nMemAvailable:   23492004 kB\n";
        assert_eq!(kilobytes(text, "MemAvailable:"), Some(23_492_004 * 1024));
        let text = "Limit  Soft  Hard  Units\nMax address space         536870912            \
                    unlimited            bytes\n";
        assert_eq!(address_space(text), Some(1 << 29));
        assert_eq!(address_space("Max address space  unlimited  unlimited  bytes\n"), None);
        let text = "anon 5\nfile 900\ninactive_file 400\nactive_file 300\nshmem 200\n";
        assert_eq!(page_cache(text), 700);
        assert_eq!(page_cache(""), 0);
    }
}
