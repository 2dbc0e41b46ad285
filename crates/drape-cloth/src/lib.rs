#![doc = include_str!("../README.md")]

mod angle;
mod bend;
mod breen;
mod clip;
mod cloth;
mod connectors;
mod energy;
mod error;
mod field;
mod force;
mod grain;
mod lattice;
mod mesh;
mod panel;
mod pattern;
mod reference;
mod rim;
mod scratch;
mod seam;
mod share;
mod state;
mod stiffness;
mod tangent;
mod workspace;

pub use breen::{Block, Breen};
pub use cloth::{Areas, Cloth, Committed, Strains};
pub use error::ClothError;
pub use grain::Grain;
pub use lattice::Lattice;
pub use mesh::Mesh;
pub use pattern::Pattern;
pub use reference::Reference;
pub use seam::{Seam, SeamBending, SeamState};
pub use state::State;
pub use workspace::Workspace;
