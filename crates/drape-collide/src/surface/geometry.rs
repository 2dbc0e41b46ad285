//! Surface at rest: constant data of all primitives and pairs.
//!
//! From the triangles at rest follow their edges, the area of each primitive (vertex, edge,
//! triangle), the order of the primitives in space, and the distances of each pair:
//!
//! ```math
//! \hat d_{ij} = \hat d_i + \hat d_j, \qquad \xi_{ij} = \xi_i + \xi_j
//! ```
//!
//! The distances are smaller where two primitives lie close at rest, where distances still grow,
//! where bodies pinch cloth, and between the sides of an open seam. Primitives that share a vertex,
//! or that a closed seam joins, are exempt.
//!
//! The broad phase reads this data. This chapter uses vectors, errors and
//! [`mesh_io`](crate::mesh_io).

mod order;
mod parts;
mod plain_mesh;
mod primitives;
mod seam_exemptions;
mod separations;
mod topology;

pub(crate) use order::{PrimitiveRun, SpatialOrder, WIDTH};
pub use parts::{ContactDistances, SurfaceParts};
pub use plain_mesh::PlainMesh;
pub(crate) use primitives::Primitives;
pub(crate) use seam_exemptions::SeamExemptions;
pub(crate) use separations::{
    PinchState, RestProximity, Separations, THINNED_FRACTION, share_vertex,
};
pub(crate) use topology::classes;
pub use topology::equivalence_classes;
