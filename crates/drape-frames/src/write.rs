//! Writing a run to a folder, frame by frame.

pub(crate) mod file;
pub(crate) mod files;
pub(crate) mod npy;
pub(crate) mod writer;
