#![doc = include_str!("../README.md")]

mod barrier;
mod body;
mod closest;
mod contact;
mod detect;
mod detector;
mod error;
mod friction;
mod gap;
mod mesh;
mod mollifier;
mod obj;
mod order;
mod pair;
mod pose;
mod primitive;
mod proximity;
mod surface;
mod survey;
mod topology;
mod tree;
mod triangulate;
mod vector;

pub use body::{Body, Shape};
pub use contact::{Contact, Settings};
pub use detector::{Detector, Pairs};
pub use error::CollideError;
pub use gap::{Gap, Gradient, Hessian};
pub use mesh::Mesh;
pub use pair::{Kind, Pair};
pub use pose::Pose;
pub use proximity::Proximity;
pub use surface::{Skin, Surface, SurfaceParts};
pub use survey::Survey;
pub use triangulate::Outline;
