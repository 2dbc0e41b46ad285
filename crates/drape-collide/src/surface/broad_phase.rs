//! Broad phase: search for candidate pairs.
//!
//! A pair is a candidate if its distance falls below its activation distance plus a margin `$m$`,
//! at given positions or on straight trajectories from there:
//!
//! ```math
//! \min_t d(x + t\,\Delta x) < \hat d + m
//! ```
//!
//! As long as no vertex drifts by more than half of the margin, no other pair is active. A tree of
//! boxes over primitives in a fixed order finds the candidates. Lists are sorted, so no result
//! depends on the number of threads.
//!
//! [`detector`](super::detector) calls the search. This chapter uses [`geometry`](super::geometry)
//! and [`distance`](super::distance).

mod body_boxes;
mod candidates;
mod margin;
mod query;
mod rest;
mod scan;
mod sweep;
mod tree;

pub(crate) use body_boxes::BodyBoxes;
pub use candidates::CandidatePairs;
pub(crate) use candidates::{Detection, PastDetection, largest};
pub(crate) use margin::AdaptiveMargin;
pub(crate) use query::{PairLimit, PairQuery};
pub(crate) use rest::close_at_rest;
pub(crate) use scan::PairScan;
pub use sweep::Sweep;
pub(crate) use tree::{Bounds, BoxTree, Probe, fill_lanes};
