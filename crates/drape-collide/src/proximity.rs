//! Distance and time of impact of meshes that a caller moves: triangles, edges and points, without
//! areas, groups and seams.
//!
//! Each [`ProximityMesh`](mesh) has a tree of boxes. Two trees are descended together:
//!
//! - [`distance`](mesh_distance): branch and bound. A pair of boxes that is farther apart than the
//!   nearest pair of primitives so far is left out,
//! - [`impact`]: the boxes move linearly, and a pair of boxes that meets later than the earliest
//!   pair of primitives so far is left out.
//!
//! Each vertex and each edge belongs to one triangle of its mesh (representative triangles
//! \[Cur08\]), so no two primitives are compared twice. [`first_contact`] finds the time of impact
//! of two primitives. This chapter uses vectors, errors, and the closest points and exact
//! predicates of [`surface`](crate::surface).

mod boxes;
mod coplanarity;
mod first_contact;
mod impact;
mod leaf;
mod mesh;
mod mesh_distance;
mod primitive;

pub use impact::{Impact, earliest_impact, earliest_self_impact};
pub use mesh::{MeshMotion, ProximityMesh};
pub use mesh_distance::{MeshDistance, mesh_distance};
pub use primitive::{Primitive, PrimitivePair};
