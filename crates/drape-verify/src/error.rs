use std::path::PathBuf;

/// Why recorded frames cannot be checked.
///
/// Every variant names one remedy and carries the values that led to it.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum VerifyError {
    /// The folder is none of a run, or of one by an older version.
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
        /// What the operating system answered.
        reason: String,
    },
    /// A file is larger than any frame.
    #[error("{} has {bytes} bytes, and no frame has more than {limit}", path.display())]
    TooLarge {
        /// The file.
        path: PathBuf,
        /// Its length.
        bytes: u64,
        /// The greatest length.
        limit: u64,
    },
    /// A file is not as the run wrote it.
    #[error("{}, line {line}: {reason}; run the scene again", path.display())]
    Malformed {
        /// The file.
        path: PathBuf,
        /// The line, from 1.
        line: usize,
        /// What is wrong with it.
        reason: String,
    },
    /// The folder was written by a newer version.
    #[error("{} is of format {format}, and this version reads format {known}; check it with the version that wrote it", path.display())]
    UnknownFormat {
        /// The file.
        path: PathBuf,
        /// Its format.
        format: u64,
        /// The one that is known.
        known: u64,
    },
    /// Frames are missing.
    #[error("{} has {found} of {needed} frames, and {missing} is the first that is missing; run the scene again", folder.display())]
    MissingFrame {
        /// The folder.
        folder: PathBuf,
        /// The file.
        missing: String,
        /// Frames that are there.
        found: usize,
        /// Frames that the run says it wrote, or that the largest number calls for.
        needed: usize,
    },
    /// A file has not as much of something as surfaces.json says: it is cut off, or of another run.
    #[error("{} has {found} {what}, and surfaces.json says {needed}: it is cut off, or of another run", path.display())]
    WrongCount {
        /// The file.
        path: PathBuf,
        /// Of what.
        what: &'static str,
        /// How many there are.
        found: usize,
        /// How many there should be.
        needed: usize,
    },
    /// A triangle names a vertex that is not of its part, or has not the corners it has in the first frame.
    #[error("{}: triangle {triangle} has the corners {corners:?} (from 0): {reason}; run the scene again", path.display())]
    BadTriangle {
        /// The file.
        path: PathBuf,
        /// The triangle, from 0.
        triangle: usize,
        /// Its corners.
        corners: [u32; 3],
        /// What is wrong with it.
        reason: &'static str,
    },
}
