//! Distance and time of impact of meshes that a caller moves.

#![allow(clippy::unwrap_used)]

#[path = "../support/mod.rs"]
mod support;

mod distances;
mod impacts;
mod random_motions;
mod refusals;
mod shapes;
