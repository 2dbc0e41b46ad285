//! Surface at rest: what never changes while it moves.
//!
//! From triangles at rest come their edges, the area that each primitive (vertex, edge, triangle)
//! stands for, the order of the primitives in space, and the distances of each pair:
//!
//! ```math
//! \hat d_{ij} = \hat d_i + \hat d_j, \qquad \xi_{ij} = \xi_i + \xi_j
//! ```
//!
//! or less where two primitives lie close at rest, where distances still grow, where bodies pinch and
//! between the sides of an open seam. Primitives that share a vertex, or are joined by a closed seam,
//! are exempt.
//!
//! The broad phase reads all of this. This chapter uses vectors, errors and
//! [`mesh_io`](crate::mesh_io).

mod order;
mod parts;
mod primitives;
mod seam_exemptions;
mod separations;
mod topology;

pub(crate) use order::{Order, Run, WIDTH};
pub use parts::{ContactDistances, SurfaceParts};
pub(crate) use primitives::Primitives;
pub(crate) use separations::{
    PinchState, RestProximity, Separations, THINNED_FRACTION, share_vertex,
};
pub use topology::equivalence_classes;
