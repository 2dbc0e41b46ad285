//! Triangle meshes and their files.
//!
//! A file in OBJ, STL or PLY format becomes a [`Triangulation`] with the vertices, the triangles
//! and the unit of the file. A point cache (PC2) adds the positions of the vertices from frame to
//! frame. Files that are cut off or malformed are refused with the reason.
//!
//! The chapter [`body`](crate::body) builds closed surfaces from triangulations, and merges
//! vertices at one position there. This chapter uses errors and vectors only.

mod merge;
mod mesh_file;
#[cfg(feature = "mesh-files")]
mod obj;
#[cfg(feature = "mesh-files")]
mod ply;
mod point_cache;
#[cfg(feature = "mesh-files")]
mod stl;
mod triangulation;

pub(crate) use merge::{MergedMesh, doubled_area, merge_coincident_vertices};
pub use mesh_file::{MESH_BYTES_MAX, parse_mesh, read_mesh, read_mesh_within};
pub use point_cache::PointCache;
pub use triangulation::Triangulation;
