//! Barrier of a pair of primitives: energy, gradient and second derivative.
//!
//! ```math
//! E = k A\, m\, b(d - \xi)
//! ```
//!
//! The two-stage barrier `$b$` is infinite at the minimum separation `$\xi$` \[Li21\]. The
//! mollifier `$m$` makes the energy of two edges continuous where they become parallel
//! \[Li20, §5\]. All pairs of vertices with triangles and of edges are summed, whatever features
//! the closest points lie on.
//!
//! [`contact`](super::contact) evaluates a [`Gap`] for each active pair. This chapter uses pairs,
//! [`distance`](super::distance) and the scalar [`Barrier`](crate::barrier::Barrier).

mod gap;
mod mollifier;

pub use gap::{Gap, GaussNewton, Gradient, Hessian};
