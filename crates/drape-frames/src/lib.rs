#![doc = include_str!("../README.md")]
//!
//! # Tour
//!
//! [`Recording`] opens a folder and reads each [`Frame`]. The [`Manifest`] names the panels and
//! bodies, the [`Topology`] has their triangles.
//!
//! Layers, lowest first:
//!
//! * `error`.
//! * `text` and `array` read files.
//! * `manifest`, `topology`, `index` and `energy_table` are the data that all frames share.
//! * `array_frames` reads a frame, and `recording` a folder.
//!
//! `surface` measures surfaces of triangles. [`samples`] writes runs for examples and tests.

mod error;

// Files.
mod array;
mod text;

// Data that all frames share.
mod energy_table;
mod index;
mod manifest;
mod topology;

// Surfaces.
mod surface;

// Frames.
mod array_frames;
mod frame;
mod recording;

// Runs for examples and tests.
pub mod samples;

pub use energy_table::EnergyTable;
pub use error::Error;
pub use frame::Frame;
pub use manifest::{Manifest, SurfacePart};
pub use recording::Recording;
pub use surface::curvature::curvatures;
pub use surface::vector;
pub use topology::Topology;
