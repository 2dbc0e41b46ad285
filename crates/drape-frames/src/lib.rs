#![doc = include_str!("../README.md")]
//!
//! # Tour
//!
//! [`Recording`] opens a folder and reads each [`Frame`]. The [`Manifest`] names the panels and
//! bodies, the [`Topology`] has their triangles. A recording may also have its frames in memory, or
//! from a [`FrameSource`]. [`FrameWriter`] writes a folder.
//!
//! Layers, lowest first:
//!
//! * `error`.
//! * `text` and `array` read files.
//! * `manifest`, `topology` and `energy_table` are the data that all frames share.
//! * `frame` is one frame, and `source` is where frames come from: a folder, memory, or a program.
//! * `recording` gives the frames of a source one by one.
//! * `write` writes a folder.
//!
//! `surface` measures surfaces of triangles. [`samples`] writes runs for examples and tests.

mod error;

// Files.
mod array;
mod text;

// Data that all frames share.
mod energy_table;
mod manifest;
mod topology;

// Surfaces.
mod surface;

// Frames.
mod frame;
mod frame_hash;
mod recording;
mod source;

// Writing.
mod write;

// Runs for examples and tests.
pub mod samples;

pub use energy_table::EnergyTable;
pub use error::Error;
pub use frame::Frame;
pub use manifest::{CLOSED_GAP, Manifest, SurfacePart};
pub use recording::Recording;
pub use source::FrameSource;
pub use surface::curvature::curvatures;
pub use surface::vector;
pub use topology::Topology;
pub use write::writer::{FrameWriter, SavedWriter, prepare_folder, write_summary};
