//! Errors of this crate, and what may be wrong with a checkpoint.

use std::path::PathBuf;

/// Reason why a checkpoint cannot be written or used.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A file or the folder cannot be written: check space and permissions.
    #[error("cannot write the checkpoint {}: {reason}", path.display())]
    Write {
        /// The file or folder.
        path: PathBuf,
        /// Message of the system.
        reason: std::io::Error,
    },
    /// The folder cannot be read: check its path and permissions.
    #[error("cannot read checkpoints in {}: {reason}", path.display())]
    Read {
        /// The folder.
        path: PathBuf,
        /// Message of the system.
        reason: std::io::Error,
    },
    /// Failure to encode the value of a section.
    #[error("the section \"{section}\" of a checkpoint cannot be written: {reason}")]
    Encode {
        /// Name of the section.
        section: String,
        /// Message of the encoder.
        reason: String,
    },
    /// A section is missing or is no value of the type that is asked for.
    #[error("the checkpoint has no right section \"{section}\": {reason}")]
    Section {
        /// Name of the section.
        section: String,
        /// Fault, in words.
        reason: String,
    },
}

/// Fault of the bytes of a checkpoint.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum Damage {
    /// The file does not begin as a checkpoint does.
    #[error("it is no checkpoint")]
    Magic,
    /// The file is of another version of the format.
    #[error("it has version {found} of the format, not {known}")]
    Version {
        /// Version of the file.
        found: u32,
        /// Version that is known.
        known: u32,
    },
    /// Wrong length: the file is truncated, or has bytes after its checksum.
    #[error("it is cut off, or goes on behind its end")]
    Length,
    /// A section is not as it was written.
    #[error("its section {number} is not as it was written")]
    Section {
        /// Number of the section, from 0.
        number: usize,
    },
    /// The file as a whole is not as it was written.
    #[error("it is not as it was written")]
    Whole,
    /// The file cannot be read.
    #[error("it cannot be read: {reason}")]
    Unreadable {
        /// Message of the system.
        reason: String,
    },
}
