//! Limits that a user sets for a run: time, memory, disk.

use std::path::Path;
use std::time::Instant;

/// Limits of a run. A run that reaches a limit ends with a checkpoint.
#[derive(Debug, Clone, Default)]
pub struct Limits {
    /// Time, in s.
    pub max_wall: Option<f64>,
    /// Memory of the program, in MB.
    pub max_memory: Option<f64>,
    /// Disk that its results take, in MB.
    pub max_disk: Option<f64>,
}

/// Bytes of a MB.
const MEGABYTE: f64 = 1e6;

impl Limits {
    /// Returns the first limit, in words, that is reached by a run that began at `begin` and writes
    /// to `folder`.
    pub fn reached(&self, begin: Instant, folder: &Path) -> Option<String> {
        let over = |limit: Option<f64>, now: Option<f64>| {
            limit.zip(now).filter(|(limit, now)| now >= limit)
        };
        if let Some((limit, now)) = over(self.max_wall, Some(begin.elapsed().as_secs_f64())) {
            return Some(format!("--max-wall: it has taken {now:.0} s, of {limit} s"));
        }

        // Memory and disk are measured only where they are limited.
        let memory = || resident_bytes().map(|bytes| bytes / MEGABYTE);
        if let Some((limit, now)) = over(self.max_memory, self.max_memory.and_then(|_| memory())) {
            return Some(format!("--max-memory: it takes {now:.0} MB, of {limit} MB"));
        }
        let disk = || Some(bytes_in(folder) / MEGABYTE);
        if let Some((limit, now)) = over(self.max_disk, self.max_disk.and_then(|_| disk())) {
            return Some(format!("--max-disk: its results take {now:.0} MB, of {limit} MB"));
        }
        None
    }
}

/// Returns the resident memory of the program, in bytes, by `/proc`. Returns `None` where the
/// system does not report it.
fn resident_bytes() -> Option<f64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmRSS:"))?;
    let kilobytes: f64 = line.trim().strip_suffix("kB")?.trim().parse().ok()?;
    Some(1024.0 * kilobytes)
}

/// Returns the size of the files of a `folder`, in bytes.
fn bytes_in(folder: &Path) -> f64 {
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
    entries.filter_map(|entry| entry.metadata().ok()).map(|metadata| metadata.len() as f64).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_limit_that_is_reached_is_named() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        std::fs::write(folder.path().join("frame"), vec![0; 3_000_000]).expect("written");
        let reached = |limits: Limits| limits.reached(Instant::now(), folder.path());
        assert_eq!(reached(Limits::default()), None);
        let disk = |max_disk| Limits { max_disk: Some(max_disk), ..Limits::default() };
        assert_eq!(reached(disk(4.0)), None);
        assert!(reached(disk(2.0)).expect("reached").contains("--max-disk"));
        let wall = Limits { max_wall: Some(1e-9), ..Limits::default() };
        assert!(reached(wall).expect("reached").contains("--max-wall"));
        #[cfg(target_os = "linux")]
        {
            let memory = |max_memory| Limits { max_memory: Some(max_memory), ..Limits::default() };
            assert_eq!(reached(memory(1e6)), None);
            assert!(reached(memory(0.1)).expect("reached").contains("--max-memory"));
        }
    }
}
