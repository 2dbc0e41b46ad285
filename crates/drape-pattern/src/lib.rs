#![doc = include_str!("../README.md")]
//!
//! # Tour
//!
//! [`Pattern::read`] reads a file and returns a checked [`Pattern`]: [`Panel`]s, whose outlines are
//! chains of [`Edge`]s, and [`Seam`]s between them. [`Cutter::cut`] cuts a pattern into particles
//! and returns a [`CutPattern`]: a [`Cut`] of each panel and the [`SeamNodes`] of each seam.
//! [`Quality`] measures a cut, [`figure`] draws a cut pattern. A fault of a pattern is a
//! [`Mistake`] with a remedy, in an [`Error`] or in diagnostics of the file. A remark that prevents
//! nothing is a [`PatternNote`].
//!
//! Layers, lowest first: `length`, `ease`, `edge`, `polygon`; `mistake`, `note`, `error`; the
//! chapters `panel` and `pattern`, `sketch`; the chapters `read` and `cut`; `write`.
#![cfg_attr(docsrs, feature(doc_cfg))]

// Geometry of outlines.
mod edge;
mod polygon;

// The pattern.
mod ease;
mod panel;
mod pattern;
mod sketch;

// Mistakes and notes.
mod error;
mod length;
mod mistake;
mod note;

// Files become patterns, patterns become particles.
mod cut;
mod read;

// Patterns and cuts are written to files.
mod write;

pub use cut::{Cut, CutPattern, Cutter, NodeId, Quality, SeamNodes, Tie};
pub use ease::{DEFAULT_EASE, MAX_EASE};
pub use edge::{Curve, Edge};
pub use error::Error;
pub use mistake::Mistake;
pub use note::PatternNote;
pub use panel::dart::{Dart, OpenDart};
pub use panel::placement::Placement;
pub use panel::{Fold, Panel};
pub use pattern::Pattern;
pub use pattern::seam::{EdgeId, Seam};
#[cfg(feature = "schema")]
pub use read::pattern_schema;
pub use read::{PatternTable, Request, SeamKeys, Unit};
pub use sketch::{Sketch, SketchFault};
pub use write::{DxfDrawing, Page, Paper, figure, seam_colour};
