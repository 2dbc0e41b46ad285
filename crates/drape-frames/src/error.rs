//! Errors of reading and writing frames.

use std::path::{Path, PathBuf};

/// Reason why frames cannot be read or written.
///
/// Every variant names one remedy and carries the values that led to it.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// The folder holds no run, or a run of an older version.
    #[error("{} has no surfaces.json; give the folder of a run", folder.display())]
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
    /// A line of a text file differs from any line that a run writes.
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
    /// The run has no frame of the given number.
    #[error("{} has no frame {number}; its frames are 0 to {last}", named(folder.as_deref()))]
    NoFrame {
        /// The folder, or `None` for frames in memory.
        folder: Option<PathBuf>,
        /// Requested number.
        number: usize,
        /// Number of the last frame.
        last: usize,
    },
    /// The folder was written by another version.
    #[error("{} is of format {format}, and this version reads format {known}; run the scene again, or read it with the version that wrote it", path.display())]
    UnknownFormat {
        /// The file.
        path: PathBuf,
        /// Its format.
        format: u64,
        /// Format that is read here.
        known: u64,
    },
    /// A triangle has a corner that is no vertex.
    #[error("triangle {triangle} has a corner that is not among the {vertices} vertices")]
    Corner {
        /// Index of the first such triangle, counted from 0.
        triangle: usize,
        /// Number of vertices.
        vertices: usize,
    },
    /// Frames are missing.
    #[error("{} has {found} of {needed} frames, and {missing} is the first that is missing; run the scene again", folder.display())]
    MissingFrame {
        /// The folder.
        folder: PathBuf,
        /// Name of the first missing file.
        missing: String,
        /// Number of frames in the folder.
        found: usize,
        /// Number of frames that the summary gives, or that the largest frame number implies.
        needed: usize,
    },
    /// A count differs from the count in surfaces.json: the file is cut off, or belongs to another
    /// run.
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
    /// A triangle has a vertex of another part as a corner, or its corners differ from the first
    /// frame.
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
    /// A frame in memory does not fit the parts of its run.
    #[error("frame {number}: {reason}")]
    BadFrame {
        /// Number of the frame, from 0.
        number: usize,
        /// Fault, in words.
        reason: String,
    },
    /// The triangles or the material coordinates in memory do not fit the parts of the run.
    #[error("the topology does not fit the parts: {reason}")]
    BadTopology {
        /// Fault, in words.
        reason: String,
    },
    /// Frames that a state of a writer counts are missing.
    #[error("{} has {found} frames, of {frames} that the checkpoint counts; run the scene again", path.display())]
    LostFrames {
        /// The list of frames.
        path: PathBuf,
        /// Number of frames in the list.
        found: usize,
        /// Number of frames that the state of the writer counts.
        frames: usize,
    },
    /// The folder holds results.
    #[error("{} holds results already; give another folder, or allow the replacement", folder.display())]
    Occupied {
        /// The folder.
        folder: PathBuf,
    },
    /// A file cannot be written.
    #[error("cannot write {}: {reason}", path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// Answer of the operating system.
        reason: String,
    },
}

/// Returns the name of a run in messages: its `folder`, if it has one.
fn named(folder: Option<&Path>) -> String {
    folder.map_or_else(|| "the recording".to_owned(), |folder| folder.display().to_string())
}

impl Error {
    /// Returns the error of a file or folder `path` that the operating system cannot read.
    pub(crate) fn unreadable(path: &Path, error: &std::io::Error) -> Error {
        Error::Unreadable { path: path.to_owned(), reason: error.to_string() }
    }

    /// Returns the error of a file or folder `path` that the operating system cannot write.
    pub(crate) fn unwritable(path: &Path, error: &std::io::Error) -> Error {
        Error::Write { path: path.to_owned(), reason: error.to_string() }
    }

    /// Returns the error of a fault in a line of the text file `path`.
    pub(crate) fn malformed(path: &Path, line: usize, reason: impl Into<String>) -> Error {
        Error::Malformed { path: path.to_owned(), line, reason: reason.into() }
    }
}
