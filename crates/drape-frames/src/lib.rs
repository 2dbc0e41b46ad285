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
//! * `text`, `array` and `obj` read files.
//! * `manifest`, `topology`, `index` and `energy_table` are the data that all frames share.
//! * `obj_frames` and `array_frames` read a frame of either format.
//! * `recording` reads a folder in either format.
//!
//! `surface` measures surfaces of triangles.

mod error;

// Files.
mod array;
mod obj;
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
mod obj_frames;
mod recording;

pub use energy_table::EnergyTable;
pub use error::Error;
pub use frame::Frame;
pub use manifest::{Manifest, SurfacePart};
pub use recording::Recording;
pub use surface::curvature::curvatures;
pub use surface::vector;
pub use topology::Topology;
