#![doc = include_str!("../README.md")]

mod boundary;
mod crossing;
mod cut;
mod cutter;
mod edge;
mod figure;
mod file;
mod freesewing;
mod garmentcode;
mod grid;
mod joining;
mod joints;
mod lattice;
mod mistake;
mod note;
mod panel;
mod path;
mod pattern;
mod placement;
mod quality;
mod read;
mod rim;

pub use boundary::{NodeId, SeamNodes, Tie};
pub use cut::{Cut, CutPattern};
pub use cutter::Cutter;
pub use edge::{Curve, Edge};
pub use figure::figure;
pub use mistake::{Error, Mistake, Subject};
pub use note::Note;
pub use panel::{Fold, Panel};
pub use pattern::{EdgeId, MAX_EASE, Pattern, Stitch};
pub use placement::Placement;
pub use quality::Quality;
