//! Geometry of surfaces of triangles: vectors and curvatures.

pub(crate) mod curvature;
pub mod vector;
