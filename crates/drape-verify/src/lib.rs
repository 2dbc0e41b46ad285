#![doc = include_str!("../README.md")]
//!
//! # Tour
//!
//! [`Recording`] opens a folder of frames and reads them one by one. A [`Verdict`] says of one frame
//! which [`ClosePair`]s of triangles intersect or lie closer than the [`Manifest`] promises.
//! [`triangles_intersect`] is the exact test by itself.
//!
//! Layers, lowest first: `error`; `manifest` and `obj` read the files; `mesh` numbers the triangles;
//! `triangle` says which are joined, `intersection` and `distance` test a pair, `grid` finds the pairs;
//! `verdict` looks at a frame; `recording` ties the files to it.

// The files of a run.
mod manifest;
mod obj;
mod recording;

// The triangles of a frame.
mod mesh;
mod triangle;

// The tests of a pair, and the pairs to test.
mod distance;
mod grid;
mod intersection;

// The result.
mod error;
mod verdict;

pub use error::Error;
pub use intersection::triangles_intersect;
pub use manifest::{Manifest, Part};
pub use mesh::{Mesh, PartNumber};
pub use recording::Recording;
pub use verdict::{ClosePair, Verdict};
