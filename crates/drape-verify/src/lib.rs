#![doc = include_str!("../README.md")]
//!
//! # Tour
//!
//! [`Verifier`] opens a folder of frames and tests them one by one. A [`Verdict`] says of one frame
//! which [`ClosePair`]s of triangles intersect or lie closer than the run promises.
//! [`triangles_intersect`] is the exact test by itself.
//!
//! Layers, lowest first: `triangle` says which triangles are joined, `intersection` and `distance` test
//! a pair, `grid` finds the pairs; `joints` says which vertices are one point, `mesh` numbers the
//! triangles; `inside` finds cloth in bodies, `verdict` looks at a frame; `verifier` ties frames to
//! their folder.

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
