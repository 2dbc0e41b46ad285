//! Distances of primitives: closest points of a vertex and a triangle, and of two edges.
//!
//! The closest points are given by weights of the four vertices,
//!
//! ```math
//! p = \sum_i w_i x_i, \qquad d = |p|, \qquad n = p / d, \qquad \nabla d = w \otimes n ,
//! ```
//!
//! and are exact to rounding for slivers and nearly parallel edges too \[Eri05\].
//!
//! The broad phase, the barrier and the step filter take distances from here. This chapter uses
//! vectors only.

mod closest;
mod height;

pub(crate) use closest::{ClosestPoints, edge_edge, vertex_face};
pub(crate) use height::{Height, height};
