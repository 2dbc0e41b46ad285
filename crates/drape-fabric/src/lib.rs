#![doc = include_str!("../README.md")]

mod batch;
mod bending;
mod bending_batch;
mod breen;
mod fabric;
mod file;
mod law;
mod memories;
mod path;
mod piecewise;
mod shear;
mod shear_batch;
mod traction;
mod traction_batch;

pub use batch::{BatchLaw, LANES, Lanes, Responses, Sliders};
pub use bending::{BendingBackbone, BendingLaw};
pub use bending_batch::BendingBatch;
pub use breen::{BreenWork, Work, breen_curvature};
pub use drape_hysteresis::{BlimanSorine, Dahl};
pub use fabric::{Direction, Fabric, Problem, Provenance, SURFACE_FRICTION};
pub use law::{Law, Memory, Response, drive};
pub use memories::{Lane, Memories, Moving, Remembered};
pub use piecewise::Piecewise;
pub use shear::{Locking, ShearBackbone, ShearLaw};
pub use shear_batch::ShearBatch;
pub use traction::{
    BUCKLING_STRAIN, Buckling, POST_BUCKLING_STIFFNESS, Polynomial, Primed, TOE_RATIO_MIN,
    TractionBackbone, TractionLaw,
};
pub use traction_batch::TractionBatch;
