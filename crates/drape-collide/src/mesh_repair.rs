//! Meshes of bodies as they come from other programs: inspected, and repaired where that is safe.
//!
//! [`MeshInspection`] says what a triangulation is: size, volume, parts, holes, edges on which its
//! triangles do not agree, triangles without area, intersections with itself. [`repair`] merges,
//! orients, closes small holes and thins, and says what it did ([`RepairNote`]). A body needs a
//! closed surface ([`Mesh`](crate::Mesh)): the caller inspects what `Mesh` refuses, repairs it, and
//! stores the repaired file.
//!
//! `edges` finds the triangles on both sides of each edge; `intersection` tests edges and triangles
//! exactly; `holes`, `orientation` and `thinning` each repair one thing. The chapter uses
//! triangulations (`mesh_io`), closed surfaces (`body`) and the exact predicate of `surface`.

mod edges;
mod holes;
mod inspection;
mod intersection;
mod merge;
mod orientation;
mod quadric;
mod repair;
mod thinning;

pub use holes::Hole;
pub use inspection::{EdgeLengths, MeshInspection, Places};
pub use repair::{RepairNote, RepairSettings, Repaired, repair};
