//! Limits on the sizes of input files.

use std::fmt;
use std::sync::atomic::{AtomicU32, Ordering};

/// Factor by which all limits in this process are raised.
static FACTOR: AtomicU32 = AtomicU32::new(1);

/// Largest size of a kind of input file. The limit keeps a wrong path from filling the memory.
///
/// ```
/// use drape_input::SizeLimit;
///
/// let limit = SizeLimit::new("tables", 1 << 20);
/// assert!(limit.check(1 << 20).is_ok());
/// let refused = limit.check(1 + (1 << 20)).unwrap_err();
/// assert_eq!(refused.to_string(), "the file has 1048577 bytes, more than 1048576");
/// assert!(refused.help().ends_with("--raise-limits 2 reads it"));
/// ```
#[derive(Debug, Clone, Copy)]
pub struct SizeLimit {
    kind: &'static str,
    bytes: u64,
}

/// Refusal of a file that is larger than the limit of its kind.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct TooLarge {
    kind: &'static str,
    bytes: u64,
    limit: u64,
    /// Limit without the factor of the process, in bytes.
    usual: u64,
}

impl SizeLimit {
    /// Returns the limit of `bytes` for the files `kind`, a noun in the plural.
    #[must_use]
    pub const fn new(kind: &'static str, bytes: u64) -> Self {
        Self { kind, bytes }
    }

    /// Returns the limit times the factor [`size_limit_factor`], in bytes.
    #[must_use]
    pub fn bytes(self) -> u64 {
        self.bytes.saturating_mul(u64::from(size_limit_factor()))
    }

    /// Checks that a file of `bytes` bytes is not larger than the limit.
    ///
    /// # Errors
    /// [`TooLarge`] if the file is larger.
    pub fn check(self, bytes: u64) -> Result<(), TooLarge> {
        let Self { kind, bytes: usual } = self;
        let limit = self.bytes();
        if bytes <= limit { Ok(()) } else { Err(TooLarge { kind, bytes, limit, usual }) }
    }
}

/// Multiplies all limits in this process by `factor`, or by 1 if `factor` is 0, for a user who asks
/// for larger limits.
pub fn raise_size_limits(factor: u32) {
    FACTOR.store(factor.max(1), Ordering::Relaxed);
}

/// Returns the factor by which [`raise_size_limits`] has raised all limits in this process.
pub fn size_limit_factor() -> u32 {
    FACTOR.load(Ordering::Relaxed)
}

impl TooLarge {
    /// Returns the remedy for the user, which names `--raise-limits`.
    #[must_use]
    pub fn help(&self) -> String {
        let Self { kind, bytes, usual, .. } = self;
        let factor = bytes.div_ceil(*usual.max(&1));
        format!(
            "{kind} are seldom so large: is this the right file? --raise-limits {factor} reads it"
        )
    }
}

impl fmt::Display for TooLarge {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { bytes, limit, .. } = self;
        write!(f, "the file has {bytes} bytes, more than {limit}")
    }
}

impl std::error::Error for TooLarge {}

#[cfg(test)]
mod tests {
    use crate::Document;

    #[test]
    fn a_file_larger_than_its_kind_is_answered_with_its_size_and_the_limit() {
        let path = std::env::temp_dir().join(format!("drape-large-{}.toml", std::process::id()));
        std::fs::write(&path, "#".repeat((1 << 20) + 1)).expect("written");
        let read = Document::read(&path);
        std::fs::remove_file(&path).expect("it was just written");
        let mistake = read.expect_err("it is too large").0.remove(0);
        assert_eq!(mistake.message, "the file has 1048577 bytes, more than 1048576");
        assert!(mistake.help.is_some_and(|help| help.ends_with("--raise-limits 2 reads it")));
    }
}
