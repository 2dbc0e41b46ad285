#![doc = include_str!("../README.md")]
//!
//! # Tour
//!
//! [`Verifier`] opens a folder of frames and tests each frame. A [`Verdict`] lists the
//! [`ClosePair`]s of triangles of a frame that intersect or are closer than the run promises.
//! [`triangles_intersect`] is the exact test of two triangles.
//!
//! Layers, lowest first:
//!
//! * `triangle` decides which triangles are joined.
//! * `intersection` and `distance` test a pair, and `grid` finds the pairs.
//! * `joints` decides which vertices are one point, and `mesh` numbers the triangles.
//! * `inside` finds cloth in bodies, and `verdict` tests a frame.
//! * `verifier` reads the frames of a folder.

// The triangles of a frame.
mod joints;
mod mesh;
mod triangle;

// The tests of a pair, and the pairs to test.
mod distance;
mod grid;
mod intersection;

// The result.
mod inside;
mod verdict;
mod verifier;

pub use drape_frames::Error;
pub use inside::EnclosedPiece;
pub use intersection::triangles_intersect;
pub use mesh::{Mesh, PartNumber};
pub use verdict::{ClosePair, Verdict};
pub use verifier::Verifier;
