#![doc = include_str!("../README.md")]
//!
//! # Modules
//!
//! Measured curves become a [`Fabric`] (`drape-fit`) or a file does; a cloth (`drape-cloth`) evaluates
//! its laws at thousands of connectors.
//!
//! * `laws`: the one-dimensional laws of traction, bending and shear, one connector at a time. They are
//!   the definition; everything else is held to them by test.
//! * `batch`: the same laws for many connectors side by side, in loops that are vectorised.
//! * `fabric`, `check`, `file`, `assumed`: the fabric, the range of each of its numbers, its TOML, and the
//!   comments in it.
//! * `breen`: the work curves of Breen, House & Wozny, derived from the laws.

// The laws: for one connector, and for many side by side.
mod batch;
mod laws;

// The fabric and its file.
mod assumed;
mod check;
mod fabric;
mod file;

// Another model of the same fabric.
mod breen;

pub use batch::batch_law::{BatchLaw, Responses};
pub use batch::bending::BendingBatch;
pub use batch::lanes::{LANES, Lanes};
pub use batch::memories::{Memories, MemoriesMut, MemoryBatch};
pub use batch::shear::ShearBatch;
pub use batch::traction::TractionBatch;
pub use breen::{BreenWork, Work, breen_curvature};
pub use check::Problem;
pub use drape_hysteresis::{BlimanSorine, Dahl, Loads, PassedKnot, PreparedDahl, Response, Stroke};
pub use fabric::{Fabric, Provenance, SURFACE_FRICTION, YarnLaws};
#[cfg(feature = "schema")]
pub use file::fabric_schema;
pub use laws::bending::{BendingBackbone, BendingLaw};
pub use laws::law::{Law, Memory, drive};
pub use laws::piecewise::Piecewise;
pub use laws::shear::{Locking, ShearBackbone, ShearLaw};
pub use laws::traction::buckling::{BUCKLING_STRAIN, Buckling, POST_BUCKLING_STIFFNESS};
pub use laws::traction::exponential::{ExponentialToe, STEEPNESS_MIN};
pub use laws::traction::polynomial::Polynomial;
pub use laws::traction::primed::{Primed, TOE_RATIO_MIN};
pub use laws::traction::proportional::{FRICTION_RATIO_MAX, ProportionalFriction};
pub use laws::traction::{TractionBackbone, TractionFriction, TractionLaw};
pub use laws::varying::Varying;
