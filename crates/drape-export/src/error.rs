//! Error of frames that cannot be written in a format.

use std::io;

/// Reason why frames cannot be written in a format.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// The frames cannot be read.
    #[error(transparent)]
    Frames(#[from] drape_frames::Error),
    /// The file cannot be written.
    #[error("{0}")]
    Write(#[from] io::Error),
    /// The rate is out of range.
    #[error("{rate} is no number of frames per second; give one above 0 and up to {limit}")]
    BadRate {
        /// The rate, in frames per second.
        rate: f64,
        /// Largest rate, in frames per second.
        limit: f64,
    },
    /// The first frame comes after the last.
    #[error("there are no frames {first}..{last}; the first is at most the last")]
    NoFrames {
        /// Number of the first frame.
        first: usize,
        /// Number of the last frame.
        last: usize,
    },
    /// The name is no name of a field.
    #[error("there is no field `{key}`; take one of {known}")]
    UnknownField {
        /// Name that was given.
        key: String,
        /// Names of the fields.
        known: String,
    },
    /// The format cannot store as many items.
    #[error("{format} has room for {limit} {what}, and these are {found}; give fewer frames")]
    TooLarge {
        /// The format.
        format: &'static str,
        /// Items that are counted, in words.
        what: &'static str,
        /// Number of items.
        found: usize,
        /// Largest number that the format has room for.
        limit: usize,
    },
}
