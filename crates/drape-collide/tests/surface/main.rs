//! Contact of surfaces: triangles against triangles, with every pair certified.

#![allow(clippy::unwrap_used)]

#[path = "../support/mod.rs"]
mod support;

mod broad_phase;
mod derivatives;
mod layers;
mod sheets;
