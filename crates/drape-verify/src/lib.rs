#![doc = include_str!("../README.md")]

mod distance;
mod error;
mod grid;
mod intersection;
mod manifest;
mod mesh;
mod recording;
mod verdict;
mod wavefront;

pub use error::VerifyError;
pub use manifest::{Manifest, Part};
pub use mesh::{Mesh, PartNumber};
pub use recording::Recording;
pub use verdict::{Place, Verdict};
