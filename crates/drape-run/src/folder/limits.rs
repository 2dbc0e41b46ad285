//! Limits that a user sets for a run: time, memory, disk.

use std::fmt;
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

/// Limit that a run has reached.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ReachedLimit {
    /// Limit of the time of the run, in s.
    Wall {
        /// Time that the run has taken, in s.
        taken: f64,
        /// The limit, in s.
        limit: f64,
    },
    /// Limit of the memory of the program, in MB.
    Memory {
        /// Memory that the program takes, in MB.
        taken: f64,
        /// The limit, in MB.
        limit: f64,
    },
    /// Limit of the disk that the results take, in MB.
    Disk {
        /// Size of the results, in MB.
        taken: f64,
        /// The limit, in MB.
        limit: f64,
    },
}

impl fmt::Display for ReachedLimit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Wall { taken, limit } => {
                write!(f, "the limit of time: it has taken {taken:.0} s, of {limit} s")
            }
            Self::Memory { taken, limit } => {
                write!(f, "the limit of memory: it takes {taken:.0} MB, of {limit} MB")
            }
            Self::Disk { taken, limit } => {
                write!(f, "the limit of disk: its results take {taken:.0} MB, of {limit} MB")
            }
        }
    }
}

/// Bytes of a MB.
const MEGABYTE: f64 = 1e6;

impl Limits {
    /// Returns the first limit that is reached by a run that began at `begin` and writes to
    /// `folder`.
    pub fn reached(&self, begin: Instant, folder: &Path) -> Option<ReachedLimit> {
        let over = |limit: Option<f64>, now: Option<f64>| {
            limit.zip(now).filter(|(limit, now)| now >= limit)
        };
        if let Some((limit, taken)) = over(self.max_wall, Some(begin.elapsed().as_secs_f64())) {
            return Some(ReachedLimit::Wall { taken, limit });
        }

        // Memory and disk are measured only where they are limited.
        let memory = || resident_bytes().map(|bytes| bytes / MEGABYTE);
        let now = self.max_memory.and_then(|_| memory());
        if let Some((limit, taken)) = over(self.max_memory, now) {
            return Some(ReachedLimit::Memory { taken, limit });
        }
        let now = self.max_disk.map(|_| bytes_in(folder) / MEGABYTE);
        over(self.max_disk, now).map(|(limit, taken)| ReachedLimit::Disk { taken, limit })
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
        assert_eq!(reached(disk(2.0)), Some(ReachedLimit::Disk { taken: 3.0, limit: 2.0 }));
        let wall = Limits { max_wall: Some(1e-9), ..Limits::default() };
        assert!(matches!(reached(wall), Some(ReachedLimit::Wall { limit: 1e-9, .. })));
        #[cfg(target_os = "linux")]
        {
            let memory = |max_memory| Limits { max_memory: Some(max_memory), ..Limits::default() };
            assert_eq!(reached(memory(1e6)), None);
            let over = reached(memory(0.1));
            assert!(matches!(over, Some(ReachedLimit::Memory { limit: 0.1, .. })), "{over:?}");
        }
    }
}
