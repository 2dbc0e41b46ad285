//! Cutting of a checked pattern into particles at a spacing.
//!
//! 1. `breakpoint` finds the points of the outlines that become nodes: ends of edges, and notches
//!    opposite to them across seams. `simplify` removes breakpoints between pieces shorter than
//!    half a spacing, or merges two of them (`collapse`).
//! 2. `sampling` divides each piece of outline into equal arcs: `$n = \mathrm{round}(L/h)$` of them
//!    for a length `$L$` and a spacing `$h$`. Both sides of a seam have the same number; in a
//!    gather the longer side has a multiple of it. `sampling` places the nodes and pairs them
//!    (`seam_nodes`).
//! 3. `cutter` cuts each panel: `rectangle` where the outline is the border of a grid along the
//!    grain, else a `lattice` inside the outline and a `rim` of triangles between them. Both give a
//!    `panel_cut`.
//! 4. `quality` measures a cut. `cut_pattern` holds the cuts of all panels.
//!
//! The chapter uses only the model (`pattern`, `panel`, `edge`) and hands a [`CutPattern`] to the
//! scene.

mod breakpoint;
mod collapse;
mod cut_pattern;
mod cutter;
mod lattice;
mod merge;
mod panel_cut;
mod quality;
mod rectangle;
mod region;
mod rim;
mod sampling;
mod seam_nodes;
mod simplify;

pub use cut_pattern::CutPattern;
pub use cutter::Cutter;
pub use panel_cut::Cut;
pub use quality::Quality;
pub use seam_nodes::{NodeId, SeamNodes, Tie};
