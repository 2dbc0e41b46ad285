//! Surfaces of triangles: vectors, and curvature.

pub(crate) mod curvature;
pub mod vector;
