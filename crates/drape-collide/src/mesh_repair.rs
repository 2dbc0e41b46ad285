//! Meshes of bodies as other programs wrote them: inspected, and repaired where that is safe.
//!
//! [`MeshInspection`] describes a triangulation: size, volume, parts, holes, edges on which
//! triangles disagree, triangles without area, and self-intersections. [`repair`] merges, orients,
//! closes small holes and thins, and reports each change as a [`RepairNote`]. A body needs a closed
//! surface ([`Mesh`](crate::Mesh)): the caller inspects what `Mesh` refuses, repairs it, and stores
//! the repaired file.
//!
//! `edges` finds the triangles on both sides of each edge. `intersection` tests edges and triangles
//! exactly. `holes`, `orientation` and `thinning` repair one kind of fault each. The chapter uses
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
pub use inspection::{EdgeLengths, FaultPlaces, MeshInspection};
pub use repair::{RepairNote, RepairSettings, RepairedMesh, repair};
