//! Triangle meshes and their files.
//!
//! A file in OBJ, STL or PLY format becomes a [`Triangulation`]: vertices and triangles as the file
//! has them, in its unit. A point cache (PC2) adds the positions of the vertices from frame to
//! frame. Files that are cut off or malformed are refused with the reason.
//!
//! Vertices at the same position are merged where a closed surface is made of a triangulation, in
//! the chapter [`body`](crate::body), which is the only user of this one. This chapter uses errors
//! and vectors only.

mod merge;
mod mesh_file;
mod obj;
mod ply;
mod point_cache;
mod stl;
mod triangulation;

pub(crate) use merge::{Merged, doubled_area, merge_coincident_vertices};
pub use mesh_file::{MESH_BYTES_MAX, parse_mesh, read_mesh, read_mesh_within};
pub use point_cache::PointCache;
pub use triangulation::Triangulation;
