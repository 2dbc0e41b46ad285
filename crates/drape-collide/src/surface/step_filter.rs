//! Step filter: limits a step of the solver such that no pair comes below its minimum separation.
//!
//! Each vertex moves straight from `$x$` to `$x + t \Delta x$`. A plane between the closest points
//! of a pair proves its distance: if all heights of the first primitive over the plane are at least
//! `$h$` and all heights of the second are at most `$k$`, then `$d \ge h - k$`. Two filters use the
//! plane. Both are continuous collision detection (CCD) with all rounding bounded:
//!
//! - one fraction `$t$` for all vertices, by conservative advancement \[Mir96\],
//! - a fraction for each vertex, by a plane between each pair \[Che26\] that moves with the pair.
//!
//! [`contact`](super::contact) passes trial steps of the solver here. This chapter uses
//! [`tracked_pairs`](super::tracked_pairs) and [`distance`](super::distance).

mod ccd_filter;
mod common_fraction;
mod safeguards;
mod separating_planes;
mod step_limiter;
mod trial;
mod truncation;

pub use ccd_filter::CcdFilter;
pub use common_fraction::{FractionLimit, StepFraction};
#[cfg(test)]
pub(crate) use safeguards::Safeguards;
pub(crate) use step_limiter::StepLimiter;
pub use step_limiter::SurfaceTrial;
pub use truncation::Truncation;
