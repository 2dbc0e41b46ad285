//! Contact of surfaces: triangles against triangles, with every pair certified.

#![allow(clippy::unwrap_used)]

#[path = "../support/mod.rs"]
mod support;

mod broad_phase;
mod derivatives;
mod energy;
mod exact;
mod exactness;
mod layers;
mod oracle;
mod pinch;
mod planted_faults;
mod separations;
mod sheets;
mod stiffness;
mod surfaces;
