//! Limits on the sizes of input files, and the reader of input files.

use std::borrow::Cow;
use std::fmt;
use std::path::Path;

use crate::diagnostic::advice::Advice;
use crate::diagnostic::remedy::Remedy;
use crate::diagnostic::{Diagnostic, Diagnostics};
use crate::file_access::FileAccess;
use crate::file_access::similar_file::missing_file_help;

/// Largest size of a kind of input file. The limit keeps a wrong path from filling the memory.
///
/// ```
/// use drape_input::{FileAccess, Remedy, SizeLimit};
///
/// let (limit, usual) = (SizeLimit::new("tables", 1 << 20), FileAccess::default());
/// assert!(limit.check(1 << 20, &usual).is_ok());
/// let refused = limit.check(1 + (1 << 20), &usual).unwrap_err();
/// assert_eq!(refused.to_string(), "the file has 1048577 bytes, more than 1048576");
/// assert_eq!(refused.help().remedy, Some(Remedy::RaiseLimits { factor: 2 }));
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
    /// Limit without the factor of the access, in bytes.
    usual: u64,
}

impl SizeLimit {
    /// Returns the limit of `bytes` for the files `kind`, a noun in the plural.
    #[must_use]
    pub const fn new(kind: &'static str, bytes: u64) -> Self {
        Self { kind, bytes }
    }

    /// Returns the limit times the factor in `access`, in bytes.
    #[must_use]
    pub fn bytes(self, access: &FileAccess) -> u64 {
        self.bytes.saturating_mul(u64::from(access.size_factor.max(1)))
    }

    /// Reads the file `path` in memory or on disk. The limit is raised by the factor in `access`.
    ///
    /// # Errors
    /// A mistake if the file is missing, is no file, is larger than the limit, or cannot be read.
    pub fn read<'a>(
        self,
        path: &Path,
        access: &'a FileAccess,
    ) -> Result<Cow<'a, [u8]>, Diagnostics> {
        if let Some(bytes) = access.held(path) {
            self.check_file(path, bytes.len() as u64, access)?;
            return Ok(Cow::Borrowed(bytes));
        }

        // The kind is checked before the file is opened, because opening a pipe waits for its
        // writer.
        let metadata = std::fs::metadata(path).map_err(|error| {
            let message = format!("cannot open the file: {error}");
            Diagnostic::new(path, message).help(missing_file_help(path))
        })?;
        if !metadata.is_file() {
            return Err(Diagnostic::new(path, "this is not a file").help("name a file").into());
        }
        self.check_file(path, metadata.len(), access)?;
        let bytes = std::fs::read(path).map_err(|error| {
            let message = format!("cannot read the file: {error}");
            Diagnostic::new(path, message).help("check that you may read the file")
        })?;
        Ok(Cow::Owned(bytes))
    }

    /// Checks that the file `path` of `bytes` bytes is not larger than the limit with the given
    /// `access`.
    ///
    /// # Errors
    /// The mistake, with its remedy, if the file is larger.
    fn check_file(self, path: &Path, bytes: u64, access: &FileAccess) -> Result<(), Diagnostics> {
        let refused = self.check(bytes, access);
        refused.map_err(|large| Diagnostic::new(path, large.to_string()).help(large.help()).into())
    }

    /// Checks that a file of `bytes` bytes is not larger than the limit with the given `access`.
    ///
    /// # Errors
    /// [`TooLarge`] if the file is larger.
    pub fn check(self, bytes: u64, access: &FileAccess) -> Result<(), TooLarge> {
        let Self { kind, bytes: usual } = self;
        let limit = self.bytes(access);
        if bytes <= limit { Ok(()) } else { Err(TooLarge { kind, bytes, limit, usual }) }
    }
}

impl TooLarge {
    /// Returns the remedy for the user.
    #[must_use]
    pub fn help(&self) -> Advice {
        let Self { kind, bytes, usual, .. } = self;
        let factor = bytes.div_ceil(*usual.max(&1));
        let question = format!("{kind} are seldom so large: is this the right file?");
        Advice::from(question).with(Remedy::RaiseLimits { factor })
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
    use crate::{Document, FileAccess, Remedy};

    #[test]
    fn a_file_larger_than_its_kind_is_answered_with_its_size_and_the_limit() {
        let path = std::env::temp_dir().join(format!("drape-large-{}.toml", std::process::id()));
        std::fs::write(&path, "#".repeat((1 << 20) + 1)).expect("written");
        let read = Document::read(&path);
        let twice = FileAccess { size_factor: 2, ..FileAccess::default() };
        let raised = Document::read_with(&path, &twice);
        std::fs::remove_file(&path).expect("it was just written");
        let mistake = read.expect_err("it is too large").0.remove(0);
        assert_eq!(mistake.message, "the file has 1048577 bytes, more than 1048576");
        assert_eq!(mistake.remedy, Some(Remedy::RaiseLimits { factor: 2 }));
        assert_eq!(raised.map(|document| document.text().len()), Ok((1 << 20) + 1));
    }
}
