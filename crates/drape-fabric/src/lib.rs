#![doc = include_str!("../README.md")]
//!
//! # Modules
//!
//! A [`Fabric`] comes from measured curves (`drape-fit`) or from a file. A cloth (`drape-cloth`)
//! evaluates the laws of the fabric at thousands of connectors.
//!
//! * `laws`: the one-dimensional laws of traction, bending and shear, for one connector. These laws
//!   are the definition. Tests compare all other forms with them.
//! * `batch`: the laws for many connectors side by side, in vectorised loops.
//! * `fabric`, `check`, `file`, `assumed`: the fabric, the admissible range of each number, the
//!   TOML file, and the comments in the file.
//! * [`samples`]: fabrics for examples and tests.
//! * `breen`: the work curves of Breen, House & Wozny, derived from the laws.
#![cfg_attr(docsrs, feature(doc_cfg))]

// The laws for one connector, and for many side by side.
mod batch;
mod laws;

// The fabric and its file.
mod assumed;
mod check;
mod fabric;
mod file;

// Work curves for another model of cloth.
mod breen;

// Fabrics for examples and tests.
pub mod samples;

pub use batch::batch_law::{BatchLaw, Responses};
pub use batch::bending::BendingBatch;
pub use batch::lanes::{LANES, Lanes};
pub use batch::memories::{Memories, MemoriesMut, MemoryBatch};
pub use batch::shear::ShearBatch;
pub use batch::traction::TractionBatch;
pub use breen::{BreenWork, Work, breen_curvature};
pub use check::Problem;
pub use drape_hysteresis::{
    BlimanSorine, Dahl, Error as FrictionError, Loads, PassedKnot, PreparedDahl, Response, Stroke,
};
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
