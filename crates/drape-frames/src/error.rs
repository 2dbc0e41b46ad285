//! Error of a folder of frames that cannot be read.

use std::path::PathBuf;

/// Reason why recorded frames cannot be read.
///
/// Every variant names one remedy and carries the values that led to it.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// The folder holds no run, or one of an older version.
    #[error("{} has no surfaces.json; give the folder that `drape run` wrote its frames to", folder.display())]
    NotARun {
        /// The folder.
        folder: PathBuf,
    },
    /// A file cannot be opened or read.
    #[error("cannot read {}: {reason}; check the path and the permissions", path.display())]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// Answer of the operating system.
        reason: String,
    },
    /// A file is larger than any frame can be.
    #[error("{} has {bytes} bytes, and no frame has more than {limit}", path.display())]
    TooLarge {
        /// The file.
        path: PathBuf,
        /// Its length, in bytes.
        bytes: u64,
        /// Largest length that is read, in bytes.
        limit: u64,
    },
    /// A file is not as the run wrote it.
    #[error("{}, line {line}: {reason}; run the scene again", path.display())]
    Malformed {
        /// The file.
        path: PathBuf,
        /// Number of the line, from 1.
        line: usize,
        /// Fault, in words.
        reason: String,
    },
    /// A file is not the array that the run wrote.
    #[error("{}: {reason}; run the scene again", path.display())]
    BadArray {
        /// The file.
        path: PathBuf,
        /// Fault, in words.
        reason: String,
    },
    /// There is no frame of that number.
    #[error("{} has no frame {number}; its frames are 0 to {last}", folder.display())]
    NoFrame {
        /// The folder.
        folder: PathBuf,
        /// Number that was asked for.
        number: usize,
        /// Number of the last frame.
        last: usize,
    },
    /// The folder was written by a newer version.
    #[error("{} is of format {format}, and this version reads formats up to {known}; read it with the version that wrote it", path.display())]
    UnknownFormat {
        /// The file.
        path: PathBuf,
        /// Its format.
        format: u64,
        /// Newest format that is read here.
        known: u64,
    },
    /// Frames are missing.
    #[error("{} has {found} of {needed} frames, and {missing} is the first that is missing; run the scene again", folder.display())]
    MissingFrame {
        /// The folder.
        folder: PathBuf,
        /// First file that is missing.
        missing: String,
        /// Number of frames in the folder.
        found: usize,
        /// Number of frames that the summary gives, or that the largest frame number implies.
        needed: usize,
    },
    /// A count differs from that in surfaces.json: the file is cut off, or belongs to another run.
    #[error("{} has {found} {what}, and surfaces.json says {needed}: it is cut off, or of another run", path.display())]
    WrongCount {
        /// The file.
        path: PathBuf,
        /// Counted items, in words.
        what: &'static str,
        /// Number in the file.
        found: usize,
        /// Number that surfaces.json gives.
        needed: usize,
    },
    /// A triangle names a vertex of another part, or has other corners than in the first frame.
    #[error("{}: triangle {triangle} has the corners {corners:?} (from 0): {reason}; run the scene again", path.display())]
    BadTriangle {
        /// The file.
        path: PathBuf,
        /// Number of the triangle, from 0.
        triangle: usize,
        /// Numbers of its corners, from 0.
        corners: [u32; 3],
        /// Fault, in words.
        reason: &'static str,
    },
}
