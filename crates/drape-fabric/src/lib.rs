#![doc = include_str!("../README.md")]

mod bending;
mod fabric;
mod file;
mod law;
mod path;
mod piecewise;
mod shear;
mod traction;

pub use bending::{BendingBackbone, BendingLaw};
pub use drape_hysteresis::{BlimanSorine, Dahl};
pub use fabric::{Direction, Fabric, Problem, Provenance, SURFACE_FRICTION};
pub use law::{Law, Memory, Response, drive};
pub use piecewise::Piecewise;
pub use shear::{Locking, ShearBackbone, ShearLaw};
pub use traction::{
    BUCKLING_STRAIN, Buckling, POST_BUCKLING_STIFFNESS, Polynomial, Primed, TOE_RATIO_MIN,
    TractionBackbone, TractionLaw,
};
