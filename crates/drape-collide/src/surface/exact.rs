//! Exact tests: intersections of edges with triangles, and points inside bodies.
//!
//! The predicates are exact for the rounded positions \[She97\], by the crate `robust`. Touching
//! counts as an intersection. A point is inside a body if the triangles of the body fill the whole
//! sphere around the point.
//!
//! [`contact`](super::contact) runs the test on every accepted step, as a proof that does not
//! depend on the step filter. This chapter uses the surface and the tree of the broad phase.

mod intersections;
mod predicate;
mod winding;

pub use intersections::{Intersection, intersections};
pub(crate) use intersections::{IntersectionTest, exempt_intersections};
pub use predicate::segment_meets_triangle;
pub(crate) use winding::encloses;
