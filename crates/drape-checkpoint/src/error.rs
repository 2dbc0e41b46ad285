//! Errors of this crate, and faults of the bytes of a checkpoint.

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
    /// A link, a folder, a pipe or a device has the name of a checkpoint: move it away.
    #[error("{} is no file that was written as a checkpoint, but a link, a folder, a pipe or a device; move it away", path.display())]
    Irregular {
        /// The link, folder, pipe or device.
        path: PathBuf,
    },
    /// Failure to encode the value of a section.
    #[error("the section \"{section}\" of a checkpoint cannot be written: {reason}")]
    Encode {
        /// Name of the section.
        section: String,
        /// Message of the encoder.
        reason: String,
    },
    /// A section is missing, or its content is not a value of the requested type.
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
    /// The file does not begin with the first bytes of a checkpoint.
    #[error("it is no checkpoint")]
    Magic,
    /// The file has an unknown version of the format.
    #[error("it has version {found} of the format, not {known}")]
    Version {
        /// Version of the file.
        found: u32,
        /// Version that this crate reads.
        known: u32,
    },
    /// Wrong length: the file is truncated, or has bytes after its checksum.
    #[error("it is cut off, or goes on behind its end")]
    Length,
    /// The bytes of a section have changed since the section was written.
    #[error("its section {number} is not as it was written")]
    Section {
        /// Number of the section, from 0.
        number: usize,
    },
    /// Bytes outside the sections have changed, or the file has no readable identity.
    #[error("it is not as it was written")]
    Whole,
    /// The file cannot be read.
    #[error("it cannot be read: {reason}")]
    Unreadable {
        /// Message of the system.
        reason: String,
    },
}
