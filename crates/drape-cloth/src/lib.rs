#![doc = include_str!("../README.md")]

mod bending;
mod cloth;
mod error;
mod lattice;
mod pattern;
mod shear;
mod state;
mod tangent;
mod traction;
mod vector;

pub use cloth::{Areas, Cloth, Committed, Strains};
pub use error::ClothError;
pub use lattice::Lattice;
pub use pattern::Pattern;
pub use state::State;
