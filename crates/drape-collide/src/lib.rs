#![doc = include_str!("../README.md")]

mod barrier;
mod body;
mod contact;
mod detect;
mod error;
mod friction;
mod mesh;
mod obj;
mod pose;
mod primitive;
mod proximity;
mod survey;
mod triangulate;
mod vector;

pub use body::{Body, Shape};
pub use contact::{Contact, Settings};
pub use error::CollideError;
pub use mesh::Mesh;
pub use pose::Pose;
pub use proximity::Proximity;
pub use survey::Survey;
pub use triangulate::Outline;
