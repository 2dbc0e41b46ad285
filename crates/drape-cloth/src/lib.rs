#![doc = include_str!("../README.md")]
//!
//! # Modules
//!
//! ```text
//!   panel ──▶ layout ──▶ kernel, rim ──▶ evaluate
//!  (Lattice)  (arrays)   (one strip)    (Cloth, Workspace)
//!
//!   seam, breen: beside the panels' connectors;  reference: checks the kernels
//! ```
//!
//! [`Cloth::new`] goes from left to right once. A solver calls [`Workspace`] at every trial and
//! [`Workspace::commit`] once per accepted step. `measure` holds the formulas that all modules
//! share.
//!
//! The modules are listed in layers: a module uses modules of its layer and of earlier layers.
#![cfg_attr(docsrs, feature(doc_cfg))]

// Panels before deformation, and the measures of connectors.
mod error;
mod measure;
mod panel;

// Division of work among threads.
mod threads;

// Connectors in arrays, the kernels on them, and their memories.
mod kernel;
mod layout;
mod rim;
mod state;

// Connectors in scalar form: seams, the model of Breen, the reference.
mod breen;
mod reference;
mod seam;

// The cloth and its evaluation.
mod cloth;
mod evaluate;

pub use breen::particles::Breen;
pub use cloth::{Cloth, ConnectorAreas, Strains};
pub use error::Error;
pub use evaluate::workspace::{Trial, Workspace};
pub use layout::sparsity::Sparsity;
pub use measure::block::Block;
pub use measure::triangle_strain::TriangleStrain;
pub use panel::allowance::Allowance;
pub use panel::fold::Fold;
pub use panel::graded::GradedPanel;
pub use panel::grain::Grain;
pub use panel::interpolation::Interpolation;
pub use panel::lattice::{Cell, Lattice};
pub use panel::mesh::Mesh;
pub use reference::cloth::ReferenceCloth;
pub use seam::bending::{SeamBending, SeamBendingState};
pub use seam::description::{Seam, Tie};
pub use state::State;
